#include "cast/glb.h"

#include "cast/need.h"
#include "lib/file.h"

void text_open(struct text *text)
{
    *text = (struct text){ 0 };
    text->f = need(open_memstream(&text->data, &text->size));
}

void text_close(struct text *text)
{
    if (text->f) fclose(text->f);
    text->f = NULL;
}

void glb_open(struct glb *glb)
{
    *glb = (struct glb){ 0 };
    text_open(&glb->bytes), text_open(&glb->views), text_open(&glb->accessors);
}

int glb_view(struct glb *glb, const void *data, size_t bytes, enum target target, size_t stride)
{
    FILE *f = glb->views.f;
    fprintf(f, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu", glb->view_count ? "," : "", glb->size, bytes);
    if (target) fprintf(f, ",\"target\":%d", (int)target);
    if (stride) fprintf(f, ",\"byteStride\":%zu", stride);
    fputc('}', f);
    fwrite(data, 1, bytes, glb->bytes.f);
    for (glb->size += bytes; glb->size % 4; glb->size++) fputc(0, glb->bytes.f);
    return glb->view_count++;
}

int glb_accessor(struct glb *glb, int view, size_t offset, size_t count, enum component component, bool normalized, const char *type, const char *limits)
{
    fprintf(glb->accessors.f, "%s{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,%s\"count\":%zu,\"type\":\"%s\"%s}",
            glb->accessor_count ? "," : "", view, offset, (int)component, normalized ? "\"normalized\":true," : "", count, type, limits);
    return glb->accessor_count++;
}

void glb_lists(struct glb *glb, FILE *json)
{
    text_close(&glb->views), text_close(&glb->accessors);
    fprintf(json, "\"buffers\":[{\"byteLength\":%zu}],\"bufferViews\":[%s],\"accessors\":[%s],", glb->size, glb->views.data, glb->accessors.data);
}

static void write_u32(FILE *f, size_t value)
{
    for (int k = 0; k < 4; k++) fputc((int)(value >> 8 * k & 255), f);
}

bool glb_write(const char *path, struct glb *glb, struct text *json, struct error *err)
{
    struct text *bytes = &glb->bytes, file;
    while (ftell(json->f) % 4) fputc(' ', json->f);
    text_close(json), text_close(bytes), text_close(&glb->views), text_close(&glb->accessors);
    text_open(&file);
    fwrite("glTF\2\0\0\0", 1, 8, file.f);
    write_u32(file.f, 12 + 8 + json->size + 8 + bytes->size);
    write_u32(file.f, json->size);
    fwrite("JSON", 1, 4, file.f);
    fwrite(json->data, 1, json->size, file.f);
    write_u32(file.f, bytes->size);
    fwrite("BIN\0", 1, 4, file.f);
    fwrite(bytes->data, 1, bytes->size, file.f);
    text_close(&file);
    bool good = file_write(path, file.data, file.size, err);
    free(file.data), free(json->data), free(bytes->data), free(glb->views.data), free(glb->accessors.data);
    return good;
}

void glb_place(float to[3], struct vec3 p) { to[0] = (float)p.y, to[1] = (float)p.z, to[2] = (float)p.x; }

void glb_limits(char text[LIMITS_SIZE], const float *values, size_t count, size_t n, size_t stride)
{
    float low[3] = { 1e9f, 1e9f, 1e9f }, high[3] = { -1e9f, -1e9f, -1e9f };
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < n; k++) {
            float value = values[i * stride + k];
            low[k] = value < low[k] ? value : low[k];
            high[k] = value > high[k] ? value : high[k];
        }
    int used = snprintf(text, LIMITS_SIZE, ",\"min\":[");
    for (size_t k = 0; k < n; k++) used += snprintf(text + used, LIMITS_SIZE - (size_t)used, "%s%.9g", k ? "," : "", (double)low[k]);
    used += snprintf(text + used, LIMITS_SIZE - (size_t)used, "],\"max\":[");
    for (size_t k = 0; k < n; k++) used += snprintf(text + used, LIMITS_SIZE - (size_t)used, "%s%.9g", k ? "," : "", (double)high[k]);
    snprintf(text + used, LIMITS_SIZE - (size_t)used, "]");
}

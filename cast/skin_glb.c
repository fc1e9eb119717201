#include "cast/skin_glb.h"

#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A file in the making: bytes, and the JSON lists that tell what they are. */
struct text { FILE *f; char *data; size_t size; };
struct out { struct text bytes, views, accessors; size_t size; int view_count, accessor_count; };

static void open_text(struct text *text)
{
    *text = (struct text){ 0 };
    text->f = open_memstream(&text->data, &text->size);
    if (!text->f) abort();
}

static void close_text(struct text *text)
{
    if (text->f) fclose(text->f);
    text->f = NULL;
}

enum component { U8 = 5121, I16 = 5122, U16 = 5123, F32 = 5126 };
enum target { NO_TARGET, VERTICES = 34962, INDICES = 34963 };

/* stride: of one vertex; 0 where that goes without saying */
static int add_view(struct out *out, const void *data, size_t bytes, enum target target, size_t stride)
{
    fprintf(out->views.f, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu", out->view_count ? "," : "", out->size, bytes);
    if (target) fprintf(out->views.f, ",\"target\":%d", (int)target);
    if (stride) fprintf(out->views.f, ",\"byteStride\":%zu", stride);
    fputc('}', out->views.f);
    fwrite(data, 1, bytes, out->bytes.f);
    for (out->size += bytes; out->size % 4; out->size++) fputc(0, out->bytes.f);
    return out->view_count++;
}

static int add_accessor(struct out *out, int view, size_t offset, size_t count, enum component component, bool normalized, const char *type,
                        const char *limits)
{
    fprintf(out->accessors.f, "%s{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,%s\"count\":%zu,\"type\":\"%s\"%s}",
            out->accessor_count ? "," : "", view, offset, (int)component, normalized ? "\"normalized\":true," : "", count, type, limits);
    return out->accessor_count++;
}

/* Forward, left, up become z, x, y. */
static void to_file(float to[3], struct vec3 p) { to[0] = (float)p.y, to[1] = (float)p.z, to[2] = (float)p.x; }

static void limits_of(char *text, size_t size, const float *values, size_t count, size_t n)
{
    float low[3] = { 1e9f, 1e9f, 1e9f }, high[3] = { -1e9f, -1e9f, -1e9f };
    for (size_t i = 0; i < count * n; i++) {
        low[i % n] = values[i] < low[i % n] ? values[i] : low[i % n];
        high[i % n] = values[i] > high[i % n] ? values[i] : high[i % n];
    }
    int used = snprintf(text, size, ",\"min\":[");
    for (size_t k = 0; k < n; k++) used += snprintf(text + used, size - (size_t)used, "%s%.9g", k ? "," : "", (double)low[k]);
    used += snprintf(text + used, size - (size_t)used, "],\"max\":[");
    for (size_t k = 0; k < n; k++) used += snprintf(text + used, size - (size_t)used, "%s%.9g", k ? "," : "", (double)high[k]);
    snprintf(text + used, size - (size_t)used, "]");
}

static void *need(void *memory)
{
    if (!memory) abort();
    return memory;
}

/* --- the skin: a primitive a piece; views of all pieces together --- */

static void add_pieces(struct out *out, FILE *primitives, const struct skin_figure *figure)
{
    size_t n = 0, indices = 0, v = 0, used = 0;
    for (int i = 0; i < figure->pieces; i++) n += figure->piece[i].vertices, indices += figure->piece[i].indices;
    float(*position)[3] = need(malloc(n * sizeof *position)), (*normal)[3] = need(malloc(n * sizeof *normal));
    uint16_t(*uv)[2] = need(malloc(n * sizeof *uv)), *index = need(malloc(indices * sizeof *index));
    uint8_t(*joints)[4] = need(malloc(n * sizeof *joints)), (*weights)[4] = need(malloc(n * sizeof *weights));
    for (int i = 0; i < figure->pieces; i++) {
        const struct skin_piece *piece = &figure->piece[i];
        for (size_t k = 0; k < piece->vertices; k++, v++) {
            const struct skin_vertex *from = &piece->vertex[k];
            to_file(position[v], from->position);
            to_file(normal[v], from->normal);
            uv[v][0] = (uint16_t)lround(65535 * from->uv.x), uv[v][1] = (uint16_t)lround(65535 * from->uv.y);
            memcpy(joints[v], from->joint, 4);
            memcpy(weights[v], from->weight, 4);
        }
        memcpy(index + used, piece->index, piece->indices * sizeof *index);
        used += piece->indices;
    }
    int views[6] = { add_view(out, position, n * sizeof *position, VERTICES, 12), add_view(out, normal, n * sizeof *normal, VERTICES, 12),
                     add_view(out, uv, n * sizeof *uv, VERTICES, 4), add_view(out, joints, n * sizeof *joints, VERTICES, 4),
                     add_view(out, weights, n * sizeof *weights, VERTICES, 4), add_view(out, index, indices * sizeof *index, INDICES, 0) };
    v = used = 0;
    for (int i = 0; i < figure->pieces; i++) {
        const struct skin_piece *piece = &figure->piece[i];
        size_t count = piece->vertices;
        char limits[256];
        limits_of(limits, sizeof limits, position[v], count, 3);
        int first = add_accessor(out, views[0], 12 * v, count, F32, false, "VEC3", limits);
        add_accessor(out, views[1], 12 * v, count, F32, false, "VEC3", "");
        add_accessor(out, views[2], 4 * v, count, U16, true, "VEC2", "");
        add_accessor(out, views[3], 4 * v, count, U8, false, "VEC4", "");
        add_accessor(out, views[4], 4 * v, count, U8, true, "VEC4", "");
        add_accessor(out, views[5], 2 * used, piece->indices, U16, false, "SCALAR", "");
        fprintf(primitives, "%s{\"attributes\":{\"POSITION\":%d,\"NORMAL\":%d,\"TEXCOORD_0\":%d,\"JOINTS_0\":%d,\"WEIGHTS_0\":%d},\"indices\":%d,\"material\":%d}",
                i ? "," : "", first, first + 1, first + 2, first + 3, first + 4, first + 5, i);
        v += count, used += piece->indices;
    }
    free(position), free(normal), free(uv), free(index), free(joints), free(weights);
}

/* --- the skeleton --- */

/* The mesh is node 0, a joint j node 1 + j. */
static void write_nodes(FILE *f, const struct body *body, const char *name)
{
    fprintf(f, "{\"name\":\"%s\",\"mesh\":0,\"skin\":0}", name);
    for (int j = 0; j < JOINT_COUNT; j++) {
        int parent = joint_parent(j), children = 0;
        float t[3];
        to_file(t, parent < 0 ? body->at[j] : vec3_sub(body->at[j], body->at[parent]));
        fprintf(f, ",{\"name\":\"%s\",\"translation\":[%.9g,%.9g,%.9g]", joint_name[j], (double)t[0], (double)t[1], (double)t[2]);
        for (int c = 0; c < JOINT_COUNT; c++)
            if (joint_parent(c) == j) fprintf(f, "%s%d", children++ ? "," : ",\"children\":[", 1 + c);
        fputs(children ? "]}" : "}", f);
    }
}

static int add_inverse_bind(struct out *out, const struct body *body)
{
    float m[JOINT_COUNT][16] = { { 0 } };
    for (int j = 0; j < JOINT_COUNT; j++) {
        to_file(&m[j][12], vec3_scale(body->at[j], -1));
        m[j][0] = m[j][5] = m[j][10] = m[j][15] = 1;
    }
    return add_accessor(out, add_view(out, m, sizeof m, NO_TARGET, 0), 0, JOINT_COUNT, F32, false, "MAT4", "");
}

static void add_clip(struct out *out, FILE *f, const struct clip *clip)
{
    size_t n = (size_t)clip->keys + 1;
    float time_s[MOST_KEYS + 1], hips[MOST_KEYS + 1][3];
    int16_t turn[JOINT_COUNT][MOST_KEYS + 1][4];
    char limits[128];
    for (size_t i = 0; i < n; i++) {
        time_s[i] = (float)(clip->duration_s * (double)i / clip->keys);
        to_file(hips[i], clip->hips[i]);
        for (int j = 0; j < JOINT_COUNT; j++) {
            struct quat q = clip->turn[j][i];
            const double file[4] = { q.y, q.z, q.x, q.w };
            for (int k = 0; k < 4; k++) turn[j][i][k] = (int16_t)lround(32767 * file[k]);
        }
    }
    limits_of(limits, sizeof limits, time_s, n, 1);
    int input = add_accessor(out, add_view(out, time_s, n * sizeof *time_s, NO_TARGET, 0), 0, n, F32, false, "SCALAR", limits);
    int first = add_accessor(out, add_view(out, hips, n * sizeof *hips, NO_TARGET, 0), 0, n, F32, false, "VEC3", "");
    for (int j = 0; j < JOINT_COUNT; j++) add_accessor(out, add_view(out, turn[j], n * sizeof *turn[j], NO_TARGET, 0), 0, n, I16, true, "VEC4", "");
    fprintf(f, "{\"name\":\"%s\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":%d,\"path\":\"translation\"}}", clip->name, 1 + HIPS);
    for (int j = 0; j < JOINT_COUNT; j++) fprintf(f, ",{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"rotation\"}}", 1 + j, 1 + j);
    fputs("],\"samplers\":[", f);
    for (int j = 0; j <= JOINT_COUNT; j++) fprintf(f, "%s{\"input\":%d,\"output\":%d}", j ? "," : "", input, first + j);
    fputs("]}", f);
}

/* --- the file --- */

static void write_u32(FILE *f, size_t value)
{
    for (int k = 0; k < 4; k++) fputc((int)(value >> 8 * k & 255), f);
}

static bool write_file(const char *path, struct text *json, struct text *bytes, struct error *err)
{
    struct text file;
    fflush(json->f);
    while (json->size % 4) fputc(' ', json->f), fflush(json->f);
    close_text(json), close_text(bytes);
    open_text(&file);
    fwrite("glTF\2\0\0\0", 1, 8, file.f);
    write_u32(file.f, 12 + 8 + json->size + 8 + bytes->size);
    write_u32(file.f, json->size);
    fwrite("JSON", 1, 4, file.f);
    fwrite(json->data, 1, json->size, file.f);
    write_u32(file.f, bytes->size);
    fwrite("BIN\0", 1, 4, file.f);
    fwrite(bytes->data, 1, bytes->size, file.f);
    close_text(&file);
    bool good = file_write(path, file.data, file.size, err);
    free(file.data);
    return good;
}

bool write_skin_glb(const char *path, const struct skin_figure *figure, struct error *err)
{
    struct out out = { 0 };
    struct text json, primitives, clips;
    open_text(&out.bytes), open_text(&out.views), open_text(&out.accessors), open_text(&json), open_text(&primitives), open_text(&clips);
    add_pieces(&out, primitives.f, figure);
    int inverse_bind = add_inverse_bind(&out, figure->body);
    for (int i = 0; i < figure->clips; i++) {
        if (i) fputc(',', clips.f);
        add_clip(&out, clips.f, &figure->clip[i]);
    }
    int image = add_view(&out, figure->png, figure->png_size, NO_TARGET, 0);
    close_text(&out.views), close_text(&out.accessors), close_text(&primitives), close_text(&clips);

    FILE *f = json.f;
    fputs("{\"asset\":{\"version\":\"2.0\",\"generator\":\"Staffage\",\"copyright\":\"CC0-1.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],", f);
    fprintf(f, "\"buffers\":[{\"byteLength\":%zu}],\"bufferViews\":[%s],\"accessors\":[%s],", out.size, out.views.data, out.accessors.data);
    fprintf(f, "\"images\":[{\"bufferView\":%d,\"mimeType\":\"image/png\"}],\"samplers\":[{\"wrapS\":33071,\"wrapT\":33071}],\"textures\":[{\"source\":0,\"sampler\":0}],\"materials\":[", image);
    for (int i = 0; i < figure->pieces; i++)
        fprintf(f, "%s{\"name\":\"%s\",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0,\"roughnessFactor\":%g}}", i ? "," : "",
                figure->piece[i].material, figure->piece[i].roughness);
    fprintf(f, "],\"meshes\":[{\"name\":\"%s\",\"primitives\":[%s]}],\"nodes\":[", figure->name, primitives.data);
    write_nodes(f, figure->body, figure->name);
    fprintf(f, "],\"skins\":[{\"inverseBindMatrices\":%d,\"skeleton\":1,\"joints\":[", inverse_bind);
    for (int j = 0; j < JOINT_COUNT; j++) fprintf(f, "%s%d", j ? "," : "", 1 + j);
    fprintf(f, "]}],\"animations\":[%s]}", clips.data);
    bool good = write_file(path, &json, &out.bytes, err);
    struct text *const all[] = { &out.bytes, &out.views, &out.accessors, &json, &primitives, &clips };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) free(all[i]->data);
    return good;
}

#include "cast/glb.h"

#include "lib/file.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A file in the making: bytes, and the JSON lists that tell what they are. */
struct out { FILE *bytes, *views, *accessors; size_t size; int count; };
struct text { FILE *f; char *data; size_t size; };

static void open_text(struct text *text)
{
    *text = (struct text){ 0 };
    text->f = open_memstream(&text->data, &text->size);
    if (!text->f) abort();
}

enum { F32 = 5126, U16 = 5123, U8 = 5121 };
enum target { NO_TARGET, VERTICES = 34962, INDICES = 34963 };

/* Append an accessor over a view of its own. Returns its index. */
static int add_accessor(struct out *out, const void *data, size_t bytes, size_t count, int component, const char *type,
                        enum target target, const char *limits)
{
    fprintf(out->views, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu", out->count ? "," : "", out->size, bytes);
    if (target) fprintf(out->views, ",\"target\":%d", (int)target);
    fputc('}', out->views);
    fprintf(out->accessors, "%s{\"bufferView\":%d,\"componentType\":%d,\"count\":%zu,\"type\":\"%s\"%s}", out->count ? "," : "",
            out->count, component, count, type, limits);
    fwrite(data, 1, bytes, out->bytes);
    for (out->size += bytes; out->size % 4; out->size++) fputc(0, out->bytes);
    return out->count++;
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

/* --- the skin --- */

struct vertex { size_t point, normal; enum part part; uint16_t at; };

static int by_content(const void *a, const void *b)
{
    const struct vertex *v = a, *w = b;
    if (v->part != w->part) return v->part < w->part ? -1 : 1;
    if (v->point != w->point) return v->point < w->point ? -1 : 1;
    return (v->normal > w->normal) - (v->normal < w->normal);
}

/* Points of one part that share their normal are a vertex. Returns the list, numbered. */
static struct vertex *find_vertices(size_t *count, const struct model *model, const struct surface *surface)
{
    struct vertex *list = malloc(3 * model->count * sizeof *list);
    size_t kept = 0;
    if (!list) abort();
    for (size_t c = 0; c < 3 * model->count; c++)
        list[c] = (struct vertex){ surface->point[c / 3][c % 3], surface->normal[c / 3][c % 3], model->triangles[c / 3].part, 0 };
    qsort(list, 3 * model->count, sizeof *list, by_content);
    for (size_t c = 0; c < 3 * model->count; c++)
        if (!c || by_content(&list[c], &list[kept - 1])) list[kept++] = list[c];
    if (kept > UINT16_MAX) abort();
    for (size_t i = 0; i < kept; i++) list[i].at = (uint16_t)i;
    *count = kept;
    return list;
}

/* Positions, normals, joints and weights are the first four accessors. */
static void add_vertices(struct out *out, const struct vertex *list, size_t count, const struct surface *surface,
                         const struct skeleton *skeleton)
{
    float(*position)[3] = malloc(count * sizeof *position), (*normal)[3] = malloc(count * sizeof *normal);
    float(*weights)[4] = malloc(count * sizeof *weights);
    uint8_t(*joints)[4] = malloc(count * sizeof *joints);
    char limits[256];
    if (!position || !normal || !weights || !joints) abort();
    for (size_t i = 0; i < count; i++) {
        struct vec3 p = surface->points[list[i].point], body = vec3_scale(p, 1 / skeleton->scale);
        body.z += skeleton->ground_z;
        struct binding b = walker_bind_point(skeleton, list[i].part, body);
        to_file(position[i], p);
        to_file(normal[i], vec3_unit(surface->normals[list[i].normal]));
        for (int k = 0; k < 4; k++) {
            joints[i][k] = (uint8_t)b.joint[k];
            weights[i][k] = (float)b.weight[k];
        }
    }
    limits_of(limits, sizeof limits, position[0], count, 3);
    add_accessor(out, position, count * sizeof *position, count, F32, "VEC3", VERTICES, limits);
    add_accessor(out, normal, count * sizeof *normal, count, F32, "VEC3", VERTICES, "");
    add_accessor(out, joints, count * sizeof *joints, count, U8, "VEC4", VERTICES, "");
    add_accessor(out, weights, count * sizeof *weights, count, F32, "VEC4", VERTICES, "");
    free(position), free(normal), free(joints), free(weights);
}

static double linear(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4); }

static double roughness(enum material material) { return material == SHOES ? 0.45 : material == SKIN ? 0.6 : material == HAIR ? 0.7 : 0.9; }

/* A primitive and a material for each surface that there is. */
static void add_surfaces(struct out *out, FILE *primitives, FILE *materials, const struct model *model, const struct surface *surface,
                         const struct vertex *list, size_t count, const struct palette *palette)
{
    uint16_t *index = malloc(3 * model->count * sizeof *index);
    int made = 0;
    if (!index) abort();
    for (int m = 0; m < MATERIAL_COUNT; m++) {
        size_t n = 0;
        for (size_t c = 0; c < 3 * model->count; c++) {
            const struct triangle *t = &model->triangles[c / 3];
            if ((int)t->material != m) continue;
            struct vertex key = { surface->point[c / 3][c % 3], surface->normal[c / 3][c % 3], t->part, 0 };
            const struct vertex *found = bsearch(&key, list, count, sizeof key, by_content);
            index[n++] = found->at;
        }
        if (!n) continue;
        int indices = add_accessor(out, index, n * sizeof *index, n, U16, "SCALAR", INDICES, "");
        const double *rgb = palette->rgb[m];
        fprintf(primitives, "%s{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"JOINTS_0\":2,\"WEIGHTS_0\":3},\"indices\":%d,\"material\":%d}",
                made ? "," : "", indices, made);
        fprintf(materials, "%s{\"name\":\"%s\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[%.6g,%.6g,%.6g,1],\"metallicFactor\":0,\"roughnessFactor\":%g}}",
                made ? "," : "", material_name[m], linear(rgb[0]), linear(rgb[1]), linear(rgb[2]), roughness((enum material)m));
        made++;
    }
    free(index);
}

/* --- the skeleton --- */

/* The mesh is node 0, a joint j node 1 + j. */
static void write_nodes(FILE *f, const struct skeleton *skeleton, const char *name)
{
    fprintf(f, "{\"name\":\"%s\",\"mesh\":0,\"skin\":0}", name);
    for (int j = 0; j < JOINT_COUNT; j++) {
        int parent = walker_joint_parent(j), children = 0;
        struct vec3 at = skeleton->at[j];
        if (parent < 0) at.z -= skeleton->ground_z;
        else at = vec3_sub(at, skeleton->at[parent]);
        float t[3];
        to_file(t, vec3_scale(at, skeleton->scale));
        fprintf(f, ",{\"name\":\"%s\",\"translation\":[%.9g,%.9g,%.9g]", walker_joint_name[j], (double)t[0], (double)t[1], (double)t[2]);
        for (int c = 0; c < JOINT_COUNT; c++)
            if (walker_joint_parent(c) == j) fprintf(f, "%s%d", children++ ? "," : ",\"children\":[", 1 + c);
        fputs(children ? "]}" : "}", f);
    }
}

static int add_inverse_bind(struct out *out, const struct skeleton *skeleton)
{
    float m[JOINT_COUNT][16] = { { 0 } };
    for (int j = 0; j < JOINT_COUNT; j++) {
        struct vec3 at = skeleton->at[j];
        at.z -= skeleton->ground_z;
        to_file(&m[j][12], vec3_scale(at, -skeleton->scale));
        m[j][0] = m[j][5] = m[j][10] = m[j][15] = 1;
    }
    return add_accessor(out, m, sizeof m, JOINT_COUNT, F32, "MAT4", NO_TARGET, "");
}

static void add_walk(struct out *out, FILE *channels, FILE *samplers, const struct walk *walk, const struct skeleton *skeleton)
{
    enum { N = WALK_KEYS + 1 };
    float time_s[N], hips[N][3], turn[N][4];
    char limits[128];
    for (int i = 0; i < N; i++) {
        time_s[i] = (float)(walk->duration_s * i / WALK_KEYS);
        struct vec3 at = walk->hips[i];
        at.z -= skeleton->ground_z;
        to_file(hips[i], vec3_scale(at, skeleton->scale));
    }
    limits_of(limits, sizeof limits, time_s, N, 1);
    int input = add_accessor(out, time_s, sizeof time_s, N, F32, "SCALAR", NO_TARGET, limits);
    fprintf(samplers, "{\"input\":%d,\"output\":%d}", input, add_accessor(out, hips, sizeof hips, N, F32, "VEC3", NO_TARGET, ""));
    fprintf(channels, "{\"sampler\":0,\"target\":{\"node\":%d,\"path\":\"translation\"}}", 1 + HIPS);
    for (int j = 0; j < JOINT_COUNT; j++) {
        for (int i = 0; i < N; i++) {
            struct quat q = walk->turn[j][i];
            float file[4] = { (float)q.y, (float)q.z, (float)q.x, (float)q.w };
            memcpy(turn[i], file, sizeof file);
        }
        int output = add_accessor(out, turn, sizeof turn, N, F32, "VEC4", NO_TARGET, "");
        fprintf(samplers, ",{\"input\":%d,\"output\":%d}", input, output);
        fprintf(channels, ",{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"rotation\"}}", 1 + j, 1 + j);
    }
}

/* --- the file --- */

static void write_u32(FILE *f, size_t value)
{
    for (int k = 0; k < 4; k++) fputc((int)(value >> 8 * k & 255), f);
}

static bool write_glb(const char *folder, const char *name, struct text *json, struct text *bytes, struct error *err)
{
    struct text file;
    while (ftell(json->f) % 4) fputc(' ', json->f);
    fclose(json->f), fclose(bytes->f);
    open_text(&file);
    fwrite("glTF\2\0\0\0", 1, 8, file.f);
    write_u32(file.f, 12 + 8 + json->size + 8 + bytes->size);
    write_u32(file.f, json->size);
    fwrite("JSON", 1, 4, file.f);
    fwrite(json->data, 1, json->size, file.f);
    write_u32(file.f, bytes->size);
    fwrite("BIN\0", 1, 4, file.f);
    fwrite(bytes->data, 1, bytes->size, file.f);
    fclose(file.f);
    char *path = string_format("%s/%s.glb", folder, name);
    bool good = path && file_write(path, file.data, file.size, err);
    free(path);
    free(file.data);
    return good;
}

bool write_walker(struct model *model, const struct skeleton *skeleton, const struct walk *walk, const char *folder,
                  const char *name, const struct palette *palette, struct error *err)
{
    enum { BYTES, VIEWS, ACCESSORS, PRIMITIVES, MATERIALS, NODES, CHANNELS, SAMPLERS, JSON, TEXTS };
    struct text text[TEXTS];
    for (int i = 0; i < TEXTS; i++) open_text(&text[i]);
    struct out out = { text[BYTES].f, text[VIEWS].f, text[ACCESSORS].f, 0, 0 };
    struct surface surface = make_surface(model);
    size_t count;
    struct vertex *list = find_vertices(&count, model, &surface);
    add_vertices(&out, list, count, &surface, skeleton);
    add_surfaces(&out, text[PRIMITIVES].f, text[MATERIALS].f, model, &surface, list, count, palette);
    write_nodes(text[NODES].f, skeleton, name);
    int inverse_bind = add_inverse_bind(&out, skeleton);
    add_walk(&out, text[CHANNELS].f, text[SAMPLERS].f, walk, skeleton);
    for (int i = VIEWS; i < JSON; i++) fclose(text[i].f);

    FILE *f = text[JSON].f;
    fputs("{\"asset\":{\"version\":\"2.0\",\"generator\":\"staffage-cast\",\"copyright\":\"free for any use\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],", f);
    fprintf(f, "\"buffers\":[{\"byteLength\":%zu}],\"bufferViews\":[%s],\"accessors\":[%s],", out.size, text[VIEWS].data, text[ACCESSORS].data);
    fprintf(f, "\"meshes\":[{\"name\":\"%s\",\"primitives\":[%s]}],\"materials\":[%s],\"nodes\":[%s],", name, text[PRIMITIVES].data,
            text[MATERIALS].data, text[NODES].data);
    fprintf(f, "\"skins\":[{\"inverseBindMatrices\":%d,\"skeleton\":1,\"joints\":[", inverse_bind);
    for (int j = 0; j < JOINT_COUNT; j++) fprintf(f, "%s%d", j ? "," : "", 1 + j);
    fprintf(f, "]}],\"animations\":[{\"name\":\"walk\",\"channels\":[%s],\"samplers\":[%s]}]}", text[CHANNELS].data, text[SAMPLERS].data);
    bool good = write_glb(folder, name, &text[JSON], &text[BYTES], err);
    for (int i = 0; i < TEXTS; i++) free(text[i].data);
    free(list);
    surface_release(&surface);
    model_release(model);
    return good;
}

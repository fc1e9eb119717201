/* A vehicle as a binary glTF 2.0 file: +y up, +z front, metres. */
#include "cast/coat.h"
#include "cast/vehicle.h"
#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A file in the making: bytes, and the JSON lists that tell what they are. */
struct text { FILE *f; char *data; size_t size; };
enum { BYTES, VIEWS, ACCESSORS, MESHES, MATERIALS, NODES, CHANNELS, SAMPLERS, JSON, TEXTS };
struct out { struct text text[TEXTS]; size_t size; int views, accessors, materials; int material_of[COATS]; const char *color; };

static void *need(void *memory)
{
    if (!memory) abort();
    return memory;
}

static void open_text(struct text *text)
{
    *text = (struct text){ 0 };
    text->f = need(open_memstream(&text->data, &text->size));
}

/* --- vertices of one material --- */

struct vertex { float p[3], n[3]; };
struct vertices { struct vertex *list; uint32_t *index; size_t count, indices; };

/* Forward, left, up become z, x, y. */
static struct vertex vertex_of(struct vec3 p, struct vec3 n)
{
    return (struct vertex){ { (float)p.y, (float)p.z, (float)p.x }, { (float)n.y, (float)n.z, (float)n.x } };
}

static int by_content(const void *a, const void *b) { return memcmp(a, b, sizeof(struct vertex)); }

static struct vertices vertices_of(const struct shell *s, int material)
{
    struct vertices v = { need(malloc((3 * s->faces_count + 1) * sizeof *v.list)), need(malloc((3 * s->faces_count + 1) * sizeof *v.index)), 0, 0 };
    struct vertex *corner = need(malloc((3 * s->faces_count + 1) * sizeof *corner));
    for (size_t f = 0; f < s->faces_count; f++)
        for (int k = 0; s->faces[f].material == material && k < 3; k++) {
            uint32_t i = s->faces[f].v[k];
            struct vec3 n = s->n[i];
            for (double *x = &n.x; x <= &n.z; x++) *x = nearbyint(*x * 2048) / 2048; /* nearly the same is the same */
            corner[v.indices++] = vertex_of(vec3_add(s->p[i], vec3(0, 0, 0)), vec3_add(vec3_unit(n), vec3(0, 0, 0))); /* no -0 */
        }
    memcpy(v.list, corner, v.indices * sizeof *corner);
    qsort(v.list, v.indices, sizeof *v.list, by_content);
    for (size_t i = 0; i < v.indices; i++)
        if (!i || by_content(&v.list[i], &v.list[v.count - 1])) v.list[v.count++] = v.list[i];
    for (size_t i = 0; i < v.indices; i++)
        v.index[i] = (uint32_t)((struct vertex *)bsearch(&corner[i], v.list, v.count, sizeof *corner, by_content) - v.list);
    free(corner);
    return v;
}

/* --- pieces of the file --- */

static int add_view(struct out *o, const void *data, size_t bytes, int target, size_t stride)
{
    FILE *f = o->text[VIEWS].f;
    fprintf(f, "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu", o->views ? "," : "", o->size, bytes);
    if (stride) fprintf(f, ",\"byteStride\":%zu", stride);
    if (target) fprintf(f, ",\"target\":%d", target);
    fputc('}', f);
    fwrite(data, 1, bytes, o->text[BYTES].f);
    for (o->size += bytes; o->size % 4; o->size++) fputc(0, o->text[BYTES].f);
    return o->views++;
}

static int add_accessor(struct out *o, int view, size_t offset, int component, size_t count, const char *type, const char *limits)
{
    fprintf(o->text[ACCESSORS].f, "%s{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,\"count\":%zu,\"type\":\"%s\"%s}",
            o->accessors ? "," : "", view, offset, component, count, type, limits);
    return o->accessors++;
}

static double linear(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4); }

static int material_for(struct out *o, int coat)
{
    if (o->material_of[coat] >= 0) return o->material_of[coat];
    const struct coat_info *c = &coat_info[coat];
    double rgb[3] = { c->rgb[0], c->rgb[1], c->rgb[2] };
    unsigned own = coat == PAINT_COAT && o->color ? (unsigned)strtoul(o->color + 1, NULL, 16) : 0;
    for (int k = 0; own && k < 3; k++) rgb[k] = (own >> (16 - 8 * k) & 255) / 255.0;
    FILE *f = o->text[MATERIALS].f;
    fprintf(f, "%s{\"name\":\"%s\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[%.5g,%.5g,%.5g,1],\"metallicFactor\":%g,\"roughnessFactor\":%g}",
            o->materials ? "," : "", c->name, linear(rgb[0]), linear(rgb[1]), linear(rgb[2]), c->metallic, c->roughness);
    if (c->clearcoat > 0) fprintf(f, ",\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":%g,\"clearcoatRoughnessFactor\":0.03}}", c->clearcoat);
    if (c->transmission > 0) fprintf(f, ",\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":%g}},\"doubleSided\":true", c->transmission);
    fputc('}', f);
    return o->material_of[coat] = o->materials++;
}

static void add_primitive(struct out *o, const struct vertices *v, int coat, bool first)
{
    float low[3] = { 1e9f, 1e9f, 1e9f }, high[3] = { -1e9f, -1e9f, -1e9f };
    for (size_t i = 0; i < v->count; i++)
        for (int k = 0; k < 3; k++) {
            low[k] = fminf(low[k], v->list[i].p[k]);
            high[k] = fmaxf(high[k], v->list[i].p[k]);
        }
    char limits[256];
    snprintf(limits, sizeof limits, ",\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]", (double)low[0], (double)low[1], (double)low[2],
             (double)high[0], (double)high[1], (double)high[2]);
    int view = add_view(o, v->list, v->count * sizeof *v->list, 34962, sizeof *v->list);
    int position = add_accessor(o, view, 0, 5126, v->count, "VEC3", limits), normal = add_accessor(o, view, 12, 5126, v->count, "VEC3", "");
    bool is_short = v->count < 65535;
    uint16_t *small = need(malloc((v->indices + 1) * sizeof *small));
    for (size_t i = 0; i < v->indices; i++) small[i] = (uint16_t)v->index[i];
    view = is_short ? add_view(o, small, v->indices * sizeof *small, 34963, 0) : add_view(o, v->index, v->indices * sizeof *v->index, 34963, 0);
    free(small);
    int index = add_accessor(o, view, 0, is_short ? 5123 : 5125, v->indices, "SCALAR", "");
    fprintf(o->text[MESHES].f, "%s{\"attributes\":{\"POSITION\":%d,\"NORMAL\":%d},\"indices\":%d,\"material\":%d}", first ? "" : ",", position, normal,
            index, material_for(o, coat));
}

static void add_mesh(struct out *o, const struct shell *shell, const char *name, bool first)
{
    fprintf(o->text[MESHES].f, "%s{\"name\":\"%s\",\"primitives\":[", first ? "" : ",", name);
    bool none = true;
    for (int m = 0; m < COATS; m++) {
        struct vertices v = vertices_of(shell, m);
        if (v.indices) add_primitive(o, &v, m, none), none = false;
        free(v.list), free(v.index);
    }
    fputs("]}", o->text[MESHES].f);
}

/* Each wheel turns forward once in a second. */
static void add_roll(struct out *o, const struct vehicle *v)
{
    static const float time_s[5] = { 0, 0.25f, 0.5f, 0.75f, 1 };
    const float h = 0.70710678f, turn[5][4] = { { 0, 0, 0, 1 }, { h, 0, 0, h }, { 1, 0, 0, 0 }, { h, 0, 0, -h }, { 0, 0, 0, -1 } };
    int input = add_accessor(o, add_view(o, time_s, sizeof time_s, 0, 0), 0, 5126, 5, "SCALAR", ",\"min\":[0],\"max\":[1]");
    int output = add_accessor(o, add_view(o, turn, sizeof turn, 0, 0), 0, 5126, 5, "VEC4", "");
    fprintf(o->text[SAMPLERS].f, "{\"input\":%d,\"output\":%d}", input, output);
    for (int i = 0; i < v->wheels; i++)
        fprintf(o->text[CHANNELS].f, "%s{\"sampler\":0,\"target\":{\"node\":%d,\"path\":\"rotation\"}}", i ? "," : "", 2 + i);
}

static void write_u32(FILE *f, size_t value)
{
    for (int k = 0; k < 4; k++) fputc((int)(value >> 8 * k & 255), f);
}

static bool write_glb(const char *path, struct out *o, struct error *err)
{
    struct text *json = &o->text[JSON], *bytes = &o->text[BYTES], file;
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
    bool good = file_write(path, file.data, file.size, err);
    free(file.data);
    return good;
}

static bool write_level(const struct vehicle *v, const struct vehicle_spec *spec, const char *path, struct error *err)
{
    struct out o = { .color = spec->color };
    for (int i = 0; i < TEXTS; i++) open_text(&o.text[i]);
    for (int i = 0; i < COATS; i++) o.material_of[i] = -1;
    add_mesh(&o, &v->body, "body", true);
    fprintf(o.text[NODES].f, "{\"name\":\"%s\",\"children\":[1", spec->name);
    for (int i = 0; i < v->wheels; i++) fprintf(o.text[NODES].f, ",%d", 2 + i);
    fputs("]},{\"name\":\"body\",\"mesh\":0}", o.text[NODES].f);
    for (int i = 0; i < v->wheels; i++) {
        const struct wheel *w = &v->wheel[i];
        if (v->wheel_shell[i].faces_count) add_mesh(&o, &v->wheel_shell[i], w->name, false);
        fprintf(o.text[NODES].f, ",{\"name\":\"%s\",\"mesh\":%d,\"translation\":[%.9g,%.9g,%.9g]}", w->name, 1 + w->shell, w->hub.y, w->hub.z, w->hub.x);
    }
    add_roll(&o, v);
    for (int i = VIEWS; i < JSON; i++) fclose(o.text[i].f);

    FILE *f = o.text[JSON].f;
    fputs("{\"asset\":{\"version\":\"2.0\",\"generator\":\"staffage-cast\",\"copyright\":\"CC0-1.0\"},", f);
    fputs("\"extensionsUsed\":[\"KHR_materials_clearcoat\"", f);
    if (strstr(o.text[MATERIALS].data, "transmission")) fputs(",\"KHR_materials_transmission\"", f);
    fprintf(f, "],\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"buffers\":[{\"byteLength\":%zu}],\"bufferViews\":[%s],\"accessors\":[%s],\"meshes\":[%s],", o.size,
            o.text[VIEWS].data, o.text[ACCESSORS].data, o.text[MESHES].data);
    fprintf(f, "\"materials\":[%s],\"nodes\":[%s],\"animations\":[{\"name\":\"roll\",\"channels\":[%s],\"samplers\":[%s],\"extras\":{\"roll_m\":%.6g}}]}",
            o.text[MATERIALS].data, o.text[NODES].data, o.text[CHANNELS].data, o.text[SAMPLERS].data, 2 * PI * v->wheel[0].radius);
    bool good = write_glb(path, &o, err);
    for (int i = 0; i < TEXTS; i++) free(o.text[i].data);
    return good;
}

void vehicle_release(struct vehicle *v)
{
    shell_release(&v->body);
    for (int i = 0; i < WHEELS; i++) shell_release(&v->wheel_shell[i]);
    *v = (struct vehicle){ 0 };
}

#define FAR_TRIANGLES 1300 /* what some forty pixels can show */

/* The origin lies below the middle of the box. */
static double middle_of(const struct vehicle *v)
{
    struct vec3 low, high;
    shell_bounds(&low, &high, &v->body);
    for (int i = 0; i < v->wheels; i++) {
        low.x = fmin(low.x, v->wheel[i].hub.x - v->wheel[i].radius);
        high.x = fmax(high.x, v->wheel[i].hub.x + v->wheel[i].radius);
    }
    return (low.x + high.x) / 2;
}

static void move(struct vehicle *v, double x)
{
    for (size_t i = 0; i < v->body.points; i++) v->body.p[i].x += x;
    for (int i = 0; i < v->wheels; i++) v->wheel[i].hub.x += x;
}

bool write_vehicle(size_t triangles[LEVELS], const struct vehicle_spec *spec, const char *folder, struct error *err)
{
    static const char *const suffix[LEVELS] = { "", "-middle", "-far" };
    bool good = true;
    double middle_x = 0;
    for (int level = 0; good && level < LEVELS; level++) {
        struct vehicle vehicle = { 0 };
        vehicle.body.least_bevel_m = level == NEAR ? 0.0008 : level == MIDDLE ? 0.025 : 1;
        spec->make(&vehicle, spec, (enum level)level);
        if (level == NEAR) middle_x = middle_of(&vehicle);
        move(&vehicle, -middle_x);
        size_t wheels = 0;
        for (int i = 0; i < vehicle.wheels; i++) {
            shell_clean(&vehicle.wheel_shell[i]);
            wheels += vehicle.wheel_shell[vehicle.wheel[i].shell].faces_count;
        }
        shell_clean(&vehicle.body);
        if (level == FAR) shell_decimate(&vehicle.body, FAR_TRIANGLES - wheels);
        triangles[level] = wheels + vehicle.body.faces_count;
        char *path = string_format("%s/%s%s.glb", folder, spec->name, suffix[level]);
        good = path && write_level(&vehicle, spec, path, err);
        free(path);
        vehicle_release(&vehicle);
    }
    return good;
}

/* A vehicle as a binary glTF file. */
#include "cast/coat.h"
#include "cast/glb.h"
#include "cast/need.h"
#include "cast/vehicle.h"
#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The file, and the JSON lists of what is a vehicle's. */
enum { MESHES, MATERIALS, NODES, CHANNELS, LISTS };
struct out { struct glb glb; struct text list[LISTS]; int materials; int material_of[COATS]; const char *color; };

/* --- vertices of one material --- */

struct vertex { float p[3], n[3]; };
struct vertices { struct vertex *list; uint32_t *index; size_t count, indices; };

static struct vertex vertex_of(struct vec3 p, struct vec3 n)
{
    struct vertex v;
    glb_place(v.p, p), glb_place(v.n, n);
    return v;
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

static double linear(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4); }

static int material_for(struct out *o, int coat)
{
    if (o->material_of[coat] >= 0) return o->material_of[coat];
    const struct coat_info *c = &coat_info[coat];
    double rgb[3] = { c->rgb[0], c->rgb[1], c->rgb[2] };
    unsigned own = coat == PAINT_COAT && o->color ? (unsigned)strtoul(o->color + 1, NULL, 16) : 0;
    for (int k = 0; own && k < 3; k++) rgb[k] = (own >> (16 - 8 * k) & 255) / 255.0;
    FILE *f = o->list[MATERIALS].f;
    fprintf(f, "%s{\"name\":\"%s\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[%.5g,%.5g,%.5g,1],\"metallicFactor\":%g,\"roughnessFactor\":%g}",
            o->materials ? "," : "", c->name, linear(rgb[0]), linear(rgb[1]), linear(rgb[2]), c->metallic, c->roughness);
    if (c->clearcoat > 0) fprintf(f, ",\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":%g,\"clearcoatRoughnessFactor\":0.03}}", c->clearcoat);
    if (c->transmission > 0) fprintf(f, ",\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":%g}},\"doubleSided\":true", c->transmission);
    fputc('}', f);
    return o->material_of[coat] = o->materials++;
}

static void add_primitive(struct out *o, const struct vertices *v, int coat, bool first)
{
    char limits[LIMITS_SIZE];
    glb_limits(limits, v->list[0].p, v->count, 3, sizeof *v->list / sizeof(float));
    int view = glb_view(&o->glb, v->list, v->count * sizeof *v->list, VERTICES, sizeof *v->list);
    int position = glb_accessor(&o->glb, view, 0, v->count, F32, false, "VEC3", limits), normal = glb_accessor(&o->glb, view, 12, v->count, F32, false, "VEC3", "");
    bool is_short = v->count < 65535;
    uint16_t *small = need(malloc((v->indices + 1) * sizeof *small));
    for (size_t i = 0; i < v->indices; i++) small[i] = (uint16_t)v->index[i];
    view = is_short ? glb_view(&o->glb, small, v->indices * sizeof *small, INDICES, 0) : glb_view(&o->glb, v->index, v->indices * sizeof *v->index, INDICES, 0);
    free(small);
    int index = glb_accessor(&o->glb, view, 0, v->indices, is_short ? U16 : U32, false, "SCALAR", "");
    fprintf(o->list[MESHES].f, "%s{\"attributes\":{\"POSITION\":%d,\"NORMAL\":%d},\"indices\":%d,\"material\":%d}", first ? "" : ",", position, normal,
            index, material_for(o, coat));
}

static void add_mesh(struct out *o, const struct shell *shell, const char *name, bool first)
{
    fprintf(o->list[MESHES].f, "%s{\"name\":\"%s\",\"primitives\":[", first ? "" : ",", name);
    bool none = true;
    for (int m = 0; m < COATS; m++) {
        struct vertices v = vertices_of(shell, m);
        if (v.indices) add_primitive(o, &v, m, none), none = false;
        free(v.list), free(v.index);
    }
    fputs("]}", o->list[MESHES].f);
}

/* Each wheel turns forward once in a second. Returns the accessor of the times; that of the turns follows it. */
static int add_roll(struct out *o, const struct vehicle *v)
{
    static const float time_s[5] = { 0, 0.25f, 0.5f, 0.75f, 1 };
    const float h = 0.70710678f, turn[5][4] = { { 0, 0, 0, 1 }, { h, 0, 0, h }, { 1, 0, 0, 0 }, { h, 0, 0, -h }, { 0, 0, 0, -1 } };
    struct glb *glb = &o->glb;
    int input = glb_accessor(glb, glb_view(glb, time_s, sizeof time_s, NO_TARGET, 0), 0, 5, F32, false, "SCALAR", ",\"min\":[0],\"max\":[1]");
    glb_accessor(glb, glb_view(glb, turn, sizeof turn, NO_TARGET, 0), 0, 5, F32, false, "VEC4", "");
    for (int i = 0; i < v->wheels; i++)
        fprintf(o->list[CHANNELS].f, "%s{\"sampler\":0,\"target\":{\"node\":%d,\"path\":\"rotation\"}}", i ? "," : "", 2 + i);
    return input;
}

static bool write_level(const struct vehicle *v, const struct vehicle_spec *spec, const char *path, struct error *err)
{
    struct out o = { .color = spec->color };
    struct text json;
    glb_open(&o.glb), text_open(&json);
    for (int i = 0; i < LISTS; i++) text_open(&o.list[i]);
    for (int i = 0; i < COATS; i++) o.material_of[i] = -1;
    add_mesh(&o, &v->body, "body", true);
    fprintf(o.list[NODES].f, "{\"name\":\"%s\",\"children\":[1", spec->name);
    bool driven = v->driver.faces_count > 0;
    for (int i = 0; i < v->wheels + driven; i++) fprintf(o.list[NODES].f, ",%d", 2 + i);
    fputs("]},{\"name\":\"body\",\"mesh\":0}", o.list[NODES].f);
    for (int i = 0; i < v->wheels; i++) {
        const struct wheel *w = &v->wheel[i];
        if (v->wheel_shell[i].faces_count) add_mesh(&o, &v->wheel_shell[i], w->name, false);
        fprintf(o.list[NODES].f, ",{\"name\":\"%s\",\"mesh\":%d,\"translation\":[%.9g,%.9g,%.9g]}", w->name, 1 + w->shell, w->hub.y, w->hub.z, w->hub.x);
    }
    if (driven) {
        add_mesh(&o, &v->driver, "driver", false);
        fprintf(o.list[NODES].f, ",{\"name\":\"driver\",\"mesh\":%d}", 1 + v->wheels);
    }
    int times = add_roll(&o, v);
    for (int i = 0; i < LISTS; i++) text_close(&o.list[i]);

    FILE *f = json.f;
    fputs("{\"asset\":{\"version\":\"2.0\",\"generator\":\"staffage-cast\",\"copyright\":\"CC0-1.0\"},", f);
    fputs("\"extensionsUsed\":[\"KHR_materials_clearcoat\"", f);
    if (strstr(o.list[MATERIALS].data, "transmission")) fputs(",\"KHR_materials_transmission\"", f);
    fputs("],\"scene\":0,\"scenes\":[{\"nodes\":[0]}],", f);
    glb_lists(&o.glb, f);
    fprintf(f, "\"meshes\":[%s],\"materials\":[%s],\"nodes\":[%s],", o.list[MESHES].data, o.list[MATERIALS].data, o.list[NODES].data);
    fprintf(f, "\"animations\":[{\"name\":\"roll\",\"channels\":[%s],\"samplers\":[{\"input\":%d,\"output\":%d}],\"extras\":{\"roll_m\":%.6g}}]}",
            o.list[CHANNELS].data, times, times + 1, 2 * PI * v->wheel[0].radius);
    for (int i = 0; i < LISTS; i++) free(o.list[i].data);
    return glb_write(path, &o.glb, &json, err);
}

void vehicle_release(struct vehicle *v)
{
    shell_release(&v->body), shell_release(&v->driver);
    for (int i = 0; i < WHEELS; i++) shell_release(&v->wheel_shell[i]);
    *v = (struct vehicle){ 0 };
}

#define FAR_TRIANGLES 1450 /* what some forty pixels can show */

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
    for (size_t i = 0; i < v->driver.points; i++) v->driver.p[i].x += x;
    for (int i = 0; i < v->wheels; i++) v->wheel[i].hub.x += x;
}

bool write_vehicle(size_t triangles[LEVELS], const struct vehicle_spec *spec, struct crew *crew, const char *folder, struct error *err)
{
    static const char *const suffix[LEVELS] = { "", "-middle", "-far" };
    bool good = true;
    double middle_x = 0;
    for (int level = 0; good && level < LEVELS; level++) {
        struct vehicle vehicle = { .crew = crew };
        vehicle.body.least_bevel_m = level == NEAR ? 0.0008 : level == MIDDLE ? 0.025 : 1;
        spec->make(&vehicle, spec, (enum level)level);
        if (level == NEAR) middle_x = middle_of(&vehicle);
        move(&vehicle, -middle_x);
        size_t wheels = 0;
        for (int i = 0; i < vehicle.wheels; i++) {
            shell_clean(&vehicle.wheel_shell[i]);
            wheels += vehicle.wheel_shell[vehicle.wheel[i].shell].faces_count;
        }
        shell_clean(&vehicle.body), shell_clean(&vehicle.driver);
        if (level == FAR) shell_decimate(&vehicle.body, FAR_TRIANGLES - wheels);
        triangles[level] = wheels + vehicle.body.faces_count + vehicle.driver.faces_count;
        char *path = need(string_format("%s/%s%s.glb", folder, spec->name, suffix[level]));
        good = write_level(&vehicle, spec, path, err);
        free(path);
        vehicle_release(&vehicle);
    }
    return good;
}

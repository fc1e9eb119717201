/* The vehicles of the cast, as their files have them: sound surfaces, true sizes, wheels that stand on the ground and roll. */
#include "gen/model/catalogue.h"
#include "gen/model/gltf.h"
#include "gen/model/rig.h"
#include "tests/tap.h"

#include <jansson.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the issue of a cast of our own asks for, by the classes that labels give them. */
static const struct { const char *name; enum entity_class class_; int wheels; } wanted[] = {
    { "sedan", CLASS_CAR, 4 }, { "hatchback", CLASS_CAR, 4 }, { "estate", CLASS_CAR, 4 }, { "suv", CLASS_CAR, 4 }, { "minivan", CLASS_CAR, 4 },
    { "van", CLASS_VAN, 4 }, { "pickup", CLASS_CAR, 4 }, { "taxi", CLASS_CAR, 4 }, { "box-truck", CLASS_TRUCK, 4 }, { "city-bus", CLASS_BUS, 4 },
    { "ambulance", CLASS_AMBULANCE, 4 }, { "fire-truck", CLASS_FIRE_TRUCK, 4 }, { "dump-truck", CLASS_CONSTRUCTION, 6 },
    { "motorcycle", CLASS_MOTORCYCLE, 2 }, { "bicycle", CLASS_BICYCLE, 2 }
};
static const int most_triangles[DETAIL_COUNT] = { 45000, 8500, 1500 };

/* --- surfaces: all triangles but those of glass, which is thin, with points that lie at one place made one --- */

struct place { float p[3]; uint32_t corner; };
struct side { uint32_t a, b; int way; };
struct solid { size_t triangles, points; uint32_t (*at)[3]; struct vec3 *place; size_t normals_inward, thin; };

static int by_place(const void *x, const void *y)
{
    const struct place *p = x, *q = y;
    return memcmp(p->p, q->p, sizeof p->p);
}

static int by_ends(const void *x, const void *y)
{
    const struct side *p = x, *q = y;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return (p->b > q->b) - (p->b < q->b);
}

static struct solid solid_of(const struct model *m)
{
    struct solid s = { 0 };
    size_t room = 0;
    for (size_t i = 0; i < m->mesh_count; i++) room += m->meshes[i].triangles;
    s.at = calloc(room + 1, sizeof *s.at);
    s.place = calloc(3 * room + 1, sizeof *s.place);
    struct place *places = calloc(3 * room + 1, sizeof *places);
    if (!s.at || !s.place || !places) abort();
    for (size_t i = 0; i < m->mesh_count; i++) {
        const struct mesh *mesh = &m->meshes[i];
        if (m->materials[mesh->material].transmission > 0) continue;
        for (size_t t = 0; t < mesh->triangles; t++, s.triangles++) {
            struct vec3 p[3];
            for (size_t k = 0; k < 3; k++) {
                const float *q = mesh->position_m[mesh->triangle[t][k]];
                for (int c = 0; c < 3; c++) places[3 * s.triangles + k].p[c] = q[c] + 0.0f;
                places[3 * s.triangles + k].corner = (uint32_t)(3 * s.triangles + k);
                p[k] = vec3((double)q[0], (double)q[1], (double)q[2]);
            }
            struct vec3 face = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
            s.thin += vec3_norm(face) < 1e-9;
            for (int k = 0; k < 3; k++) {
                const float *n = mesh->normal[mesh->triangle[t][k]];
                s.normals_inward += vec3_dot(face, vec3((double)n[0], (double)n[1], (double)n[2])) < 0;
            }
        }
    }
    qsort(places, 3 * s.triangles, sizeof *places, by_place);
    for (size_t c = 0; c < 3 * s.triangles; c++) {
        const struct place *q = &places[c];
        if (!c || by_place(q, q - 1)) s.place[s.points++] = vec3((double)q->p[0], (double)q->p[1], (double)q->p[2]);
        s.at[q->corner / 3][q->corner % 3] = (uint32_t)(s.points - 1);
    }
    free(places);
    return s;
}

/* Sides that do not have as many triangles to the one side as to the other. */
static size_t open_sides(const struct solid *s)
{
    struct side *sides = calloc(3 * s->triangles + 1, sizeof *sides);
    size_t open = 0, n = 0;
    if (!sides) abort();
    for (size_t c = 0; c < 3 * s->triangles; c++) {
        uint32_t a = s->at[c / 3][c % 3], b = s->at[c / 3][(c % 3 + 1) % 3];
        sides[n++] = a < b ? (struct side){ a, b, 1 } : (struct side){ b, a, -1 };
    }
    qsort(sides, n, sizeof *sides, by_ends);
    for (size_t i = 0, j; i < n; i = j) {
        int sum = 0;
        for (j = i; j < n && by_ends(&sides[i], &sides[j]) == 0; j++) sum += sides[j].way;
        open += sum != 0;
    }
    free(sides);
    return open;
}

static uint32_t root(uint32_t *of, uint32_t i)
{
    while (of[i] != i) i = of[i] = of[of[i]];
    return i;
}

/* Pieces that hang together and enclose less than nothing: they are inside out. */
static size_t pieces_inside_out(const struct solid *s, size_t *pieces)
{
    uint32_t *of = calloc(s->points + 1, sizeof *of);
    double *volume = calloc(s->points + 1, sizeof *volume);
    size_t wrong = 0;
    if (!of || !volume) abort();
    for (size_t i = 0; i < s->points; i++) of[i] = (uint32_t)i;
    for (size_t t = 0; t < s->triangles; t++)
        for (int k = 1; k < 3; k++) of[root(of, s->at[t][k])] = root(of, s->at[t][0]);
    for (size_t t = 0; t < s->triangles; t++) {
        uint32_t piece = root(of, s->at[t][0]);
        struct vec3 o = s->place[piece], p[3];
        for (int k = 0; k < 3; k++) p[k] = vec3_sub(s->place[s->at[t][k]], o);
        volume[piece] += vec3_dot(p[0], vec3_cross(p[1], p[2])) / 6;
    }
    *pieces = 0;
    for (size_t i = 0; i < s->points; i++) {
        if (of[i] != i) continue;
        ++*pieces;
        wrong += volume[i] <= 0;
    }
    free(of), free(volume);
    return wrong;
}

static void check_surface(const struct model *m, const char *name)
{
    struct solid s = solid_of(m);
    size_t pieces, open = open_sides(&s), wrong = pieces_inside_out(&s, &pieces);
    OK(open == 0, "%s: closed (%zu open sides)", name, open);
    OK(s.thin == 0, "%s: no degenerate triangle (%zu)", name, s.thin);
    OK(wrong == 0, "%s: %zu pieces, none inside out (%zu)", name, pieces, wrong);
    OK(s.normals_inward * 50 < 3 * s.triangles, "%s: normals look outward (%zu of %zu do not)", name, s.normals_inward, 3 * s.triangles);
    free(s.at), free(s.place);
}

/* --- sizes and wheels --- */

static void check_size(const struct model *m, const struct catalogue_model *listed, const char *name)
{
    double size[3] = { m->max_m.x - m->min_m.x, m->max_m.y - m->min_m.y, m->max_m.z - m->min_m.z };
    for (int k = 0; k < 3; k++) NEAR(size[k], listed->size_m[k], 0.02 * listed->size_m[k], "%s: as large as the catalogue says, axis %d", name, k);
    NEAR(m->lowest_m, 0, 0.002, "%s: its lowest point lies on the file's ground", name);
}

/* Axle distance, track, and wheel diameter as the catalogue's file has them: read anew, for gen does not ask for them. */
struct stated { double wheelbase_m, track_m, wheel_m; };

static struct stated stated_of(const char *catalogue, const char *name)
{
    json_t *root = json_load_file(catalogue, 0, NULL), *entry;
    struct stated s = { 0, 0, 0 };
    size_t i;
    json_array_foreach(json_object_get(root, "models"), i, entry) {
        if (strcmp(json_string_value(json_object_get(entry, "name")), name)) continue;
        s.wheelbase_m = json_number_value(json_object_get(entry, "wheelbase_m"));
        s.track_m = json_number_value(json_object_get(entry, "track_m"));
        s.wheel_m = json_number_value(json_object_get(entry, "wheel_diameter_m"));
    }
    json_decref(root);
    return s;
}

static void check_wheels(const struct model *m, const char *path, int wheels, const struct stated *stated, const char *name)
{
    struct error err = ERROR_NONE;
    struct gltf gltf;
    int found = 0, standing = 0;
    double front_m = -1e9, rear_m = 0, rear_count = 0, left_m = 0, radius_m = 0; /* glTF's z is forward, x left */
    if (!OK(gltf_read(&gltf, path, &err), "%s: is read", name)) return;
    for (size_t i = 0; i < gltf.channel_count; i++) {
        const struct gltf_node *node = &gltf.nodes[gltf.channels[i].node];
        if (gltf.channels[i].path != GLTF_ROTATION || node->mesh < 0) continue;
        found++;
        /* The tyre's radius, of its lowest vertex, is the hub's height. */
        double low = 0;
        for (size_t p = 0; p < gltf.meshes[node->mesh].primitive_count; p++) {
            const struct gltf_accessor *a = &gltf.accessors[gltf.meshes[node->mesh].primitives[p].position];
            const struct gltf_view *view = &gltf.views[a->view];
            for (size_t v = 0; v < a->count; v++) {
                float at[3];
                memcpy(at, gltf.buffers[view->buffer].data + view->offset + a->offset + v * view->stride, sizeof at);
                low = fmin(low, (double)at[1]);
            }
        }
        standing += fabs(node->translation[1] + low) < 0.002;
        if (node->translation[2] > front_m) front_m = node->translation[2], left_m = fabs(node->translation[0]), radius_m = node->translation[1];
        if (node->translation[2] < 0) rear_m += node->translation[2], rear_count++;
    }
    OK(found == wheels && standing == wheels, "%s: %d wheels, %d on the ground", name, found, standing);
    gltf_release(&gltf);
    NEAR(front_m - rear_m / rear_count, stated->wheelbase_m, 0.02, "%s: wheelbase, to the middle of the rear axles", name);
    NEAR(2 * left_m, stated->track_m, 0.03, "%s: track of the front wheels", name);
    NEAR(2 * radius_m, stated->wheel_m, 0.002, "%s: diameter of the wheels", name);
    OK(m->rig && m->rig->animation_count == 1 && !strcmp(m->rig->animations[0].name, "roll") && m->rig->channel_count == (size_t)wheels,
       "%s: all of them roll", name);
}

static void check_vehicle(const struct catalogue_model *listed, int wheels, const struct material_rules *rules)
{
    struct stated stated = stated_of(listed->home, listed->name);
    struct model_options options = listed->options;
    options.rules = rules;
    for (int detail = 0; detail < DETAIL_COUNT; detail++) {
        struct error err = ERROR_NONE;
        struct model *m = NULL;
        char name[100];
        snprintf(name, sizeof name, "%s, %s", listed->name, detail_name((enum detail)detail));
        if (!OK(listed->files[detail] && model_load(&m, listed->files[detail], &options, &err), "%s: is loaded %s", name, err.text)) continue;
        size_t triangles = 0;
        bool paint = false, glass = false;
        for (size_t i = 0; i < m->mesh_count; i++) triangles += m->meshes[i].triangles;
        for (size_t i = 0; i < m->material_count; i++) {
            paint = paint || m->materials[i].kind == FINISH_PAINT;
            glass = glass || m->materials[i].transmission > 0;
        }
        OK((int)triangles == listed->triangles[detail] && listed->triangles[detail] <= most_triangles[detail], "%s: %zu triangles, as listed, not too many", name, triangles);
        OK(paint && glass == (wheels > 2 && detail != DETAIL_FAR), "%s: takes a colour%s", name, glass ? ", has glass" : "");
        check_surface(m, name);
        check_size(m, listed, name);
        check_wheels(m, listed->files[detail], wheels, &stated, name);
        model_destroy(m);
    }
}

int main(void)
{
    struct error err = ERROR_NONE;
    const char *top = getenv("top_builddir");
    char folder[600];
    snprintf(folder, sizeof folder, "%s/models", top ? top : ".");
    struct catalogue *catalogue = NULL;
    struct material_rules *rules = NULL;
    char rules_path[600];
    snprintf(rules_path, sizeof rules_path, "%s/templates/materials.rules", getenv("top_srcdir") ? getenv("top_srcdir") : ".");
    OK(material_rules_read(&rules, rules_path, &err), "the rules are read");
    if (!OK(catalogue_read(&catalogue, (const char *[]){ folder, NULL }, &err), "the cast is listed %s", err.text)) return tap_done();
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        const struct catalogue_model *listed = catalogue_find(catalogue, wanted[i].name);
        if (OK(listed && listed->class_ == wanted[i].class_, "%s is listed, of its class", wanted[i].name)) check_vehicle(listed, wanted[i].wheels, rules);
    }
    material_rules_destroy(rules);
    catalogue_destroy(catalogue);
    return tap_done();
}

/* The vehicles of the cast, as their files have them: sound surfaces, true sizes, wheels that stand on the ground and roll. */
#include "gen/model/catalogue.h"
#include "gen/model/gltf.h"
#include "gen/model/rig.h"
#include "tests/cast/surface.h"
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
static const int most_triangles[DETAIL_COUNT] = { 53000, 10500, 1500 };

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

/* Who drives sits within: parked or not, a vehicle has the same size. */
static void check_driver(const struct model *m, bool expected, const char *name)
{
    struct error err = ERROR_NONE;
    struct model posed[2];
    double size[2][3];
    for (int parked = 0; parked < 2; parked++) {
        if (!OK(model_pose(&posed[parked], m, &(struct posture){ .parked = parked }, &err), "%s: stands %s", name, parked ? "parked" : "manned")) return;
        const struct model *p = &posed[parked];
        memcpy(size[parked], (double[]){ p->max_m.x - p->min_m.x, p->max_m.y - p->min_m.y, p->max_m.z - p->min_m.z }, sizeof size[0]);
    }
    OK((posed[1].mesh_count < posed[0].mesh_count) == expected && !memcmp(size[0], size[1], sizeof size[0]), "%s: %s", name,
       expected ? "parked, nobody is in it, and it has the same size" : "there is no driver to leave out");
    for (int parked = 0; parked < 2; parked++) model_posed_release(&posed[parked]);
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
        check_surface(m, name, false);
        check_size(m, listed, name);
        check_wheels(m, listed->files[detail], wheels, &stated, name);
        check_driver(m, wheels > 2 && detail != DETAIL_FAR && listed->class_ != CLASS_BUS, name);
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

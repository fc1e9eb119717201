/* The people of the cast, as their files have them: sound surfaces, true sizes, feet that stay where they tread. */
#include "gen/model/catalogue.h"
#include "gen/model/gltf.h"
#include "gen/model/rig.h"
#include "gen/motion/gait.h"
#include "tests/cast/surface.h"
#include "tests/gen/tread.h"
#include "tests/tap.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Stature without shoes, by the tables that docs/cast.md names (children: WHO's medians). */
static const struct { const char *name; double stature_m; } statures[] = {
    { "man-jacket", 1.79 }, { "man-shirt", 1.83 }, { "man-heavy", 1.76 }, { "man-sweater", 1.72 }, { "woman-leggings", 1.71 },
    { "woman-heavy", 1.62 }, { "boy-6", 1.16 }, { "girl-9", 1.325 }
};
static const char *const paces[] = { "walk", "slow_walk", "run", "stand" };

/* --- poses --- */

static size_t find_animation(const struct rig *rig, const char *name)
{
    size_t i = 0;
    while (i < rig->animation_count && strcmp(rig->animations[i].name, name)) i++;
    return i;
}

/* Quaternions' parts, metres; 1 where the two are not of the same thing. */
static double key_difference(const struct rig_channel *a, size_t key_a, const struct rig_channel *b, size_t key_b)
{
    size_t n = a->path == GLTF_ROTATION ? 4 : 3;
    double most = a->path == b->path && a->node == b->node ? 0 : 1;
    for (size_t k = 0; k < n; k++) most = fmax(most, fabs(a->value[key_a * n + k] - b->value[key_b * n + k]));
    return most;
}

static void check_loops(const struct rig *rig, const char *name)
{
    size_t halt = find_animation(rig, "halt"), stand = find_animation(rig, "stand");
    double apart = 0, to_stand = 0;
    bool both = halt < rig->animation_count && stand < rig->animation_count && rig->animations[halt].count == rig->animations[stand].count;
    for (size_t a = 0; a < rig->animation_count; a++)
        for (size_t i = 0; i < rig->animations[a].count; i++) {
            const struct rig_channel *c = &rig->channels[rig->animations[a].first + i];
            if (a != halt) apart = fmax(apart, key_difference(c, 0, c, c->keys - 1));
            else if (both) to_stand = fmax(to_stand, key_difference(c, c->keys - 1, &rig->channels[rig->animations[stand].first + i], 0));
        }
    OK(apart == 0, "%s: every animation but halt ends as it begins", name);
    OK(both && to_stand < 0.002, "%s: halt ends as stand begins (to %.4f)", name, to_stand);
}

/* Go on for a loop and a half at the animation's own speed, and see how far what touches the ground goes over it. */
static void check_feet(const struct model *m, const char *name, const char *pace)
{
    struct error err = ERROR_NONE;
    size_t animation = find_animation(m->rig, pace);
    struct gait gait;
    if (!OK(animation < m->rig->animation_count && gait_create(&gait, m, animation, NULL, &err), "%s has a gait: %s", name, pace)) return;
    struct tread tread = { 0 };
    for (int f = 0, frames = 90; f < frames; f++) {
        double part = 1.5 * f / frames, gone_m = gait.walks ? gait.stride_m * part : 0;
        struct posture posture = { .animation = animation, .time_s = gait.walks ? gait_time(&gait, gone_m, 0) : gait.duration_s * part };
        struct model posed;
        if (!model_pose(&posed, m, &posture, &err)) break;
        tread_add(&tread, &posed, &(struct pose){ mat3_identity(), vec3(gone_m, 0, 0) });
        model_posed_release(&posed);
    }
    bool runs = !strcmp(pace, "run"), stands = !strcmp(pace, "stand");
    double trodden = (double)tread.trodden / 90;
    OK(gait.walks == !stands, "%s, %s: it %s", name, pace, stands ? "stays" : "goes ahead");
    OK(runs ? trodden > 0.5 && trodden < 0.95 : trodden > 0.9, "%s, %s: on its feet for %.0f %% of the time", name, pace, 100 * trodden);
    OK(tread.slide_m < 0.03 && tread.sunk_m < 0.02, "%s, %s: feet slide %.1f mm, sink %.1f mm in at most", name, pace, 1000 * tread.slide_m, 1000 * tread.sunk_m);
    tread_release(&tread);
    gait_release(&gait);
}

/* --- files --- */

static void check_weights(const char *path, const char *name)
{
    struct error err = ERROR_NONE;
    struct gltf gltf;
    size_t vertices = 0, wrong = 0;
    if (!OK(gltf_read(&gltf, path, &err), "%s is read", name)) return;
    for (size_t i = 0; i < gltf.meshes[0].primitive_count; i++) {
        const struct gltf_accessor *a = &gltf.accessors[gltf.meshes[0].primitives[i].weights[0]];
        const struct gltf_view *view = &gltf.views[a->view];
        for (size_t v = 0; v < a->count; v++, vertices++) {
            const uint8_t *w = gltf.buffers[view->buffer].data + view->offset + a->offset + v * view->stride;
            wrong += a->component != GLTF_U8 || !a->normalized || w[0] + w[1] + w[2] + w[3] != 255;
        }
    }
    OK(vertices > 300 && wrong == 0, "%s: weights sum to 1 at %zu vertices", name, vertices);
    gltf_release(&gltf);
}

static void check_size(const struct model *m, const struct catalogue_model *listed)
{
    struct error err = ERROR_NONE;
    struct model posed;
    struct posture standing = { .animation = find_animation(m->rig, "stand") };
    if (!OK(model_pose(&posed, m, &standing, &err), "%s stands", listed->name)) return;
    double size[3] = { posed.max_m.x - posed.min_m.x, posed.max_m.y - posed.min_m.y, posed.max_m.z - posed.min_m.z };
    for (int k = 0; k < 3; k++) NEAR(size[k], listed->size_m[k], 0.02 * listed->size_m[k], "%s: as large as the catalogue says, axis %d", listed->name, k);
    NEAR(posed.min_m.z, 0, 0.004, "%s stands on the ground", listed->name);
    for (size_t i = 0; i < sizeof statures / sizeof *statures; i++) {
        double shoes = 0.013 * statures[i].stature_m, hair = strcmp(listed->name, "man-shirt") ? 0.012 : 0.03;
        if (!strcmp(statures[i].name, listed->name))
            NEAR(size[2], statures[i].stature_m + shoes + hair, 0.02 * statures[i].stature_m, "%s: its stature, shoes and hair", listed->name);
    }
    model_posed_release(&posed);
}

static void check_person(const struct catalogue_model *listed, size_t number)
{
    for (int detail = 0; detail < DETAIL_COUNT; detail++) {
        struct error err = ERROR_NONE;
        struct model *m = NULL;
        char name[100];
        snprintf(name, sizeof name, "%s, %s", listed->name, detail_name((enum detail)detail));
        if (!OK(listed->files[detail] && model_load(&m, listed->files[detail], &listed->options, &err), "%s is loaded %s", name, err.text)) continue;
        size_t triangles = 0;
        for (size_t i = 0; i < m->mesh_count; i++) triangles += m->meshes[i].triangles;
        OK((int)triangles == listed->triangles[detail], "%s: %zu triangles, as listed", name, triangles);
        check_surface(m, name, true);
        check_weights(listed->files[detail], name);
        check_loops(m->rig, name);
        if (detail == DETAIL_NEAR) check_size(m, listed);
        /* Poses take their time: all from the air, every eighth from near as well. */
        if (detail == DETAIL_FAR || (detail == DETAIL_NEAR && number % 8 == 0))
            for (size_t i = 0; i < sizeof paces / sizeof *paces; i++) check_feet(m, name, paces[i]);
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
    if (!OK(catalogue_read(&catalogue, (const char *[]){ folder, NULL }, &err), "the cast is listed %s", err.text)) return tap_done();
    size_t people = 0;
    for (size_t i = 0; i < catalogue->count; i++)
        if (catalogue->models[i].class_ == CLASS_PERSON && catalogue->models[i].files[DETAIL_FAR]) check_person(&catalogue->models[i], people++);
    OK(people >= 12, "%zu people", people);
    catalogue_destroy(catalogue);
    return tap_done();
}

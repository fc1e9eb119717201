#include "write_scene.h"

#include "write_outlines.h"

#include "lib/file.h"
#include "lib/image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_camera(FILE *f, const struct camera *camera)
{
    fprintf(f, "{model: %s, size_px: [%d, %d], params: [", camera_model_name(camera->model), camera->width_px, camera->height_px);
    for (int i = 0; i < camera_model_param_count(camera->model); i++) fprintf(f, "%s%.12g", i ? ", " : "", camera->params[i]);
    fputs("]", f);
}

static void put_pose(FILE *f, const struct proving_shot *s)
{
    fprintf(f, "pose: {look_at: {position_m: [%g, %g, %g], target_m: [%g, %g, %g], up: [%g, %g, %g]}}}", s->eye_m.x, s->eye_m.y,
            s->eye_m.z, s->target_m.x, s->target_m.y, s->target_m.z, s->up.x, s->up.y, s->up.z);
}

/* The street's middle, where the tool lays a smooth road over the reconstruction. */
#define ROAD "paths: [{name: street, use: vehicles, width_m: 7, points_m: [[-40, 0], [40, 0]]}]\n"

/* What a glance says: to the north houses of 5 to 10 m with a few gaps, 9 to 10 m from the middle; to the south lower ones,
 * twice as far, and trees before them; both ways the street goes on. */
#define SKYLINE "surroundings: {skyline_deg: [[0, 35], [90, 10], [180, 20], [270, 10]]}\n"

/* Known with the light; or fitted to asphalt, as its user would have it. */
static void put_exposure(FILE *f, const struct proving_case *c, const struct camera *camera, const char *variant)
{
    const int *q = c->patch_px;
    double scale = (double)camera->width_px / c->camera.width_px;
    if (!strcmp(variant, "known")) fprintf(f, "exposure: {value: [%g, %g, %g]}\n", c->k[0], c->k[1], c->k[2]);
    else if (strcmp(variant, "fitted") != 0) return;
    else if (c->has_mesh) fputs("exposure: {roads: true}\n", f);
    else fprintf(f, "exposure: {patch_px: [%.0f, %.0f, %.0f, %.0f]}\n", q[0] * scale, q[1] * scale, q[2] * scale, q[3] * scale);
}

static bool put_photographs(FILE *f, const struct proving_case *c, const struct camera *camera, const char *variant, struct error *err)
{
    if (!strcmp(variant, "light")) {
        fputs("photographs: {files: [grey.png]}\nexposure: {value: 1}\nsurroundings: {skyline_deg: 0}\nground: {height_m: 0, albedo: 0.11}\n"
              "camera: {model: PINHOLE, size_px: [1000, 1000], horizontal_fov_deg: 70, pose: {look_at: "
              "{position_m: [0, 0, 60], target_m: [0, 0, 0], up: [0, 1, 0]}}}\n", f);
        return true;
    }
    if (!c->has_mesh) {
        fputs("photographs: {files: [photograph-0.jpg]}\ncamera: ", f);
        put_camera(f, camera);
        fputs(", ", f);
        put_pose(f, &c->shots[0]);
        fprintf(f, "\nground: {height_m: 0, albedo: %g}\n" SKYLINE, PROVING_ALBEDO);
        put_exposure(f, c, camera, variant);
        return write_outlines(f, c, camera, err);
    }
    const char *name = c->flies ? "drone" : "fixed";
    fprintf(f, "cameras:\n  %s: ", name);
    put_camera(f, camera);
    fputs("}\nshots:\n", f);
    for (size_t i = 0; i < c->shot_count; i++) {
        fprintf(f, "  - {photograph: photograph-%zu.jpg, camera: %s, time: %s, ", i, name, c->time);
        put_pose(f, &c->shots[i]);
        fputs("\n", f);
    }
    fprintf(f, "static: {mesh: place.ply}\nground: {albedo: %g}\n" ROAD, PROVING_ALBEDO);
    put_exposure(f, c, camera, variant);
    return write_outlines(f, c, camera, err);
}

static void put_cast(FILE *f, const struct proving_case *c, const char *models)
{
    fputs("models:\n", f);
    for (size_t i = 0; i < proving_entity_count(c); i++) {
        const struct proving_entity *e = &c->entities[i];
        bool seen = false;
        for (size_t k = 0; k < i; k++) seen |= !strcmp(e->model, c->entities[k].model);
        if (!seen) fprintf(f, "  %s: {file: \"%s/%s.glb\", class: %s}\n", e->model, models, e->model, e->class_);
    }
    fputs("entities:\n", f);
    for (size_t i = 0; i < proving_entity_count(c); i++) {
        const struct proving_entity *e = &c->entities[i];
        fprintf(f, "  - {name: %s, model: %s, at: {world_m: [%g, %g]}, heading_deg: %g", e->name, e->model, e->position_m.x,
                e->position_m.y, e->heading_deg);
        if (e->color) fprintf(f, ", color: \"%s\"", e->color);
        fputs("}\n", f);
    }
}

/* Beside the scene file. */
static bool write_grey(const char *path, struct error *err)
{
    struct image grey;
    char *file = path_beside(path, "grey.png");
    bool ok = file && image_init(&grey, 1000, 1000, 3, PIXEL_U8, err);
    if (ok) {
        memset(grey.data, 128, image_size(&grey));
        ok = file_exists(file) || image_write(file, &grey, err);
        image_release(&grey);
    }
    free(file);
    return ok;
}

bool write_scene(const char *path, const struct proving_case *c, const char *variant, const char *method,
                 const struct camera *camera, const char *models, struct error *err)
{
    FILE *f = fopen(path, "w");
    if (!f) return error_at(err, ERR_INPUT, path, 0, 0, "cannot be written");
    bool stand_in = !strcmp(variant, "light");
    fputs("staffage: 1\nplace: {latitude_deg: 48.1, longitude_deg: 11.5, height_m: 500}\n", f);
    if (stand_in || !c->has_mesh) fprintf(f, "time: %s\n", c->time);
    fprintf(f, "light: %s\n", !strcmp(variant, "auto") ? "auto" : c->light);
    bool ok = (!stand_in || write_grey(path, err)) && put_photographs(f, c, camera, variant, err);
    if (!stand_in) {
        bool plain = !strcmp(method, "plain");
        fprintf(f, "transfer: {method: %s}\n", plain ? "layers" : method);
        if (plain) fputs("lens: {grain: none, compression: none}\n", f);
        if (c->visibility_m > 0)
            fprintf(f, "weather: {visibility_m: %g, haze: [%g, %g, %g]}\n", c->visibility_m, c->haze[0], c->haze[1], c->haze[2]);
    }
    put_cast(f, c, models);
    return (fclose(f) == 0 || error_at(err, ERR_INPUT, path, 0, 0, "cannot be written")) && ok;
}

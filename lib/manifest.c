#include "lib/manifest.h"

#include "lib/file.h"
#include "lib/json_walk.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#define SIDE_MAX 65535

static bool walk_rotation(struct walk *walk, const char *key, struct mat3 *rotation)
{
    if (!walk_reals(walk, key, rotation->m[0], 9)) return false;
    return (mat3_orthonormality(*rotation) <= 1e-6 && mat3_determinant(*rotation) > 0) ||
           walk_wrong(walk, key, "must be a rotation");
}

static bool walk_rect(struct walk *walk, const char *key, struct rect *rect)
{
    struct walk in;
    if (!walk_enter(&in, walk, key) || !walk_int(&in, "x0", &rect->x0, -SIDE_MAX, SIDE_MAX) ||
        !walk_int(&in, "y0", &rect->y0, -SIDE_MAX, SIDE_MAX) || !walk_int(&in, "x1", &rect->x1, -SIDE_MAX, SIDE_MAX) ||
        !walk_int(&in, "y1", &rect->y1, -SIDE_MAX, SIDE_MAX))
        return false;
    if (rect->x1 <= rect->x0 || rect->y1 <= rect->y0) return walk_wrong(walk, key, "must hold pixels: x0 < x1, y0 < y1");
    return walk_leave(&in);
}

static bool walk_size(struct walk *walk, int *width_px, int *height_px)
{
    return walk_int(walk, "width_px", width_px, 1, SIDE_MAX) && walk_int(walk, "height_px", height_px, 1, SIDE_MAX);
}

static bool walk_camera(struct walk *walk, struct camera *camera)
{
    struct walk in;
    char name[32] = "";
    if (!walk->reading) snprintf(name, sizeof name, "%s", camera_model_name(camera->model));
    if (!walk_enter(&in, walk, "camera") || !walk_string(&in, "model", name, sizeof name)) return false;
    if (!camera_model_from_name(&camera->model, name)) return walk_wrong(&in, "model", "names no camera model: %s", name);
    return walk_size(&in, &camera->width_px, &camera->height_px) &&
           walk_reals(&in, "params", camera->params, (size_t)camera_model_param_count(camera->model)) && walk_leave(&in);
}

static bool walk_pose(struct walk *walk, const char *key, struct pose *pose)
{
    struct walk in;
    double t[3] = { pose->translation.x, pose->translation.y, pose->translation.z };
    if (!walk_enter(&in, walk, key) || !walk_rotation(&in, "rotation", &pose->rotation) ||
        !walk_reals(&in, "translation_m", t, 3))
        return false;
    pose->translation = vec3(t[0], t[1], t[2]);
    return walk_leave(&in);
}

static bool walk_view(struct walk *walk, struct view *view)
{
    struct walk in;
    return walk_enter(&in, walk, "view") && walk_size(&in, &view->width_px, &view->height_px) &&
           walk_real(&in, "fx_px", &view->fx_px, 1e-6, 1e12) && walk_real(&in, "fy_px", &view->fy_px, 1e-6, 1e12) &&
           walk_real(&in, "cx_px", &view->cx_px, -1e12, 1e12) && walk_real(&in, "cy_px", &view->cy_px, -1e12, 1e12) &&
           walk_rotation(&in, "view_from_camera", &view->view_from_camera) &&
           walk_rect(&in, "window_px", &view->window_px) && walk_bool(&in, "aligned", &view->aligned) && walk_leave(&in);
}

static bool walk_entity(struct walk *walk, struct manifest_entity *entity)
{
    int id = entity->id;
    char name[64] = "";
    if (!walk->reading) snprintf(name, sizeof name, "%s", class_info(entity->class_)->name);
    if (!walk_int(walk, "id", &id, 1, UINT16_MAX) || !walk_string(walk, "name", entity->name, sizeof entity->name) ||
        !walk_string(walk, "class", name, sizeof name))
        return false;
    entity->id = (uint16_t)id;
    if (!class_from_name(&entity->class_, name)) return walk_wrong(walk, "class", "names no class: %s", name);
    return walk_leave(walk);
}

static bool walk_entities(struct walk *walk, struct manifest *manifest)
{
    json_t *array = walk->reading ? walk_take(walk, "entities") : json_array();
    if (walk->reading) {
        if (!array) return false;
        if (!json_is_array(array)) return walk_wrong(walk, "entities", "must be a list");
        manifest->entity_count = json_array_size(array);
        manifest->entities = calloc(manifest->entity_count + 1, sizeof *manifest->entities);
        if (!manifest->entities) return error_set(walk->err, ERR_MEMORY, "out of memory");
    } else if (!walk_put(walk, "entities", array)) {
        return false;
    }
    bool taken[UINT16_MAX + 1] = { false };
    for (size_t i = 0; i < manifest->entity_count; i++) {
        struct walk in = { .reading = walk->reading, .err = walk->err };
        snprintf(in.where, sizeof in.where, "entities[%zu].", i);
        if (walk->reading) {
            in.object = json_array_get(array, i);
            if (!json_is_object(in.object)) return walk_wrong(walk, "entities", "must hold objects");
        } else {
            in.object = json_object();
            if (json_array_append_new(array, in.object) != 0) return error_set(walk->err, ERR_MEMORY, "out of memory");
        }
        if (!walk_entity(&in, &manifest->entities[i])) return false;
        if (taken[manifest->entities[i].id]) return walk_wrong(&in, "id", "is taken: %d", manifest->entities[i].id);
        taken[manifest->entities[i].id] = true;
    }
    return true;
}

static bool one_of(struct walk *walk, const char *key, const char *value, const char *const *choices)
{
    for (; *choices; choices++)
        if (!strcmp(*choices, value)) return true;
    return walk_wrong(walk, key, "has no value %s", value);
}

static bool walk_exposure(struct walk *walk, struct manifest *m)
{
    if (!walk_reals(walk, "exposure", m->exposure, 3)) return false;
    for (int c = 0; c < 3; c++)
        if (!(m->exposure[c] > 0)) return walk_wrong(walk, "exposure", "must be above 0");
    double at[2] = { m->exposure_at_px.x, m->exposure_at_px.y };
    if (!walk_reals(walk, "exposure_at_px", at, 2)) return false;
    m->exposure_at_px = (struct vec2){ at[0], at[1] };
    if (!walk_bool(walk, "exposure_fitted", &m->exposure_fitted)) return false;
    if (!m->exposure_fitted) return true;
    return walk_int(walk, "exposure_samples", &m->exposure_samples, 0, INT_MAX) &&
           (m->exposure_samples > 0 || walk_rect(walk, "exposure_patch_px", &m->exposure_patch_px)) &&
           walk_reals(walk, "exposure_median", m->exposure_median, 3);
}

/* What the photograph has of its own, and what the frame's folder has of the place. */
static bool walk_place(struct walk *walk, struct manifest *m)
{
    char name[32] = "";
    int palette = 0;
    if (!walk->reading) {
        const char *known = palette_name((int)m->palette);
        if (!known) return walk_wrong(walk, "palette", "names no palette: %d", (int)m->palette);
        snprintf(name, sizeof name, "%s", known);
    }
    if (!walk_bool(walk, "has_shares", &m->has_shares) || !walk_bool(walk, "has_place", &m->has_place) ||
        !walk_bool(walk, "has_place_labels", &m->has_place_labels) || !walk_string(walk, "palette", name, sizeof name))
        return false;
    while (palette_name(palette) && strcmp(palette_name(palette), name) != 0) palette++;
    if (!palette_name(palette)) return walk_wrong(walk, "palette", "names no palette: %s", name);
    m->palette = (enum palette)palette;
    return walk_real(walk, "shaded", &m->shaded, 0, 1) && walk_text(walk, "semantic", m->semantic, sizeof m->semantic) &&
           walk_text(walk, "depth", m->depth, sizeof m->depth);
}

static bool walk_weather(struct walk *walk, struct manifest *m)
{
    if (!walk_bool(walk, "has_mist", &m->has_mist)) return false;
    if (m->has_mist && (!walk_real(walk, "visibility_m", &m->visibility_m, 1e-300, 1e300) ||
                        !walk_reals(walk, "haze", m->haze, 3)))
        return false;
    if (!walk_bool(walk, "has_motion", &m->has_motion) || !walk_real(walk, "defocus_px", &m->defocus_px, 0, 1000) ||
        !walk_real(walk, "focus_m", &m->focus_m, 0, 1e300))
        return false;
    return m->defocus_px <= 0 || m->focus_m > 0 || walk_wrong(walk, "focus_m", "must be more than 0 where there is a defocus");
}

/* What is done to the picture as the camera did it. */
static bool walk_hand(struct walk *walk, struct manifest *m)
{
    return walk_bool(walk, "softness_auto", &m->softness_auto) && walk_real(walk, "softness_px", &m->softness_px, 0, 100) &&
           walk_bool(walk, "sharpening_auto", &m->sharpening_auto) && walk_real(walk, "sharpening", &m->sharpening, 0, 3) &&
           walk_bool(walk, "grain_auto", &m->grain_auto) && walk_real(walk, "grain", &m->grain, 0, 100) &&
           walk_bool(walk, "vignetting_auto", &m->vignetting_auto) && walk_real(walk, "vignetting", &m->vignetting, 0, 0.95) &&
           walk_bool(walk, "highlights_auto", &m->highlights_auto) && walk_real(walk, "highlights", &m->highlights, 0, 1) &&
           walk_bool(walk, "blacks_auto", &m->blacks_auto) && walk_real(walk, "blacks", &m->blacks, 0, 100) &&
           walk_bool(walk, "compression_auto", &m->compression_auto) && walk_int(walk, "seed", &m->seed, 0, INT_MAX);
}

static bool walk_transfer(struct walk *walk, struct manifest *m)
{
    static const char *const transfers[] = { "layers", "ratio", "threshold", "alpha", NULL };
    return walk_string(walk, "transfer", m->transfer, sizeof m->transfer) &&
           one_of(walk, "transfer", m->transfer, transfers) && walk_real(walk, "t1", &m->t1, 0, 255) &&
           walk_real(walk, "t2", &m->t2, 0, 255) && walk_real(walk, "t3", &m->t3, 0, 255) &&
           walk_bool(walk, "overwrite_below", &m->overwrite_below) && walk_bool(walk, "mask_dilated", &m->mask_dilated);
}

static bool walk_manifest(struct walk *walk, struct manifest *m)
{
    if (!walk_string(walk, "frame", m->frame, sizeof m->frame) || !walk_bool(walk, "new_view", &m->new_view) ||
        !walk_text(walk, "photograph", m->photograph, sizeof m->photograph) ||
        !walk_size(walk, &m->width_px, &m->height_px) || !walk_string(walk, "key", m->key, sizeof m->key))
        return false;
    if (m->new_view == (m->photograph[0] != '\0'))
        return walk_wrong(walk, "photograph", m->new_view ? "must be empty in a new view" : "is empty, and the frame is no new view");
    if (strlen(m->key) != 16 || strspn(m->key, "0123456789abcdef") != 16)
        return walk_wrong(walk, "key", "must be 16 hex digits");
    if (!walk_camera(walk, &m->camera) || !walk_pose(walk, "world_from_camera", &m->world_from_camera) ||
        !walk_bool(walk, "empty", &m->empty))
        return false;
    /* An empty frame has no passes, so no view and no exposure. */
    if (!m->empty && (!walk_view(walk, &m->view) || !walk_exposure(walk, m))) return false;
    return walk_transfer(walk, m) && walk_place(walk, m) && walk_weather(walk, m) && walk_hand(walk, m) &&
           walk_entities(walk, m) && walk_leave(walk);
}

static bool walk_version(struct walk *walk)
{
    json_t *version = walk_take(walk, "version");
    if (!version) return false;
    if (!json_is_integer(version)) return walk_wrong(walk, "version", "must be a whole number");
    if (json_integer_value(version) != MANIFEST_VERSION)
        return walk_wrong(walk, "version", "is %lld, this program reads %d", (long long)json_integer_value(version),
                     MANIFEST_VERSION);
    return true;
}

static bool name_file(struct error *err, const char *path)
{
    snprintf(err->file, sizeof err->file, "%s", path);
    return false;
}

bool manifest_write(const char *path, const struct manifest *manifest, struct error *err)
{
    struct manifest copy = *manifest; /* the walk writes only when it reads */
    struct walk walk = { .object = json_object(), .err = err };
    char *text = NULL;
    bool done = walk_put(&walk, "version", json_integer(MANIFEST_VERSION)) && walk_manifest(&walk, &copy);
    if (!done) {
        name_file(err, path);
    } else {
        /* 17 digits: every double comes back as it was. */
        text = json_dumps(walk.object, JSON_INDENT(1) | JSON_REAL_PRECISION(17));
        done = text ? file_write(path, text, strlen(text), err) : error_set(err, ERR_MEMORY, "out of memory");
    }
    free(text);
    json_decref(walk.object);
    return done;
}

bool manifest_read(struct manifest *manifest, const char *path, struct error *err)
{
    char *data = NULL;
    size_t size = 0;
    if (!file_read(&data, &size, path, err)) return false;
    json_error_t json_error;
    struct manifest read = { .entity_count = 0 };
    struct walk walk = { .reading = true, .object = json_loadb(data, size, JSON_REJECT_DUPLICATES, &json_error), .err = err };
    bool done = false;
    if (!walk.object) {
        error_at(err, ERR_INPUT, path, json_error.line, json_error.column, "no frame manifest, or a damaged one: %s",
                 json_error.text);
    } else if (!json_is_object(walk.object)) {
        error_at(err, ERR_INPUT, path, 0, 0, "no frame manifest: must be an object");
    } else if (!walk_version(&walk) || !walk_manifest(&walk, &read)) {
        error_prefix(err, "no frame manifest of this version, generate the frame again: ");
        name_file(err, path);
    } else {
        *manifest = read;
        done = true;
    }
    if (!done) manifest_release(&read);
    json_decref(walk.object);
    free(data);
    return done;
}

void manifest_release(struct manifest *manifest)
{
    free(manifest->entities);
    manifest->entities = NULL;
    manifest->entity_count = 0;
}

#include "lib/manifest.h"

#include "lib/file.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#define KEYS_MAX 32
#define SIDE_MAX 65535

/* One walk over the fields both writes and reads: what is written in one order
 * under one name with one set of checks is read with the same. */
struct walk {
    bool reading;
    json_t *object;             /* that is filled, or read from */
    char where[48];             /* "camera." before its keys in messages */
    const char *seen[KEYS_MAX]; /* keys that were asked for */
    size_t seen_count;
    struct error *err;
};

__attribute__((format(printf, 3, 4)))
static bool wrong(struct walk *walk, const char *key, const char *format, ...)
{
    char text[256];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return error_set(walk->err, walk->reading ? ERR_INPUT : ERR_BUG, "\"%s%s\" %s", walk->where, key, text);
}

/* The value of a key, borrowed; NULL and an error when there is none. */
static json_t *take(struct walk *walk, const char *key)
{
    json_t *value = json_object_get(walk->object, key);
    if (!value) wrong(walk, key, "is missing");
    walk->seen[walk->seen_count++] = key;
    return value;
}

/* Takes the value over; NULL stands for memory that ended. */
static bool put(struct walk *walk, const char *key, json_t *value)
{
    return json_object_set_new(walk->object, key, value) == 0 || error_set(walk->err, ERR_MEMORY, "out of memory");
}

static bool walk_bool(struct walk *walk, const char *key, bool *value)
{
    if (!walk->reading) return put(walk, key, json_boolean(*value));
    json_t *json = take(walk, key);
    if (!json) return false;
    if (!json_is_boolean(json)) return wrong(walk, key, "must be true or false");
    *value = json_is_true(json);
    return true;
}

static bool walk_int(struct walk *walk, const char *key, int *value, int least, int most)
{
    if (walk->reading) {
        json_t *json = take(walk, key);
        if (!json) return false;
        json_int_t read = json_integer_value(json);
        if (!json_is_integer(json) || read < least || read > most)
            return wrong(walk, key, "must be a whole number from %d to %d", least, most);
        *value = (int)read;
        return true;
    }
    if (*value < least || *value > most) return wrong(walk, key, "must be from %d to %d, not %d", least, most, *value);
    return put(walk, key, json_integer(*value));
}

static bool walk_reals(struct walk *walk, const char *key, double *values, size_t n)
{
    if (walk->reading) {
        json_t *json = take(walk, key);
        if (!json) return false;
        if (!json_is_array(json) || json_array_size(json) != n) return wrong(walk, key, "must be %zu numbers", n);
        for (size_t i = 0; i < n; i++) {
            if (!json_is_number(json_array_get(json, i))) return wrong(walk, key, "must hold numbers");
            values[i] = json_number_value(json_array_get(json, i));
        }
        return true;
    }
    json_t *json = json_array();
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(values[i])) {
            json_decref(json);
            return wrong(walk, key, "must hold finite numbers");
        }
        json_array_append_new(json, json_real(values[i]));
    }
    return put(walk, key, json);
}

static bool walk_real(struct walk *walk, const char *key, double *value, double least, double most)
{
    if (walk->reading) {
        json_t *json = take(walk, key);
        if (!json) return false;
        if (!json_is_number(json)) return wrong(walk, key, "must be a number");
        *value = json_number_value(json);
    }
    if (!isfinite(*value) || !(*value >= least) || !(*value <= most))
        return wrong(walk, key, "must be from %g to %g, not %g", least, most, *value);
    return walk->reading || put(walk, key, json_real(*value));
}

static bool walk_string(struct walk *walk, const char *key, char *value, size_t size)
{
    if (!walk->reading) {
        json_t *json = json_string(value);
        if (!json) return error_set(walk->err, ERR_INPUT, "\"%s%s\" must be UTF-8", walk->where, key);
        return put(walk, key, json);
    }
    json_t *json = take(walk, key);
    if (!json) return false;
    if (!json_is_string(json) || json_string_length(json) == 0 || json_string_length(json) >= size)
        return wrong(walk, key, "must be a text of 1 to %zu bytes", size - 1);
    memcpy(value, json_string_value(json), json_string_length(json) + 1);
    return true;
}

/* A walk over the object under a key. */
static bool enter(struct walk *inner, struct walk *walk, const char *key)
{
    json_t *object = walk->reading ? take(walk, key) : json_object();
    if (walk->reading && !object) return false;
    if (walk->reading && !json_is_object(object)) return wrong(walk, key, "must be an object");
    if (!walk->reading && !put(walk, key, object)) return false;
    *inner = (struct walk){ .reading = walk->reading, .object = object, .err = walk->err };
    snprintf(inner->where, sizeof inner->where, "%.23s%.22s.", walk->where, key);
    return true;
}

/* Whether every key of the object was asked for. */
static bool leave(struct walk *walk)
{
    if (!walk->reading) return true;
    const char *key;
    json_t *value;
    json_object_foreach(walk->object, key, value) {
        bool known = false;
        for (size_t i = 0; i < walk->seen_count; i++) known = known || !strcmp(key, walk->seen[i]);
        if (!known) return wrong(walk, key, "is no key of a frame manifest");
    }
    return true;
}

static bool walk_rotation(struct walk *walk, const char *key, struct mat3 *rotation)
{
    if (!walk_reals(walk, key, rotation->m[0], 9)) return false;
    return (mat3_orthonormality(*rotation) <= 1e-6 && mat3_determinant(*rotation) > 0) ||
           wrong(walk, key, "must be a rotation");
}

static bool walk_rect(struct walk *walk, const char *key, struct rect *rect)
{
    struct walk in;
    if (!enter(&in, walk, key) || !walk_int(&in, "x0", &rect->x0, -SIDE_MAX, SIDE_MAX) ||
        !walk_int(&in, "y0", &rect->y0, -SIDE_MAX, SIDE_MAX) || !walk_int(&in, "x1", &rect->x1, -SIDE_MAX, SIDE_MAX) ||
        !walk_int(&in, "y1", &rect->y1, -SIDE_MAX, SIDE_MAX))
        return false;
    if (rect->x1 <= rect->x0 || rect->y1 <= rect->y0) return wrong(walk, key, "must hold pixels: x0 < x1, y0 < y1");
    return leave(&in);
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
    if (!enter(&in, walk, "camera") || !walk_string(&in, "model", name, sizeof name)) return false;
    if (!camera_model_from_name(&camera->model, name)) return wrong(&in, "model", "names no camera model: %s", name);
    return walk_size(&in, &camera->width_px, &camera->height_px) &&
           walk_reals(&in, "params", camera->params, (size_t)camera_model_param_count(camera->model)) && leave(&in);
}

static bool walk_pose(struct walk *walk, const char *key, struct pose *pose)
{
    struct walk in;
    double t[3] = { pose->translation.x, pose->translation.y, pose->translation.z };
    if (!enter(&in, walk, key) || !walk_rotation(&in, "rotation", &pose->rotation) ||
        !walk_reals(&in, "translation_m", t, 3))
        return false;
    pose->translation = vec3(t[0], t[1], t[2]);
    return leave(&in);
}

static bool walk_view(struct walk *walk, struct view *view)
{
    struct walk in;
    return enter(&in, walk, "view") && walk_size(&in, &view->width_px, &view->height_px) &&
           walk_real(&in, "fx_px", &view->fx_px, 1e-6, 1e12) && walk_real(&in, "fy_px", &view->fy_px, 1e-6, 1e12) &&
           walk_real(&in, "cx_px", &view->cx_px, -1e12, 1e12) && walk_real(&in, "cy_px", &view->cy_px, -1e12, 1e12) &&
           walk_rotation(&in, "view_from_camera", &view->view_from_camera) &&
           walk_rect(&in, "window_px", &view->window_px) && walk_bool(&in, "aligned", &view->aligned) && leave(&in);
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
    if (!class_from_name(&entity->class_, name)) return wrong(walk, "class", "names no class: %s", name);
    return leave(walk);
}

static bool walk_entities(struct walk *walk, struct manifest *manifest)
{
    json_t *array = walk->reading ? take(walk, "entities") : json_array();
    if (walk->reading) {
        if (!array) return false;
        if (!json_is_array(array)) return wrong(walk, "entities", "must be a list");
        manifest->entity_count = json_array_size(array);
        manifest->entities = calloc(manifest->entity_count + 1, sizeof *manifest->entities);
        if (!manifest->entities) return error_set(walk->err, ERR_MEMORY, "out of memory");
    } else if (!put(walk, "entities", array)) {
        return false;
    }
    bool taken[UINT16_MAX + 1] = { false };
    for (size_t i = 0; i < manifest->entity_count; i++) {
        struct walk in = { .reading = walk->reading, .err = walk->err };
        snprintf(in.where, sizeof in.where, "entities[%zu].", i);
        if (walk->reading) {
            in.object = json_array_get(array, i);
            if (!json_is_object(in.object)) return wrong(walk, "entities", "must hold objects");
        } else {
            in.object = json_object();
            if (json_array_append_new(array, in.object) != 0) return error_set(walk->err, ERR_MEMORY, "out of memory");
        }
        if (!walk_entity(&in, &manifest->entities[i])) return false;
        if (taken[manifest->entities[i].id]) return wrong(&in, "id", "is taken: %d", manifest->entities[i].id);
        taken[manifest->entities[i].id] = true;
    }
    return true;
}

static bool one_of(struct walk *walk, const char *key, const char *value, const char *const *choices)
{
    for (; *choices; choices++)
        if (!strcmp(*choices, value)) return true;
    return wrong(walk, key, "has no value %s", value);
}

static bool walk_manifest(struct walk *walk, struct manifest *m)
{
    static const char *const transfers[] = { "layers", "ratio", "threshold", "alpha", NULL };
    if (!walk_string(walk, "frame", m->frame, sizeof m->frame) ||
        !walk_string(walk, "photograph", m->photograph, sizeof m->photograph) ||
        !walk_size(walk, &m->width_px, &m->height_px) || !walk_string(walk, "key", m->key, sizeof m->key))
        return false;
    if (strlen(m->key) != 16 || strspn(m->key, "0123456789abcdef") != 16)
        return wrong(walk, "key", "must be 16 hex digits");
    if (!walk_camera(walk, &m->camera) || !walk_pose(walk, "world_from_camera", &m->world_from_camera) ||
        !walk_bool(walk, "empty", &m->empty))
        return false;
    /* An empty frame has no passes, so no view and no exposure. */
    if (!m->empty && (!walk_view(walk, &m->view) || !walk_int(walk, "receiver_reduction", &m->receiver_reduction, 1, 16) ||
                       !walk_bool(walk, "exposure_given", &m->exposure_given) ||
                      !(m->exposure_given ? walk_real(walk, "exposure", &m->exposure, 1e-12, 1e12)
                                          : walk_rect(walk, "exposure_patch_px", &m->exposure_patch_px))))
        return false;
    return walk_bool(walk, "white_balance", &m->white_balance) &&
           walk_reals(walk, "ground_radiance", m->ground_radiance, 3) &&
           walk_string(walk, "transfer", m->transfer, sizeof m->transfer) &&
           one_of(walk, "transfer", m->transfer, transfers) && walk_real(walk, "t1", &m->t1, 0, 255) &&
           walk_real(walk, "t2", &m->t2, 0, 255) && walk_real(walk, "t3", &m->t3, 0, 255) &&
           walk_bool(walk, "overwrite_below", &m->overwrite_below) && walk_bool(walk, "mask_dilated", &m->mask_dilated) &&
           walk_bool(walk, "has_shares", &m->has_shares) && walk_entities(walk, m) && leave(walk);
}

static bool walk_version(struct walk *walk)
{
    json_t *version = take(walk, "version");
    if (!version) return false;
    if (!json_is_integer(version)) return wrong(walk, "version", "must be a whole number");
    if (json_integer_value(version) != MANIFEST_VERSION)
        return wrong(walk, "version", "is %lld, this program reads %d", (long long)json_integer_value(version),
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
    bool done = put(&walk, "version", json_integer(MANIFEST_VERSION)) && walk_manifest(&walk, &copy);
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

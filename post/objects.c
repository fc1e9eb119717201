#include "post/objects.h"

#include "lib/json_file.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

struct object { enum entity_class class_; bool in_frame, visible; double height_px, visible_fraction; };

static bool read_object(struct object *object, const json_t *entity)
{
    const json_t *name = json_object_get(entity, "class"), *in_frame = json_object_get(entity, "in_frame");
    const json_t *pixels = json_object_get(entity, "pixels_visible"), *fraction = json_object_get(entity, "visible_fraction");
    const json_t *height = json_array_get(json_object_get(entity, "box_visible_px"), 3);
    if (!json_is_string(name) || !class_from_name(&object->class_, json_string_value(name)) || !json_is_boolean(in_frame) ||
        !json_is_integer(pixels) || !json_is_number(fraction) || !json_is_number(height))
        return false;
    object->in_frame = json_is_true(in_frame);
    object->visible = json_integer_value(pixels) > 0;
    object->height_px = json_number_value(height);
    object->visible_fraction = json_number_value(fraction);
    return true;
}

/* Out: *list (*n), the caller's */
static bool read_objects(struct object **list, size_t *n, const char *path, struct error *err)
{
    json_t *root = NULL;
    if (!json_file_read(&root, path, JSON_OBJECT, err)) return false;
    const json_t *entities = json_object_get(root, "entities");
    size_t count = json_array_size(entities);
    struct object *read = calloc(count + 1, sizeof *read);
    bool ok = read || error_set(err, ERR_MEMORY, "no memory for objects");
    if (ok && !json_is_array(entities)) ok = error_at(err, ERR_INPUT, path, 0, 0, "has no list of entities");
    for (size_t i = 0; ok && i < count; i++)
        ok = read_object(&read[i], json_array_get(entities, i)) ||
             error_at(err, ERR_INPUT, path, 0, 0, "entities[%zu] is not what staffage writes", i);
    json_decref(root);
    if (ok) *list = read, *n = count;
    else free(read);
    return ok;
}

/* Room for one more, which doubles. */
static bool make_room(double **values, size_t n)
{
    if (n > 0 && (n & (n - 1)) != 0) return true;
    double *more = n <= SIZE_MAX / sizeof *more / 2 ? realloc(*values, (n > 0 ? 2 * n : 1) * sizeof *more) : NULL;
    if (!more) return false;
    *values = more;
    return true;
}

static bool put(struct objects *to, const struct object *object, struct error *err)
{
    to->count++;
    if (!object->visible) return true;
    if (!make_room(&to->height_px, to->visible) || !make_room(&to->visible_fraction, to->visible))
        return error_set(err, ERR_MEMORY, "no memory for objects");
    to->height_px[to->visible] = object->height_px;
    to->visible_fraction[to->visible++] = object->visible_fraction;
    return true;
}

bool objects_add(struct objects objects[CLASS_COUNT], const char *path, struct error *err)
{
    struct object *list;
    size_t n;
    if (!read_objects(&list, &n, path, err)) return false;
    bool ok = true;
    for (size_t i = 0; ok && i < n; i++)
        if (list[i].in_frame) ok = put(&objects[list[i].class_], &list[i], err);
    free(list);
    return ok;
}

void objects_release(struct objects objects[CLASS_COUNT])
{
    for (int c = 0; c < CLASS_COUNT; c++) {
        free(objects[c].height_px);
        free(objects[c].visible_fraction);
        objects[c] = (struct objects){ 0 };
    }
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void objects_sort(struct objects objects[CLASS_COUNT])
{
    for (int c = 0; c < CLASS_COUNT; c++) {
        size_t n = objects[c].visible;
        if (n == 0) continue;
        qsort(objects[c].height_px, n, sizeof *objects[c].height_px, ascending);
        qsort(objects[c].visible_fraction, n, sizeof *objects[c].visible_fraction, ascending);
    }
}

void objects_quartiles(double quartiles[3], const double *values, size_t n)
{
    for (int k = 0; k < 3; k++) {
        double at = (double)(n - 1) * (k + 1) / 4, below = floor(at);
        size_t i = (size_t)below;
        quartiles[k] = i + 1 < n ? values[i] + (at - below) * (values[i + 1] - values[i]) : values[i];
    }
}

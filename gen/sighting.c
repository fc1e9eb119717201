#include "gen/sighting.h"

#include "lib/file.h"
#include "lib/json_file.h"

#include <jansson.h>
#include <stdlib.h>

enum { NAMED = 3 }; /* of those that have the same fault; the others are counted */

enum fault { FAULT_NONE, FAULT_OUTSIDE, FAULT_HIDDEN, FAULT_SMALL, FAULT_COUNT };

/* What all frames together show of an entity. */
struct sighting {
    bool in_frame;
    int size_px;       /* the larger side of its largest box while something of it was visible; 0: nothing ever was */
    const char *frame; /* the one with that box */
};

static enum fault fault_of(const struct sighting *s)
{
    if (!s->in_frame) return FAULT_OUTSIDE;
    if (s->size_px == 0) return FAULT_HIDDEN;
    return s->size_px < SIGHTING_SMALL_PX ? FAULT_SMALL : FAULT_NONE;
}

static bool seen_well(const struct sighting *sightings, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (fault_of(&sightings[i]) != FAULT_NONE) return false;
    return true;
}

static void look(struct sighting *s, const json_t *labels, const char *frame)
{
    const json_t *box = json_object_get(labels, "box_amodal_px");
    json_int_t width = json_integer_value(json_array_get(box, 2)), height = json_integer_value(json_array_get(box, 3));
    int size_px = (int)(width > height ? width : height);
    if (!json_is_true(json_object_get(labels, "in_frame"))) return;
    s->in_frame = true;
    if (json_integer_value(json_object_get(labels, "pixels_visible")) == 0 || size_px <= s->size_px) return;
    s->size_px = size_px;
    s->frame = frame;
}

/* The labels list the scene's own entities first, in its order. */
static bool look_at_frame(struct sighting *sightings, size_t n, const char *out_folder, const char *frame, struct error *err)
{
    char *path = string_format("%s/frames/%s/labels.json", out_folder, frame);
    json_t *root = NULL;
    bool ok = path ? json_file_read(&root, path, JSON_OBJECT, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    for (size_t i = 0; ok && i < n; i++) look(&sightings[i], json_array_get(json_object_get(root, "entities"), i), frame);
    json_decref(root);
    free(path);
    return ok;
}

static char *one_text(const char *name, const struct sighting *s)
{
    switch (fault_of(s)) {
    case FAULT_OUTSIDE: return string_format("%s is in no frame", name);
    case FAULT_HIDDEN: return string_format("%s is hidden in every frame that it is in", name);
    default: return string_format("%s is %d px large at most (frame %s)", name, s->size_px, s->frame);
    }
}

static char *count_text(size_t count, enum fault fault)
{
    const char *verb = count == 1 ? "entity is" : "entities are";
    switch (fault) {
    case FAULT_OUTSIDE: return string_format("%zu more %s in no frame", count, verb);
    case FAULT_HIDDEN: return string_format("%zu more %s hidden in every frame with them", count, verb);
    default: return string_format("%zu more %s less than %d px large in every frame", count, verb, SIGHTING_SMALL_PX);
    }
}

static bool warn_of(struct stage *stage, const struct sighting *sightings, enum fault fault, struct error *err)
{
    const struct scene *scene = stage->scene;
    size_t count = 0;
    for (size_t i = 0; i < scene->entity_count; i++) {
        if (fault_of(&sightings[i]) != fault || count++ >= NAMED) continue;
        if (!stage_warn(stage, one_text(scene->entities[i].name, &sightings[i]), err)) return false;
    }
    return count <= NAMED || stage_warn(stage, count_text(count - NAMED, fault), err);
}

bool sighting_warn(struct stage *stage, const char *out_folder, const struct frame_result *frames, size_t n, struct error *err)
{
    size_t count = stage->scene->entity_count;
    struct sighting *sightings = calloc(count + 1, sizeof *sightings);
    bool ok = sightings || error_set(err, ERR_MEMORY, "no memory for what frames show");
    for (size_t i = 0; ok && i < n && !seen_well(sightings, count); i++)
        ok = look_at_frame(sightings, count, out_folder, frames[i].name, err);
    for (int fault = FAULT_OUTSIDE; ok && fault < FAULT_COUNT; fault++)
        ok = warn_of(stage, sightings, (enum fault)fault, err);
    free(sightings);
    return ok;
}

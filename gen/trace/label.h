/* The label files of a frame; docs/labels.md describes every key. */
#ifndef STAFFAGE_GEN_LABEL_H
#define STAFFAGE_GEN_LABEL_H

#include "gen/world/entity.h"
#include "gen/trace/trace.h"
#include "lib/camera.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* What the labels say beside what was traced. All borrowed. */
struct label_context {
    const char *frame;             /* "000123" */
    const char *photograph;        /* path */
    const struct camera *camera;
    struct pose world_from_camera;
    bool has_sun;
    struct vec3 sun_direction;
    const struct entity *entities; /* (entity_count) in the order of the labels */
    size_t entity_count;
};

/* Write instance.png, depth.exr, amodal.json, amodal/NNNNN.exr, labels.json and, where there are
 * occluders, visible.png and receiver.png into a frame's folder.
 * Err: ERR_IO, ERR_MEMORY */
bool labels_write(const char *frame_folder, const struct frame_labels *labels, const struct label_context *context,
                  struct error *err);

#endif

/* The label files of a frame; docs/labels.md describes every key. */
#ifndef STAFFAGE_GEN_LABEL_H
#define STAFFAGE_GEN_LABEL_H

#include "gen/world/entity.h"
#include "gen/trace/trace.h"
#include "lib/camera.h"
#include "lib/class.h"
#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

/* What the labels say beside what was traced. All borrowed. */
struct label_context {
    const char *frame;             /* "000123" */
    const char *photograph;        /* path; NULL: a view that no photograph has */
    const struct camera *camera;
    struct pose world_from_camera;
    bool has_sun;
    struct vec3 sun_direction;
    const struct entity *entities; /* (entity_count) in the order of the labels */
    size_t entity_count;
    double time_s;                 /* since the scene began; NAN: a scene that stands still */
    const char *time;              /* ISO 8601; NULL: none */
    const struct vec3 *velocity_m_s; /* (entity_count) world; NULL: none */
    enum palette palette;          /* of semantic_id */
    const struct image *motion;    /* by motion_trace; NULL: none */
};

/* Write instance.png, depth.exr, amodal.json, amodal/NNNNN.exr, labels.json and, where there are
 * occluders or a place, visible.png and receiver.png; of a place place_depth.exr, and
 * place_labels.png if it has labels; and motion.exr, into a frame's folder.
 * Err: ERR_IO, ERR_MEMORY */
bool labels_write(const char *frame_folder, const struct frame_labels *labels, const struct label_context *context,
                  struct error *err);

#endif

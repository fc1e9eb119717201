/* Pixels of a shot that show road in full light: what its exposure is fitted to. */
#ifndef STAFFAGE_GEN_SUNLIT_H
#define STAFFAGE_GEN_SUNLIT_H

#include "gen/light/light.h"
#include "gen/stage.h"
#include "lib/camera.h"
#include "lib/error.h"

#include <stddef.h>

/* Points of the roads, evenly over all of them, that the camera sees and that nothing of the static mesh
 * shades; the middle of roads for vehicles, and of footways where there are none.
 * Out: *q_px, the caller's (free), at most SUNLIT_MAX; none is no error
 * Err: ERR_MEMORY */
#define SUNLIT_MAX 2000
bool sunlit_pixels(struct vec2 **q_px, size_t *n, const struct stage *stage, const struct light *light,
                   const struct camera *camera, struct pose world_from_camera, struct error *err);

#endif

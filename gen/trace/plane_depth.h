/* How far away a ground plane is, pixel by pixel. */
#ifndef STAFFAGE_GEN_TRACE_PLANE_DEPTH_H
#define STAFFAGE_GEN_TRACE_PLANE_DEPTH_H

#include "gen/world/ground.h"
#include "lib/camera.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

/* Out: depth  F32 1, initialized here: z by the ray through each pixel's centre, NaN above the horizon
 * Err: ERR_MEMORY */
bool plane_depth(struct image *depth, const struct plane *plane, const struct camera *camera,
                 struct pose world_from_camera, struct error *err);

#endif

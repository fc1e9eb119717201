/* The place alone, as a camera sees it where no photograph was taken. */
#ifndef STAFFAGE_GEN_TRACE_PLACE_H
#define STAFFAGE_GEN_TRACE_PLACE_H

#include "gen/world/static_mesh.h"
#include "lib/camera.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#define PLACE_HOLE_SRGB 128 /* grey where there is nothing: sky, and holes of the mesh */

struct place_view {
    struct image rgb;    /* U8 3 sRGB, through the camera's own lens; pixels at edges from PLACE_SAMPLES squared rays */
    struct image cover;  /* U8 1: 255 x share of the pixel's rays that meet the place; 0 is all PLACE_HOLE_SRGB */
    struct image depth;  /* F32 1: z by the ray through the centre, NaN in holes */
    struct image label;  /* U8 1: the face's label there, 0 without; empty unless the mesh has labels */
};
#define PLACE_SAMPLES 4

/* Out: *view, initialized here; free with place_view_release
 * In:  mesh indexed
 * Err: ERR_INPUT: the mesh has no colours; ERR_MEMORY */
bool place_render(struct place_view *view, const struct static_mesh *mesh, const struct camera *camera,
                  struct pose world_from_camera, struct error *err);
void place_view_release(struct place_view *view);

#endif

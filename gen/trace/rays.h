/* Rays through the centres of a row of pixels, in the photograph and up to one width beside it.
 *
 * A lens has to be inverted step by step, which costs more than to trace the ray. So rays are
 * computed at some pixels and interpolated (cubic) between; a cell of pixels for which that is off
 * by more than RAYS_TOLERANCE_PX in its middle, or that reaches where the lens maps no direction, is
 * computed pixel by pixel. */
#ifndef STAFFAGE_GEN_RAYS_H
#define STAFFAGE_GEN_RAYS_H

#include "lib/camera.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stdint.h>

#define RAYS_TOLERANCE_PX 1e-5

struct rays {
    const struct camera *camera; /* borrowed */
    struct camera_intrinsics in;
    bool pinhole;
    int y;
    double within_px;   /* where in a pixel: 0.5 its centre, 0 its corner at the top left */
    /* Beside the photograph as well: index 0 is x = -width_px. */
    struct vec3 *ray;   /* (3 width) unit, camera coordinates */
    bool *exists;       /* (3 width) the lens maps a direction there */
    struct vec3 *node;  /* (cells + 3) exact, at the first pixel of a cell; one cell more before, two behind */
    uint8_t *node_state;
    bool *cell_ready;   /* (cells) */
    int cells;
};

/* Err: ERR_MEMORY. rays_release may be called after a failure, too. */
bool rays_init(struct rays *rays, const struct camera *camera, struct error *err);
/* The same through the pixels' top left corners. */
bool rays_init_corners(struct rays *rays, const struct camera *camera, struct error *err);
void rays_release(struct rays *rays);
void rays_begin_row(struct rays *rays, int y);
/* Out: *direction unit, camera coordinates. False where the lens maps no direction.
 * In:  x from -width_px to 2 width_px - 1 */
bool rays_get(struct rays *rays, struct vec3 *direction, int x);

#endif

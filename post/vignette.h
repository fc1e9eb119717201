/* How a lens's picture darkens towards its corners: V(r) = 1 - fall_off r^2, r = 1 in the corners. */
#ifndef STAFFAGE_POST_VIGNETTE_H
#define STAFFAGE_POST_VIGNETTE_H

#include "lib/image.h"
#include "lib/rect.h"
#include "lib/vec.h"
#include "post/flat.h"

#include <stdbool.h>
#include <stddef.h>

struct vignette {
    double fall_off;        /* share of the light that the corners lose */
    double quarter[4];      /* the same from the right, lower, left and upper quarter of the picture alone */
    bool agree;             /* whether these tell the same: else it is light of the place and not of the lens */
    size_t patches;
};

/* From the slopes of brightness in flat patches: of all that makes them, only the lens points to the middle everywhere.
 * Src: after Y. Zheng, J. Yu, S. B. Kang, S. Lin, C. Kambhamettu, Single-image vignetting correction using
 *      radial gradient symmetry, CVPR 2008
 * In:  patches, of a picture of this size */
void vignette_measure(struct vignette *vignette, const struct flat_patches *patches, int width_px, int height_px);

/* V at a place of a picture of this size. */
double vignette_at(double fall_off, struct vec2 q_px, int width_px, int height_px);
/* Darken what is put in as the photograph is there, whose exposure is right at `fitted_px`.
 * In/out: object (F32 RGBA, linear), the window of a picture of this size */
void vignette_shade(struct image *object, double fall_off, struct vec2 fitted_px, struct rect window_px, int width_px, int height_px);

#endif

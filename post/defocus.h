/* What is out of focus: every point becomes a disc. */
#ifndef STAFFAGE_POST_DEFOCUS_H
#define STAFFAGE_POST_DEFOCUS_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

#define DEFOCUS_MAX_PX 256.0

/* Diameter of the disc that a point at depth z_m becomes: at_infinity_px |1 - focus_m / z_m|, at most
 * DEFOCUS_MAX_PX; 0 for a depth that is not known.
 * Src: similar triangles of a thin lens, z much larger than its focal length */
double defocus_diameter_px(double at_infinity_px, double focus_m, double z_m);

/* Blur the layers by the discs of their depths. An edge takes the depth of the nearest pixel that has one.
 * In/out: object (F32 RGBA), light (as of ground_light_take)
 * In:  depth (F32) of the entities, NaN where none is seen; ground (F32) that of the ground, NaN where it is
 *      not known; empty: it is taken to be that of the nearest entity;
 *      visible, receiver (U8, or NULL) as for the transfers; all of one size
 * Err: ERR_MEMORY */
bool defocus_blur(struct image *object, struct image *light, const struct image *depth, const struct image *ground,
                  const struct image *visible, const struct image *receiver, double at_infinity_px, double focus_m,
                  struct error *err);

#endif

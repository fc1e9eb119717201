/* How near a picture comes to the truth. */
#ifndef STAFFAGE_PROVING_COMPARE_PICTURE_H
#define STAFFAGE_PROVING_COMPARE_PICTURE_H

#include "compare.h"
#include "lib/image.h"

/* Photograph and truth as developed (U8 3) and as light without noise (F32 3), the result, the same without grain and
 * compression (or empty), and whose each pixel is in truth. */
struct picture_input { struct image photograph, truth, result, photograph_light, truth_light, plain, owner; };

/* Fills the first three groups of figures.
 * In: owner U8 1: the entity, or 0 */
bool compare_picture(struct comparison *to, const struct picture_input *in, struct error *err);

#endif

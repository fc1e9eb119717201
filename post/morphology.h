/* Neighbourhood operations of OpenCV. All are on one-channel images of 3 by 3 pixels
 * unless said; beyond the border nothing grows in and nothing is eaten away. */
#ifndef STAFFAGE_POST_MORPHOLOGY_H
#define STAFFAGE_POST_MORPHOLOGY_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The largest value around each pixel. Out: of the size and type of `in`, initialized here. */
bool morphology_dilate(struct image *out, const struct image *in, struct error *err);
/* The smallest value around each pixel. Out: as above. */
bool morphology_erode(struct image *out, const struct image *in, struct error *err);
/* Gaussian of 5 by 5 pixels, sigma 1.1; the border is mirrored. Out: as above. */
bool morphology_blur(struct image *out, const struct image *in, struct error *err);
/* Gaussian, cut off at 3 sigma; F32 of any channels; beyond the border is 0. Out: as above. */
bool morphology_gaussian(struct image *out, const struct image *in, double sigma_px, struct error *err);

#ifdef __cplusplus
}
#endif
#endif

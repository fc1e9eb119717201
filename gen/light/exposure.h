/* How bright the render must be to belong into the photograph. */
#ifndef STAFFAGE_GEN_EXPOSURE_H
#define STAFFAGE_GEN_EXPOSURE_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/rect.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

struct exposure {
    double k[3];        /* linear photograph value per unit of radiance, for R, G and B */
    struct vec2 at_px;  /* where in the picture that is so: its middle, if it was given; that of the patch; the mean of the samples */
    bool fitted;
    struct rect patch_px; /* of a fit to a patch, else empty */
    size_t samples;     /* of a fit to samples, else 0: how many were of use */
    double median[3];   /* of the fit: linear values of the patch or the samples */
};

struct exposure exposure_given(const double k[3], int width_px, int height_px);

/* Fit to a patch of unshadowed ground: its median over the radiance of the rendered ground,
 * channel by channel (white_balance) or one k by luminance.
 * In:  photograph (U8, 3 channels, sRGB)
 * Err: ERR_INPUT: the patch lies outside, is saturated in more than 1 % of its pixels, is
 *      black, or is not one surface in one light (its 90th percentile of luminance is more
 *      than 4 times the 10th); or the ground_radiance is not positive */
bool exposure_fit(struct exposure *exposure, const struct image *photograph, struct rect patch_px,
                  const double ground_radiance[3], bool white_balance, struct error *err);

/* The same from pixels here and there that show sunlit ground, such as a road's. Those outside the
 * picture or saturated are left out.
 * In:  sample_px (n)
 * Err: ERR_INPUT: fewer than 20 are of use, or they are black; or as above */
bool exposure_fit_samples(struct exposure *exposure, const struct image *photograph, const struct vec2 *sample_px,
                          size_t n, const double ground_radiance[3], bool white_balance, struct error *err);

/* The same, seen through air: of the medians, the haze's own light is taken away, and what the air
 * keeps back is given to the rest.
 * In:  transmission above 0; haze as linear values of the photograph
 * Err: ERR_INPUT: the ground is not brighter than the haze before it */
bool exposure_clear(struct exposure *exposure, double transmission, const double haze[3],
                    const double ground_radiance[3], bool white_balance, struct error *err);

#endif

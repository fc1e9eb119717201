/* The softness that all of a photograph has: of its lens, its sensor, its compression. */
#ifndef STAFFAGE_POST_SOFTNESS_H
#define STAFFAGE_POST_SOFTNESS_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* Blur both layers by a Gaussian, which is cut off at 3 standard deviations.
 * In/out: object (F32 RGBA), light (as of ground_light_take)
 * In:  visible, receiver (U8, or NULL) as for the transfers
 * Err: ERR_MEMORY */
bool softness_blur(struct image *object, struct image *light, const struct image *visible, const struct image *receiver,
                   double sigma_px, struct error *err);

#endif

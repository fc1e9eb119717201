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

/* Blur the edge of what hides a layer: the lens mixed it with what is behind.
 * In/out: share (U8): 255 where nothing hides. Err: ERR_MEMORY */
bool softness_share(struct image *share, double sigma_px, struct error *err);

#define SOFTNESS_TAKEN_BACK_MAX_PX2 0.1 /* more would show the steps between few samples */

/* Make both layers narrower by this variance, at most SOFTNESS_TAKEN_BACK_MAX_PX2: what an anti-aliasing of few
 * samples has blurred too much. Cover stays between 0 and 1, and light at or above 0.
 * In/out: as above. Err: ERR_MEMORY */
bool softness_take_back(struct image *object, struct image *light, double variance_px2, struct error *err);

#endif

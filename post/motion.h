/* Motion blur: what moves while the shutter is open is spread evenly along its way. */
#ifndef STAFFAGE_POST_MOTION_H
#define STAFFAGE_POST_MOTION_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

#define MOTION_MAX_PX 1024.0

/* Each pixel takes the mean along the way of the entity that is seen there, or of the nearest one: so
 * the blur reaches out of the mask by half of the way, of which no more than MOTION_MAX_PX counts. The ground's light moves with the ground.
 * In/out: object (F32 RGBA), light (as of ground_light_take)
 * In:  motion (F32, 3 channels): px right, px down, 0; depth (F32), NaN where no entity is seen;
 *      plane (F32 RGBA): alpha 0 where no ground is, and its motion there that of the nearest;
 *      visible, receiver (U8, or NULL) as for the transfers; all of one size
 * Err: ERR_MEMORY */
bool motion_blur(struct image *object, struct image *light, const struct image *motion, const struct image *depth,
                 const struct image *plane, const struct image *visible, const struct image *receiver, struct error *err);

#endif

/* The nearest pixel that has something, for those that have nothing. */
#ifndef STAFFAGE_POST_SPREAD_H
#define STAFFAGE_POST_SPREAD_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* Give each pixel whose first channel is NaN the values of the nearest that has a number there,
 * however far that is. Without any such pixel nothing changes.
 * In/out: image (F32). Err: ERR_MEMORY */
bool spread_known(struct image *image, struct error *err);

/* Which pixels lie within `reach_px` of one that is marked.
 * In/out: mask (U8, 1 channel): 0, or marked. Err: ERR_MEMORY */
bool spread_mask(struct image *mask, double reach_px, struct error *err);

#endif

/* Float layers of a window that are changed as a whole. */
#ifndef STAFFAGE_POST_LAYER_H
#define STAFFAGE_POST_LAYER_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* Out: initialized here. Err: ERR_MEMORY */
bool layer_copy(struct image *out, const struct image *in, struct error *err);
/* Where a layer (F32) has anything within `reach_px`: only there can a blur change it.
 * Out: near (U8): 0 or 1, initialized here. Err: ERR_MEMORY */
bool layer_reach(struct image *near, const struct image *layer, double reach_px, struct error *err);
/* Put `made`, which is taken over, in the place of a layer: or, when it did not come out well, let it go. */
void layer_replace(struct image *layer, struct image *made, bool good);

#endif

/* What a frame's labels are before anything is put in: the photograph's own, or the place's. */
#ifndef STAFFAGE_POST_BEFORE_H
#define STAFFAGE_POST_BEFORE_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/manifest.h"

#include <stdbool.h>

/* In, here and below: out, the output folder; the frame's manifest
 * Err: ERR_INPUT at the file: missing, truncated, of another kind, or not in proportion to the picture */

/* Out: semantic, U8: of 1 channel, ids; of 3 or 4, colours; empty when the frame has none.
 *      Initialized here, of the picture's size: the nearest pixels where it is stored at another. */
bool before_semantic(struct image *semantic, const char *out, const struct manifest *manifest, struct error *err);

/* Out: depth of 1 channel: F32 in metres or U16 in millimetres, 0 = unknown; empty when the frame has
 *      none. Initialized here, as above. */
bool before_depth(struct image *depth, const char *out, const struct manifest *manifest, struct error *err);

#endif

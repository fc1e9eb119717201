/* Depth in metres, and as 16-bit pictures for readers that have no EXR. */
#ifndef STAFFAGE_POST_DEPTH_H
#define STAFFAGE_POST_DEPTH_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* The depth that a frame has before, overwritten where an entity is; nothing else changes in the form
 * that `before` has, and the other form is made from it. Millimetres are rounded; 0 = unknown, which
 * is also what does not fit (65.5355 m and more).
 * Out: metres (F32) and millimetres (U16), initialized here
 * In:  before, F32 metres or U16 millimetres, or empty; entity (F32, NaN = no entity) */
bool depth_overwrite(struct image *metres, struct image *millimetres, const struct image *before,
                     const struct image *entity, struct error *err);

#endif

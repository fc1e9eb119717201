/* Depth as 16-bit pictures, for readers that have no EXR. */
#ifndef STAFFAGE_POST_DEPTH_H
#define STAFFAGE_POST_DEPTH_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* Millimetres, rounded; 0 = unknown, which is also what does not fit (65.5355 m and more).
 * Out: (U16), initialized here. In: depth_m (F32, 1 channel, NaN = unknown) */
bool depth_millimetres(struct image *out, const struct image *depth_m, struct error *err);

#endif

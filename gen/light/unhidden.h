/* Where a picture shows the place itself, and not what its user outlined before it. */
#ifndef STAFFAGE_GEN_UNHIDDEN_H
#define STAFFAGE_GEN_UNHIDDEN_H

#include "gen/trace/trace.h"
#include "lib/error.h"
#include "lib/image.h"

#include <stddef.h>

/* Outlines are drawn by hand, and lenses mix what meets there: they reach a little farther than they were drawn.
 * Out: *unhidden (U8, 1 channel): 255, 0 where something stands
 * Err: ERR_MEMORY */
bool unhidden_create(struct image *unhidden, const struct occluder *occluders, size_t n, int width_px, int height_px, struct error *err);

#endif

/* A camera's sharpening, done to what is put in: to the picture is added a part of what it differs by from
 * itself blurred by a Gaussian of STEP_SHARPENING_PX. In levels, since a camera does it last, and of the
 * brightness only, so that no colour comes of it. */
#ifndef STAFFAGE_POST_SHARPENING_H
#define STAFFAGE_POST_SHARPENING_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* What of the photograph shows through was sharpened with it, and is not once more.
 * In/out: levels (F32, 3 channels, 0..255)
 * In:  before (F32, 3 channels, 0..255), the photograph; cover (F32, 1 channel): the share of each pixel that hides it
 * Err: ERR_MEMORY */
bool sharpening_add(struct image *levels, const struct image *before, const struct image *cover, double amount, struct error *err);

/* Undo as much, of a picture's brightness. In/out: levels (F32, 1 channel). Err: ERR_MEMORY; levels are then no use */
bool sharpening_take_back(struct image *levels, double amount, struct error *err);

#endif

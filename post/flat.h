/* Small squares of a photograph, and how far each is from an even ramp of brightness: in the flattest
 * of them there is nothing to see but what the camera added. */
#ifndef STAFFAGE_POST_FLAT_H
#define STAFFAGE_POST_FLAT_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

#define FLAT_SIDE_PX 16

struct flat_patch {
    int x, y;           /* its first pixel */
    double level;       /* mean of R, G and B, 0..255 */
    double right, down; /* how much that rises in a pixel */
    double variance[2]; /* of (R + G + B) / sqrt(3) about the ramp, of either half: two diagonal quarters, and the others */
};
double flat_patch_variance(const struct flat_patch *patch); /* of both halves */

struct flat_patches { struct flat_patch *patch; size_t count; };

/* Evenly spread over the photograph, some ten thousands at most, without those that touch 0 or 255
 * in any channel, where a camera shows no noise.
 * Out: patches, by rows; release them. In: rgb (U8, 3 channels). Err: ERR_MEMORY */
bool flat_patches_find(struct flat_patches *patches, const struct image *rgb, struct error *err);
void flat_patches_release(struct flat_patches *patches);

#endif

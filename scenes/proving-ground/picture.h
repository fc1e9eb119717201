/* A part of a picture, its truth and their difference, side by side. */
#ifndef STAFFAGE_PROVING_PICTURE_H
#define STAFFAGE_PROVING_PICTURE_H

#include "lib/image.h"
#include "lib/rect.h"

/* Out: picture (U8 3, initialized here): result, truth, and 128 + 4 (result - truth)
 * In:  result, truth U8 3 of one size
 * Err: ERR_INPUT: they are of two sizes, or the part lies outside */
bool picture_beside(struct image *picture, const struct image *result, const struct image *truth, struct rect part, struct error *err);

#endif

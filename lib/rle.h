/* Masks as COCO writes them: runs of 0 and 1 down the columns, zeros first,
 * and the printable string that carries the runs in JSON.
 * Src: FORMATS.md; the string's differences start at the fourth run, as in every
 *      published COCO file (the first three are written as they are). */
#ifndef STAFFAGE_LIB_RLE_H
#define STAFFAGE_LIB_RLE_H

#include "lib/error.h"
#include "lib/rect.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The lengths of the runs: zeros first (that one may be 0 long); their sum is
 * height_px * width_px, at most UINT32_MAX. */
struct rle {
    int width_px, height_px;
    uint32_t *counts;  /* (count) owned */
    size_t count;
};

/* In: mask (h,w) of mask_px, 0 or not; mask_px lies within the picture, whose other pixels are 0.
 *     A NULL mask with an empty mask_px is a picture of zeros.
 * Err: ERR_MEMORY; rle untouched */
bool rle_encode(struct rle *rle, const uint8_t *mask, struct rect mask_px, int width_px, int height_px,
                struct error *err);
/* Out: mask (height_px, width_px) row-major, 0 or 1 */
void rle_decode(uint8_t *mask, const struct rle *rle);
/* The compressed string, NUL-terminated; the caller frees. NULL only when memory ends. */
char *rle_to_string(const struct rle *rle);
/* Err: ERR_INPUT: a byte that the format does not have, an end within a number, runs that do
 *      not fill the picture; ERR_MEMORY; rle untouched */
bool rle_from_string(struct rle *rle, const char *string, int width_px, int height_px, struct error *err);
/* How many pixels are 1. */
uint64_t rle_area(const struct rle *rle);
void rle_release(struct rle *rle);

#endif

/* Blurs that differ from pixel to pixel: the weights of the pixels around one, and their mean. */
#ifndef STAFFAGE_POST_KERNEL_H
#define STAFFAGE_POST_KERNEL_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

struct tap { int dx, dy; float weight; };
/* The weights add up to 1. */
struct kernel { struct tap *taps; size_t count; };

/* How much of a disc round the middle of a pixel lies in each pixel: of 1 px or less, all in its own. */
bool kernel_disc(struct kernel *kernel, double diameter_px, struct error *err);
/* Even steps along a vector whose middle is the middle of a pixel, each shared among the four pixels round it. */
bool kernel_line(struct kernel *kernel, double dx_px, double dy_px, struct error *err);
void kernel_release(struct kernel *kernel);

/* The mean around a pixel of what can be seen: sum(w share in) / sum(w share). Where nothing hides, that
 * is a plain blur; and what is hidden neither spills from behind an edge nor darkens what is beside it.
 * Beyond the image is nothing, unhidden. Where nothing is seen at all, nothing comes out.
 * Out: mean, a number for each channel of `in` (at most 4)
 * In:  in (F32); share (U8, 255 = all of the pixel is seen; NULL: everywhere) */
void kernel_mean(float *mean, const struct kernel *kernel, const struct image *in, const struct image *share, int x, int y);

#endif

/* How sharp the edges of a picture are. */
#ifndef STAFFAGE_POST_EDGE_H
#define STAFFAGE_POST_EDGE_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

#define EDGE_SHARPENING_PX 1.0  /* standard deviation of the Gaussian whose difference to a picture a camera adds to it */

struct edges {
    size_t count;               /* that could be measured */
    double sigma_px[3];         /* standard deviation of their blur before sharpening, the pixel's area in it: quartiles */
    double low, high;           /* medians of the brightness on their two sides, 0 to 1 */
    double sharpening;          /* how much of the difference was added; 0 where that cannot be told from chance */
    size_t telling;             /* edges that are narrow enough to tell */
    double sharpening_quartiles[3];
};

/* Fit a blurred and sharpened step, in levels, to the strongest straight and lone edges, one a square of some
 * pixels; their slant samples it finer than a pixel, as in ISO 12233. Those that clip at 255 are left out.
 * In:  rgb (U8, 3 channels); only (U8, 1 channel, or NULL): where an edge's middle must lie, not 0
 * Err: ERR_MEMORY */
bool edges_measure(struct edges *edges, const struct image *rgb, const struct image *only, struct error *err);

/* The same of a rendered layer's outlines, as they come out between two brightnesses.
 * In: object (F32 RGBA), of which alpha counts; low, high (0 to 1). Err: ERR_MEMORY */
bool edges_of_layer(struct edges *edges, const struct image *object, double low, double high, struct error *err);

#endif

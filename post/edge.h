/* How sharp the edges of a picture are. */
#ifndef STAFFAGE_POST_EDGE_H
#define STAFFAGE_POST_EDGE_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

struct edges {
    size_t count;               /* that could be measured */
    double sigma_px[3];         /* standard deviation of their blur, the pixel's area in it: quartiles */
};

/* Fit a blurred step, in linear light, to the strongest straight and lone edges, one a square of some pixels;
 * their slant samples it finer than a pixel, as in ISO 12233. Those that clip at 255 are left out.
 * In:  rgb (U8, 3 channels); only (U8, 1 channel, or NULL): where an edge's middle must lie, not 0
 * Err: ERR_MEMORY */
bool edges_measure(struct edges *edges, const struct image *rgb, const struct image *only, struct error *err);

/* The same of a rendered layer's outlines. In: object (F32 RGBA), of which alpha counts. Err: ERR_MEMORY */
bool edges_of_layer(struct edges *edges, const struct image *object, struct error *err);

/* The blur that gives an edge as wide as `wanted_px` to one that has `own_px`; 0 when that is wider already. */
double edge_softness(double wanted_px, double own_px);

#endif

/* How sharp the edges of a picture are. */
#ifndef STAFFAGE_POST_EDGE_H
#define STAFFAGE_POST_EDGE_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

/* Widths are standard deviations of the blur before sharpening, the pixel's area in it. */
struct edges {
    size_t count;               /* that could be measured */
    double sharp_px;            /* the width on which the sharp ones agree; 0 where there are none */
    double sigma_px[3];         /* of all of them: quartiles */
    double sharpening;          /* how much of the difference to the picture blurred by STEP_SHARPENING_PX was added; 0 where
                                 * that cannot be told from chance */
    size_t telling;             /* edges that tell */
    double sharpening_quartiles[3];
};

/* Fit a blurred step, in linear light, to the strongest straight and lone edges, one a square of some pixels. The picture's
 * sharpening is looked for in levels, on sharp edges, and taken back before. Those that clip at 255 are left out.
 * In:  rgb (U8, 3 channels); only (U8, 1 channel, or NULL): where an edge's middle must lie, not 0
 * Err: ERR_MEMORY */
bool edges_measure(struct edges *edges, const struct image *rgb, const struct image *only, struct error *err);

/* The same of a rendered layer's outlines. In: object (F32 RGBA), of which alpha counts. Err: ERR_MEMORY */
bool edges_of_layer(struct edges *edges, const struct image *object, struct error *err);

/* How wide one picture's edges are, compared with those at the same places of another, as taken (not sharpened): the
 * median ratio. What the place has beside an edge is the same in both, and cancels.
 * Out: ratio, NAN where there is none; count. In: rgb, of (U8, 3 channels), only: as above. Err: ERR_MEMORY */
bool edges_compare(double *ratio, size_t *count, const struct image *rgb, const struct image *of, const struct image *only,
                   struct error *err);

#endif

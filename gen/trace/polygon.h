/* Which parts of a row of pixels a polygon covers: even-odd rule, 8 x 8 samples a pixel. */
#ifndef STAFFAGE_GEN_POLYGON_H
#define STAFFAGE_GEN_POLYGON_H

#include "lib/vec.h"
#include "lib/rect.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct polygon {
    const struct vec2 *points_px; /* (count) continuous pixels, borrowed; the last joins the first */
    size_t count;
    double *crossings_px;         /* (count) scratch, owned */
};

/* Returns false when memory ends. */
bool polygon_init(struct polygon *polygon, const struct vec2 *points_px, size_t count);
void polygon_release(struct polygon *polygon);

/* The pixels that can have a share in the polygon, within a picture. */
struct rect polygon_bounds(const struct polygon *polygon, int width_px, int height_px);

/* Out: inside (x1 - x0): is the pixel's centre within the polygon? */
void polygon_row_centres(const struct polygon *polygon, bool *inside, int y, int x0, int x1);
/* Out: samples (x1 - x0): bit 8 j + i is set when the point ((i + 0.5) / 8, (j + 0.5) / 8) of the pixel is inside */
void polygon_row_samples(const struct polygon *polygon, uint64_t *samples, int y, int x0, int x1);

#endif

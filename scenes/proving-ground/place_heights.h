/* The street's heights in cells, as a reconstruction has them: what stands on the ground as columns of matter, and trees, which
 * hang over it, from their undersides to their tops. */
#ifndef STAFFAGE_PROVING_PLACE_HEIGHTS_H
#define STAFFAGE_PROVING_PLACE_HEIGHTS_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdbool.h>

/* The pictures of it that write_pov knows: from above without trees; trees alone, from above and from below. */
enum { HEIGHTS_GROUND, HEIGHTS_TOP, HEIGHTS_BOTTOM, HEIGHTS_KINDS };
extern const char *const place_heights_kinds[HEIGHTS_KINDS];

#define PROVING_MESH_ERROR_M 0.02   /* standard deviation of the waves, along z */
#define PROVING_MESH_WAVE_M 1.6     /* their length */

/* Cells by columns from the west, by rows from the north: the pictures'. */
struct place_heights {
    float *z_m[HEIGHTS_KINDS];      /* (PROVING_MESH_ROWS, PROVING_MESH_COLUMNS); of trees NAN where there is none */
};

/* The pictures' heights, off by smooth waves.
 * In: pictures (HEIGHTS_KINDS) U16. Out: *heights, initialized here; free with place_heights_release */
bool place_heights_create(struct place_heights *heights, const struct image *pictures, struct error *err);
void place_heights_release(struct place_heights *heights);

/* The point of a cell at this height. */
struct vec3 place_heights_point(int column, int row, double z_m);
/* Is there matter, more than 5 cm deep? Nothing is outside of the cells. */
bool place_heights_solid(const struct place_heights *heights, struct vec3 p);

#endif

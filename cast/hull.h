/* A closed surface of triangles that share points; of several pieces, each of a material of its own. */
#ifndef STAFFAGE_CAST_HULL_H
#define STAFFAGE_CAST_HULL_H

#include "cast/field.h"
#include "lib/vec.h"

#include <stddef.h>
#include <stdint.h>

struct hull { /* { 0 } is empty; running out of memory ends the program */
    struct vec3 *point;
    uint8_t *piece;               /* (points) */
    uint32_t (*triangle)[3];      /* counter-clockwise from outside */
    uint8_t *material;            /* (triangles) or NULL: where it changes, there is a line to keep */
    size_t points, triangles;
};

/* Append the surface of a shape, as a net in cells of a size. */
void hull_add_shape(struct hull *hull, const struct shape *shape, int piece, double cell_m);
/* Make do with fewer triangles, where they are missed least; closed stays closed.
 * In: weight  (pieces) how much an error counts there
 * Src: Garland, Heckbert 1997, Surface simplification using quadric error metrics */
void hull_decimate(struct hull *hull, size_t triangles, const double *weight);
struct hull hull_copy(const struct hull *hull);
void hull_release(struct hull *hull);

#endif

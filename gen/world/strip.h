/* Along and across: where points of the world lie beside a path. */
#ifndef STAFFAGE_GEN_STRIP_H
#define STAFFAGE_GEN_STRIP_H

#include "gen/world/path.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The samples of a path in square cells, so that its nearest one is found at once. */
struct strip {
    const struct path *path; /* borrowed */
    double reach_m;
    struct vec2 min_m, max_m;/* of what lies within reach */
    double cell_m;           /* >= reach_m */
    size_t columns, rows;    /* of cells, x and y */
    uint32_t *first;         /* (rows * columns + 1) into sample */
    uint32_t *sample;        /* (path.n) by cell */
};

/* Err: ERR_MEMORY */
bool strip_create(struct strip *strip, const struct path *path, double reach_m, struct error *err);
void strip_release(struct strip *strip);

/* s_m < 0 before the path's begin, > its length after its end; offset_m to the left. */
struct strip_place { double s_m, offset_m; };
/* False where (x, y) is farther than reach_m from the path. */
bool strip_find(const struct strip *strip, struct strip_place *place, double x_m, double y_m);
/* In a narrow bend, and where a path comes by again, a point lies beside it more than once: wherever
 * the path is nearer than just before and after. Out: places, nearest first. Returns how many. */
#define STRIP_PLACES 4
size_t strip_find_all(const struct strip *strip, struct strip_place places[STRIP_PLACES], double x_m, double y_m);

/* The mesh near the strip, in pieces whose edges are at most edge_m long on the map. */
typedef void strip_visitor(void *user, const struct vec3 corner_m[3]);
void strip_visit(const struct strip *strip, struct static_mesh *mesh, double edge_m, strip_visitor *visit, void *user);
/* The same of one triangle. */
void strip_visit_triangle(const struct strip *strip, const struct vec3 corner_m[3], double edge_m,
                          strip_visitor *visit, void *user);

#endif

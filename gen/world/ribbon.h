/* A smooth road over a lumpy mesh: a strip along a way, fitted robustly to the mesh below it. */
#ifndef STAFFAGE_GEN_RIBBON_H
#define STAFFAGE_GEN_RIBBON_H

#include "gen/world/road.h"
#include "gen/world/static_mesh.h"

#include <stdbool.h>
#include <stddef.h>

/* Heights on a grid along the way (rows, RIBBON_STEP_M apart) and across it (columns, from right to left). */
#define RIBBON_STEP_M 0.5
struct ribbon {
    const struct way *way;   /* borrowed */
    double half_width_m;     /* half of carriageway and sidewalks together */
    size_t rows, columns;
    double *height_m;        /* (rows, columns) */
};

/* Fit to the vertices of the mesh within the ribbon: bumps (parked cars, crowns of trees) and holes do
 * not lift or sink it; heights are smooth along and across.
 * Err: ERR_INPUT without a place: fewer than a fifth of the way lies over the mesh */
bool ribbon_fit(struct ribbon *ribbon, const struct way *way, struct static_mesh *mesh, struct error *err);
void ribbon_release(struct ribbon *ribbon);
/* False outside the ribbon. normal: unit, upward. */
bool ribbon_at(const struct ribbon *ribbon, double *z_m, struct vec3 *normal, double x_m, double y_m);

/* Lay the ribbons into the mesh: vertices near them in height are moved onto them, those along their
 * edges part of the way (so that no edge shows), holes are filled; what stands on the road or reaches
 * over it (more than RIBBON_CLEAR_M away in height) stays. Before static_mesh_index. */
#define RIBBON_CLEAR_M 0.6
bool ribbons_lay(struct static_mesh *mesh, const struct ribbon *ribbons, size_t n, struct error *err);

#endif

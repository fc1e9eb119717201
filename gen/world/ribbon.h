/* A smooth road over a lumpy mesh: a strip along a way, fitted robustly to the mesh below it. */
#ifndef STAFFAGE_GEN_RIBBON_H
#define STAFFAGE_GEN_RIBBON_H

#include "gen/world/road.h"
#include "gen/world/static_mesh.h"
#include "gen/world/strip.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

/* Heights on a grid along the way (rows, RIBBON_STEP_M apart) and across it (columns, from right to left). */
#define RIBBON_STEP_M 0.5
#define RIBBON_MARGIN_M 1.0  /* beside the edges: there mesh and ribbon fade into each other */
struct ribbon {
    const struct way *way;   /* borrowed */
    struct strip strip;      /* of the way's path, to the margin's outer edge */
    double half_width_m;     /* half of carriageway and sidewalks together */
    size_t rows, columns;
    double *height_m;        /* (rows, columns) */
    double rms_m;            /* of the mesh that was taken for road, over or below it */
    double taken;            /* 0..1: the part of the mesh within that was */
};

/* Fit to the mesh within the ribbon (its surface, however its vertices are spread): bumps (parked cars, crowns of trees) and holes do
 * not lift or sink it; heights are smooth along and across.
 * Err: ERR_INPUT without a place: fewer than a fifth of the way lies over the mesh */
bool ribbon_fit(struct ribbon *ribbon, const struct way *way, struct static_mesh *mesh, struct error *err);
void ribbon_release(struct ribbon *ribbon);
/* False outside the ribbon. normal: unit, upward. */
bool ribbon_at(const struct ribbon *ribbon, double *z_m, struct vec3 *normal, double x_m, double y_m);
/* The surface of all ribbons together: where several meet, they fade into each other. Returns how far
 * it is road: 1 on a ribbon, falling to 0 over the margin beside it, 0 elsewhere (*z_m is untouched). */
double ribbons_at(const struct ribbon *ribbons, size_t n, double *z_m, double x_m, double y_m);
/* Unit, upward, where ribbons_at is 1. */
struct vec3 ribbons_normal(const struct ribbon *ribbons, size_t n, double x_m, double y_m);

/* Lay the ribbons into the mesh: vertices near them in height are moved onto them, those along their
 * edges part of the way (so that no edge shows), holes are filled; what stands on the road or reaches
 * over it (more than RIBBON_CLEAR_M away in height) stays. Before static_mesh_index. */
#define RIBBON_CLEAR_M 0.6
bool ribbons_lay(struct static_mesh *mesh, const struct ribbon *ribbons, size_t n, struct error *err);

#endif

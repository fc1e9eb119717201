/* A smooth curve on the map, by arc length. */
#ifndef STAFFAGE_GEN_PATH_H
#define STAFFAGE_GEN_PATH_H

#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

#define PATH_STEP_M 0.25

struct path {
    struct vec2 *point_m; /* (n) world x, y; steps of at most PATH_STEP_M */
    double *s_m;          /* (n) arc length, from 0 */
    size_t n;
};

/* A curve through the points (world x, y), in their order, smooth in direction: no corner, and at
 * most a few decimetres off the straight line between two neighbours that are not in a bend.
 * Err: ERR_INPUT without a place: fewer than 2 points that differ, a point that is not finite */
bool path_create(struct path *path, const struct vec2 *point_m, size_t n, struct error *err);
void path_release(struct path *path);
double path_length(const struct path *path);

struct path_point {
    struct vec2 p_m;
    double heading_rad;    /* of the curve's direction, clockwise from the world's +y */
    double curvature;      /* 1/m, positive to the left */
};
/* s_m is held to the curve's ends; offset_m is to the left of its direction. */
struct path_point path_at(const struct path *path, double s_m, double offset_m);
/* The nearest point of the curve. Returns the distance; offset_m is positive to the left. */
double path_project(const struct path *path, double *s_m, double *offset_m, struct vec2 p_m);

#endif

/* The surface of a solid as a net: a point in each cell of a grid that it passes, a quad across each edge of the grid that it cuts.
 * Src: Gibson 1998, Constrained elastic surface nets */
#ifndef STAFFAGE_CAST_SURFACE_NET_H
#define STAFFAGE_CAST_SURFACE_NET_H

#include "cast/form.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct surface_net {
    struct vec3 *point;    /* the mean of where the surface cuts its cell's edges: near it */
    bool *first_layer;     /* (points) its cell is one of the first across y */
    uint32_t (*quad)[4];   /* counter-clockwise from outside */
    size_t points, quads;
};
/* The grid: its first corner, and how many corners it has along each axis. */
struct net_grid { struct vec3 low, cell_m; int n[3]; };

/* In: slack_m  how far the form's values may be off from distances: what lies deeper or further out than that is not looked at cell by
 *              cell. INFINITY: all of it is. */
struct surface_net surface_net_create(const struct form *solid, const struct net_grid *grid, double slack_m);
void surface_net_release(struct surface_net *net);
/* A quad's two triangles, along its shorter diagonal, with its points where they are now: the first where it is not longer by more than
 * `even_m`. */
void quad_split(uint32_t triangle[2][3], const uint32_t quad[4], const struct vec3 *point, double even_m);

#endif

#include "cast/hull.h"

#include "cast/need.h"
#include "cast/surface_net.h"

#include <math.h>
#include <string.h>

/* Onto the surface, but not far out of its cell. */
static struct vec3 settle(const struct shape *shape, struct vec3 p, double cell_m)
{
    for (int turn = 0; turn < 2; turn++) {
        double step = fmin(fmax(field(shape, p), -0.4 * cell_m), 0.4 * cell_m);
        p = vec3_sub(p, vec3_scale(field_normal(shape, p, 0.3 * cell_m), 0.8 * step));
    }
    return p;
}

static double shape_at(const void *self, struct vec3 p) { return field(self, p); }

void hull_add_shape(struct hull *hull, const struct shape *shape, int piece, double cell_m)
{
    struct vec3 low, high;
    shape_bounds(&low, &high, shape);
    double margin = 2 * cell_m + 0.02;
    struct net_grid grid = { vec3_sub(low, vec3(margin, margin, margin)), vec3(cell_m, cell_m, cell_m), { 0 } };
    const double size[3] = { high.x - low.x, high.y - low.y, high.z - low.z };
    for (int k = 0; k < 3; k++) grid.n[k] = (int)((size[k] + 2 * margin) / cell_m) + 2;
    struct surface_net net = surface_net_create(&(struct form){ shape_at, shape }, &grid, shape->folds_m);
    size_t points = hull->points + net.points, triangles = hull->triangles + 2 * net.quads;
    hull->point = need(realloc(hull->point, (points + 1) * sizeof *hull->point));
    hull->piece = need(realloc(hull->piece, points + 1));
    hull->triangle = need(realloc(hull->triangle, (triangles + 1) * sizeof *hull->triangle));
    for (size_t i = 0; i < net.points; i++) net.point[i] = settle(shape, net.point[i], cell_m);
    for (size_t i = 0; i < net.quads; i++) {
        uint32_t(*to)[3] = &hull->triangle[hull->triangles + 2 * i];
        quad_split(to, net.quad[i], net.point, 0);
        for (int k = 0; k < 6; k++) to[k / 3][k % 3] += (uint32_t)hull->points;
    }
    memcpy(hull->point + hull->points, net.point, net.points * sizeof *net.point);
    memset(hull->piece + hull->points, piece, net.points);
    hull->points = points, hull->triangles = triangles;
    surface_net_release(&net);
}

static void *copy_of(const void *from, size_t size) { return from ? memcpy(need(malloc(size + 1)), from, size) : NULL; }

struct hull hull_copy(const struct hull *hull)
{
    struct hull copy = *hull;
    copy.point = copy_of(hull->point, hull->points * sizeof *copy.point);
    copy.piece = copy_of(hull->piece, hull->points);
    copy.triangle = copy_of(hull->triangle, hull->triangles * sizeof *copy.triangle);
    copy.material = copy_of(hull->material, hull->triangles);
    return copy;
}

void hull_release(struct hull *hull)
{
    free(hull->point);
    free(hull->piece);
    free(hull->triangle);
    free(hull->material);
    *hull = (struct hull){ 0 };
}

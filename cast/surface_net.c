#include "cast/hull.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 4 }; /* cells a side that are looked at together first */

struct grid { int n[3]; struct vec3 low; double cell_m; float *value; uint32_t *point; };

static size_t at(const struct grid *g, int i, int j, int k) { return ((size_t)i * (size_t)g->n[1] + (size_t)j) * (size_t)g->n[2] + (size_t)k; }

static struct vec3 place(const struct grid *g, double i, double j, double k)
{
    return vec3(g->low.x + i * g->cell_m, g->low.y + j * g->cell_m, g->low.z + k * g->cell_m);
}

static void *need(void *memory)
{
    if (!memory) abort();
    return memory;
}

/* Far from the surface a block has one sign. */
static void fill(struct grid *g, const struct shape *shape)
{
    double half = BLOCK / 2.0, safe = 2.2 * half * sqrt(3) * g->cell_m + shape->folds_m;
    for (int i = 0; i < g->n[0]; i += BLOCK)
        for (int j = 0; j < g->n[1]; j += BLOCK)
            for (int k = 0; k < g->n[2]; k += BLOCK) {
                double middle = field(shape, place(g, i + half, j + half, k + half));
                for (int a = i; a < i + BLOCK && a < g->n[0]; a++)
                    for (int b = j; b < j + BLOCK && b < g->n[1]; b++)
                        for (int c = k; c < k + BLOCK && c < g->n[2]; c++)
                            g->value[at(g, a, b, c)] = (float)(fabs(middle) > safe ? middle : field(shape, place(g, a, b, c)));
            }
}

/* Onto the surface, but not far out of its cell. */
static struct vec3 settle(const struct shape *shape, struct vec3 p, double cell_m)
{
    for (int turn = 0; turn < 2; turn++) {
        double step = fmin(fmax(field(shape, p), -0.4 * cell_m), 0.4 * cell_m);
        p = vec3_sub(p, vec3_scale(field_normal(shape, p, 0.3 * cell_m), 0.8 * step));
    }
    return p;
}

static void add_point(struct hull *hull, struct grid *g, const struct shape *shape, int piece, int i, int j, int k)
{
    struct vec3 sum = { 0, 0, 0 };
    int cuts = 0;
    for (int e = 0; e < 12; e++) { /* an edge: its axis, and the corner of the other two axes */
        int axis = e / 4, c[3] = { 0, 0, 0 };
        c[(axis + 1) % 3] = e & 1, c[(axis + 2) % 3] = e >> 1 & 1;
        double a = (double)g->value[at(g, i + c[0], j + c[1], k + c[2])];
        double b = (double)g->value[at(g, i + c[0] + (axis == 0), j + c[1] + (axis == 1), k + c[2] + (axis == 2))];
        if ((a < 0) == (b < 0)) continue;
        double t[3] = { c[0], c[1], c[2] };
        t[axis] += a / (a - b);
        sum = vec3_add(sum, place(g, i + t[0], j + t[1], k + t[2]));
        cuts++;
    }
    if (!cuts) return;
    g->point[at(g, i, j, k)] = (uint32_t)hull->points;
    if ((hull->points & (hull->points - 1)) == 0) {
        size_t room = hull->points ? 2 * hull->points : 1;
        hull->point = need(realloc(hull->point, room * sizeof *hull->point));
        hull->piece = need(realloc(hull->piece, room));
    }
    hull->piece[hull->points] = (uint8_t)piece;
    hull->point[hull->points++] = settle(shape, vec3_scale(sum, 1.0 / cuts), g->cell_m);
}

static void add_triangle(struct hull *hull, uint32_t a, uint32_t b, uint32_t c)
{
    if ((hull->triangles & (hull->triangles - 1)) == 0)
        hull->triangle = need(realloc(hull->triangle, (hull->triangles ? 2 * hull->triangles : 1) * sizeof *hull->triangle));
    uint32_t corner[3] = { a, b, c };
    memcpy(hull->triangle[hull->triangles++], corner, sizeof corner);
}

/* A quad an edge of the grid that the surface cuts, along its shorter diagonal. */
static void add_quad(struct hull *hull, const struct grid *g, int i, int j, int k, int axis)
{
    bool in = g->value[at(g, i, j, k)] < 0;
    if (in == (g->value[at(g, i + (axis == 0), j + (axis == 1), k + (axis == 2))] < 0)) return;
    uint32_t q[4];
    for (int s = 0; s < 4; s++) {
        int d[3] = { 0, 0, 0 }, turn = in ? s : 3 - s;
        d[(axis + 1) % 3] = turn == 0 || turn == 3, d[(axis + 2) % 3] = turn < 2;
        q[s] = g->point[at(g, i - d[0], j - d[1], k - d[2])];
    }
    const struct vec3 *p = hull->point;
    int s = vec3_norm(vec3_sub(p[q[0]], p[q[2]])) > vec3_norm(vec3_sub(p[q[1]], p[q[3]]));
    add_triangle(hull, q[s], q[s + 1], q[s + 2]);
    add_triangle(hull, q[s], q[s + 2], q[(s + 3) % 4]);
}

void hull_add_shape(struct hull *hull, const struct shape *shape, int piece, double cell_m)
{
    struct vec3 low, high;
    shape_bounds(&low, &high, shape);
    double margin = 2 * cell_m + 0.02;
    struct grid g = { .low = vec3_sub(low, vec3(margin, margin, margin)), .cell_m = cell_m };
    const double size[3] = { high.x - low.x, high.y - low.y, high.z - low.z };
    size_t total = 1;
    for (int k = 0; k < 3; k++) total *= (size_t)(g.n[k] = (int)((size[k] + 2 * margin) / cell_m) + 2);
    g.value = need(malloc(total * sizeof *g.value));
    g.point = need(malloc(total * sizeof *g.point));
    fill(&g, shape);
    for (int i = 0; i + 1 < g.n[0]; i++)
        for (int j = 0; j + 1 < g.n[1]; j++)
            for (int k = 0; k + 1 < g.n[2]; k++) add_point(hull, &g, shape, piece, i, j, k);
    for (int i = 1; i + 1 < g.n[0]; i++)
        for (int j = 1; j + 1 < g.n[1]; j++)
            for (int k = 1; k + 1 < g.n[2]; k++)
                for (int axis = 0; axis < 3; axis++) add_quad(hull, &g, i, j, k, axis);
    free(g.value);
    free(g.point);
}

void hull_release(struct hull *hull)
{
    free(hull->point);
    free(hull->piece);
    free(hull->triangle);
    free(hull->material);
    *hull = (struct hull){ 0 };
}

#include "cast/surface_net.h"

#include "cast/need.h"

#include <math.h>

enum { BLOCK = 4 }; /* cells a side that are looked at together first */

struct field_grid { const struct net_grid *of; float *value; uint32_t *point; };

static size_t at(const struct net_grid *g, int i, int j, int k) { return ((size_t)i * (size_t)g->n[1] + (size_t)j) * (size_t)g->n[2] + (size_t)k; }

static struct vec3 place(const struct net_grid *g, double i, double j, double k)
{
    return vec3(g->low.x + i * g->cell_m.x, g->low.y + j * g->cell_m.y, g->low.z + k * g->cell_m.z);
}

/* Far from the surface a block has one sign. */
static void fill(struct field_grid *f, const struct form *solid, double slack_m)
{
    const struct net_grid *g = f->of;
    double half = BLOCK / 2.0, safe = 2.2 * half * vec3_norm(g->cell_m) + slack_m;
    for (int i = 0; i < g->n[0]; i += BLOCK)
        for (int j = 0; j < g->n[1]; j += BLOCK)
            for (int k = 0; k < g->n[2]; k += BLOCK) {
                double middle = isinf(safe) ? 0 : form_at(solid, place(g, i + half, j + half, k + half));
                for (int a = i; a < i + BLOCK && a < g->n[0]; a++)
                    for (int b = j; b < j + BLOCK && b < g->n[1]; b++)
                        for (int c = k; c < k + BLOCK && c < g->n[2]; c++)
                            f->value[at(g, a, b, c)] = (float)(fabs(middle) > safe ? middle : form_at(solid, place(g, a, b, c)));
            }
}

static void add_point(struct surface_net *net, const struct field_grid *f, int i, int j, int k)
{
    const struct net_grid *g = f->of;
    struct vec3 sum = { 0, 0, 0 };
    int cuts = 0;
    for (int e = 0; e < 12; e++) { /* an edge: its axis, and the corner of the other two axes */
        int axis = e / 4, c[3] = { 0, 0, 0 };
        c[(axis + 1) % 3] = e & 1, c[(axis + 2) % 3] = e >> 1 & 1;
        double a = (double)f->value[at(g, i + c[0], j + c[1], k + c[2])];
        double b = (double)f->value[at(g, i + c[0] + (axis == 0), j + c[1] + (axis == 1), k + c[2] + (axis == 2))];
        if ((a < 0) == (b < 0)) continue;
        double t[3] = { c[0], c[1], c[2] };
        t[axis] += a / (a - b);
        sum = vec3_add(sum, place(g, i + t[0], j + t[1], k + t[2]));
        cuts++;
    }
    if (!cuts) return;
    f->point[at(g, i, j, k)] = (uint32_t)net->points;
    if ((net->points & (net->points - 1)) == 0) {
        size_t room = net->points ? 2 * net->points : 1;
        net->point = need(realloc(net->point, room * sizeof *net->point));
        net->first_layer = need(realloc(net->first_layer, room * sizeof *net->first_layer));
    }
    net->first_layer[net->points] = j == 0;
    net->point[net->points++] = vec3_scale(sum, 1.0 / cuts);
}

static void add_quad(struct surface_net *net, const struct field_grid *f, int i, int j, int k, int axis)
{
    const struct net_grid *g = f->of;
    bool in = f->value[at(g, i, j, k)] < 0;
    if (in == (f->value[at(g, i + (axis == 0), j + (axis == 1), k + (axis == 2))] < 0)) return;
    if ((net->quads & (net->quads - 1)) == 0) net->quad = need(realloc(net->quad, (net->quads ? 2 * net->quads : 1) * sizeof *net->quad));
    for (int s = 0; s < 4; s++) {
        int d[3] = { 0, 0, 0 }, turn = in ? s : 3 - s;
        d[(axis + 1) % 3] = turn == 0 || turn == 3, d[(axis + 2) % 3] = turn < 2;
        net->quad[net->quads][s] = f->point[at(g, i - d[0], j - d[1], k - d[2])];
    }
    net->quads++;
}

struct surface_net surface_net_create(const struct form *solid, const struct net_grid *g, double slack_m)
{
    struct surface_net net = { 0 };
    size_t total = (size_t)g->n[0] * (size_t)g->n[1] * (size_t)g->n[2];
    struct field_grid f = { g, need(malloc(total * sizeof *f.value)), need(malloc(total * sizeof *f.point)) };
    fill(&f, solid, slack_m);
    for (int i = 0; i + 1 < g->n[0]; i++)
        for (int j = 0; j + 1 < g->n[1]; j++)
            for (int k = 0; k + 1 < g->n[2]; k++) add_point(&net, &f, i, j, k);
    for (int i = 1; i + 1 < g->n[0]; i++)
        for (int j = 1; j + 1 < g->n[1]; j++)
            for (int k = 1; k + 1 < g->n[2]; k++)
                for (int axis = 0; axis < 3; axis++) add_quad(&net, &f, i, j, k, axis);
    free(f.value), free(f.point);
    return net;
}

void surface_net_release(struct surface_net *net)
{
    free(net->point), free(net->first_layer), free(net->quad);
    *net = (struct surface_net){ 0 };
}

void quad_split(uint32_t triangle[2][3], const uint32_t q[4], const struct vec3 *p, double even_m)
{
    int s = vec3_norm(vec3_sub(p[q[0]], p[q[2]])) > vec3_norm(vec3_sub(p[q[1]], p[q[3]])) + even_m;
    for (int half = 0; half < 2; half++) {
        triangle[half][0] = q[s];
        triangle[half][1] = q[s + 1 + half];
        triangle[half][2] = q[(s + 2 + half) % 4];
    }
}

#include "cast/hull.h"

#include "cast/need.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Sum of squared distances to planes: p^T A p + 2 b p + c. */
struct quadric { double xx, xy, xz, yy, yz, zz, bx, by, bz, c; };
struct edge { double cost; uint32_t from, to, version; struct vec3 at; };

#define NONE UINT32_MAX
#define WELD_M 2e-4
struct work {
    struct hull *hull;
    struct quadric *quadric;     /* (points) */
    uint32_t *version;           /* (points) counts what happened to it */
    uint32_t *first, *next;      /* corners (3 * triangle + k) at a point: a list each */
    bool *gone;                  /* (triangles) */
    uint32_t *mark, marks;       /* (points) */
    struct edge *heap;
    size_t heap_count, heap_room;
};

/* --- quadrics --- */

static void add_plane(struct quadric *q, struct vec3 n, double d, double w)
{
    q->xx += w * n.x * n.x, q->xy += w * n.x * n.y, q->xz += w * n.x * n.z;
    q->yy += w * n.y * n.y, q->yz += w * n.y * n.z, q->zz += w * n.z * n.z;
    q->bx += w * n.x * d, q->by += w * n.y * d, q->bz += w * n.z * d, q->c += w * d * d;
}

static struct quadric sum_of(const struct quadric *p, const struct quadric *q)
{
    struct quadric s = *p;
    double *to = &s.xx;
    for (int k = 0; k < 10; k++) to[k] += (&q->xx)[k];
    return s;
}

static double error_at_point(const struct quadric *q, struct vec3 p)
{
    return q->xx * p.x * p.x + 2 * q->xy * p.x * p.y + 2 * q->xz * p.x * p.z + q->yy * p.y * p.y + 2 * q->yz * p.y * p.z +
           q->zz * p.z * p.z + 2 * (q->bx * p.x + q->by * p.y + q->bz * p.z) + q->c;
}

/* The best place near the edge; in flat surroundings, where that is not told, on the edge. */
static struct vec3 best_place(const struct quadric *q, struct vec3 a, struct vec3 b)
{
    struct vec3 middle = vec3_scale(vec3_add(a, b), 0.5), best = middle;
    double det = q->xx * (q->yy * q->zz - q->yz * q->yz) - q->xy * (q->xy * q->zz - q->yz * q->xz) + q->xz * (q->xy * q->yz - q->yy * q->xz);
    double trace = q->xx + q->yy + q->zz;
    if (fabs(det) > 1e-4 * trace * trace * trace) {
        struct vec3 r = vec3(-q->bx, -q->by, -q->bz);
        struct mat3 inverse = { { { q->yy * q->zz - q->yz * q->yz, q->xz * q->yz - q->xy * q->zz, q->xy * q->yz - q->xz * q->yy },
                                  { q->xz * q->yz - q->xy * q->zz, q->xx * q->zz - q->xz * q->xz, q->xy * q->xz - q->xx * q->yz },
                                  { q->xy * q->yz - q->xz * q->yy, q->xy * q->xz - q->xx * q->yz, q->xx * q->yy - q->xy * q->xy } } };
        best = vec3_scale(mat3_apply(inverse, r), 1 / det);
        if (vec3_norm(vec3_sub(best, middle)) < vec3_norm(vec3_sub(a, b))) return best;
        best = middle;
    }
    double least = error_at_point(q, middle);
    if (error_at_point(q, a) < least) best = a, least = error_at_point(q, a);
    return error_at_point(q, b) < least ? b : best;
}

/* --- the heap: the cheapest edge first --- */

static bool before(const struct edge *a, const struct edge *b)
{
    if (a->cost != b->cost) return a->cost < b->cost;
    return a->from != b->from ? a->from < b->from : a->to < b->to; /* the same order everywhere */
}

static void push(struct work *w, uint32_t from, uint32_t to)
{
    struct quadric q = sum_of(&w->quadric[from], &w->quadric[to]);
    struct vec3 a = w->hull->point[from], b = w->hull->point[to];
    struct edge edge = { .from = from, .to = to, .version = w->version[from] + w->version[to], .at = best_place(&q, a, b) };
    edge.cost = error_at_point(&q, edge.at) + 1e-9 * vec3_dot(vec3_sub(a, b), vec3_sub(a, b)); /* of equals the shortest */
    if (w->heap_count == w->heap_room) {
        w->heap_room = w->heap_room ? 2 * w->heap_room : 1024;
        w->heap = need(realloc(w->heap, w->heap_room * sizeof *w->heap));
    }
    size_t i = w->heap_count++;
    for (; i > 0 && before(&edge, &w->heap[(i - 1) / 2]); i = (i - 1) / 2) w->heap[i] = w->heap[(i - 1) / 2];
    w->heap[i] = edge;
}

static struct edge pop(struct work *w)
{
    struct edge top = w->heap[0], last = w->heap[--w->heap_count];
    size_t i = 0;
    for (size_t child; (child = 2 * i + 1) < w->heap_count; i = child) {
        if (child + 1 < w->heap_count && before(&w->heap[child + 1], &w->heap[child])) child++;
        if (!before(&w->heap[child], &last)) break;
        w->heap[i] = w->heap[child];
    }
    w->heap[i] = last;
    return top;
}

/* --- collapsing --- */

#define EACH_CORNER(c, w, p) for (uint32_t c = (w)->first[p]; c != NONE; c = (w)->next[c])

static bool has(const uint32_t *t, uint32_t p) { return t[0] == p || t[1] == p || t[2] == p; }

static struct vec3 normal_of(struct vec3 a, struct vec3 b, struct vec3 c) { return vec3_cross(vec3_sub(b, a), vec3_sub(c, a)); }

/* What stays around a moved point must neither turn over nor shrink to nothing. */
static bool keeps_facing(const struct work *w, uint32_t moved, uint32_t other, struct vec3 to)
{
    EACH_CORNER(c, w, moved) {
        const uint32_t *t = w->hull->triangle[c / 3];
        if (w->gone[c / 3] || has(t, other)) continue;
        struct vec3 p[3], old, new;
        for (int k = 0; k < 3; k++) p[k] = w->hull->point[t[k]];
        old = normal_of(p[0], p[1], p[2]);
        p[c % 3] = to;
        new = normal_of(p[0], p[1], p[2]);
        double size = vec3_norm(new), longest = 0;
        for (int k = 0; k < 3; k++) longest = fmax(longest, vec3_norm(vec3_sub(p[k], p[(k + 1) % 3])));
        if (size < 0.02 * longest * longest || vec3_dot(old, new) < 0.3 * vec3_norm(old) * size) return false;
    }
    return true;
}

static int corners_at(const struct work *w, uint32_t p)
{
    int n = 0;
    EACH_CORNER(c, w, p) n += !w->gone[c / 3];
    return n;
}

/* An edge of a closed surface may go when its ends share just the two neighbours beside it. */
static bool is_simple(struct work *w, uint32_t a, uint32_t b)
{
    uint32_t around = ++w->marks, seen = ++w->marks;
    int shared = 0, beside = 0;
    EACH_CORNER(c, w, a) {
        if (w->gone[c / 3]) continue;
        const uint32_t *t = w->hull->triangle[c / 3];
        beside += has(t, b);
        for (int k = 0; k < 3; k++) w->mark[t[k]] = around;
    }
    EACH_CORNER(c, w, b) {
        if (w->gone[c / 3]) continue;
        const uint32_t *t = w->hull->triangle[c / 3];
        for (int k = 0; k < 3; k++)
            if (t[k] != a && t[k] != b && w->mark[t[k]] == around) {
                w->mark[t[k]] = seen, shared++;
                if (corners_at(w, t[k]) < 4) return false; /* it would be left with two faces, back to back */
            }
    }
    return shared == 2 && beside == 2;
}

/* Returns how many triangles that took. */
static size_t collapse(struct work *w, const struct edge *edge)
{
    uint32_t from = edge->from, to = edge->to, last = NONE;
    size_t taken = 0;
    w->quadric[to] = sum_of(&w->quadric[to], &w->quadric[from]);
    w->hull->point[to] = edge->at;
    EACH_CORNER(c, w, from) {
        uint32_t *t = w->hull->triangle[c / 3];
        last = c;
        if (w->gone[c / 3]) continue;
        if (has(t, to)) w->gone[c / 3] = true, taken++;
        else t[c % 3] = to;
    }
    if (last != NONE) w->next[last] = w->first[to], w->first[to] = w->first[from];
    w->first[from] = NONE;
    w->version[to] += w->version[from] + 1;
    w->version[from] = NONE / 4;
    for (uint32_t *link = &w->first[to]; *link != NONE;) { /* leave out what is gone */
        if (w->gone[*link / 3]) *link = w->next[*link];
        else link = &w->next[*link];
    }
    uint32_t pushed = ++w->marks;
    EACH_CORNER(c, w, to) {
        const uint32_t *t = w->hull->triangle[c / 3];
        for (int k = 0; k < 3; k++)
            if (t[k] != to && w->mark[t[k]] != pushed) {
                w->mark[t[k]] = pushed;
                push(w, t[k] < to ? t[k] : to, t[k] < to ? to : t[k]);
            }
    }
    return taken;
}

/* The face at the other side of a triangle's side k, or NONE. */
static uint32_t beside(const struct work *w, size_t triangle, int k)
{
    const uint32_t *t = w->hull->triangle[triangle];
    uint32_t a = t[k], b = t[(k + 1) % 3];
    EACH_CORNER(c, w, b) {
        const uint32_t *o = w->hull->triangle[c / 3];
        if (o[(c + 1 - c / 3 * 3) % 3] == a) return c / 3;
    }
    return NONE;
}

/* A line between materials counts as if a wall stood on it. */
static void keep_lines(struct work *w)
{
    const struct hull *h = w->hull;
    for (size_t t = 0; t < h->triangles; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t o = beside(w, t, k), a = h->triangle[t][k], b = h->triangle[t][(k + 1) % 3];
            if (o == NONE || h->material[o] == h->material[t]) continue;
            struct vec3 along = vec3_sub(h->point[b], h->point[a]);
            struct vec3 wall = vec3_cross(along, normal_of(h->point[h->triangle[t][0]], h->point[h->triangle[t][1]], h->point[h->triangle[t][2]]));
            double size = vec3_norm(wall), weight = 0.5 * vec3_dot(along, along);
            if (!(size > 0)) continue;
            wall = vec3_scale(wall, 1 / size);
            add_plane(&w->quadric[a], wall, -vec3_dot(wall, h->point[a]), weight);
            add_plane(&w->quadric[b], wall, -vec3_dot(wall, h->point[a]), weight);
        }
}

static void begin(struct work *w, const double *weight)
{
    struct hull *h = w->hull;
    size_t corners = 3 * h->triangles;
    w->quadric = need(calloc(h->points + 1, sizeof *w->quadric));
    w->version = need(calloc(h->points + 1, sizeof *w->version));
    w->mark = need(calloc(h->points + 1, sizeof *w->mark));
    w->first = need(malloc((h->points + 1) * sizeof *w->first));
    w->next = need(malloc((corners + 1) * sizeof *w->next));
    w->gone = need(calloc(h->triangles + 1, sizeof *w->gone));
    for (size_t p = 0; p < h->points; p++) w->first[p] = NONE;
    for (uint32_t c = 0; c < corners; c++) {
        uint32_t p = h->triangle[c / 3][c % 3];
        w->next[c] = w->first[p], w->first[p] = c;
    }
    for (size_t t = 0; t < h->triangles; t++) {
        const uint32_t *at = h->triangle[t];
        struct vec3 n = normal_of(h->point[at[0]], h->point[at[1]], h->point[at[2]]);
        double area = vec3_norm(n);
        if (!(area > 0)) continue;
        n = vec3_scale(n, 1 / area);
        for (int k = 0; k < 3; k++) add_plane(&w->quadric[at[k]], n, -vec3_dot(n, h->point[at[0]]), area * weight[h->piece[at[k]]]);
    }
    if (h->material) keep_lines(w);
    for (size_t t = 0; t < h->triangles; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t a = h->triangle[t][k], b = h->triangle[t][(k + 1) % 3];
            if (a < b) push(w, a, b); /* its other side has it the other way around */
        }
}

static uint32_t root(uint32_t *parent, uint32_t p)
{
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
}

/* What no collapse could mend: points nearly at one place become one, and the faces between them go. */
static void weld(struct work *w)
{
    struct hull *h = w->hull;
    uint32_t *parent = need(malloc((h->points + 1) * sizeof *parent));
    for (uint32_t p = 0; p < h->points; p++) parent[p] = p;
    for (size_t t = 0; t < h->triangles; t++)
        for (int k = 0; k < 3 && !w->gone[t]; k++) {
            uint32_t a = h->triangle[t][k], b = h->triangle[t][(k + 1) % 3];
            if (vec3_norm(vec3_sub(h->point[a], h->point[b])) < WELD_M) parent[root(parent, a)] = root(parent, b);
        }
    for (size_t t = 0; t < h->triangles; t++) {
        uint32_t *at = h->triangle[t];
        for (int k = 0; k < 3; k++) at[k] = root(parent, at[k]);
        if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) w->gone[t] = true;
    }
    free(parent);
}

static void compact(struct work *w)
{
    struct hull *h = w->hull;
    size_t kept = 0, points = 0;
    for (size_t t = 0; t < h->triangles; t++) {
        if (w->gone[t]) continue;
        if (h->material) h->material[kept] = h->material[t];
        memmove(h->triangle[kept++], h->triangle[t], sizeof *h->triangle);
    }
    h->triangles = kept;
    memset(w->mark, 0, h->points * sizeof *w->mark);
    for (size_t c = 0; c < 3 * kept; c++) w->mark[h->triangle[c / 3][c % 3]] = 1;
    for (size_t p = 0; p < h->points; p++) {
        if (!w->mark[p]) continue;
        h->point[points] = h->point[p];
        h->piece[points] = h->piece[p];
        w->mark[p] = (uint32_t)points++;
    }
    h->points = points;
    for (size_t c = 0; c < 3 * kept; c++) h->triangle[c / 3][c % 3] = w->mark[h->triangle[c / 3][c % 3]];
}

void hull_decimate(struct hull *hull, size_t triangles, const double *weight)
{
    struct work w = { .hull = hull };
    size_t left = hull->triangles;
    begin(&w, weight);
    while (left > triangles && w.heap_count) {
        struct edge edge = pop(&w);
        if (edge.version != w.version[edge.from] + w.version[edge.to] || w.first[edge.from] == NONE || w.first[edge.to] == NONE) continue;
        if (!is_simple(&w, edge.from, edge.to) || !keeps_facing(&w, edge.from, edge.to, edge.at) ||
            !keeps_facing(&w, edge.to, edge.from, edge.at)) continue;
        left -= collapse(&w, &edge);
    }
    weld(&w);
    compact(&w);
    free(w.quadric), free(w.version), free(w.mark), free(w.first), free(w.next), free(w.gone), free(w.heap);
}

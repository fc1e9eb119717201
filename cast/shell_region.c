/* Regions of a shell: sunk, hollowed out, lined. */
#include "cast/shell.h"

#include "cast/need.h"

#include <stdlib.h>
#include <string.h>

/* Directed edges of faces, sorted: to ask whose edge the other side of one is. */
struct edge { uint32_t a, b, face; };
struct edges { struct edge *list; size_t count; };

static int by_ends(const void *x, const void *y)
{
    const struct edge *e = x, *f = y;
    if (e->a != f->a) return e->a < f->a ? -1 : 1;
    return (e->b > f->b) - (e->b < f->b);
}

static struct edges edges_of(const struct shell *s)
{
    struct edges edges = { need(malloc((3 * s->faces_count + 1) * sizeof *edges.list)), 3 * s->faces_count };
    for (size_t c = 0; c < edges.count; c++) {
        const uint32_t *v = s->faces[c / 3].v;
        edges.list[c] = (struct edge){ v[c % 3], v[(c % 3 + 1) % 3], (uint32_t)(c / 3) };
    }
    qsort(edges.list, edges.count, sizeof *edges.list, by_ends);
    return edges;
}

/* The face beyond the edge from a to b, or UINT32_MAX. */
static uint32_t beyond(const struct edges *edges, uint32_t a, uint32_t b)
{
    struct edge key = { b, a, 0 };
    const struct edge *found = bsearch(&key, edges->list, edges->count, sizeof key, by_ends);
    return found ? found->face : UINT32_MAX;
}

/* A copy of each point that is asked for, made once. */
struct copies { uint32_t *at; size_t count; };

static struct copies no_copies(const struct shell *s)
{
    struct copies c = { need(malloc((s->points + 1) * sizeof *c.at)), s->points };
    memset(c.at, 0xff, s->points * sizeof *c.at);
    return c;
}

static uint32_t copy_of(struct copies *copies, struct shell *s, uint32_t v, struct vec3 p, struct vec3 n)
{
    if (copies->at[v] == UINT32_MAX) copies->at[v] = shell_point(s, p, n);
    return copies->at[v];
}

/* Faces that are not kept go. */
static void keep(struct shell *s, const bool *gone, size_t marked)
{
    size_t kept = 0;
    for (size_t f = 0; f < s->faces_count; f++)
        if (f >= marked || !gone[f]) s->faces[kept++] = s->faces[f];
    s->faces_count = kept;
}

void shell_sink(struct shell *s, int material, int wall, move_fn *move, const void *self)
{
    struct edges edges = edges_of(s);
    struct copies floor = no_copies(s), top = no_copies(s), bottom = no_copies(s);
    size_t faces = s->faces_count;
    for (size_t f = 0; f < faces; f++) {
        if (s->faces[f].material != material) continue;
        for (int k = 0; k < 3; k++) {
            uint32_t a = s->faces[f].v[k], b = s->faces[f].v[(k + 1) % 3], o = beyond(&edges, a, b);
            if (o == UINT32_MAX || s->faces[o].material == material) continue;
            struct vec3 pa = s->p[a], pb = s->p[b], na = s->n[a], nb = s->n[b];
            uint32_t q[4] = { copy_of(&top, s, a, pa, na), copy_of(&top, s, b, pb, nb),
                              copy_of(&bottom, s, b, move(self, pb, nb), nb), copy_of(&bottom, s, a, move(self, pa, na), na) };
            shell_quad(s, q[0], q[1], q[2], q[3], wall);
        }
    }
    shell_smooth(s, faces, 40);
    for (size_t f = 0; f < faces; f++)
        for (int k = 0; s->faces[f].material == material && k < 3; k++) {
            uint32_t v = s->faces[f].v[k];
            struct vec3 p = s->p[v], n = s->n[v];
            s->faces[f].v[k] = copy_of(&floor, s, v, move(self, p, n), n);
        }
    free(edges.list), free(floor.at), free(top.at), free(bottom.at);
}

void shell_hollow(struct shell *s, int material, int wall, int end, move_fn *move, const void *self, struct vec3 middle)
{
    struct edges edges = edges_of(s);
    struct copies top = no_copies(s), bottom = no_copies(s), rim = no_copies(s);
    size_t faces = s->faces_count;
    uint32_t centre = shell_point(s, middle, vec3(0, 0, 1));
    bool *gone = need(calloc(faces + 1, sizeof *gone));
    for (size_t f = 0; f < faces; f++) gone[f] = s->faces[f].material == material;
    for (int part = 0; part < 2; part++) { /* walls, then the end: smooth each by itself */
        size_t first = s->faces_count;
        for (size_t f = 0; f < faces; f++)
            for (int k = 0; gone[f] && k < 3; k++) {
                uint32_t a = s->faces[f].v[k], b = s->faces[f].v[(k + 1) % 3], o = beyond(&edges, a, b);
                if (o == UINT32_MAX || gone[o]) continue;
                struct vec3 pa = s->p[a], pb = s->p[b], na = s->n[a], nb = s->n[b], ma = move(self, pa, na), mb = move(self, pb, nb);
                if (part == 0)
                    shell_quad(s, copy_of(&top, s, a, pa, na), copy_of(&top, s, b, pb, nb), copy_of(&bottom, s, b, mb, nb),
                               copy_of(&bottom, s, a, ma, na), wall);
                else
                    shell_face(s, copy_of(&rim, s, a, ma, na), copy_of(&rim, s, b, mb, nb), centre, end);
            }
        shell_smooth(s, first, 40);
    }
    keep(s, gone, faces);
    free(edges.list), free(top.at), free(bottom.at), free(rim.at), free(gone);
}

void shell_take(struct shell *to, struct shell *from, int material)
{
    struct copies copies = no_copies(from);
    bool *gone = need(calloc(from->faces_count + 1, sizeof *gone));
    for (size_t f = 0; f < from->faces_count; f++) {
        if (from->faces[f].material != material) continue;
        uint32_t v[3];
        for (int k = 0; k < 3; k++) {
            uint32_t i = from->faces[f].v[k];
            v[k] = copy_of(&copies, to, i, from->p[i], from->n[i]);
        }
        shell_face(to, v[0], v[1], v[2], material);
        gone[f] = true;
    }
    keep(from, gone, from->faces_count);
    free(copies.at), free(gone);
}

static struct vec3 within(struct vec3 p, struct vec3 n, double thickness_m)
{
    struct vec3 q = vec3_sub(p, vec3_scale(n, thickness_m));
    q.y = p.y == 0 ? 0 : fmax(q.y, 0);
    return q;
}

/* Where a sheet from side to side has its middle: it sags, so that what of its rim runs across is more than a line. */
static struct vec3 across(struct vec3 p) { return vec3(p.x, 0, p.z - 0.25 * p.y); }

void shell_line(struct shell *s, const struct form *chosen, double thickness, int material)
{
    struct edges edges = edges_of(s);
    struct copies inner = no_copies(s), outer_rim = no_copies(s), inner_rim = no_copies(s), near = no_copies(s), middle = no_copies(s);
    size_t faces = s->faces_count;
    bool *in = need(calloc(faces + 1, sizeof *in));
    for (size_t f = 0; f < faces; f++) {
        const uint32_t *v = s->faces[f].v;
        in[f] = form_at(chosen, vec3_scale(vec3_add(s->p[v[0]], vec3_add(s->p[v[1]], s->p[v[2]])), 1.0 / 3)) < 0;
    }
    for (size_t f = 0; f < faces; f++)
        for (int k = 0; in[f] && k < 3; k++) {
            uint32_t a = s->faces[f].v[k], b = s->faces[f].v[(k + 1) % 3], o = beyond(&edges, a, b);
            if (o != UINT32_MAX && in[o]) continue;
            struct vec3 pa = s->p[a], pb = s->p[b], na = s->n[a], nb = s->n[b];
            if (o == UINT32_MAX && pa.y == 0 && pb.y == 0) continue; /* the mirror image goes on there */
            struct vec3 qa = within(pa, na, thickness), qb = within(pb, nb, thickness);
            if (o == UINT32_MAX)
                shell_quad(s, copy_of(&outer_rim, s, b, pb, nb), copy_of(&outer_rim, s, a, pa, na), copy_of(&inner_rim, s, a, qa, na),
                           copy_of(&inner_rim, s, b, qb, nb), material);
            else
                shell_quad(s, copy_of(&near, s, a, qa, na), copy_of(&near, s, b, qb, nb), copy_of(&middle, s, b, across(qb), nb),
                           copy_of(&middle, s, a, across(qa), na), material);
        }
    shell_smooth(s, faces, 50);
    for (size_t f = 0; f < faces; f++) {
        if (!in[f]) continue;
        uint32_t q[3];
        for (int k = 0; k < 3; k++) {
            uint32_t v = s->faces[f].v[k];
            struct vec3 p = s->p[v], n = s->n[v];
            q[k] = copy_of(&inner, s, v, within(p, n, thickness), vec3_scale(n, -1));
        }
        shell_face(s, q[0], q[2], q[1], material);
    }
    free(edges.list), free(inner.at), free(outer_rim.at), free(inner_rim.at), free(near.at), free(middle.at), free(in);
}

/* --- what is too small --- */

struct place { int64_t v[3]; uint32_t point; };

static int by_place(const void *a, const void *b)
{
    const struct place *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->v[k] != q->v[k]) return p->v[k] < q->v[k] ? -1 : 1;
    return (p->point > q->point) - (p->point < q->point);
}

static uint32_t one_of(uint32_t *first, uint32_t i)
{
    while (first[i] != i) i = first[i] = first[first[i]];
    return i;
}

/* Of a face without an area, whose corners lie in a line, the two nearest become one. */
static bool merge_flat(const struct shell *s, uint32_t *first)
{
    bool merged = false;
    for (size_t f = 0; f < s->faces_count; f++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++) v[k] = one_of(first, s->faces[f].v[k]);
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        struct vec3 a = s->p[v[0]], b = s->p[v[1]], c = s->p[v[2]];
        if (vec3_norm(vec3_cross(vec3_sub(b, a), vec3_sub(c, a))) > 4e-9) continue;
        double side[3] = { vec3_norm(vec3_sub(b, a)), vec3_norm(vec3_sub(c, b)), vec3_norm(vec3_sub(a, c)) };
        int k = side[0] <= side[1] && side[0] <= side[2] ? 0 : side[1] <= side[2] ? 1 : 2;
        first[v[(k + 1) % 3]] = v[k];
        merged = true;
    }
    return merged;
}

void shell_clean(struct shell *s)
{
    const double scale = 2e4;
    struct place *places = need(malloc((s->points + 1) * sizeof *places));
    for (size_t i = 0; i < s->points; i++) {
        struct vec3 p = s->p[i];
        places[i] = (struct place){ { llround(p.x * scale), llround(p.y * scale), llround(p.z * scale) }, (uint32_t)i };
        s->p[i] = vec3((double)places[i].v[0] / scale, (double)places[i].v[1] / scale, (double)places[i].v[2] / scale);
    }
    qsort(places, s->points, sizeof *places, by_place);
    uint32_t *first = need(malloc((s->points + 1) * sizeof *first));
    for (size_t i = 0; i < s->points; i++) {
        bool same = i && !memcmp(places[i].v, places[i - 1].v, sizeof places[i].v);
        first[places[i].point] = same ? first[places[i - 1].point] : places[i].point;
    }
    while (merge_flat(s, first)) {}
    for (size_t i = 0; i < s->points; i++) s->p[i] = s->p[one_of(first, (uint32_t)i)];
    size_t kept = 0;
    for (size_t f = 0; f < s->faces_count; f++) {
        const uint32_t *v = s->faces[f].v;
        uint32_t a = one_of(first, v[0]), b = one_of(first, v[1]), c = one_of(first, v[2]);
        if (a != b && b != c && c != a) s->faces[kept++] = s->faces[f];
    }
    s->faces_count = kept;
    free(places), free(first);
}

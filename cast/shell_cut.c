/* Lines on a shell: edges are split, and the faces beside them anew laid out. */
#include "cast/shell.h"

#include "cast/need.h"

#include <stdlib.h>
#include <string.h>

/* --- the points that split edges --- */

struct edge_map { uint64_t *key; uint32_t *value; size_t room, count; };

static uint64_t edge_key(uint32_t a, uint32_t b) { return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a; }

static uint32_t *slot(struct edge_map *map, uint64_t key)
{
    size_t i = (size_t)(key * 0x9E3779B97F4A7C15u >> 20) % map->room;
    while (map->value[i] != UINT32_MAX && map->key[i] != key) i = (i + 1) % map->room;
    map->key[i] = key;
    return &map->value[i];
}

static struct edge_map map_for(const struct shell *s)
{
    struct edge_map map = { .room = 6 * s->faces_count + 16 };
    map.key = need(malloc(map.room * sizeof *map.key));
    map.value = need(malloc(map.room * sizeof *map.value));
    memset(map.value, 0xff, map.room * sizeof *map.value);
    return map;
}

static uint32_t split_of(struct edge_map *map, uint32_t a, uint32_t b) { return *slot(map, edge_key(a, b)); }

/* Lay out each face anew around the points on its edges. */
static void apply(struct shell *s, struct edge_map *map)
{
    size_t faces = s->faces_count;
    for (size_t f = 0; f < faces; f++) {
        struct face face = s->faces[f];
        uint32_t m[3];
        int cuts = 0, k = 0;
        for (int e = 0; e < 3; e++) cuts += (m[e] = split_of(map, face.v[e], face.v[(e + 1) % 3])) != UINT32_MAX;
        if (!cuts) continue;
        if (cuts == 3) {
            for (int e = 0; e < 3; e++) shell_face(s, face.v[e], m[e], m[(e + 2) % 3], face.material);
            memcpy(s->faces[f].v, m, sizeof m);
            continue;
        }
        /* turned so that edge 0 is split, and edge 2 is not */
        while (m[k] == UINT32_MAX || m[(k + 2) % 3] != UINT32_MAX) k++;
        uint32_t a = face.v[k], b = face.v[(k + 1) % 3], c = face.v[(k + 2) % 3], ab = m[k], bc = m[(k + 1) % 3];
        if (cuts == 1) {
            shell_face(s, ab, b, c, face.material);
            memcpy(s->faces[f].v, (uint32_t[]){ a, ab, c }, sizeof m);
        } else {
            memcpy(s->faces[f].v, (uint32_t[]){ ab, b, bc }, sizeof m);
            shell_quad(s, a, ab, bc, c, face.material);
        }
    }
    free(map->key), free(map->value);
}

static uint32_t point_on(struct shell *s, const struct form *solid, uint32_t a, uint32_t b, double t)
{
    struct vec3 p = vec3_add(vec3_scale(s->p[a], 1 - t), vec3_scale(s->p[b], t));
    struct vec3 n = vec3_unit(vec3_add(vec3_scale(s->n[a], 1 - t), vec3_scale(s->n[b], t)));
    if (solid) {
        p = form_project(solid, p), n = form_normal(solid, p);
        if (p.y == 0) n.y = 0, n = vec3_unit(n);
    }
    return shell_point(s, p, n);
}

void shell_refine(struct shell *s, const struct form *solid, const struct form *near, double width, double length_m)
{
    for (int round = 0; round < 4; round++) {
        double *value = need(malloc((s->points + 1) * sizeof *value));
        for (size_t i = 0; i < s->points; i++) value[i] = form_at(near, s->p[i]);
        struct edge_map map = map_for(s);
        size_t before = s->points;
        for (size_t c = 0; c < 3 * s->faces_count; c++) {
            uint32_t a = s->faces[c / 3].v[c % 3];
            uint32_t b = s->faces[c / 3].v[(c % 3 + 1) % 3];
            double length = vec3_norm(vec3_sub(s->p[a], s->p[b]));
            bool crosses = (value[a] < 0) != (value[b] < 0);
            if (length <= length_m || (!crosses && fmin(fabs(value[a]), fabs(value[b])) > width)) continue;
            uint32_t *at = slot(&map, edge_key(a, b));
            if (*at == UINT32_MAX) *at = point_on(s, solid, a, b, 0.5);
        }
        free(value);
        bool done = s->points == before;
        apply(s, &map);
        if (done) break;
    }
}

/* Where between a and b the function has the level. */
static double root(const struct shell *s, const struct form *near, double level, uint32_t a, uint32_t b, double va, double vb)
{
    double low = 0, high = 1, t = 0.5;
    for (int i = 0; i < 14; i++) {
        t = i % 3 == 2 ? (low + high) / 2 : low + (high - low) * va / (va - vb);
        double v = form_at(near, vec3_add(vec3_scale(s->p[a], 1 - t), vec3_scale(s->p[b], t))) - level;
        if ((v < 0) == (va < 0)) low = t, va = v;
        else high = t, vb = v;
        if (v == 0) break;
    }
    return t;
}

/* Between points p and q: where the function comes furthest to the other side than `side` (-1, 1), if it gets there. */
static bool dips(double *t, const struct form *near, double level, double side, struct vec3 p, struct vec3 q)
{
    const double golden = 0.381966;
    double low = 0, high = 1, at[2] = { golden, 1 - golden }, v[2];
#define VALUE(t) (side * (form_at(near, vec3_add(vec3_scale(p, 1 - (t)), vec3_scale(q, t))) - level))
    for (int k = 0; k < 2; k++) v[k] = VALUE(at[k]);
    for (int i = 0; i < 8; i++) {
        if (v[0] < v[1]) high = at[1], at[1] = at[0], v[1] = v[0], at[0] = low + golden * (high - low), v[0] = VALUE(at[0]);
        else low = at[0], at[0] = at[1], v[0] = v[1], at[1] = high - golden * (high - low), v[1] = VALUE(at[1]);
    }
#undef VALUE
    *t = at[v[1] < v[0]];
    return fmin(v[0], v[1]) < -1e-4;
}

/* What is narrower than a face must not slip between its corners. */
static void find_narrow(struct shell *s, const struct form *solid, const struct form *near, double level)
{
    double *value = need(malloc((s->points + 1) * sizeof *value));
    struct edge_map map = map_for(s);
    for (size_t i = 0; i < s->points; i++) value[i] = form_at(near, s->p[i]) - level;
    for (size_t c = 0; c < 3 * s->faces_count; c++) {
        uint32_t a = s->faces[c / 3].v[c % 3], b = s->faces[c / 3].v[(c % 3 + 1) % 3];
        if (a > b) { uint32_t keep = a; a = b, b = keep; }
        double length = vec3_norm(vec3_sub(s->p[a], s->p[b])), t;
        if (value[a] * value[b] <= 0 || length < 0.03 || fabs(value[a]) + fabs(value[b]) > length) continue;
        uint32_t *at = slot(&map, edge_key(a, b));
        if (*at == UINT32_MAX && dips(&t, near, level, value[a] < 0 ? -1 : 1, s->p[a], s->p[b])) {
            *at = point_on(s, solid, a, b, t);
            s->pinned[*at] = true; /* drawn onto one of its two lines it would be in vain */
        }
    }
    free(value);
    apply(s, &map);
}

/* Points that would squeeze a face flat stay where they are. */
static void spare_faces(const struct shell *s, double *best, const struct vec3 *to)
{
    for (bool again = true; again;) {
        again = false;
        for (size_t f = 0; f < s->faces_count; f++) {
            const uint32_t *v = s->faces[f].v;
            struct vec3 old[3], now[3];
            bool moves = false;
            for (int k = 0; k < 3; k++) {
                old[k] = s->p[v[k]], now[k] = best[v[k]] > 1e8 ? old[k] : to[v[k]];
                moves = moves || best[v[k]] < 1e8;
            }
            if (!moves) continue;
            struct vec3 a = vec3_cross(vec3_sub(old[1], old[0]), vec3_sub(old[2], old[0])), b = vec3_cross(vec3_sub(now[1], now[0]), vec3_sub(now[2], now[0]));
            if (vec3_dot(a, b) > 0.15 * vec3_dot(a, a)) continue;
            for (int k = 0; k < 3; k++) best[v[k]] = 1e9;
            again = true;
        }
    }
}

/* Points of what is narrow stay in it: drawn onto its one line they would lose the other. */
static void spare_narrow(const struct shell *s, const struct form *near, double level, const double *value, double *best, const struct vec3 *to)
{
    for (size_t c = 0; c < 3 * s->faces_count; c++)
        for (int way = 0; way < 2; way++) {
            uint32_t a = s->faces[c / 3].v[(c + (size_t)way - c / 3 * 3) % 3], b = s->faces[c / 3].v[(c + (size_t)!way - c / 3 * 3) % 3];
            double t;
            if (best[a] < 1e8 && value[a] * value[b] < 0 && dips(&t, near, level, value[b] < 0 ? -1 : 1, to[a], s->p[b])) best[a] = 1e9;
        }
}

void shell_cut(struct shell *s, const struct form *solid, const struct form *near, double level)
{
    find_narrow(s, solid, near, level);
    size_t points = s->points;
    double *value = need(malloc((points + 1) * sizeof *value)), *best = need(malloc((points + 1) * sizeof *best));
    struct vec3 *to = need(malloc((points + 1) * sizeof *to));
    for (size_t i = 0; i < points; i++) {
        value[i] = form_at(near, s->p[i]) - level;
        if (fabs(value[i]) < 1e-7) value[i] = 0;
        best[i] = 1e9;
    }
    /* Points close to the line are drawn onto it, rather than leave slivers. */
    for (size_t c = 0; c < 3 * s->faces_count; c++)
        for (int way = 0; way < 2; way++) {
            uint32_t a = s->faces[c / 3].v[c % 3], b = s->faces[c / 3].v[(c % 3 + 1) % 3];
            if (way) { uint32_t keep = a; a = b, b = keep; }
            if (s->pinned[a] || value[a] * value[b] >= 0 || fabs(value[a]) > 0.35 * fabs(value[b])) continue;
            if (s->p[a].y == 0 && s->p[b].y != 0) continue;
            double t = root(s, near, level, a, b, value[a], value[b]), length = t * vec3_norm(vec3_sub(s->p[a], s->p[b]));
            if (t > 0.22 || length >= best[a]) continue;
            best[a] = length;
            to[a] = vec3_add(vec3_scale(s->p[a], 1 - t), vec3_scale(s->p[b], t));
        }
    spare_narrow(s, near, level, value, best, to);
    spare_faces(s, best, to);
    for (size_t i = 0; i < points; i++) {
        if (best[i] > 1e8) continue;
        s->p[i] = solid ? form_project(solid, to[i]) : to[i];
        if (solid) s->n[i] = form_normal(solid, s->p[i]);
        if (solid && s->p[i].y == 0) s->n[i].y = 0, s->n[i] = vec3_unit(s->n[i]);
        s->pinned[i] = true;
        value[i] = 0;
    }
    struct edge_map map = map_for(s);
    for (size_t c = 0; c < 3 * s->faces_count; c++) {
        uint32_t a = s->faces[c / 3].v[c % 3], b = s->faces[c / 3].v[(c % 3 + 1) % 3];
        if (value[a] * value[b] >= 0) continue;
        uint32_t *at = slot(&map, edge_key(a, b));
        if (*at != UINT32_MAX) continue;
        if (a > b) { uint32_t keep = a; a = b, b = keep; }
        *at = point_on(s, solid, a, b, root(s, near, level, a, b, value[a], value[b]));
        s->pinned[*at] = true;
    }
    free(value), free(best), free(to);
    apply(s, &map);
}

void shell_paint(struct shell *s, const struct form *near, double low, double high, int from, int to)
{
    for (size_t f = 0; f < s->faces_count; f++) {
        struct face *face = &s->faces[f];
        if (from >= 0 && face->material != from) continue;
        struct vec3 middle = vec3_scale(vec3_add(s->p[face->v[0]], vec3_add(s->p[face->v[1]], s->p[face->v[2]])), 1.0 / 3);
        double v = form_at(near, middle);
        if (v > low && v < high) face->material = (uint8_t)to;
    }
}

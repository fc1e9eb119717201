/* What every model of the cast must be: closed, nowhere flat, right side out. */
#ifndef STAFFAGE_TESTS_CAST_SURFACE_H
#define STAFFAGE_TESTS_CAST_SURFACE_H

#include "gen/model/model.h"
#include "gen/model/rig.h"
#include "tests/tap.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct place { float p[3]; uint32_t corner; };
struct side { uint32_t a, b; int way; };
struct solid { size_t triangles, points; uint32_t (*at)[3]; struct vec3 *place; size_t normals_inward, thin; };

static int by_place(const void *x, const void *y)
{
    const struct place *p = x, *q = y;
    return memcmp(p->p, q->p, sizeof p->p);
}

static int by_ends(const void *x, const void *y)
{
    const struct side *p = x, *q = y;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return (p->b > q->b) - (p->b < q->b);
}

/* All triangles but those of glass, which is thin, with points that lie at one place made one. as_bound: before bones move it. */
static struct solid solid_of(const struct model *m, bool as_bound)
{
    struct solid s = { 0 };
    size_t room = 0;
    for (size_t i = 0; i < m->mesh_count; i++) room += m->meshes[i].triangles;
    s.at = calloc(room + 1, sizeof *s.at);
    s.place = calloc(3 * room + 1, sizeof *s.place);
    struct place *places = calloc(3 * room + 1, sizeof *places);
    if (!s.at || !s.place || !places) abort();
    for (size_t i = 0; i < m->mesh_count; i++) {
        const struct mesh *mesh = &m->meshes[i];
        if (m->materials[mesh->material].transmission > 0) continue;
        const float(*position)[3] = (const float(*)[3])(as_bound ? m->rig->meshes[i].position : mesh->position_m);
        const float(*normal)[3] = (const float(*)[3])(as_bound ? m->rig->meshes[i].normal : mesh->normal);
        for (size_t t = 0; t < mesh->triangles; t++, s.triangles++) {
            struct vec3 p[3];
            for (size_t k = 0; k < 3; k++) {
                const float *q = position[mesh->triangle[t][k]];
                for (int c = 0; c < 3; c++) places[3 * s.triangles + k].p[c] = q[c] + 0.0f;
                places[3 * s.triangles + k].corner = (uint32_t)(3 * s.triangles + k);
                p[k] = vec3((double)q[0], (double)q[1], (double)q[2]);
            }
            struct vec3 face = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
            s.thin += vec3_norm(face) < 1e-9;
            for (int k = 0; k < 3; k++) {
                const float *n = normal[mesh->triangle[t][k]];
                s.normals_inward += !(vec3_dot(face, vec3((double)n[0], (double)n[1], (double)n[2])) >= 0);
            }
        }
    }
    qsort(places, 3 * s.triangles, sizeof *places, by_place);
    for (size_t c = 0; c < 3 * s.triangles; c++) {
        const struct place *q = &places[c];
        if (!c || by_place(q, q - 1)) s.place[s.points++] = vec3((double)q->p[0], (double)q->p[1], (double)q->p[2]);
        s.at[q->corner / 3][q->corner % 3] = (uint32_t)(s.points - 1);
    }
    free(places);
    return s;
}

/* Sides that do not have as many triangles to the one side as to the other. */
static size_t open_sides(const struct solid *s)
{
    struct side *sides = calloc(3 * s->triangles + 1, sizeof *sides);
    size_t open = 0, n = 0;
    if (!sides) abort();
    for (size_t c = 0; c < 3 * s->triangles; c++) {
        uint32_t a = s->at[c / 3][c % 3], b = s->at[c / 3][(c % 3 + 1) % 3];
        sides[n++] = a < b ? (struct side){ a, b, 1 } : (struct side){ b, a, -1 };
    }
    qsort(sides, n, sizeof *sides, by_ends);
    for (size_t i = 0, j; i < n; i = j) {
        int sum = 0;
        for (j = i; j < n && by_ends(&sides[i], &sides[j]) == 0; j++) sum += sides[j].way;
        open += sum != 0;
    }
    free(sides);
    return open;
}

static uint32_t root(uint32_t *of, uint32_t i)
{
    while (of[i] != i) i = of[i] = of[of[i]];
    return i;
}

/* Pieces that hang together and enclose less than nothing: they are inside out. */
static size_t pieces_inside_out(const struct solid *s, size_t *pieces)
{
    uint32_t *of = calloc(s->points + 1, sizeof *of);
    double *volume = calloc(s->points + 1, sizeof *volume);
    size_t wrong = 0;
    if (!of || !volume) abort();
    for (size_t i = 0; i < s->points; i++) of[i] = (uint32_t)i;
    for (size_t t = 0; t < s->triangles; t++)
        for (int k = 1; k < 3; k++) of[root(of, s->at[t][k])] = root(of, s->at[t][0]);
    for (size_t t = 0; t < s->triangles; t++) {
        uint32_t piece = root(of, s->at[t][0]);
        struct vec3 o = s->place[piece], p[3];
        for (int k = 0; k < 3; k++) p[k] = vec3_sub(s->place[s->at[t][k]], o);
        volume[piece] += vec3_dot(p[0], vec3_cross(p[1], p[2])) / 6;
    }
    *pieces = 0;
    for (size_t i = 0; i < s->points; i++) {
        if (of[i] != i) continue;
        ++*pieces;
        wrong += volume[i] <= 0;
    }
    free(of), free(volume);
    return wrong;
}

static void check_surface(const struct model *m, const char *name, bool as_bound)
{
    struct solid s = solid_of(m, as_bound);
    size_t pieces, open = open_sides(&s), wrong = pieces_inside_out(&s, &pieces);
    OK(open == 0, "%s: closed (%zu open sides)", name, open);
    OK(s.thin == 0, "%s: no degenerate triangle (%zu)", name, s.thin);
    OK(wrong == 0, "%s: %zu pieces, none inside out (%zu)", name, pieces, wrong);
    OK(s.normals_inward * 50 < 3 * s.triangles, "%s: normals look outward (%zu of %zu do not)", name, s.normals_inward, 3 * s.triangles);
    free(s.at), free(s.place);
}

#endif

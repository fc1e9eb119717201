#include "cast/shell.h"

#include "cast/need.h"
#include "cast/surface_net.h"

#include <stdlib.h>
#include <string.h>

struct vec3 form_normal(const struct form *form, struct vec3 p)
{
    const double h = 0.012; /* as wide as edges look sharp: facets of the outlines must not show */
    return vec3_unit(vec3(form_at(form, vec3(p.x + h, p.y, p.z)) - form_at(form, vec3(p.x - h, p.y, p.z)) + 1e-12,
                          form_at(form, vec3(p.x, p.y + h, p.z)) - form_at(form, vec3(p.x, p.y - h, p.z)),
                          form_at(form, vec3(p.x, p.y, p.z + h)) - form_at(form, vec3(p.x, p.y, p.z - h))));
}

struct vec3 form_project(const struct form *form, struct vec3 p)
{
    bool middle = p.y == 0;
    for (int i = 0; i < 3; i++) {
        p = vec3_sub(p, vec3_scale(form_normal(form, p), form_at(form, p)));
        if (middle) p.y = 0;
    }
    return p;
}

void shell_release(struct shell *s)
{
    free(s->p), free(s->n), free(s->pinned), free(s->faces);
    *s = (struct shell){ 0 };
}

uint32_t shell_point(struct shell *s, struct vec3 p, struct vec3 n)
{
    if (s->points == s->point_room) {
        s->point_room = s->point_room ? 2 * s->point_room : 1024;
        s->p = need(realloc(s->p, s->point_room * sizeof *s->p));
        s->n = need(realloc(s->n, s->point_room * sizeof *s->n));
        s->pinned = need(realloc(s->pinned, s->point_room * sizeof *s->pinned));
    }
    s->p[s->points] = p, s->n[s->points] = n, s->pinned[s->points] = false;
    return (uint32_t)s->points++;
}

void shell_face(struct shell *s, uint32_t a, uint32_t b, uint32_t c, int material)
{
    if (a == b || b == c || c == a) return;
    if (s->faces_count == s->face_room) {
        s->face_room = s->face_room ? 2 * s->face_room : 1024;
        s->faces = need(realloc(s->faces, s->face_room * sizeof *s->faces));
    }
    s->faces[s->faces_count++] = (struct face){ { a, b, c }, (uint8_t)material };
}

void shell_quad(struct shell *s, uint32_t a, uint32_t b, uint32_t c, uint32_t d, int material)
{
    uint32_t t[2][3];
    quad_split(t, (const uint32_t[]){ a, b, c, d }, s->p, 1e-9);
    for (int half = 0; half < 2; half++) shell_face(s, t[half][0], t[half][1], t[half][2], material);
}

void shell_add_solid(struct shell *s, const struct form *solid, struct vec3 low, struct vec3 high, struct vec3 cell, int material)
{
    struct net_grid grid = { vec3(low.x - 1.5 * cell.x, -0.5 * cell.y, low.z - 1.5 * cell.z), cell, { 0 } };
    grid.n[0] = (int)((high.x - low.x) / cell.x) + 5;
    grid.n[1] = (int)(high.y / cell.y) + 4;
    grid.n[2] = (int)((high.z - low.z) / cell.z) + 5;
    struct surface_net net = surface_net_create(solid, &grid, INFINITY);
    uint32_t first = (uint32_t)s->points;
    for (size_t i = 0; i < net.points; i++) {
        struct vec3 p = net.point[i];
        bool middle = net.first_layer[i]; /* the first cells lie about the middle */
        if (middle) p.y = 0;
        p = form_project(solid, p);
        struct vec3 n = form_normal(solid, p);
        if (middle) n.y = 0, n = vec3_unit(n);
        shell_point(s, p, n);
    }
    for (size_t i = 0; i < net.quads; i++) {
        const uint32_t *q = net.quad[i];
        shell_quad(s, first + q[0], first + q[1], first + q[2], first + q[3], material);
    }
    surface_net_release(&net);
}

/* --- the whole --- */

void shell_append(struct shell *s, const struct shell *other, struct vec3 offset, bool mirrored)
{
    double side = mirrored ? -1 : 1;
    uint32_t first = (uint32_t)s->points;
    for (size_t i = 0; i < other->points; i++) {
        struct vec3 p = vec3_add(other->p[i], offset), n = other->n[i];
        shell_point(s, vec3(p.x, side * p.y, p.z), vec3(n.x, side * n.y, n.z));
    }
    for (size_t f = 0; f < other->faces_count; f++) {
        const uint32_t *v = other->faces[f].v;
        shell_face(s, first + v[0], first + v[mirrored ? 2 : 1], first + v[mirrored ? 1 : 2], other->faces[f].material);
    }
}

void shell_mirror(struct shell *s)
{
    size_t points = s->points, faces = s->faces_count;
    uint32_t *to = need(malloc((points + 1) * sizeof *to));
    for (size_t i = 0; i < points; i++) {
        struct vec3 p = s->p[i], n = s->n[i];
        to[i] = p.y == 0 && n.y == 0 ? (uint32_t)i : shell_point(s, vec3(p.x, -p.y, p.z), vec3(n.x, -n.y, n.z));
    }
    for (size_t f = 0; f < faces; f++) {
        struct face face = s->faces[f];
        shell_face(s, to[face.v[0]], to[face.v[2]], to[face.v[1]], face.material);
    }
    free(to);
}

void shell_bounds(struct vec3 *low, struct vec3 *high, const struct shell *s)
{
    *low = vec3(1e9, 1e9, 1e9), *high = vec3(-1e9, -1e9, -1e9);
    for (size_t c = 0; c < 3 * s->faces_count; c++) {
        struct vec3 p = s->p[s->faces[c / 3].v[c % 3]];
        *low = vec3(fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z));
        *high = vec3(fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z));
    }
}

static struct vec3 face_normal(const struct shell *s, const struct face *f)
{
    return vec3_cross(vec3_sub(s->p[f->v[1]], s->p[f->v[0]]), vec3_sub(s->p[f->v[2]], s->p[f->v[0]]));
}

void shell_smooth(struct shell *s, size_t first, double crease_deg)
{
    size_t corners = 3 * (s->faces_count - first), points = s->points;
    if (!corners) return;
    double limit = cos(crease_deg * PI / 180);
    uint32_t *head = need(malloc(points * sizeof *head)), *next = need(malloc(corners * sizeof *next));
    struct vec3 *normal = need(malloc(corners * sizeof *normal));
    uint32_t *own = need(malloc(corners * sizeof *own));
    memset(head, 0xff, points * sizeof *head);
    for (size_t c = corners; c-- > 0;) {
        uint32_t v = s->faces[first + c / 3].v[c % 3];
        next[c] = head[v], head[v] = (uint32_t)c;
    }
    for (size_t c = 0; c < corners; c++) {
        struct vec3 mine = face_normal(s, &s->faces[first + c / 3]), sum = { 0, 0, 0 };
        for (uint32_t o = head[s->faces[first + c / 3].v[c % 3]]; o != UINT32_MAX; o = next[o]) {
            struct vec3 n = face_normal(s, &s->faces[first + o / 3]);
            if (vec3_dot(n, mine) >= limit * vec3_norm(n) * vec3_norm(mine)) sum = vec3_add(sum, n);
        }
        normal[c] = vec3_norm(sum) > 0 ? vec3_unit(sum) : vec3(0, 0, 1);
    }
    for (size_t c = 0; c < corners; c++) {
        uint32_t v = s->faces[first + c / 3].v[c % 3], same = UINT32_MAX;
        for (uint32_t o = head[v]; o < c && o != UINT32_MAX; o = next[o])
            if (vec3_dot(normal[o], normal[c]) > 0.9999) same = own[o];
        if (same == UINT32_MAX) {
            if (head[v] == c) s->n[v] = normal[c], same = v;
            else same = shell_point(s, s->p[v], normal[c]);
        }
        own[c] = same;
    }
    for (size_t c = 0; c < corners; c++) s->faces[first + c / 3].v[c % 3] = own[c];
    free(head), free(next), free(normal), free(own);
}

#include "gen/model/mesh.h"

#include "lib/vec.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

bool mesh_init(struct mesh *mesh, size_t vertices, size_t triangles, bool with_normals, bool with_uv, struct error *err)
{
    if (vertices > UINT32_MAX || triangles > UINT32_MAX) return error_set(err, ERR_INPUT, "a mesh of %zu vertices and %zu triangles is too large", vertices, triangles);
    struct mesh made = { .vertices = vertices, .triangles = triangles };
    size_t v = vertices ? vertices : 1, t = triangles ? triangles : 1;
    made.position_m = calloc(v, sizeof *made.position_m);
    made.triangle = calloc(t, sizeof *made.triangle);
    if (with_normals) made.normal = calloc(v, sizeof *made.normal);
    if (with_uv) made.uv = calloc(v, sizeof *made.uv);
    if (!made.position_m || !made.triangle || (with_normals && !made.normal) || (with_uv && !made.uv)) {
        mesh_release(&made);
        return error_set(err, ERR_MEMORY, "no memory for a mesh of %zu triangles", triangles);
    }
    *mesh = made;
    return true;
}

void mesh_uv_at(double uv[2], const struct mesh *mesh, size_t triangle, double u, double v)
{
    const double weight[3] = { 1 - u - v, u, v };
    uv[0] = uv[1] = 0;
    for (int k = 0; mesh->uv && k < 3; k++)
        for (int i = 0; i < 2; i++) uv[i] += weight[k] * (double)mesh->uv[mesh->triangle[triangle][k]][i];
}

void mesh_release(struct mesh *mesh)
{
    free(mesh->position_m);
    free(mesh->normal);
    free(mesh->uv);
    free(mesh->triangle);
    free(mesh->source);
    *mesh = (struct mesh){ 0 };
}

static struct vec3 from_float(const float p[3])
{
    return vec3((double)p[0], (double)p[1], (double)p[2]);
}

/* Twice the area, along the normal. */
static struct vec3 area_vector(const struct mesh *mesh, size_t triangle)
{
    const uint32_t *t = mesh->triangle[triangle];
    struct vec3 a = from_float(mesh->position_m[t[0]]), b = from_float(mesh->position_m[t[1]]), c = from_float(mesh->position_m[t[2]]);
    return vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
}

static bool check(const struct mesh *mesh, struct error *err)
{
    for (size_t i = 0; i < mesh->vertices; i++) {
        const float *p = mesh->position_m[i];
        if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2]))
            return error_set(err, ERR_INPUT, "the position of vertex %zu is not a number", i);
        if (mesh->normal && !isfinite(mesh->normal[i][0] + mesh->normal[i][1] + mesh->normal[i][2]))
            return error_set(err, ERR_INPUT, "the normal of vertex %zu is not a number", i);
        if (mesh->uv && !isfinite(mesh->uv[i][0] + mesh->uv[i][1]))
            return error_set(err, ERR_INPUT, "the texture position of vertex %zu is not a number", i);
    }
    for (size_t i = 0; i < mesh->triangles; i++)
        for (int k = 0; k < 3; k++)
            if (mesh->triangle[i][k] >= mesh->vertices)
                return error_set(err, ERR_INPUT, "triangle %zu uses vertex %u of %zu", i, mesh->triangle[i][k], mesh->vertices);
    return true;
}

static void drop_degenerate(struct mesh *mesh)
{
    size_t kept = 0;
    for (size_t i = 0; i < mesh->triangles; i++) {
        struct vec3 n = area_vector(mesh, i);
        if (n.x == 0 && n.y == 0 && n.z == 0) continue;
        memmove(mesh->triangle[kept++], mesh->triangle[i], sizeof *mesh->triangle);
    }
    mesh->triangles = kept;
}

static bool drop_unused(struct mesh *mesh, struct error *err)
{
    uint32_t *to = malloc((mesh->vertices + 1) * sizeof *to);
    if (!to) return error_set(err, ERR_MEMORY, "no memory for a mesh of %zu vertices", mesh->vertices);
    memset(to, 0, mesh->vertices * sizeof *to);
    for (size_t i = 0; i < mesh->triangles; i++)
        for (int k = 0; k < 3; k++) to[mesh->triangle[i][k]] = 1;
    uint32_t kept = 0;
    for (size_t i = 0; i < mesh->vertices; i++) {
        if (!to[i]) continue;
        memmove(mesh->position_m[kept], mesh->position_m[i], sizeof *mesh->position_m);
        if (mesh->normal) memmove(mesh->normal[kept], mesh->normal[i], sizeof *mesh->normal);
        if (mesh->uv) memmove(mesh->uv[kept], mesh->uv[i], sizeof *mesh->uv);
        if (mesh->source) mesh->source[kept] = mesh->source[i];
        to[i] = kept++;
    }
    for (size_t i = 0; i < mesh->triangles; i++)
        for (int k = 0; k < 3; k++) mesh->triangle[i][k] = to[mesh->triangle[i][k]];
    mesh->vertices = kept;
    free(to);
    return true;
}

/* A corner of a triangle, to be sorted by the place where it lies. */
struct corner { float p[3], uv[2]; uint32_t source, triangle, k; };

static int by_place(const void *a, const void *b)
{
    const struct corner *c = a, *d = b;
    for (int i = 0; i < 3; i++)
        if (c->p[i] != d->p[i]) return c->p[i] < d->p[i] ? -1 : 1;
    for (int i = 0; i < 2; i++)
        if (c->uv[i] != d->uv[i]) return c->uv[i] < d->uv[i] ? -1 : 1;
    if (c->triangle != d->triangle) return c->triangle < d->triangle ? -1 : 1;
    return (int)c->k - (int)d->k;
}

static double corner_angle(const struct mesh *mesh, const struct corner *c)
{
    const uint32_t *t = mesh->triangle[c->triangle];
    struct vec3 p = from_float(c->p), a = from_float(mesh->position_m[t[(c->k + 1) % 3]]), b = from_float(mesh->position_m[t[(c->k + 2) % 3]]);
    struct vec3 u = vec3_sub(a, p), v = vec3_sub(b, p);
    return atan2(vec3_norm(vec3_cross(u, v)), vec3_dot(u, v));
}

/* Normals from the shape alone: at each corner the mean, weighted by angle, of the faces that meet
 * there and bend little against its own. Corners that agree in all become one vertex again.
 * Src: Thuermer and Wuethrich 1998, Computing Vertex Normals from Polygonal Facets */
static bool compute_normals(struct mesh *mesh, struct error *err)
{
    size_t corners = 3 * mesh->triangles;
    struct mesh made = { 0 };
    struct vec3 *face = malloc((mesh->triangles + 1) * sizeof *face);
    struct corner *corner = malloc((corners + 1) * sizeof *corner);
    if (!face || !corner) error_set(err, ERR_MEMORY, "no memory for the normals of %zu triangles", mesh->triangles);
    if (err->code != ERR_OK || !mesh_init(&made, corners, mesh->triangles, true, mesh->uv, err)) goto out;
    if (mesh->source && !(made.source = calloc(corners + 1, sizeof *made.source))) {
        error_set(err, ERR_MEMORY, "no memory for the normals of %zu triangles", mesh->triangles);
        goto out;
    }
    for (size_t i = 0; i < mesh->triangles; i++) {
        face[i] = vec3_unit(area_vector(mesh, i));
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t v = mesh->triangle[i][k];
            struct corner *c = &corner[3 * i + k];
            *c = (struct corner){ .triangle = (uint32_t)i, .k = k };
            memcpy(c->p, mesh->position_m[v], sizeof c->p);
            if (mesh->uv) memcpy(c->uv, mesh->uv[v], sizeof c->uv);
            if (mesh->source) c->source = mesh->source[v];
        }
    }
    qsort(corner, corners, sizeof *corner, by_place);
    double cosine = cos(MESH_SMOOTH_DEG * M_PI / 180);
    size_t used = 0;
    for (size_t first = 0, end; first < corners; first = end) {
        size_t group = used;
        for (end = first + 1; end < corners && !memcmp(corner[end].p, corner[first].p, sizeof corner->p);) end++;
        for (size_t i = first; i < end; i++) {
            struct vec3 own = face[corner[i].triangle], n = { 0, 0, 0 };
            for (size_t j = first; j < end; j++) {
                struct vec3 other = face[corner[j].triangle];
                if (vec3_dot(own, other) >= cosine) n = vec3_add(n, vec3_scale(other, corner_angle(mesh, &corner[j])));
            }
            n = vec3_unit(vec3_norm(n) > 0 ? n : own);
            float normal[3] = { (float)n.x, (float)n.y, (float)n.z };
            size_t v = group;
            while (v < used && (memcmp(made.normal[v], normal, sizeof normal) != 0 ||
                                (made.uv && memcmp(made.uv[v], corner[i].uv, sizeof *made.uv) != 0) ||
                                (made.source && made.source[v] != corner[i].source))) v++;
            if (v == used) {
                memcpy(made.position_m[v], corner[i].p, sizeof corner[i].p);
                memcpy(made.normal[v], normal, sizeof normal);
                if (made.uv) memcpy(made.uv[v], corner[i].uv, sizeof *made.uv);
                if (made.source) made.source[v] = corner[i].source;
                used++;
            }
            made.triangle[corner[i].triangle][corner[i].k] = (uint32_t)v;
        }
    }
    made.vertices = used;
    made.material = mesh->material;
    mesh_release(mesh);
    *mesh = made;
    made = (struct mesh){ 0 };
out:
    mesh_release(&made);
    free(face);
    free(corner);
    return err->code == ERR_OK;
}

/* The file's normals, with length 1; where one has no length, that of a face that uses it. */
static void repair_normals(struct mesh *mesh)
{
    for (size_t i = 0; i < mesh->triangles; i++)
        for (int k = 0; k < 3; k++) {
            float *n = mesh->normal[mesh->triangle[i][k]];
            struct vec3 v = from_float(n);
            if (vec3_norm(v) < 1e-12) v = area_vector(mesh, i);
            v = vec3_unit(v);
            n[0] = (float)v.x, n[1] = (float)v.y, n[2] = (float)v.z;
        }
}

bool mesh_tidy(struct mesh *mesh, struct error *err)
{
    if (!check(mesh, err)) return false;
    drop_degenerate(mesh);
    if (mesh->normal) repair_normals(mesh);
    else if (!compute_normals(mesh, err)) return false;
    return drop_unused(mesh, err);
}

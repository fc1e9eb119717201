/* The reconstruction's long edges are split, and nothing else about it changes. */
#include "scenes/proving-ground/place_mesh.h"

#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

/* A pit 4 m deep in a level place: a grid of cells of 0.2 m, whose walls are long and thin. */
enum { N = 6 };
static struct place_mesh pit(void)
{
    struct place_mesh m = { .vertices_m = calloc(N * N, sizeof *m.vertices_m), .faces = calloc(2 * (N - 1) * (N - 1), sizeof *m.faces) };
    if (!m.vertices_m || !m.faces) exit(1);
    for (int i = 0; i < N * N; i++) {
        int x = i % N, y = i / N;
        m.vertices_m[m.vertex_count++] = vec3(0.2 * x, -0.2 * y, x > 1 && x < 4 && y > 1 && y < 4 ? -4 - 0.01 * x * y : 0);
    }
    for (int y = 0; y + 1 < N; y++)
        for (int x = 0; x + 1 < N; x++) {
            int a = y * N + x, b = a + N;
            memcpy(m.faces[m.face_count++], (int[3]){ a, b, b + 1 }, sizeof *m.faces);
            memcpy(m.faces[m.face_count++], (int[3]){ a, b + 1, a + 1 }, sizeof *m.faces);
        }
    return m;
}

/* The sum of all faces' area vectors, and of their areas. */
static struct vec3 area_of(double *sum_m2, const struct place_mesh *m)
{
    struct vec3 whole = vec3(0, 0, 0);
    *sum_m2 = 0;
    for (size_t i = 0; i < m->face_count; i++) {
        const struct vec3 *p = m->vertices_m;
        const int *f = m->faces[i];
        struct vec3 n = vec3_scale(vec3_cross(vec3_sub(p[f[1]], p[f[0]]), vec3_sub(p[f[2]], p[f[0]])), 0.5);
        whole = vec3_add(whole, n);
        *sum_m2 += vec3_norm(n);
    }
    return whole;
}

/* How often the edge from a to b, in this direction, is a face's. */
static int edges_from(const struct place_mesh *m, int a, int b)
{
    int n = 0;
    for (size_t i = 0; i < m->face_count; i++)
        for (int k = 0; k < 3; k++) n += m->faces[i][k] == a && m->faces[i][(k + 1) % 3] == b;
    return n;
}

static bool on_rim(struct vec3 p) { return p.x < 1e-9 || p.y > -1e-9 || p.x > 0.2 * (N - 1) - 1e-9 || p.y < -0.2 * (N - 1) + 1e-9; }

int main(void)
{
    struct error err = ERROR_NONE;
    struct place_mesh before = pit(), m = pit();
    bool split = place_mesh_split(&m, 0.9, &err);
    OK(split, "edges are split");
    double longest = 0, area, area_before;
    int gaps = 0, twice = 0;
    for (size_t i = 0; i < m.face_count; i++)
        for (int k = 0; k < 3; k++) {
            int a = m.faces[i][k], b = m.faces[i][(k + 1) % 3];
            longest = fmax(longest, vec3_norm(vec3_sub(m.vertices_m[a], m.vertices_m[b])));
            twice += edges_from(&m, a, b) != 1;
            gaps += edges_from(&m, b, a) != 1 && !(on_rim(m.vertices_m[a]) && on_rim(m.vertices_m[b]));
        }
    OK(m.vertex_count > before.vertex_count && longest <= 0.9, "until none is longer than told");
    OK(twice == 0 && gaps == 0, "faces meet at whole edges");
    struct vec3 whole = area_of(&area, &m), whole_before = area_of(&area_before, &before);
    OK(fabs(area - area_before) < 1e-9 && vec3_norm(vec3_sub(whole, whole_before)) < 1e-9, "the surface and its sides stay");
    OK(!memcmp(m.vertices_m, before.vertices_m, before.vertex_count * sizeof *m.vertices_m), "vertices that were there keep their places");
    struct place_mesh level = pit();
    for (size_t i = 0; i < level.vertex_count; i++) level.vertices_m[i].z = 0;
    OK(place_mesh_split(&level, 0.9, &err) && level.vertex_count == before.vertex_count && level.face_count == before.face_count,
       "short edges are left alone");
    place_mesh_release(&before);
    place_mesh_release(&m);
    place_mesh_release(&level);
    return tap_done();
}

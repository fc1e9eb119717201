#include "place_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void place_mesh_release(struct place_mesh *mesh)
{
    free(mesh->vertices_m);
    free(mesh->colors);
    free(mesh->faces);
    *mesh = (struct place_mesh){ 0 };
}

/* --- splitting --- */

/* An edge, its lower vertex first, and the vertex in its middle; middle 0: a free place of the table. */
struct halved { int a, b, middle; };

struct splitting {
    struct place_mesh *mesh;
    size_t vertex_room, face_room;
    struct halved *table;     /* open addressing */
    size_t table_size, table_used; /* size: a power of 2 */
    double longest_m;
    struct error *err;
};

/* Make room for one more in an array of *room. */
static bool grow(void **array, size_t *room, size_t count, size_t size, struct error *err)
{
    if (count < *room) return true;
    size_t wanted = 2 * count + 64;
    void *larger = realloc(*array, wanted * size);
    if (!larger) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
    *array = larger;
    *room = wanted;
    return true;
}

static struct halved *place_of(struct halved *table, size_t size, int a, int b)
{
    size_t i = ((size_t)a * 0x9e3779b97f4a7c15u ^ (size_t)b * 0xbf58476d1ce4e5b9u) >> 20;
    for (i &= size - 1; table[i].middle && (table[i].a != a || table[i].b != b); i = (i + 1) & (size - 1)) continue;
    return &table[i];
}

static bool table_grow(struct splitting *s)
{
    if (2 * s->table_used < s->table_size) return true;
    size_t size = s->table_size ? 2 * s->table_size : 1024;
    struct halved *larger = calloc(size, sizeof *larger);
    if (!larger) return error_set(s->err, ERR_MEMORY, "no memory for the reconstruction");
    for (size_t i = 0; i < s->table_size; i++)
        if (s->table[i].middle) *place_of(larger, size, s->table[i].a, s->table[i].b) = s->table[i];
    free(s->table);
    s->table = larger;
    s->table_size = size;
    return true;
}

static bool middle_of(struct splitting *s, int *middle, int a, int b)
{
    int low = a < b ? a : b, high = a < b ? b : a;
    struct place_mesh *m = s->mesh;
    void *vertices = m->vertices_m;
    if (!table_grow(s)) return false;
    struct halved *at = place_of(s->table, s->table_size, low, high);
    if (!at->middle) {
        if (!grow(&vertices, &s->vertex_room, m->vertex_count, sizeof *m->vertices_m, s->err)) return false;
        m->vertices_m = vertices;
        *at = (struct halved){ low, high, (int)m->vertex_count };
        m->vertices_m[m->vertex_count++] = vec3_scale(vec3_add(m->vertices_m[low], m->vertices_m[high]), 0.5);
        s->table_used++;
    }
    *middle = at->middle;
    return true;
}

/* Whether the edge a b goes before c d: the longer, then, so that both faces beside it agree, by its vertices. */
static bool before(const struct vec3 *p, int a, int b, int c, int d)
{
    double one = vec3_norm(vec3_sub(p[a], p[b])), other = vec3_norm(vec3_sub(p[c], p[d]));
    if (one != other) return one > other;
    int low = a < b ? a : b, other_low = c < d ? c : d;
    return low != other_low ? low > other_low : (a < b ? b : a) > (c < d ? d : c);
}

/* The face of this index becomes one half, the other is put at the end and comes later. */
static bool split_face(struct splitting *s, size_t i)
{
    struct place_mesh *m = s->mesh;
    for (;;) {
        int v[3], k = 0, middle;
        memcpy(v, m->faces[i], sizeof v);
        for (int e = 1; e < 3; e++)
            if (before(m->vertices_m, v[e], v[(e + 1) % 3], v[k], v[(k + 1) % 3])) k = e;
        int a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
        if (vec3_norm(vec3_sub(m->vertices_m[a], m->vertices_m[b])) <= s->longest_m) return true;
        void *faces = m->faces;
        if (!middle_of(s, &middle, a, b) || !grow(&faces, &s->face_room, m->face_count, sizeof *m->faces, s->err)) return false;
        m->faces = faces;
        memcpy(m->faces[i], (int[3]){ a, middle, c }, sizeof v);
        memcpy(m->faces[m->face_count++], (int[3]){ middle, b, c }, sizeof v);
    }
}

bool place_mesh_split(struct place_mesh *mesh, double longest_m, struct error *err)
{
    struct splitting s = { .mesh = mesh, .vertex_room = mesh->vertex_count, .face_room = mesh->face_count, .longest_m = longest_m, .err = err };
    bool ok = true;
    for (size_t i = 0; ok && i < mesh->face_count; i++) ok = split_face(&s, i);
    free(s.table);
    return ok;
}

/* --- text --- */

bool place_mesh_write(const char *path, const struct place_mesh *mesh, struct error *err)
{
    FILE *f = fopen(path, "w");
    if (!f) return error_at(err, ERR_INPUT, path, 0, 0, "cannot be written");
    fprintf(f, "ply\nformat ascii 1.0\nelement vertex %zu\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
            "property uchar green\nproperty uchar blue\nelement face %zu\nproperty list uchar int vertex_indices\nend_header\n",
            mesh->vertex_count, mesh->face_count);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        struct vec3 p = mesh->vertices_m[i];
        const uint8_t *c = mesh->colors[i];
        fprintf(f, "%.4f %.4f %.4f %d %d %d\n", p.x, p.y, p.z, c[0], c[1], c[2]);
    }
    for (size_t i = 0; i < mesh->face_count; i++) fprintf(f, "3 %d %d %d\n", mesh->faces[i][0], mesh->faces[i][1], mesh->faces[i][2]);
    return fclose(f) == 0 || error_at(err, ERR_INPUT, path, 0, 0, "cannot be written");
}

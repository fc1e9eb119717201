/* What a place costs by its size: user seconds to load and to index, and to cut twelve cars' surroundings
 * out, medians of five. A mesh of a place is halved along every edge, once and twice, for larger ones.
 * Usage: bench-place MESH.ply UNIT_M FOLDER   writes the larger ones as FOLDER/place-0.ply and place-1.ply */
#include "gen/world/static_mesh.h"
#include "lib/file.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { RUNS = 5, CARS = 12 };

struct soup { float (*position_m)[3]; uint32_t (*triangle)[3]; size_t vertices, triangles; };

static double user_s(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *value, size_t n)
{
    qsort(value, n, sizeof *value, ascending);
    return value[n / 2];
}

static void *get(size_t count, size_t element)
{
    void *memory = calloc(count + 1, element);
    if (!memory) exit(3);
    return memory;
}

/* The vertex in the middle of an edge, the same for both of its triangles. */
static uint32_t middle(struct soup *s, uint64_t (*table)[2], size_t slots, uint32_t a, uint32_t b)
{
    uint64_t key = (uint64_t)(a < b ? a : b) << 32 | (a < b ? b : a);
    size_t at = (size_t)((key * 0x9e3779b97f4a7c15u) >> 20) & (slots - 1);
    while (table[at][1] && table[at][0] != key) at = (at + 1) & (slots - 1);
    if (!table[at][1]) {
        for (int k = 0; k < 3; k++) s->position_m[s->vertices][k] = (s->position_m[a][k] + s->position_m[b][k]) / 2;
        table[at][0] = key;
        table[at][1] = ++s->vertices;
    }
    return (uint32_t)(table[at][1] - 1);
}

static struct soup subdivide(const struct static_mesh *mesh, float (*position_m)[3])
{
    struct soup s = { .vertices = static_mesh_vertex_count(mesh) };
    size_t n = static_mesh_triangle_count(mesh), slots = 1;
    while (slots < 6 * n) slots *= 2;
    uint64_t (*table)[2] = get(slots, sizeof *table);
    s.position_m = get(s.vertices + 3 * n, sizeof *s.position_m);
    s.triangle = get(4 * n, sizeof *s.triangle);
    memcpy(s.position_m, position_m, s.vertices * sizeof *position_m);
    for (size_t i = 0; i < n; i++) {
        const uint32_t *t = static_mesh_triangles(mesh)[i];
        uint32_t m[3];
        for (int c = 0; c < 3; c++) m[c] = middle(&s, table, slots, t[c], t[(c + 1) % 3]);
        const uint32_t four[4][3] = { { t[0], m[0], m[2] }, { m[0], t[1], m[1] }, { m[2], m[1], t[2] }, { m[0], m[1], m[2] } };
        memcpy(s.triangle[4 * i], four, sizeof four);
    }
    s.triangles = 4 * n;
    free(table);
    return s;
}

/* In the frame of the mesh that it was made from: a scene can have either. */
static bool write_soup(const char *path, const struct soup *s, double unit_m, struct error *err)
{
    FILE *f = fopen(path, "wb");
    if (!f) return error_set(err, ERR_IO, "%s cannot be written", path);
    fprintf(f, "ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty float x\nproperty float y\nproperty float z\n"
               "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face %zu\nproperty list uchar int vertex_indices\nend_header\n",
            s->vertices, s->triangles);
    for (size_t i = 0; i < s->vertices; i++) {
        float p[3];
        for (int k = 0; k < 3; k++) p[k] = (float)((double)s->position_m[i][k] / unit_m);
        fwrite(p, sizeof p, 1, f);
        fwrite("\x60\x60\x60", 3, 1, f);
    }
    for (size_t i = 0; i < s->triangles; i++) {
        putc(3, f);
        fwrite(s->triangle[i], sizeof *s->triangle, 1, f);
    }
    return fclose(f) == 0;
}

/* Twelve squares of 12 m over the middle of the place, upright and along a low sun. */
static bool cut(const struct static_mesh *mesh, struct static_cut *out, struct error *err)
{
    struct vec3 low, high;
    struct vec2 corner[CARS][4];
    struct prism prisms[2 * CARS];
    static_mesh_bounds(mesh, &low, &high);
    for (int i = 0; i < CARS; i++) {
        double x = low.x + (high.x - low.x) * (0.35 + 0.1 * (i % 4)), y = low.y + (high.y - low.y) * (0.35 + 0.15 * (i / 4)), z;
        if (!static_mesh_height(mesh, &z, x, y, INFINITY)) z = (low.z + high.z) / 2;
        const struct vec2 square[4] = { { x - 6, y - 6 }, { x + 6, y - 6 }, { x + 6, y + 6 }, { x - 6, y + 6 } };
        memcpy(corner[i], square, sizeof square);
        prisms[2 * i] = (struct prism){ corner[i], 4, z, vec3(0, 0, 1), -3, 4 };
        prisms[2 * i + 1] = (struct prism){ corner[i], 4, z, vec3_unit(vec3(-0.7, -0.2, 0.7)), -3, 30 };
    }
    return static_mesh_cut(mesh, out, prisms, 2 * CARS, err);
}

static bool measure(struct static_mesh **kept, const char *path, struct similarity unit, struct error *err)
{
    double load[RUNS], index[RUNS], again[RUNS], total[RUNS], first = 0;
    size_t triangles = 0;
    for (int i = 0; i < RUNS; i++) {
        struct static_mesh *mesh = NULL;
        struct static_cut out;
        double at = user_s();
        if (!static_mesh_load(&mesh, path, unit, err)) return false;
        load[i] = user_s() - at;
        if (!static_mesh_index(mesh, 0.2, err)) return false;
        index[i] = user_s() - at - load[i];
        total[i] = load[i] + index[i];
        at = user_s();
        if (!cut(mesh, &out, err)) return false;
        first = user_s() - at;
        static_cut_release(&out);
        at = user_s();
        if (!cut(mesh, &out, err)) return false;
        again[i] = user_s() - at;
        triangles = out.triangles;
        static_cut_release(&out);
        if (i + 1 < RUNS) static_mesh_destroy(mesh);
        else *kept = mesh;
    }
    double load_s = median(load, RUNS), index_s = median(index, RUNS);
    printf("%10zu %8.3f s %8.3f s %8.3f s %8.3f s %8.3f s %10zu\n", static_mesh_triangle_count(*kept), load_s, index_s,
           median(total, RUNS), first, median(again, RUNS), triangles);
    fflush(stdout);
    return true;
}

int main(int argc, char **argv)
{
    struct error err = ERROR_NONE;
    if (argc != 4) return 2;
    struct similarity unit = { atof(argv[2]), mat3_identity(), vec3(0, 0, 0) };
    printf("%10s %10s %10s %10s %10s %10s %10s\n", "triangles", "load", "index", "both", "first cut", "next cuts", "cut");
    char *path = strdup(argv[1]);
    bool ok = path != NULL;
    for (int level = 0; ok && level < 3; level++) {
        struct static_mesh *mesh = NULL;
        ok = measure(&mesh, path, unit, &err);
        free(path);
        path = NULL;
        if (ok && level < 2) {
            struct soup finer = subdivide(mesh, static_mesh_vertices(mesh));
            path = string_format("%s/place-%d.ply", argv[3], level);
            ok = path && write_soup(path, &finer, unit.scale, &err);
            free(finer.position_m);
            free(finer.triangle);
        }
        static_mesh_destroy(mesh);
    }
    free(path);
    if (!ok) error_print(&err, "bench-place");
    return error_exit_status(&err);
}

/* Places made in memory, for the tests of what looks at places. */
#ifndef STAFFAGE_TESTS_GEN_PLACE_H
#define STAFFAGE_TESTS_GEN_PLACE_H

#include "gen/world/static_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct place {
    float (*vertex)[3];
    uint32_t (*triangle)[3];
    uint8_t *label; /* (triangles) */
    size_t vertices, triangles;
    void (*paint)(uint8_t srgb[3], const float p[3]); /* a vertex; NULL: all is grey, 128 */
};

__attribute__((unused))
static void place_free(struct place *place)
{
    free(place->vertex);
    free(place->triangle);
    free(place->label);
    memset(place, 0, sizeof *place);
}

/* Add triangles. */
__attribute__((unused))
static void place_add(struct place *place, const float (*vertex)[3], size_t vertices, const uint32_t (*triangle)[3],
                      size_t triangles, uint8_t label)
{
    size_t v = place->vertices + vertices, t = place->triangles + triangles;
    place->vertex = realloc(place->vertex, v * sizeof *place->vertex);
    place->triangle = realloc(place->triangle, t * sizeof *place->triangle);
    place->label = realloc(place->label, t);
    if (!place->vertex || !place->triangle || !place->label) abort();
    memcpy(place->vertex + place->vertices, vertex, vertices * sizeof *vertex);
    for (size_t i = 0; i < triangles; i++) {
        for (int k = 0; k < 3; k++)
            place->triangle[place->triangles + i][k] = triangle[i][k] + (uint32_t)place->vertices;
        place->label[place->triangles + i] = label;
    }
    place->vertices = v;
    place->triangles = t;
}

/* Add a quadrilateral, corners in order. */
__attribute__((unused))
static void place_quad(struct place *place, const double corner[4][3], uint8_t label)
{
    static const uint32_t halves[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    float v[4][3];
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) v[i][k] = (float)corner[i][k];
    place_add(place, (const float(*)[3])v, 4, halves, 2, label);
}

/* Add level ground from (-50, -10) to (50, 190). */
__attribute__((unused))
static void place_ground(struct place *place, double z, uint8_t label)
{
    place_quad(place, (const double[4][3]){ { -50, -10, z }, { 50, -10, z }, { 50, 190, z }, { -50, 190, z } }, label);
}

/* Add an upright wall across the view, at y from (x0, z0) to (x1, z1). */
__attribute__((unused))
static void place_wall(struct place *place, double x0, double x1, double y, double z0, double z1, uint8_t label)
{
    place_quad(place, (const double[4][3]){ { x0, y, z0 }, { x1, y, z0 }, { x1, y, z1 }, { x0, y, z1 } }, label);
}

/* Add a parallelogram of quadrilaterals, columns along one side and rows along the other. */
__attribute__((unused))
static void place_grid(struct place *place, struct vec3 corner, struct vec3 column, struct vec3 row, int columns, int rows)
{
    for (int y = 0; y < rows; y++)
        for (int x = 0; x < columns; x++) {
            double quad[4][3];
            for (int i = 0; i < 4; i++) {
                struct vec3 p = vec3_add(corner, vec3_add(vec3_scale(column, x + (i == 1 || i == 2)), vec3_scale(row, y + (i > 1))));
                memcpy(quad[i], (double[]){ p.x, p.y, p.z }, sizeof quad[i]);
            }
            place_quad(place, (const double(*)[3])quad, 0);
        }
}

/* The mesh, searchable, by way of a PLY file. */
__attribute__((unused))
static bool place_mesh(struct static_mesh **mesh, const struct place *place, bool labels, struct error *err)
{
    char path[] = "place.XXXXXX.ply";
    int file = mkstemps(path, 4);
    FILE *f = file >= 0 ? fdopen(file, "w") : NULL;
    if (!f) return error_set(err, ERR_IO, "no file for a place");
    fprintf(f, "ply\nformat ascii 1.0\nelement vertex %zu\nproperty float x\nproperty float y\nproperty float z\n"
               "property uchar red\nproperty uchar green\nproperty uchar blue\n"
               "element face %zu\nproperty list uchar uint vertex_indices\n%send_header\n",
            place->vertices, place->triangles, labels ? "property uchar label\n" : "");
    for (size_t i = 0; i < place->vertices; i++) {
        const float *p = place->vertex[i];
        uint8_t srgb[3] = { 128, 128, 128 };
        if (place->paint) place->paint(srgb, p);
        fprintf(f, "%.9g %.9g %.9g %u %u %u\n", (double)p[0], (double)p[1], (double)p[2], srgb[0], srgb[1], srgb[2]);
    }
    for (size_t i = 0; i < place->triangles; i++) {
        fprintf(f, "3 %u %u %u", place->triangle[i][0], place->triangle[i][1], place->triangle[i][2]);
        if (labels) fprintf(f, " %u", place->label[i]);
        putc('\n', f);
    }
    bool ok = fclose(f) == 0 &&
              static_mesh_load(mesh, path, (struct similarity){ 1, mat3_identity(), { 0, 0, 0 } }, err);
    unlink(path);
    return ok && static_mesh_index(*mesh, 0.2, err);
}

#endif

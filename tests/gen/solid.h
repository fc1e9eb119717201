/* Models made in memory, for the tests of what looks at models. */
#ifndef STAFFAGE_TESTS_GEN_SOLID_H
#define STAFFAGE_TESTS_GEN_SOLID_H

#include "gen/model/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A model of one mesh and one default material; solid_free frees it. */
struct solid {
    struct model model;
    struct mesh mesh;
    struct material material;
    struct image texture; /* empty, or what material.base_image borrows */
    char name[32];
};

__attribute__((unused))
static void solid_init(struct solid *solid, size_t vertices, size_t triangles)
{
    memset(solid, 0, sizeof *solid);
    material_default(&solid->material);
    strcpy(solid->name, "solid");
    solid->mesh.vertices = vertices;
    solid->mesh.triangles = triangles;
    solid->mesh.position_m = calloc(vertices, sizeof *solid->mesh.position_m);
    solid->mesh.normal = calloc(vertices, sizeof *solid->mesh.normal);
    solid->mesh.uv = calloc(vertices, sizeof *solid->mesh.uv);
    solid->mesh.triangle = calloc(triangles, sizeof *solid->mesh.triangle);
    solid->model = (struct model){ .path = solid->name, .meshes = &solid->mesh, .mesh_count = 1,
                                   .materials = &solid->material, .material_count = 1 };
}

__attribute__((unused))
static void solid_free(struct solid *solid)
{
    mesh_release(&solid->mesh);
    image_release(&solid->texture);
}

__attribute__((unused))
static void solid_finish(struct solid *solid)
{
    struct vec3 lo = vec3(INFINITY, INFINITY, INFINITY), hi = vec3(-INFINITY, -INFINITY, -INFINITY);
    for (size_t i = 0; i < solid->mesh.vertices; i++) {
        const float *p = solid->mesh.position_m[i];
        lo = vec3(fmin(lo.x, (double)p[0]), fmin(lo.y, (double)p[1]), fmin(lo.z, (double)p[2]));
        hi = vec3(fmax(hi.x, (double)p[0]), fmax(hi.y, (double)p[1]), fmax(hi.z, (double)p[2]));
    }
    solid->model.min_m = lo;
    solid->model.max_m = hi;
}

/* A plate across the entity's x axis: y from -w/2 to w/2, z from 0 to h. uv runs from (0,0) at
 * y = -w/2, z = 0 (lower left for one who looks at its front, along -x) to (1,1). */
__attribute__((unused))
static void solid_plate(struct solid *solid, double width_m, double height_m)
{
    solid_init(solid, 4, 2);
    for (int i = 0; i < 4; i++) {
        int right = i == 1 || i == 2, top = i >= 2;
        float p[3] = { 0, (float)(right ? width_m / 2 : -width_m / 2), (float)(top ? height_m : 0) };
        memcpy(solid->mesh.position_m[i], p, sizeof p);
        solid->mesh.normal[i][0] = 1;
        solid->mesh.uv[i][0] = (float)right;
        solid->mesh.uv[i][1] = (float)top;
    }
    static const uint32_t t[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
    memcpy(solid->mesh.triangle, t, sizeof t);
    solid_finish(solid);
}

/* A box that stands on z = 0. */
__attribute__((unused))
static void solid_box(struct solid *solid, double length_m, double width_m, double height_m)
{
    solid_init(solid, 8, 12);
    for (int i = 0; i < 8; i++) {
        float p[3] = { (float)(i & 4 ? length_m / 2 : -length_m / 2), (float)(i & 2 ? width_m / 2 : -width_m / 2),
                       (float)(i & 1 ? height_m : 0) };
        memcpy(solid->mesh.position_m[i], p, sizeof p);
        solid->mesh.normal[i][2] = 1;
    }
    static const uint32_t t[12][3] = { { 0, 1, 3 }, { 0, 3, 2 }, { 4, 6, 7 }, { 4, 7, 5 }, { 0, 4, 5 }, { 0, 5, 1 },
                                       { 2, 3, 7 }, { 2, 7, 6 }, { 0, 2, 6 }, { 0, 6, 4 }, { 1, 5, 7 }, { 1, 7, 3 } };
    memcpy(solid->mesh.triangle, t, sizeof t);
    solid_finish(solid);
}

/* An egg that stands on z = 0, of 2 n n triangles. */
__attribute__((unused))
static void solid_egg(struct solid *solid, double length_m, double width_m, double height_m, uint32_t n)
{
    solid_init(solid, (n + 1) * (n + 1), 2 * n * n);
    for (uint32_t i = 0; i <= n; i++)
        for (uint32_t j = 0; j <= n; j++) {
            double a = M_PI * i / n, b = 2 * M_PI * j / n;
            float p[3] = { (float)(length_m / 2 * sin(a) * cos(b)), (float)(width_m / 2 * sin(a) * sin(b)),
                           (float)(height_m / 2 * (1 - cos(a))) };
            memcpy(solid->mesh.position_m[i * (n + 1) + j], p, sizeof p);
            solid->mesh.normal[i * (n + 1) + j][2] = 1;
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < n; j++) {
            uint32_t a = i * (n + 1) + j, b = a + n + 1, t[2][3] = { { a, a + 1, b }, { a + 1, b + 1, b } };
            memcpy(solid->mesh.triangle[2 * (i * n + j)], t, sizeof t);
        }
    solid_finish(solid);
}

#endif

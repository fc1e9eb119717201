/* Triangles that share a material, and what makes them fit to be rendered and traced. */
#ifndef STAFFAGE_GEN_MESH_H
#define STAFFAGE_GEN_MESH_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct mesh {
    float (*position_m)[3];   /* (vertices,3) */
    float (*normal)[3];       /* (vertices,3), unit */
    float (*uv)[2];           /* (vertices,2), v up: (0,0) is the image's lower left corner; NULL without texture */
    uint32_t (*triangle)[3];  /* (triangles,3), counter-clockwise from outside */
    uint32_t *source;         /* (vertices) the file's vertex that each was made of; NULL unless an importer set it */
    size_t vertices, triangles;
    size_t material;          /* index into model.materials */
};

/* Allocate for a mesh: positions and triangles, and normals and uv if wanted. Everything is 0.
 * Out: mesh, initialized here. Err: ERR_MEMORY; ERR_INPUT for more than 2^32 vertices. */
bool mesh_init(struct mesh *mesh, size_t vertices, size_t triangles, bool with_normals, bool with_uv, struct error *err);
void mesh_release(struct mesh *mesh);

/* Texture position of a point of a triangle, at the weights u and v of its second and third corner; (0, 0) without texture. */
void mesh_uv_at(double uv[2], const struct mesh *mesh, size_t triangle, double u, double v);

/* Check and tidy: triangles without area and vertices that no triangle uses go; a normal that is
 * missing (all of them, when mesh->normal is NULL; or one of length 0) is computed, smooth over
 * edges that bend by less than MESH_SMOOTH_DEG.
 * Err: ERR_INPUT without a place: an index out of range, a coordinate that is not a number.
 *      The mesh stays valid and the caller's. */
#define MESH_SMOOTH_DEG 40
bool mesh_tidy(struct mesh *mesh, struct error *err);

#endif

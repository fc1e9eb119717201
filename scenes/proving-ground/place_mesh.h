/* The reconstruction's mesh. */
#ifndef STAFFAGE_PROVING_PLACE_MESH_H
#define STAFFAGE_PROVING_PLACE_MESH_H

#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct place_mesh {
    struct vec3 *vertices_m;  /* (vertex_count) */
    uint8_t (*colors)[3];     /* (vertex_count) sRGB, or NULL */
    int (*faces)[3];          /* (face_count) counter-clockwise from outside */
    size_t vertex_count, face_count;
};

void place_mesh_release(struct place_mesh *mesh);

/* Split each edge that is longer than `longest_m` in its middle, and the faces beside it, until none is: walls get vertices of
 * their own. The surface stays as it is, and faces go on to meet at whole edges.
 * In/out: mesh without colors; on failure only to be released */
bool place_mesh_split(struct place_mesh *mesh, double longest_m, struct error *err);

/* As an ASCII PLY; mesh has colors. */
bool place_mesh_write(const char *path, const struct place_mesh *mesh, struct error *err);

#endif

/* What all meshes have in POV-Ray's language. */
#ifndef STAFFAGE_GEN_MESH_SDL_H
#define STAFFAGE_GEN_MESH_SDL_H

#include "gen/render/sdl.h"
#include "lib/vec.h"

#include <stddef.h>
#include <stdint.h>

/* In place of a mesh that would have no face, which POV-Ray does not take: something that is nowhere to be seen. */
void mesh_sdl_nowhere(struct sdl *sdl);
/* A block of vectors: vertex_vectors, normal_vectors. */
void mesh_sdl_vectors(struct sdl *sdl, const char *name, const struct vec3 *vector, size_t n);
/* The block face_indices. In: triangle (triangles,3) */
void mesh_sdl_faces(struct sdl *sdl, const uint32_t (*triangle)[3], size_t triangles);

#endif

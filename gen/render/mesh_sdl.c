#include "gen/render/mesh_sdl.h"

void mesh_sdl_nowhere(struct sdl *sdl)
{
    sdl_begin(sdl, "sphere");
    sdl_vector(sdl, vec3(0, 0, -1e6));
    sdl_comma(sdl);
    sdl_number(sdl, 1e-3);
    sdl_end(sdl);
}

void mesh_sdl_vectors(struct sdl *sdl, const char *name, const struct vec3 *vector, size_t n)
{
    sdl_begin(sdl, name);
    sdl_number(sdl, (double)n);
    for (size_t i = 0; i < n; i++) {
        sdl_comma(sdl);
        sdl_vector(sdl, vector[i]);
        if (i % 8 == 7) sdl_newline(sdl);
    }
    sdl_end(sdl);
}

void mesh_sdl_faces(struct sdl *sdl, const uint32_t (*triangle)[3], size_t triangles)
{
    sdl_begin(sdl, "face_indices");
    sdl_number(sdl, (double)triangles);
    for (size_t i = 0; i < triangles; i++) {
        const uint32_t *t = triangle[i];
        sdl_comma(sdl);
        sdl_vector(sdl, vec3(t[0], t[1], t[2]));
        if (i % 8 == 7) sdl_newline(sdl);
    }
    sdl_end(sdl);
}

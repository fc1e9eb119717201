#include "gen/render/place_sdl.h"

#include "gen/render/mesh_sdl.h"
#include "gen/render/sdl.h"

#include <stdlib.h>

static struct vec3 corner(const struct static_cut *cut, uint32_t i)
{
    const float *p = cut->position_m[i];
    return vec3((double)p[0], (double)p[1], (double)p[2]);
}

static void write_vertices(struct sdl *sdl, const char *name, const struct static_cut *cut, const struct vec3 *normal)
{
    sdl_begin(sdl, name);
    sdl_number(sdl, (double)cut->vertices);
    for (size_t i = 0; i < cut->vertices; i++) {
        sdl_comma(sdl);
        sdl_vector(sdl, normal ? normal[i] : corner(cut, (uint32_t)i));
        if (i % 8 == 7) sdl_newline(sdl);
    }
    sdl_end(sdl);
}

static void write_cut(struct sdl *sdl, const char *name, const struct static_cut *cut, const struct vec3 *normal)
{
    sdl_declare(sdl, name);
    if (!cut->triangles) {
        mesh_sdl_nowhere(sdl);
        return;
    }
    sdl_begin(sdl, "mesh2");
    write_vertices(sdl, "vertex_vectors", cut, NULL);
    if (normal) write_vertices(sdl, "normal_vectors", cut, normal);
    mesh_sdl_faces(sdl, cut->triangle, cut->triangles);
    sdl_end(sdl);
}

static bool write_include(struct sdl *sdl, const char *path, struct error *err)
{
    bool ok = sdl_write(sdl, path, err);
    sdl_release(sdl);
    return ok;
}

bool place_include_write(const char *path, const struct static_cut *receivers, const struct static_cut *rest,
                         struct error *err)
{
    struct vec3 *normal = NULL;
    if (!static_cut_normals(&normal, receivers, err)) return false;
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "the place round the entities of a frame: metres, world");
    write_cut(&sdl, "Receivers", receivers, normal);
    write_cut(&sdl, "Rest", rest, NULL);
    free(normal);
    return write_include(&sdl, path, err);
}

bool shades_include_write(const char *path, const struct static_cut *shades, struct error *err)
{
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "what of the place can keep the sun from the ground round the entities of a frame: metres, world");
    write_cut(&sdl, "Shades", shades, NULL);
    return write_include(&sdl, path, err);
}

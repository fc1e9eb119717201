#include "gen/render/place_sdl.h"

#include "gen/render/sdl.h"

#include <math.h>
#include <stdlib.h>

static struct vec3 corner(const struct static_cut *cut, uint32_t i)
{
    const float *p = cut->position_m[i];
    return vec3((double)p[0], (double)p[1], (double)p[2]);
}

/* By the area of the faces round each vertex. */
static bool smooth_normals(struct vec3 **out, const struct static_cut *cut, struct error *err)
{
    struct vec3 *normal = calloc(cut->vertices + 1, sizeof *normal);
    if (!normal) return error_set(err, ERR_MEMORY, "no memory for the place");
    for (size_t t = 0; t < cut->triangles; t++) {
        const uint32_t *v = cut->triangle[t];
        struct vec3 a = corner(cut, v[0]), b = corner(cut, v[1]), c = corner(cut, v[2]);
        struct vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
        for (int k = 0; k < 3; k++) normal[v[k]] = vec3_add(normal[v[k]], n);
    }
    for (size_t i = 0; i < cut->vertices; i++) {
        double norm = vec3_norm(normal[i]);
        normal[i] = norm > 0 ? vec3_scale(normal[i], 1 / norm) : vec3(0, 0, 1);
    }
    *out = normal;
    return true;
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
    if (!cut->triangles) { /* a mesh must have a face: this one is nowhere */
        sdl_begin(sdl, "sphere");
        sdl_vector(sdl, vec3(0, 0, -1e6));
        sdl_comma(sdl);
        sdl_number(sdl, 1e-3);
        sdl_end(sdl);
        return;
    }
    sdl_begin(sdl, "mesh2");
    write_vertices(sdl, "vertex_vectors", cut, NULL);
    if (normal) write_vertices(sdl, "normal_vectors", cut, normal);
    sdl_begin(sdl, "face_indices");
    sdl_number(sdl, (double)cut->triangles);
    for (size_t i = 0; i < cut->triangles; i++) {
        const uint32_t *t = cut->triangle[i];
        sdl_comma(sdl);
        sdl_vector(sdl, vec3(t[0], t[1], t[2]));
        if (i % 8 == 7) sdl_newline(sdl);
    }
    sdl_end(sdl);
    sdl_end(sdl);
}

bool place_include_write(const char *path, const struct static_cut *receivers, const struct static_cut *shades,
                         const struct static_cut *rest, struct error *err)
{
    struct vec3 *normal = NULL;
    if (!smooth_normals(&normal, receivers, err)) return false;
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "the place round the entities of a frame, and what can shade it: metres, world");
    write_cut(&sdl, "Receivers", receivers, normal);
    write_cut(&sdl, "Shades", shades, NULL);
    write_cut(&sdl, "Rest", rest, NULL);
    bool ok = sdl_write(&sdl, path, err);
    sdl_release(&sdl);
    free(normal);
    return ok;
}

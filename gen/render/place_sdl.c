#include "gen/render/place_sdl.h"

#include "gen/render/mesh_sdl.h"
#include "gen/render/sdl.h"

#include <math.h>
#include <stdlib.h>

static void write_vertices(struct sdl *sdl, const struct static_cut *cut)
{
    sdl_begin(sdl, "vertex_vectors");
    sdl_number(sdl, (double)cut->vertices);
    for (size_t i = 0; i < cut->vertices; i++) {
        const float *p = cut->position_m[i];
        sdl_comma(sdl);
        sdl_vector(sdl, vec3((double)p[0], (double)p[1], (double)p[2]));
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
    write_vertices(sdl, cut);
    if (normal) mesh_sdl_vectors(sdl, "normal_vectors", normal, cut->vertices);
    mesh_sdl_faces(sdl, cut->triangle, cut->triangles);
    sdl_end(sdl);
}

static struct vec3 corner(const struct static_cut *cut, uint32_t i)
{
    const float *p = cut->position_m[i];
    return vec3((double)p[0], (double)p[1], (double)p[2]);
}

static bool is_level(const struct static_cut *cut, const uint32_t t[3])
{
    struct vec3 a = corner(cut, t[0]), n = vec3_cross(vec3_sub(corner(cut, t[1]), a), vec3_sub(corner(cut, t[2]), a));
    return fabs(n.z) > RELIEF_LEVEL * vec3_norm(n);
}

/* The level faces, and the smooth normals of their corners. */
static bool level_part(struct static_cut *level, struct vec3 **normal, const struct static_cut *cut, struct error *err)
{
    bool *taken = calloc(cut->triangles + 1, sizeof *taken);
    for (size_t i = 0; taken && i < cut->triangles; i++) taken[i] = is_level(cut, cut->triangle[i]);
    bool ok = (taken && static_cut_pick(level, cut, taken, true)) || error_set(err, ERR_MEMORY, "no memory for the place");
    free(taken);
    return ok && static_cut_normals(normal, level, err);
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
    struct static_cut level = { 0 };
    struct vec3 *normal = NULL;
    if (!level_part(&level, &normal, receivers, err)) {
        static_cut_release(&level);
        return false;
    }
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "the place round the entities of a frame: metres, world");
    write_cut(&sdl, "Receivers", receivers, NULL);
    write_cut(&sdl, "Level", &level, normal);
    write_cut(&sdl, "Rest", rest, NULL);
    static_cut_release(&level);
    free(normal);
    return write_include(&sdl, path, err);
}

bool shades_include_write(const char *path, const struct static_cut *shades, const size_t count[TOLD_KINDS], struct error *err)
{
    static const char *const names[TOLD_KINDS] = { "Shades", "Shades_In_Part", "Shades_Told" };
    struct static_cut part = *shades;
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "what of the place can keep the sun from the ground round the entities of a frame: metres, world");
    for (int i = 0; i < TOLD_KINDS; i++) {
        part.triangles = count[i];
        write_cut(&sdl, names[i], &part, NULL);
        part.triangle += count[i];
    }
    return write_include(&sdl, path, err);
}

static void write_part(struct sdl *sdl, const char *name, const struct relief_part *part)
{
    sdl_declare(sdl, name);
    if (!part->triangles) {
        mesh_sdl_nowhere(sdl);
        return;
    }
    sdl_begin(sdl, "mesh2");
    mesh_sdl_vectors(sdl, "vertex_vectors", part->point_m, part->points);
    mesh_sdl_faces(sdl, part->triangle, part->triangles);
    sdl_end(sdl);
}

/* Each face has the middle of its own texel. */
static void write_hidden(struct sdl *sdl, const struct hidden_place *hidden, const char *map)
{
    const struct static_cut *part = &hidden->part;
    sdl_declare_string(sdl, "Hidden_Place_Map", map);
    sdl_declare(sdl, "Hidden_Place");
    sdl_begin(sdl, "mesh2");
    write_vertices(sdl, part);
    sdl_begin(sdl, "uv_vectors");
    sdl_number(sdl, (double)part->triangles);
    for (size_t i = 0; i < part->triangles; i++) {
        sdl_comma(sdl);
        sdl_vector2(sdl, ((double)(i % HIDDEN_PLACE_COLUMNS) + 0.5) / HIDDEN_PLACE_COLUMNS,
                    1 - ((double)(i / HIDDEN_PLACE_COLUMNS) + 0.5) / hidden->radiance.height_px);
        if (i % 8 == 7) sdl_newline(sdl);
    }
    sdl_end(sdl);
    mesh_sdl_faces(sdl, part->triangle, part->triangles);
    sdl_begin(sdl, "uv_indices");
    sdl_number(sdl, (double)part->triangles);
    for (size_t i = 0; i < part->triangles; i++) {
        sdl_comma(sdl);
        sdl_vector(sdl, vec3((double)i, (double)i, (double)i));
        if (i % 8 == 7) sdl_newline(sdl);
    }
    sdl_end(sdl);
    sdl_end(sdl);
}

bool relief_include_write(const char *path, const struct relief *relief, const struct hidden_place *hidden, const char *hidden_map,
                          struct error *err)
{
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "the place as light and mirrors meet it, seen from among the entities of a frame: metres, world");
    write_part(&sdl, "Relief", &relief->seen);
    write_part(&sdl, "Relief_Ground", &relief->ground);
    if (hidden && hidden->part.triangles) write_hidden(&sdl, hidden, hidden_map);
    return write_include(&sdl, path, err);
}

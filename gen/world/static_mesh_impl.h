/* What a static mesh is made of: for its own files. */
#ifndef STAFFAGE_GEN_STATIC_MESH_IMPL_H
#define STAFFAGE_GEN_STATIC_MESH_IMPL_H

#include "gen/world/static_mesh.h"

#include <embree3/rtcore.h>

#define STATIC_NO_TEXTURE UINT16_MAX

struct static_tiles;

struct static_mesh {
    struct similarity world_from_mesh;
    size_t vertices, triangles, triangle_capacity;
    float (*position_m)[3];     /* (vertices + 1,3): Embree reads 16 bytes at a time */
    uint8_t (*color)[3];        /* (vertices,3) sRGB; NULL: the file has no colours */
    int16_t *vertex_label;      /* (vertices) of a triangle there as it was loaded; NULL without labels */
    uint32_t (*triangle)[3];    /* (triangles,3) */
    /* One a triangle; NULL where the file has none. A triangle's colour is its texture's, else its own, else its corners'. */
    int16_t *label;
    uint8_t (*face_color)[3];   /* sRGB */
    uint16_t *texture;          /* STATIC_NO_TEXTURE */
    float (*uv)[3][2];          /* v up */
    struct image *textures;     /* (texture_count) U8, 3 or 4 channels */
    char **texture_names;       /* (texture_count) */
    size_t texture_count;
    float linear[256];          /* sRGB as linear light */
    /* From static_mesh_index on. */
    bool indexed;
    struct vec3 min_m, max_m;
    RTCDevice device;
    RTCScene scene;
    struct static_tiles *tiles;
};

/* --- for readers --- */

/* Each fills an empty mesh, which the caller destroys, also on failure; vertices through static_mesh_place. */
bool static_mesh_read_ply(struct static_mesh *mesh, const char *path, struct error *err);
bool static_mesh_read_obj(struct static_mesh *mesh, const char *path, struct error *err);

bool static_mesh_reserve_vertices(struct static_mesh *mesh, size_t vertices, bool with_color, struct error *err);
/* Room for so many triangles in every array that a triangle has. */
bool static_mesh_reserve_triangles(struct static_mesh *mesh, size_t triangles, struct error *err);
/* Give every triangle, those to come as well, a label (-1), a colour (0) or a texture (none). */
bool static_mesh_with_labels(struct static_mesh *mesh, struct error *err);
bool static_mesh_with_face_colors(struct static_mesh *mesh, struct error *err);
bool static_mesh_with_textures(struct static_mesh *mesh, struct error *err);
/* The image of a texture that the file names; it must be there. Out: *index, the same for the same name */
bool static_mesh_read_texture(struct static_mesh *mesh, uint16_t *index, const char *path, const char *name, struct error *err);
static inline void static_mesh_place(struct static_mesh *mesh, size_t vertex, struct vec3 p)
{
    struct vec3 q = similarity_apply(mesh->world_from_mesh, p);
    mesh->position_m[vertex][0] = (float)q.x;
    mesh->position_m[vertex][1] = (float)q.y;
    mesh->position_m[vertex][2] = (float)q.z;
}
static inline struct vec3 static_vertex(const struct static_mesh *mesh, uint32_t vertex)
{
    const float *p = mesh->position_m[vertex];
    return vec3((double)p[0], (double)p[1], (double)p[2]);
}

/* --- colours --- */

void static_color_init(struct static_mesh *mesh);
static inline uint8_t static_srgb(double share) /* 0..1 to 0..255 */
{
    return (uint8_t)(share * 255 + 0.5);
}
/* Vertex colours from the triangles', where the file has none of its own. */
bool static_mesh_color_vertices(struct static_mesh *mesh, struct error *err);

/* --- the index --- */

bool static_rays_build(struct static_mesh *mesh, struct error *err);
void static_rays_release(struct static_mesh *mesh);
bool static_tiles_build(struct static_mesh *mesh, double detail_m, struct error *err);
void static_tiles_destroy(struct static_tiles *tiles);

#endif

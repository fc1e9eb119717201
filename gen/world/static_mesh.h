/* The place as a mesh: what a reconstruction knows of it, in world metres.
 *
 * Loaded once, searched by rays (Embree) and by tiles. Rays meet the mesh at its own detail; what
 * POV-Ray is given are cuts of it, coarsened to `detail_m`, so that the cost of a pass follows the
 * place around the entities and not the size of the mesh. */
#ifndef STAFFAGE_GEN_STATIC_MESH_H
#define STAFFAGE_GEN_STATIC_MESH_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct static_mesh;

/* Load a .ply (binary or text, any scalar types, vertex colours or face colours or a face property
 * "label") or an .obj (with textures). It is not searchable before static_mesh_index.
 * Out: *mesh, the caller's; free with static_mesh_destroy
 * Err: ERR_INPUT at path: truncated, counts that the file cannot hold, an index out of range, a
 *      coordinate that is not a number, no triangles, more than 2^31 triangles */
bool static_mesh_load(struct static_mesh **mesh, const char *path, struct similarity world_from_mesh, struct error *err);
void static_mesh_destroy(struct static_mesh *mesh);

/* The vertices, world metres: to read, and before static_mesh_index also to move (a smooth road). */
size_t static_mesh_vertex_count(const struct static_mesh *mesh);
float (*static_mesh_vertices(struct static_mesh *mesh))[3];
struct vec3 static_mesh_vertex(const struct static_mesh *mesh, uint32_t vertex);
size_t static_mesh_triangle_count(const struct static_mesh *mesh);
const uint32_t (*static_mesh_triangles(const struct static_mesh *mesh))[3];
void static_mesh_bounds(const struct static_mesh *mesh, struct vec3 *min_m, struct vec3 *max_m);
/* Changes with every coordinate, colour and index. */
uint64_t static_mesh_hash(const struct static_mesh *mesh);

/* Add a surface (a smooth road where the mesh has holes); before static_mesh_index. Its triangles
 * come after the mesh's own, its colour is that of the nearest vertices of the mesh.
 * In:  position_m (vertices,3), triangle (triangles,3) indices into position_m */
bool static_mesh_add(struct static_mesh *mesh, const float (*position_m)[3], size_t vertices,
                     const uint32_t (*triangle)[3], size_t triangles, struct error *err);

/* Take triangles out: keep (triangle_count) false. Before static_mesh_index. */
bool static_mesh_keep(struct static_mesh *mesh, const bool *keep, struct error *err);

/* Build the search tree and the tiles. detail_m: edge of the cells to which cuts are coarsened. */
bool static_mesh_index(struct static_mesh *mesh, double detail_m, struct error *err);
/* Drop both, so that the mesh may be changed and indexed again. */
void static_mesh_unindex(struct static_mesh *mesh);

/* --- rays --- */

#define STATIC_NO_TRIANGLE UINT32_MAX
struct static_hit {
    double range_m;      /* INFINITY where the ray meets nothing */
    uint32_t triangle;   /* STATIC_NO_TRIANGLE */
    float u, v;          /* barycentric: p = (1-u-v) a + u b + v c */
};
/* First hits of rays from one origin. In: directions (n) unit; neighbours in the list had better be
 * neighbours in space. Safe for several threads. */
void static_mesh_hits(const struct static_mesh *mesh, struct static_hit *hits, struct vec3 origin_m,
                      const struct vec3 *directions, size_t n);
/* Does anything lie between from + near_m direction and from + far_m direction? */
bool static_mesh_blocks(const struct static_mesh *mesh, struct vec3 from_m, struct vec3 direction, double near_m,
                        double far_m);
/* The highest surface below (x, y, below_m). False over a hole. */
bool static_mesh_height(const struct static_mesh *mesh, double *z_m, double x_m, double y_m, double below_m);

struct vec3 static_mesh_normal(const struct static_mesh *mesh, uint32_t triangle); /* unit, of the face */
/* Colour at a hit, linear; a texture is averaged over footprint_m (0: the nearest texel). A mesh
 * without colours is a grey of STATIC_GREY. */
#define STATIC_GREY 0.2f
bool static_mesh_has_colors(const struct static_mesh *mesh);
void static_mesh_color(const struct static_mesh *mesh, float rgb[3], const struct static_hit *hit, double footprint_m);
/* The face's label (a semantic mesh), or -1: STATIC_LABEL_UNKNOWN in the file, or no labels at all. */
#define STATIC_LABEL_UNKNOWN 255
bool static_mesh_has_labels(const struct static_mesh *mesh);
int static_mesh_label(const struct static_mesh *mesh, uint32_t triangle);

/* --- cuts --- */

/* A convex polygon at height base_m, swept along an axis: what lies within, between below_m and
 * above_m over base_m. Along z: the place around an entity; along the sun: what can shade it. */
struct prism {
    const struct vec2 *corner_m; /* (corners) counter-clockwise; borrowed */
    size_t corners;
    double base_m;
    struct vec3 axis;            /* unit, axis.z > 0 */
    double below_m, above_m;     /* heights over base_m, below_m <= 0 */
};
/* Triangles of the coarsened mesh that reach into one of the prisms, each once, in an order that depends
 * on the mesh and the prisms alone. What is coarsened is kept for the next cut: one thread at a time. */
struct static_cut {
    float (*position_m)[3];      /* (vertices,3) world */
    float (*color)[3];           /* (vertices,3) linear */
    uint32_t (*triangle)[3];     /* (triangles,3) */
    size_t vertices, triangles;
};
bool static_mesh_cut(const struct static_mesh *mesh, struct static_cut *cut, const struct prism *prisms, size_t n,
                     struct error *err);
void static_cut_release(struct static_cut *cut);
/* The triangles that are taken, or those that are not, without colours.
 * In: taken (cut->triangles). Out: *out, initialized here; false without memory */
bool static_cut_pick(struct static_cut *out, const struct static_cut *cut, const bool *taken, bool wanted);
/* Smooth normals: at each vertex that of the faces round it, by their area.
 * Out: *normal (vertices) unit, the caller's. Err: ERR_MEMORY */
bool static_cut_normals(struct vec3 **normal, const struct static_cut *cut, struct error *err);

/* Write the mesh as binary PLY, in world metres: vertices with colours, faces with a uchar "label"
 * and its colour when labels (triangle_count) are given. */
bool static_mesh_write(const char *path, const struct static_mesh *mesh, const uint8_t *labels,
                       const uint8_t (*label_colors)[3], struct error *err);

#endif

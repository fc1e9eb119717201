/* What a glTF 2.0 file says, as plain arrays: read by tinygltf, not yet understood.
 * An index that the file does not give is -1; none is checked here. */
#ifndef STAFFAGE_GEN_GLTF_H
#define STAFFAGE_GEN_GLTF_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { GLTF_UV_SETS = 4, GLTF_JOINT_SETS = 2 };

/* Component types and primitive modes keep glTF's own numbers. */
enum gltf_component { GLTF_I8 = 5120, GLTF_U8, GLTF_I16, GLTF_U16, GLTF_U32 = 5125, GLTF_F32 };
enum gltf_mode { GLTF_POINTS, GLTF_LINES, GLTF_LINE_LOOP, GLTF_LINE_STRIP, GLTF_TRIANGLES, GLTF_STRIP, GLTF_FAN };
enum gltf_wrap { GLTF_CLAMP = 33071, GLTF_MIRROR = 33648, GLTF_REPEAT = 10497 };

struct gltf_buffer { uint8_t *data; size_t size; };
struct gltf_view { int buffer; size_t offset, size, stride; /* stride 0: packed */ };
struct gltf_accessor {
    int view, component, components; /* components: 1 to 4, 16 for a MAT4 */
    size_t offset, count;
    bool normalized, sparse;
    int sparse_index_view, sparse_index_component, sparse_value_view;
    size_t sparse_count, sparse_index_offset, sparse_value_offset;
};
struct gltf_primitive { /* accessors */
    int mode, material, indices, position, normal;
    int uv[GLTF_UV_SETS], joints[GLTF_JOINT_SETS], weights[GLTF_JOINT_SETS];
    bool has_targets;
};
struct gltf_mesh { struct gltf_primitive *primitives; size_t primitive_count; bool is_morphed; };
struct gltf_node {
    int mesh, skin, *children;
    size_t child_count;
    bool has_matrix, is_morphed;
    double matrix[16]; /* column-major, as in the file */
    double translation[3], rotation[4] /* x, y, z, w */, scale[3];
    bool is_driver; /* by its name */
};
struct gltf_skin { int inverse_bind, *joints; size_t joint_count; };
enum gltf_path { GLTF_TRANSLATION, GLTF_ROTATION, GLTF_SCALE };
enum gltf_interpolation { GLTF_STEP, GLTF_LINEAR, GLTF_CUBIC };
struct gltf_channel { int node, input, output; enum gltf_path path; enum gltf_interpolation interpolation; };
struct gltf_animation { char *name; size_t first, count; /* of the channels */ };
struct gltf_image { char *uri; uint8_t *data; size_t size; int view; }; /* one of the three */
struct gltf_texture { int image, wrap_u, wrap_v; };
struct gltf_texture_use { int texture, uv_set; double offset[2], rotation_rad, scale[2]; };
struct gltf_material {
    char *name, *alpha_mode;
    bool has_figures;
    double base_color[4], metallic, roughness, emissive[3], alpha_cutoff;
    double clearcoat, clearcoat_roughness, transmission, ior;
    struct gltf_texture_use base, metallic_roughness, emissive_texture;
};

struct gltf {
    struct gltf_buffer *buffers;
    struct gltf_view *views;
    struct gltf_accessor *accessors;
    struct gltf_mesh *meshes;
    struct gltf_node *nodes;
    struct gltf_skin *skins;
    struct gltf_animation *animations;
    struct gltf_channel *channels; /* of all animations, one after the other */
    struct gltf_image *images;
    struct gltf_texture *textures;
    struct gltf_material *materials;
    int *roots;                    /* nodes of the scene to show */
    size_t buffer_count, view_count, accessor_count, mesh_count, node_count, skin_count, animation_count, channel_count,
        image_count, texture_count, material_count, root_count;
};

/* Read a .gltf or .glb file with its buffers. External images are left to the caller.
 * Out: gltf, initialized here; free with gltf_release
 * Err: ERR_INPUT at path: no glTF, truncated, a buffer missing or short, an extension required
 *      that is not supported */
bool gltf_read(struct gltf *gltf, const char *path, struct error *err);
void gltf_release(struct gltf *gltf);

#ifdef __cplusplus
}
#endif
#endif

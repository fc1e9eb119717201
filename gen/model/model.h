/* A 3D model, ready to stand: metres, entity axes (x forward, y left, z up),
 * origin on the ground below the centre of the bounding box. */
#ifndef STAFFAGE_GEN_MODEL_H
#define STAFFAGE_GEN_MODEL_H

#include "gen/model/material.h"
#include "gen/model/mesh.h"
#include "lib/class.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rig;
struct posture;

struct model {
    char *path;
    struct mesh *meshes;
    size_t mesh_count;
    struct material *materials;
    size_t material_count;
    struct image *images;     /* each texture's pixels once, however many materials show it */
    size_t image_count;
    struct vec3 min_m, max_m; /* bounding box; min_m.z is 0, but for a posed model */
    struct rig *rig;          /* how it moves (gen/model/rig.h); NULL: it does not */
    double unit_m;            /* metres that a unit of the file became */
    double stated_unit_m;     /* metres that a unit of the file is, as it says; 0: it does not say */
    double lowest_m;          /* where its lowest vertex lay above the file's zero; loading stands it on the ground */
    char **textures;          /* paths of the files that its textures come from */
    size_t texture_count;
    char **missing_textures;  /* names that the model gives and that were not found */
    size_t missing_texture_count;
};

/* An axis of the file's own coordinates. */
enum axis { AXIS_POS_X, AXIS_NEG_X, AXIS_POS_Y, AXIS_NEG_Y, AXIS_POS_Z, AXIS_NEG_Z };
/* "+x" and so on. */
const char *axis_name(enum axis axis);
/* Takes "x" for "+x", too. Returns false for other texts (no error is set). */
bool axis_from_name(enum axis *axis, const char *name);

struct model_options {
    double unit_m;      /* metres to a unit of the file; 0: by length_m, or 1 for glTF; other formats must say */
    double length_m;    /* real length along the front axis (height_m for people); 0: unit_m decides */
    double height_m;    /* real height; 0: unit_m decides */
    enum axis up, front;
    bool axes_given;    /* false: the format's own (glTF: +y up, +z front); other formats must say */
    bool has_class;     /* class_ is known: it picks the rules' default line */
    enum entity_class class_;
    const struct material_rules *rules; /* borrowed; NULL: figures alone, by material_default where there are none */
};

/* Load a .gltf, .glb (tinygltf), .obj, .ply, .dae or .fbx (assimp) file. An animated glTF
 * stands as its first animation begins, and has a rig.
 * Materials: glTF figures as they are, then the rules by name for those without figures.
 * Textures are looked for beside the file, then in the folders around it.
 * Out: *model, the caller's; free with model_destroy.
 * Err: ERR_INPUT at the model's path: missing, broken, without triangles, no unit or axes known,
 *      index or size out of range. A missing texture is no error: see missing_textures. */
bool model_load(struct model **model, const char *path, const struct model_options *options, struct error *err);
void model_destroy(struct model *model);

/* The model in a posture of its animations (gen/model/rig.h). Unit and origin stay the loaded
 * model's: the lowest point may leave the ground. What the animation itself goes along the front axis
 * is taken out, for whoever moves the model moves it. A parked one has no driver (the node of that name).
 * Out: posed   the caller's storage: positions, normals and the box are its own, the rest is borrowed
 *              from the model, which must outlive it; its rig is NULL. Free with model_posed_release.
 * Err: ERR_INPUT at the model's path: it has no animation; a coordinate is not a number. ERR_MEMORY */
bool model_pose(struct model *posed, const struct model *model, const struct posture *posture, struct error *err);
void model_posed_release(struct model *posed);
/* Is there one to leave out when it is parked? */
bool model_has_driver(const struct model *model);

#endif

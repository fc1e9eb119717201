/* A model that moves: its nodes, what its animations do to them, and how vertices follow.
 * All of it is in the file's own coordinates, and stays so until a mesh is posed. */
#ifndef STAFFAGE_GEN_RIG_H
#define STAFFAGE_GEN_RIG_H

#include "gen/model/affine.h"
#include "gen/model/gltf.h"
#include "gen/model/mesh.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rig_node {
    int parent;                     /* -1: a root */
    bool has_matrix;
    struct affine matrix;           /* instead of the three: no channel moves such a node */
    double translation[3], rotation[4] /* x, y, z, w */, scale[3];
    bool is_driver;                 /* who is not there while a vehicle is parked */
};
struct rig_channel {                /* one of a node's three, over time */
    size_t node, keys;
    enum gltf_path path;
    enum gltf_interpolation interpolation;
    double *time_s;                 /* (keys) ascending */
    double *value;                  /* (keys, n), n 3 or 4; cubic: (keys, 3, n), in-tangent, value, out-tangent */
};
struct rig_skin {
    size_t *joint;                  /* (joints) nodes */
    struct affine *inverse_bind;    /* (joints) */
    size_t joint_count;
};
struct rig_influence { uint32_t joint; float weight; };
struct rig_mesh {                   /* how one mesh follows */
    size_t node;                    /* that shows it; moves it when there are no influences */
    size_t skin;
    size_t per_vertex;              /* 0: by the node */
    struct rig_influence *influence; /* (vertices, per_vertex): weights of a vertex sum to 1 */
    float (*position)[3];           /* (vertices) at rest */
    float (*normal)[3];             /* (vertices) at rest; NULL as long as the file gives none */
    size_t vertices;
};

struct rig_animation {
    char *name;                     /* as the file has it; maybe empty */
    size_t first, count;            /* of the channels */
    double duration_s;              /* of a loop: the last key */
    double drift_m;                 /* what it goes along the front axis in a loop: posing takes it out */
};

/* What a body does at a moment: an animation at a time, looped, and a share of the way from it to another. */
struct posture { size_t animation; double time_s; size_t to; double to_time_s, share; /* 0: none of it */ bool parked; };

struct rig {
    struct rig_node *nodes;
    size_t *order;                  /* (nodes) parents before their children */
    struct rig_animation *animations; /* at rest the model is as the first begins */
    struct rig_channel *channels;
    struct rig_skin *skins;
    struct rig_mesh *meshes;        /* one a mesh of the model, in its order */
    size_t node_count, animation_count, channel_count, skin_count, mesh_count;
    struct affine entity_from_file; /* identity until the model stands */
};

/* Meshes that were posed at rest have come to their final vertices and normals, which `source` tells
 * of: let the rig's own follow. Err: ERR_MEMORY */
bool rig_follow(struct rig *rig, const struct mesh *meshes, struct error *err);

/* Where the vertices are in a posture.
 * Out: meshes   (mesh_count) positions and, where they have them, normals, in place; entity axes
 * Err: ERR_MEMORY; ERR_INPUT without a place: a coordinate that is not a number */
bool rig_pose(struct mesh *meshes, const struct rig *rig, const struct posture *posture, struct error *err);

/* Turn triangles around whose vertices the pose at rest mirrors. Err: ERR_MEMORY */
bool rig_wind(struct mesh *meshes, const struct rig *rig, struct error *err);

/* Find the animations' drift_m. The model must stand. Err: as rig_pose */
bool rig_measure_drift(struct rig *rig, struct error *err);

/* Of all that poses follow from. */
uint64_t rig_hash(uint64_t hash, const struct rig *rig);

void rig_mesh_release(struct rig_mesh *mesh);
void rig_destroy(struct rig *rig);

#endif

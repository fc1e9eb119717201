/* What an importer hands to model.c: everything in the file's own coordinates. */
#ifndef STAFFAGE_GEN_MODEL_IMPORT_H
#define STAFFAGE_GEN_MODEL_IMPORT_H

#include "gen/model/material.h"
#include "gen/model/mesh.h"
#include "gen/model/rig.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* An image that materials refer to. */
struct import_image {
    char *name;             /* as the file says, for the search and for errors; owned */
    uint8_t *data;          /* the bytes of an embedded PNG or JPEG, or NULL; owned */
    size_t size;
};

enum { NO_IMAGE = -1 };

struct import_material {
    struct material material; /* names_only as the file says; base_image is filled in later */
    int base, opacity, metallic_roughness, emissive; /* images, or NO_IMAGE */
    bool base_replaces_color; /* the base image stands instead of base_color, not multiplied by it */
};

struct import {
    struct mesh *meshes;
    struct import_material *materials;
    struct import_image *images;
    char **missing;         /* files besides images that are not there */
    struct rig *rig;        /* or NULL; with one, meshes stand at time 0, know their source, and are as many as the rig's */
    size_t mesh_count, material_count, image_count, missing_count;
    double unit_m;          /* the file's own; 0: it says nothing */
};

/* Each fills an import that is all 0, which the caller releases, also on failure.
 * Err: ERR_INPUT at path; ERR_MEMORY */
bool import_gltf(struct import *import, const char *path, struct error *err);
bool import_assimp(struct import *import, const char *path, struct error *err);
bool import_ply(struct import *import, const char *path, struct error *err);
void import_release(struct import *import);

/* Append, zeroed or handed over. NULL or false: ERR_MEMORY. */
struct import_material *import_add_material(struct import *import, const char *name, struct error *err);
bool import_add_mesh(struct import *import, struct mesh *mesh, struct error *err);
/* An image by name, the same one for the same name. Returns its index, or NO_IMAGE (ERR_MEMORY). */
int import_add_image(struct import *import, const char *name, struct error *err);
bool import_add_missing(struct import *import, const char *name, struct error *err);

#endif

/* What the parts of the glTF importer share. */
#ifndef STAFFAGE_GEN_MODEL_GLTF_H
#define STAFFAGE_GEN_MODEL_GLTF_H

#include "gen/model/gltf.h"
#include "gen/model/model_import.h"
#include "gen/model/rig.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gltf_loader {
    struct import *import;
    const struct gltf *gltf;
    const char *path;
    int default_material;          /* index in import, -1 until needed */
    struct error *err;
};

#define GLTF_FAIL(l, ...) error_at((l)->err, ERR_INPUT, (l)->path, 0, 0, __VA_ARGS__)
#define gltf_no_memory(l) error_at((l)->err, ERR_MEMORY, (l)->path, 0, 0, "no memory for this model")

/* All values of an accessor as doubles, (count, components). `what` it is stands in errors.
 * The caller frees; NULL on failure. */
double *gltf_accessor_read(struct gltf_loader *l, size_t *count, int accessor, int components, const char *what);
/* The first byte of `count` elements in a view, having checked that they all lie in it. */
const uint8_t *gltf_elements(struct gltf_loader *l, int view, size_t offset, size_t count, size_t element, size_t *stride);

bool gltf_add_images(struct gltf_loader *l);
bool gltf_add_materials(struct gltf_loader *l);

/* Fill import->rig with nodes, channels and skins; its meshes come with the import's. */
bool gltf_add_rig(struct gltf_loader *l);
/* How the vertices of a primitive follow the skin's joints. mesh: per_vertex and influence are set,
 * one for each of the primitive's vertices. */
bool gltf_add_influences(struct gltf_loader *l, struct rig_mesh *mesh, const struct gltf_primitive *p, size_t vertices);

#endif

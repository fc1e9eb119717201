/* Textures of a model: found around it, decoded once, attached to its materials. */
#ifndef STAFFAGE_GEN_MODEL_TEXTURE_H
#define STAFFAGE_GEN_MODEL_TEXTURE_H

#include "gen/model/model.h"
#include "gen/model/model_import.h"
#include "lib/error.h"

#include <stdbool.h>

/* The file that a model means by a texture's name: as written, seen from the model's folder; then
 * by its file name alone, in any case of letters, in that folder and the two levels below it, in
 * the folder above, and in folders beside whose names tell of textures. Written for other machines:
 * backslashes, drives and schemes ("model://...") are understood.
 * Returns the path (the caller frees), or NULL when there is none. */
char *texture_find(const char *model_path, const char *name);

/* Make an image U8 of 3 channels or 4, in its place: grey becomes colour. Err: ERR_MEMORY */
bool texture_make_u8(struct image *image, struct error *err);

/* Give model->materials (already copied from import->materials) their images: model->images and
 * model->missing_textures are filled in. Figures that the file gives as textures (metallic,
 * roughness, emissive) become their means; what turns out opaque is made ALPHA_OPAQUE.
 * Err: ERR_INPUT at the texture's path when it is no image; ERR_MEMORY */
bool model_attach_textures(struct model *model, const struct import *import, struct error *err);

#endif

/* A person that walks, as a binary glTF 2.0 file: +y up, +z front, metres. */
#ifndef STAFFAGE_SCENES_MODELS_GLB_H
#define STAFFAGE_SCENES_MODELS_GLB_H

#include "lib/error.h"
#include "scenes/models/mesh.h"
#include "scenes/models/skeleton.h"
#include "scenes/models/walk.h"

#include <stdbool.h>

/* Write FOLDER/NAME.glb, and empty the model. */
bool write_walker(struct model *model, const struct skeleton *skeleton, const struct walk *walk, const char *folder,
                  const char *name, const struct palette *palette, struct error *err);

#endif

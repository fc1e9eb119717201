/* A person that walks, as a binary glTF 2.0 file: +y up, +z front, metres. */
#ifndef STAFFAGE_CAST_GLB_H
#define STAFFAGE_CAST_GLB_H

#include "lib/error.h"
#include "cast/mesh.h"
#include "cast/skeleton.h"
#include "cast/walk.h"

#include <stdbool.h>

/* Write FOLDER/NAME.glb, and empty the model. */
bool write_walker(struct model *model, const struct skeleton *skeleton, const struct walk *walk, const char *folder,
                  const char *name, const struct palette *palette, struct error *err);

#endif

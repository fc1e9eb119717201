/* The people of the cast as glTF files: skin, joints, animations, in three levels of detail. */
#ifndef STAFFAGE_CAST_FIGURE_H
#define STAFFAGE_CAST_FIGURE_H

#include "cast/listing.h"
#include "lib/error.h"

#include <stdbool.h>

/* Write FOLDER/NAME.glb, NAME-middle.glb and NAME-far.glb for each of them, and list them. */
bool write_people(struct listing *listing, const char *folder, struct error *err);

#endif

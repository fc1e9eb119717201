/* The people of the cast as glTF files: skin, joints, animations, in three levels of detail. */
#ifndef STAFFAGE_CAST_FIGURE_H
#define STAFFAGE_CAST_FIGURE_H

#include "cast/listing.h"
#include "cast/person.h"
#include "lib/error.h"

#include <stdbool.h>

/* Write FOLDER/NAME.glb, NAME-middle.glb and NAME-far.glb of one of them, and list it. */
bool write_person(struct listing *listing, const struct person *person, const char *folder, struct error *err);

#endif

/* Whether the reconstruction's lens is that of the photographs. */
#ifndef STAFFAGE_IMPORT_FOCAL_H
#define STAFFAGE_IMPORT_FOCAL_H

#include "import/photo_facts.h"
#include "import/reconstruction.h"

#include <stdbool.h>

/* Focal lengths as 35 mm film would need them: the longer side is 36 mm. */
struct focal_check { double reconstruction_mm, exif_mm; };

/* A flight at one height, looking down, hardly tells a longer lens from a greater height: where the lens comes
 * out k times too long, everything comes out k times too high, and GPS at one height cannot see it.
 * In:  facts (shot_count)
 * Out: the two of the shot whose ratio is the median
 * Returns false where they agree within 15 % (EXIF's are rounded, and definitions differ by 5 %) or EXIF has none. */
bool focal_differs(struct focal_check *check, const struct reconstruction *reconstruction, const struct photo_facts *facts);

#endif

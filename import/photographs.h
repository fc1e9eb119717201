/* The photographs of a reconstruction's shots: where they lie and what their EXIF says. */
#ifndef STAFFAGE_IMPORT_PHOTOGRAPHS_H
#define STAFFAGE_IMPORT_PHOTOGRAPHS_H

#include "import/photo_facts.h"
#include "import/reconstruction.h"
#include "lib/error.h"

#include <stddef.h>

struct photographs {
    char **names;              /* (count) as the scene file names them */
    struct photo_facts *facts; /* (count) */
    size_t count;
};

/* In:  scene_path, of the scene file to be; source, what was imported; folder, where the images' names
 *      lead from, or NULL: the source's folder, one named images in it, or the same up to two folders above
 * Out: photographs, one a shot; free with photographs_release
 * Err: ERR_INPUT at the folder that is none, or at a photograph that is missing or whose EXIF is broken */
bool photographs_find(struct photographs *photographs, const struct reconstruction *reconstruction,
                      const char *scene_path, const char *source, const char *folder, struct error *err);
void photographs_release(struct photographs *photographs);

/* How many have a time in their EXIF, with an offset from UTC or without. */
size_t photographs_with_clock(const struct photographs *photographs);

/* The local time at which a shot was taken, with the offset from UTC: the one given or, without, EXIF's own.
 * Returns false, with the text untouched, where EXIF has no time or no offset is known. */
bool photograph_time(char text[40], const struct photo_facts *facts, const char *utc_offset);

#endif

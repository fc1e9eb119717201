/* The files that a model consists of. */
#ifndef STAFFAGE_CATALOGUE_PARTS_H
#define STAFFAGE_CATALOGUE_PARTS_H

#include "gen/model/model.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* The model's own file, the material files or buffers that it names, and its textures, which are found by their names
 * wherever they lie around it: in the copy they lie beside it. */
struct part { char *from, *to; /* a path; a name in the copy's folder */ };
struct parts { struct part *list; size_t count; };

/* In:  model   as loaded
 * Err: ERR_INPUT at the model's path: a file that it names lies outside of its folder; two textures of one name */
bool parts_find(struct parts *parts, const struct model *model, struct error *err);
void parts_release(struct parts *parts);
/* Copy all of them into a folder. */
bool parts_copy(const struct parts *parts, const char *folder, struct error *err);

#endif

/* Folders as a whole. */
#ifndef STAFFAGE_CATALOGUE_FOLDER_H
#define STAFFAGE_CATALOGUE_FOLDER_H

#include "lib/error.h"

#include <stdbool.h>

/* Remove a folder and all below. What cannot be removed stays. */
void folder_remove(const char *path);
/* Bring a finished folder into place. What has the name already is removed: `replace` says that this is meant.
 * Err: ERR_INPUT at `path`: it is there, and not to be replaced; ERR_IO */
bool folder_commit(const char *temporary, const char *path, bool replace, struct error *err);

#endif

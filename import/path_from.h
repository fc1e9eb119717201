/* How one file is named in another. */
#ifndef STAFFAGE_IMPORT_PATH_FROM_H
#define STAFFAGE_IMPORT_PATH_FROM_H

#include "lib/error.h"

/* `path`, which is there, as `base_file` names it: path_beside's inverse. What has no folder but the
 * root in common with base_file, whose folder is there, is named in full. The caller frees.
 * Returns NULL with ERR_INPUT at path (or base_file) when there is no such file or folder. */
char *path_from(const char *base_file, const char *path, struct error *err);

#endif

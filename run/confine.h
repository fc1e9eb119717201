/* Take the file system away from this process, but for what a renderer needs: the
 * kernel's Landlock. POV-Ray's own restriction of file access has no effect in 3.7. */
#ifndef STAFFAGE_RUN_CONFINE_H
#define STAFFAGE_RUN_CONFINE_H

#include "lib/error.h"

#include <stdbool.h>

/* Whether this kernel has Landlock. */
bool confine_available(void);

/* From here on this process and its children can read the system's libraries and `readable`
 * with all below, write only below `writable`, and execute only `program`.
 * Err: ERR_IO when the kernel refuses, or a folder is not there; the process may then be half confined */
bool confine(const char *program, const char *readable, const char *writable, struct error *err);

#endif

/* Which frames an output folder has. */
#ifndef STAFFAGE_POST_FRAME_LIST_H
#define STAFFAGE_POST_FRAME_LIST_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* The names of all frames that gen has finished, sorted. The caller frees with frame_list_free.
 * Err: ERR_INPUT at OUT when it is no output folder, naming the one that was meant where that can be told; at OUT/frames
 *      when it cannot be read or there are none */
bool frame_list(char ***frames, size_t *count, const char *out, struct error *err);
void frame_list_free(char **frames, size_t count);

#endif

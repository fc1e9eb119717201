/* Which of the scene's own entities the frames hardly show: mostly a place that was written wrong. */
#ifndef STAFFAGE_GEN_SIGHTING_H
#define STAFFAGE_GEN_SIGHTING_H

#include "gen/frame.h"
#include "gen/stage.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

#define SIGHTING_SMALL_PX 8 /* nobody can tell what is smaller */

/* Add a line to the stage's warnings for each entity that is in no frame, hidden in all, or smaller in all of them than
 * SIGHTING_SMALL_PX; of many, for some and a count. Traffic comes and goes: of it nothing is said.
 * In:  frames (n)   all of the scene; their labels.json are read until everyone was seen well
 * Err: ERR_IO, ERR_INPUT: labels that cannot be read; ERR_MEMORY */
bool sighting_warn(struct stage *stage, const char *out_folder, const struct frame_result *frames, size_t n, struct error *err);

#endif

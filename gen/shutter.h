/* What moves in the picture while a shot's shutter is open: from its time on. */
#ifndef STAFFAGE_GEN_SHUTTER_H
#define STAFFAGE_GEN_SHUTTER_H

#include "gen/moment.h"
#include "gen/scene/scene.h"
#include "gen/stage.h"
#include "gen/trace/trace.h"
#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* Out: motion  as motion_trace gives it, initialized here
 * In:  shot, one of the scene's; moment at its time; trace whose entities are the moment's, with a receiver for each
 * Err: ERR_INPUT, as moment_at; ERR_MEMORY */
bool shutter_motion(struct image *motion, const struct stage *stage, const struct scene_shot *shot,
                    const struct moment *moment, const struct trace_input *trace, const struct frame_labels *labels,
                    struct error *err);

#endif

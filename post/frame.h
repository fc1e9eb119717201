/* One frame of the dataset: from what gen and POV-Ray left in OUT/frames/FRAME to the
 * finished picture and its labels. */
#ifndef STAFFAGE_POST_FRAME_H
#define STAFFAGE_POST_FRAME_H

#include "lib/error.h"

#include <stdbool.h>

/* Write every output of a frame, rgb/FRAME.png last: where that is, the frame is whole.
 * In:  out, the output folder; frame, "000123"
 * Err: ERR_INPUT, ERR_RENDER, ERR_IO at the file that is at fault */
bool frame_post(const char *out, const char *frame, struct error *err);

#endif

/* One pass of one frame: POV-Ray as a child that is confined to the output folder. */
#ifndef STAFFAGE_RUN_PASS_H
#define STAFFAGE_RUN_PASS_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

struct pass {
    const char *stem;             /* "frames/000123/object", from the output folder */
    int width_px, height_px;
    char *const *options;         /* (n) more of POV-Ray's options */
    size_t option_count;
};

/* Render STEM.pov to STEM.exr (linear, half float, alpha), in the current folder, the output
 * folder. STEM.exr arrives whole or not at all; STEM.log stays only when the pass failed.
 * SIGINT, SIGTERM and SIGHUP end the child, then do what they do to this process.
 * Err: ERR_RENDER at STEM.pov (absolute) with POV-Ray's own words; ERR_IO */
bool pass_render(const struct pass *pass, struct error *err);

/* POV-Ray's own words from what it printed: the errors, one line. The caller frees; NULL
 * only when memory ends. */
char *pass_complaint(const char *log);

#endif

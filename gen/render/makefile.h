/* What `make` needs in the output folder to run the frames: OUT/Makefile, a copy of
 * the templates and POV-Ray's restrictions. The makefile holds relative paths only and is
 * run inside OUT, so OUT may have any name and may be moved.
 *
 * Targets: `render` the passes; `post` (= `all`) the pictures and labels, and the passes that
 * these still need; `frame-NNNNNN` the same of one frame, by a make of its own. A frame's passes
 * are made again when one of its .pov files, its passes.key or a template is newer; its pictures
 * and labels when a pass or frame.json is, or when one of them is missing.
 *
 * Programs come from the environment: STAFFAGE_POVRAY and STAFFAGE_POST, by default
 * staffage-povray and staffage-post from PATH. Each finished target prints one line,
 * `staffage: pass NNNNNN NAME` or `staffage: frame NNNNNN`. */
#ifndef STAFFAGE_GEN_MAKEFILE_H
#define STAFFAGE_GEN_MAKEFILE_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

enum { PASS_OBJECT, PASS_PLANE, PASS_SHADOW, PASS_COUNT };

/* "object", "plane", "shadow": the names of the .pov and .exr files. */
const char *pass_name(int pass);

struct makefile_frame {
    const char *name;                /* "000123": digits only; borrowed */
    bool empty;                      /* no passes */
    int width_px[PASS_COUNT], height_px[PASS_COUNT];
    const char *options[PASS_COUNT]; /* more POV-Ray options, e.g. "+AM2 +A0.05 +R2 -J": words of
                                      * letters, digits, '+', '-' and '.'; NULL for none; borrowed */
};

/* Write OUT/Makefile, OUT/templates/ (all *.inc of templates_folder) and
 * OUT/frames/home/.povray/3.7/povray.conf. Files that would not change are left alone.
 * POV-Ray can read nothing but OUT: scenes include templates by their bare name, and
 * everything else (meshes, textures) by a path relative to OUT.
 * Err: ERR_IO; ERR_BUG for a name or an option outside the sets above */
bool makefile_write(const char *out_folder, const char *templates_folder,
                    const struct makefile_frame *frames, size_t frame_count, struct error *err);

#endif

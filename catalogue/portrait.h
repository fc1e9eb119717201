/* Pictures of models under the clear sky: rendered as anything is that a scene puts into a photograph. */
#ifndef STAFFAGE_CATALOGUE_PORTRAIT_H
#define STAFFAGE_CATALOGUE_PORTRAIT_H

#include "gen/model/catalogue.h"
#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

/* One model from one side. */
enum side { SIDE_FRONT, SIDE_LEFT, SIDE_REAR, SIDE_ABOVE /* from the front, the left and above */, SIDE_COUNT };

struct sitter {
    const char *name, *file;     /* borrowed, as is what follows */
    struct model_options options; /* with unit and axes where the file does not state them; rules are not used */
    double size_m[3];            /* length, width, height */
    bool has_color;
    double color[3];             /* linear */
};

struct portraits { struct image *pictures; size_t count; }; /* (count) 8 bit sRGB, sitter by sitter, side by side */

struct portrait_options {
    int width_px;       /* of a picture; its height is 3/4 of it */
    bool quick;         /* rougher shadows and reflections, at half the cost */
    bool quiet;         /* do not show the renderer's progress */
};

/* Render each sitter from each side: write a scene, run `staffage`, which lies beside this program, and read what it made.
 * In:  folder     for working files; made, and removed when all went well
 * Out: portraits  free with portraits_release
 * Err: ERR_RENDER, ERR_IO, ERR_MEMORY */
bool portraits_make(struct portraits *portraits, const struct sitter *sitters, size_t n, const enum side *sides, size_t side_count,
                    const struct portrait_options *options, const char *folder, struct error *err);
void portraits_release(struct portraits *portraits);

#endif

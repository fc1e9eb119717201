/* What air and lens do to the rendered layers before they are merged into the photograph. */
#ifndef STAFFAGE_POST_OPTICS_H
#define STAFFAGE_POST_OPTICS_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/manifest.h"

#include <stdbool.h>

struct optics_input {                 /* all borrowed, of the view's window */
    const struct manifest *manifest;
    const struct image *photograph;   /* F32, 3 channels, linear */
    const struct image *depth;        /* F32, of the entities */
    const struct image *ground;       /* F32, of the ground; empty when it is not known */
    const struct image *motion;       /* F32, 3 channels; empty without motion */
    const struct image *visible, *receiver; /* U8, or NULL: nothing hides */
    double exposure[3];
    double too_soft_px2;              /* variance that the layers as rendered have too much */
};

/* Whether there is anything to do in this frame. */
bool optics_wanted(const struct manifest *manifest);

/* First, what the layers are too soft is taken back. Then motion blur, defocus and softness, then mist, for those that the manifest asks for. What nothing
 * reaches keeps every bit, and its ratio of shadow to plane is 1.
 * In/out: object, plane, shadow (F32 RGBA)
 * Err: ERR_MEMORY */
bool optics_apply(struct image *object, struct image *plane, struct image *shadow, const struct optics_input *in,
                  struct error *err);

#endif

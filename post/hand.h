/* The camera's hand: what lens, sensor and file did to the photograph, measured on it or given, for what
 * is put in. */
#ifndef STAFFAGE_POST_HAND_H
#define STAFFAGE_POST_HAND_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/manifest.h"
#include "post/blacks.h"
#include "post/compression.h"
#include "post/edge.h"
#include "post/grain.h"
#include "post/highlights.h"
#include "post/vignette.h"

#include <stdbool.h>

struct hand {
    /* what is done */
    double softness_px;
    double too_soft_px2;            /* variance that the layers as rendered have too much */
    double hider_px;                /* softness of what stands before the layers, besides the area of a pixel */
    double sharpening;
    bool has_grain;
    struct grain grain, drawn;      /* as the photograph has it; and before its file pressed it */
    double fall_off;                /* 0: none */
    double knee;                    /* 1: none */
    double black;                   /* level that comes out as 0; 0: none */
    struct compression compression; /* not found: none */
    /* what it was measured from, where it was */
    struct edges edges, layer_edges;
    struct vignette vignette;
    struct highlights highlights;
    struct blacks blacks;
};

/* In:  rgb (U8, 3 channels), of the manifest's size; path, the photograph's; object (F32 RGBA), as rendered
 * Err: ERR_MEMORY; ERR_INPUT at `path` */
bool hand_measure(struct hand *hand, const struct manifest *manifest, const struct image *rgb, const char *path,
                  const struct image *object, struct error *err);
/* camera.json of the frame's folder. Err: ERR_IO, ERR_MEMORY */
bool hand_write(const char *path, const struct hand *hand, const struct manifest *manifest, struct error *err);

/* File and sensor, over what the transfer made of the view's window: what changed there is given back to
 * the picture's 8 bits, and all else keeps every bit.
 * In/out: rgb (U8, 3 channels), the whole picture
 * In:  before, after (F32, 3 channels, linear): the window; object (F32 RGBA), visible (U8, or NULL) as for the
 *      transfer. Err: ERR_MEMORY */
bool hand_develop(struct image *rgb, const struct hand *hand, const struct manifest *manifest, const struct image *before,
                  const struct image *after, const struct image *object, const struct image *visible, struct error *err);

#endif

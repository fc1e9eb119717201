/* A photograph as the estimates look at it: reduced, in logarithms of linear light, so that a change of light is
 * the same difference on dark and bright ground. */
#ifndef STAFFAGE_GEN_TONES_H
#define STAFFAGE_GEN_TONES_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stdint.h>

struct tones {
    int width_px, height_px;   /* of working pixels */
    int reduction;             /* photograph pixels along a working pixel */
    float *ln;                 /* (height,width,3) of the mean light of 3x3 working pixels; owned */
    uint8_t *good;             /* (height,width) 1: nothing in it is clipped; owned */
};

/* In:  photograph (U8 or U16; 1, 3 or 4 channels, sRGB)
 * Err: ERR_MEMORY */
bool tones_of(struct tones *tones, const struct image *photograph, struct error *err);
void tones_release(struct tones *tones);

static inline const float *tones_at(const struct tones *t, int x, int y)
{
    return t->ln + ((size_t)y * (size_t)t->width_px + (size_t)x) * 3;
}
static inline bool tones_good(const struct tones *t, int x, int y)
{
    return t->good[(size_t)y * (size_t)t->width_px + (size_t)x];
}
/* The middle of a working pixel, in pixels of the photograph. */
static inline struct vec2 tones_photograph_px(const struct tones *t, int x, int y)
{
    return (struct vec2){ (x + 0.5) * t->reduction, (y + 0.5) * t->reduction };
}

#endif

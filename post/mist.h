/* Mist: with distance, things fade into the colour of the air. */
#ifndef STAFFAGE_POST_MIST_H
#define STAFFAGE_POST_MIST_H

#include "lib/camera.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/rect.h"

#include <stdbool.h>

struct mist {
    double visibility_m;   /* meteorological: where the contrast is 5 % */
    double haze[3];        /* A: colour of the air far away, linear values of the photograph */
    double exposure[3];    /* k: of the photograph */
};

/* Fade entities into the air, k O -> k O T + A (1 - T) alpha; and their light on the ground, of which the
 * photograph's air has none: the pixel B = J T + A (1 - T) with J r for J is B r + A (1 - T)(1 - r), so
 * light -> light d, where d = 1 - A (1 - T) / B, from 0 up, is the ground's own part of the pixel.
 * In/out: object, plane (F32 RGBA), light (as of ground_light_take), of the window
 * In:  photograph (F32, 3 channels), linear; entity, ground (F32): depth z, NaN where not known: there,
 *      that of the nearest pixel counts; all of the window.
 *      camera: distances are along its rays, window_px is where the layers lie in its picture
 * Err: ERR_MEMORY */
bool mist_fade(struct image *object, struct image *plane, struct image *light, const struct mist *mist,
               const struct image *photograph, const struct image *entity, const struct image *ground,
               const struct camera *camera, struct rect window_px, struct error *err);

/* A picture without mist, a new view of the place, as it is with it: J -> J T + A (1 - T), and A where
 * nothing is known to be.
 * In/out: rgb (U8, 3 channels, sRGB). In: ground (F32): depth z of all of the picture; haze: A */
void mist_veil(struct image *rgb, const struct image *ground, double visibility_m, const double haze[3],
               const struct camera *camera);

#endif

/* The grain of a photograph: how much noise its flat parts have at each brightness, in which colours,
 * and how alike neighbouring pixels' is; and the same for what is put in.
 *
 * Noise is of the 8-bit picture: after demosaicing, tone curve and compression. Colours are turned
 * into (R+G+B)/sqrt(3), (R-B)/sqrt(2), (R-2G+B)/sqrt(6): the first is the brightness. */
#ifndef STAFFAGE_POST_GRAIN_H
#define STAFFAGE_POST_GRAIN_H

#include "lib/draw.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/rect.h"
#include "post/compression.h"
#include "post/flat.h"

#include <stdbool.h>
#include <stddef.h>

#define GRAIN_LEVELS 16             /* of (R+G+B)/3: 0..15, 16..31, ... */
#define GRAIN_LAG_PX 3
#define GRAIN_LAGS (2 * GRAIN_LAG_PX + 1)

struct grain {
    size_t patches;                 /* that it was measured on; 0: none is flat enough, or it was given */
    bool seen[GRAIN_LEVELS];        /* measured there; the others follow their neighbours */
    double covariance[GRAIN_LEVELS][3][3]; /* of the three colours, in levels squared, without that of rounding */
    double correlation[3][GRAIN_LAGS][GRAIN_LAGS]; /* of each colour with itself [3+dy][3+dx] away; 1 in the middle */
};

/* The lower envelope of the patches' variances over brightness, since texture only adds to noise. Patches are chosen by one
 * half of their pixels and measured by the other, or the flattest of many would be flat by luck.
 * Src: after C. Liu, W. T. Freeman, R. Szeliski, S. B. Kang, Noise estimation from a single image, CVPR 2006
 * In:  patches, of `rgb` (U8, 3 channels). Err: ERR_MEMORY */
bool grain_measure(struct grain *grain, const struct image *rgb, const struct flat_patches *patches, struct error *err);
/* Make it what must be there before a file presses it, for as much to be left in even places: what has been pressed once passes nearly
 * as it is, but loses where it is less than the file's steps, and these add their own. Err: ERR_MEMORY */
bool grain_before_compression(struct grain *grain, const struct compression *compression, struct error *err);
/* White noise of this standard deviation (in levels) in each of R, G and B. */
struct grain grain_white(double sigma);
/* Standard deviation of R, G or B at a level. */
double grain_sigma(const struct grain *grain, double level, int channel);

/* Add grain to what covers the share a of a pixel: sqrt(1 - (1 - a)^2) of it, so that with the
 * photograph's own, which shines through to 1 - a, it is all.
 * In/out: levels (F32, 3 channels, 0..255), a window of the picture
 * In:  cover (F32, 1 channel): a; window_px, where that lies in a picture of this width: the same pixel
 *      draws the same number whatever the window; key: its entity and purpose are set here
 * Err: ERR_MEMORY */
bool grain_add(struct image *levels, const struct image *cover, const struct grain *grain, struct draw_key key,
               struct rect window_px, int width_px, struct error *err);

#endif

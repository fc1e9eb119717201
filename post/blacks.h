/* How a camera crushes its blacks: what would be level B of sRGB, or below, comes out as 0, and what lies between B and
 * the middle of the levels is spread from 0 to there. B = 0 crushes nothing. */
#ifndef STAFFAGE_POST_BLACKS_H
#define STAFFAGE_POST_BLACKS_H

#include "lib/image.h"

#include <stdbool.h>

struct blacks {
    double level;           /* B; 0 where nothing is told */
    double channel[3];      /* what R, G and B tell each: the values at 0, over those at a level next to it */
};

/* A picture whose values pile up at 0 has lost so many levels there as the levels just above could fill: at least
 * so many, for a place seldom has as many darker things as dark ones. Told where the median of the three channels is
 * 4 to 48: fewer may be chance, more is what was painted in (a clock). What is black round the picture is left out: bars, a fisheye's corners.
 * In:  rgb (U8, 3 channels) */
void blacks_measure(struct blacks *blacks, const struct image *rgb);

/* From a level of the light as it was to the camera's, 0 to 255, and back: back, a 0 becomes B. */
double blacks_crush(double black, double level);
double blacks_lift(double black, double level);

/* A photograph's light as it was. In/out: linear (F32, 3 channels). In: rgb (U8, 3 channels), the same in levels */
void blacks_lift_image(struct image *linear, const struct image *rgb, double black);

#endif

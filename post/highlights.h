/* How a camera keeps its highlights: up to a knee K light is as it is, and beyond it comes nearer and nearer
 * to white: K + (1 - K) (1 - exp(-(x - K) / (1 - K))). K = 1 clips. */
#ifndef STAFFAGE_POST_HIGHLIGHTS_H
#define STAFFAGE_POST_HIGHLIGHTS_H

#include "lib/image.h"

#include <stdbool.h>

struct highlights {
    double knee;            /* linear */
    double exponent;        /* of the light in the place: so much of it is brighter than x as x^-exponent */
    double bright;          /* share of the picture's values above 0.7 that is above 0.9: without any, nothing can be told */
    double misfit;          /* the most by which the cumulated histogram differs from that of such light */
    bool told;              /* else the place is not of such light, and the knee says nothing */
};

/* The knee that makes the picture's histogram that of light which falls off evenly.
 * In:  rgb (U8, 3 channels) */
void highlights_measure(struct highlights *highlights, const struct image *rgb);

double highlights_of(double knee, double light);
/* In/out: object (F32 RGBA premultiplied); exposure, of its channels */
void highlights_keep(struct image *object, double knee, const double exposure[3]);

#endif

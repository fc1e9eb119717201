/* The step of light that an edge is, as a lens shows it. */
#ifndef STAFFAGE_POST_STEP_H
#define STAFFAGE_POST_STEP_H

#include "lib/image.h"

#include <stdbool.h>

#define STEP_SHARPENING_PX 1.0 /* standard deviation of the Gaussian whose difference to a picture a camera adds to it */
#define STEP_WIDE_PX 8.0       /* the farthest that is looked at across an edge; so far at least it must be from the picture's border */

/* With t = x cos + y sin - at, from the middle of a pixel, and Phi the normal distribution: low + (high - low) * (Phi(t / sigma) +
 * sharpening * (Phi(t / sigma) - Phi(t / sqrt(sigma^2 + STEP_SHARPENING_PX^2)))). */
struct step {
    double low, high, at_px, angle, sigma_px, sharpening;
    double sigma_error_px, sharpening_error; /* standard deviations, of what differs from the model as a function of t */
    double misfit;                           /* root of the mean square, in the step's height */
    double beside;                           /* by how much the light just beyond is other than the step's, in its height */
};

/* Fit it, by Gauss and Newton. As long a piece is looked at as is needed for its slant to sample it finer than a pixel, as in
 * ISO 12233. Returns false where the light is no such step, or one too blurred for the window.
 * In:  light (F32, 1 channel); sharpened: its sharpening is fitted, and else 0 */
bool step_fit(struct step *step, const struct image *light, int x, int y, double angle, double across_px, bool sharpened);

/* The direction in which the light changes. Returns false where it changes in many. */
bool step_direction(double *angle, const struct image *light, int x, int y);

/* By how much the light differs from one side to the other, so far from the edge. */
double step_contrast(const struct image *light, int x, int y, double angle, double across_px);

#endif

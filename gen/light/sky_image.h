/* A sky as image of radiances: equirectangular, row 0 looks up (+z), the last row down; column 0 begins at
 * +x and columns turn towards +y. Twice as wide as high, and of even height: the horizon is an edge of rows. */
#ifndef STAFFAGE_GEN_SKY_IMAGE_H
#define STAFFAGE_GEN_SKY_IMAGE_H

#include "lib/image.h"
#include "lib/luminance.h"
#include "lib/vec.h"

#include <math.h>

static inline double sky_row_top(const struct image *sky, int row) { return M_PI / 2 - row * M_PI / sky->height_px; }

/* Radiance from a direction: 3 channels of the pixel that it lies in. */
static inline const float *sky_radiance(const struct image *sky, struct vec3 d)
{
    double turn = atan2(d.y, d.x) / (2 * M_PI);
    int column = (int)((turn - floor(turn)) * sky->width_px) % sky->width_px;
    int row = (int)((0.5 - asin(fmin(1, fmax(-1, d.z))) / M_PI) * sky->height_px);
    return image_f32(sky, column, row < sky->height_px ? row : sky->height_px - 1);
}

/* A pixel's middle. */
static inline struct vec3 sky_direction(const struct image *sky, int column, int row)
{
    double elevation = sky_row_top(sky, row) - M_PI / sky->height_px / 2;
    double turn = (column + 0.5) / sky->width_px * 2 * M_PI;
    return vec3(cos(elevation) * cos(turn), cos(elevation) * sin(turn), sin(elevation));
}

static inline double sky_solid_angle(const struct image *sky, int row)
{
    return (sin(sky_row_top(sky, row)) - sin(sky_row_top(sky, row + 1))) * 2 * M_PI / sky->width_px;
}

/* Cosine-weighted solid angle / pi of a pixel for a level surface: over the upper half it sums to 1. */
static inline double sky_level_weight(const struct image *sky, int row)
{
    double top = sin(sky_row_top(sky, row)), bottom = sin(sky_row_top(sky, row + 1));
    return (top * top - bottom * bottom) / sky->width_px;
}

static inline double sky_pixel_luminance(const struct image *sky, int column, int row)
{
    const float *p = image_f32(sky, column, row);
    return luminance_of((double[3]){ (double)p[0], (double)p[1], (double)p[2] });
}

#endif

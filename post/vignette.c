#include "post/vignette.h"

#include <math.h>

#define PATCHES_MIN 40      /* in a quarter */
#define VARIANCE_MAX 30.0   /* of a patch, levels squared: more is texture, whose slope says nothing */
#define SLOPE_MAX 0.004     /* of the logarithm of light, in a pixel: more is an edge, or a round thing */
#define STEPS 181           /* of fall_off from -0.1 to 0.8 */

/* Slope of the logarithm of light away from the middle, in units of 1 / (half a diagonal), and where. */
static bool slope_of(double *slope, double *r, int *quarter, const struct flat_patch *p, int width_px, int height_px)
{
    double half = hypot(width_px, height_px) / 2;
    double x = p->x + FLAT_SIDE_PX / 2.0 - width_px / 2.0, y = p->y + FLAT_SIDE_PX / 2.0 - height_px / 2.0, away = hypot(x, y);
    float level = (float)p->level / 255, light = linear_from_srgb(level);
    double change = (double)(linear_from_srgb(level + 0.002f) - linear_from_srgb(level - 0.002f)) / (0.004 * 255) / (double)light;
    if (away < 0.1 * half || flat_patch_variance(p) > VARIANCE_MAX || hypot(p->right, p->down) * change > SLOPE_MAX) return false;
    *slope = change * (p->right * x + p->down * y) / away * half;
    *r = away / half;
    bool sideways = fabs(x) * height_px > fabs(y) * width_px;
    *quarter = sideways ? (x > 0 ? 0 : 2) : (y > 0 ? 1 : 3);
    return true;
}

static double fall_off_of_step(int step)
{
    return -0.1 + 0.005 * step;
}

void vignette_measure(struct vignette *vignette, const struct flat_patches *patches, int width_px, int height_px)
{
    double off[4][STEPS] = { 0 };
    size_t count[4] = { 0 };
    *vignette = (struct vignette){ .agree = true };
    for (size_t i = 0; i < patches->count; i++) {
        double slope, r;
        int quarter;
        if (!slope_of(&slope, &r, &quarter, &patches->patch[i], width_px, height_px)) continue;
        count[quarter]++;
        /* Absolute differences, so that what is not even everywhere does not count by its size. */
        for (int s = 0; s < STEPS; s++) {
            double v = fall_off_of_step(s);
            off[quarter][s] += r * fabs(slope + 2 * v * r / (1 - v * r * r));
        }
    }
    double least = INFINITY, most = -INFINITY, sum = 0;
    for (int q = 0; q < 4; q++) {
        int best = 0;
        for (int s = 0; s < STEPS; s++)
            if (off[q][s] < off[q][best]) best = s;
        double v = vignette->quarter[q] = fall_off_of_step(best);
        least = fmin(least, v);
        most = fmax(most, v);
        sum += v;
        vignette->patches += count[q];
        vignette->agree = vignette->agree && count[q] >= PATCHES_MIN;
    }
    vignette->fall_off = (sum - least - most) / 2; /* the median */
    vignette->agree = vignette->agree && vignette->fall_off > 0 && most - least < 0.05 + vignette->fall_off / 2;
}

double vignette_at(double fall_off, struct vec2 q, int width_px, int height_px)
{
    double x = 2 * q.x - width_px, y = 2 * q.y - height_px;
    return 1 - fall_off * (x * x + y * y) / ((double)width_px * width_px + (double)height_px * height_px);
}

void vignette_shade(struct image *object, double fall_off, struct vec2 fitted_px, struct rect window, int width_px, int height_px)
{
    double there = vignette_at(fall_off, fitted_px, width_px, height_px);
    for (int y = 0; y < object->height_px; y++)
        for (int x = 0; x < object->width_px; x++) {
            float *px = image_f32(object, x, y);
            struct vec2 q = { window.x0 + x + 0.5, window.y0 + y + 0.5 };
            float by = (float)(vignette_at(fall_off, q, width_px, height_px) / there);
            for (int c = 0; c < 3; c++) px[c] *= by;
        }
}

#include "post/highlights.h"

#include <math.h>

#define FIRST_LEVEL 150     /* 0.30: what is darker says little of the highlights */
#define VALUES_MIN 2000.0
#define BRIGHT_MIN 0.05
#define MISFIT_MAX 0.04

double highlights_of(double knee, double light)
{
    if (light <= knee) return light;
    return knee < 1 ? knee + (1 - knee) * -expm1(-(light - knee) / (1 - knee)) : 1;
}

static double light_of(double knee, double value)
{
    if (value <= knee) return value;
    return knee < 1 ? knee - (1 - knee) * log1p(-(value - knee) / (1 - knee)) : INFINITY;
}

/* Share of the values that are above the upper end of a level. In: first, the light that they begin with */
static double share_above(int level, double knee, double exponent, double first)
{
    return level < 255 ? pow(light_of(knee, (double)linear_from_srgb(((float)level + 0.5f) / 255)) / first, -exponent) : 0;
}

static double first_light(double knee)
{
    return light_of(knee, (double)linear_from_srgb((FIRST_LEVEL - 0.5f) / 255));
}

/* The most by which the two cumulated histograms differ. */
static double misfit(const double count[256], double all, double knee, double exponent)
{
    double most = 0, below = 0;
    for (int level = FIRST_LEVEL; level < 255; level++) {
        below += count[level] / all;
        most = fmax(most, fabs(1 - below - share_above(level, knee, exponent, first_light(knee))));
    }
    return most;
}

static double likelihood(const double count[256], double knee, double exponent)
{
    double sum = 0, first = first_light(knee), above = 1;
    for (int level = FIRST_LEVEL; level < 256; level++) {
        double next = share_above(level, knee, exponent, first);
        /* A part per million for what the model cannot know. */
        sum += count[level] * log(fmax(above - next, 0) + 1e-6);
        above = next;
    }
    return sum;
}

void highlights_measure(struct highlights *highlights, const struct image *rgb)
{
    double count[256] = { 0 }, all = 0, bright = 0, shining = 0, best = -INFINITY;
    const uint8_t *px = rgb->data;
    size_t n = 3 * (size_t)rgb->width_px * (size_t)rgb->height_px;
    for (size_t i = 0; i < n; i++) count[px[i]]++;
    for (int level = FIRST_LEVEL; level < 256; level++) {
        float light = linear_from_srgb((float)level / 255);
        all += count[level];
        bright += light > 0.7f ? count[level] : 0;
        shining += light > 0.9f ? count[level] : 0;
    }
    *highlights = (struct highlights){ .knee = 1, .bright = bright > 0 ? shining / bright : 0 };
    bool enough = all >= VALUES_MIN && bright >= VALUES_MIN / 4 && highlights->bright >= BRIGHT_MIN;
    for (int k = 0; enough && k <= 35; k++)
        for (int e = 1; e <= 60; e++) {
            double knee = 0.3 + 0.02 * k, exponent = 0.1 * e, l = likelihood(count, knee, exponent);
            if (!(l > best)) continue;
            best = l;
            highlights->knee = knee;
            highlights->exponent = exponent;
        }
    highlights->misfit = enough ? misfit(count, all, highlights->knee, highlights->exponent) : 1;
    highlights->told = highlights->misfit < MISFIT_MAX;
}

void highlights_keep(struct image *object, double knee, const double exposure[3])
{
    size_t n = (size_t)object->width_px * (size_t)object->height_px;
    float *px = object->data;
    for (size_t i = 0; i < n; i++, px += 4)
        for (int c = 0; c < 3 && px[3] > 0; c++) {
            double scale = exposure[c] / (double)px[3], light = (double)px[c] * scale;
            if (light > knee) px[c] = (float)(highlights_of(knee, light) / scale);
        }
}

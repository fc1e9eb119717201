#include "post/blacks.h"

#include <stdlib.h>

#define MIDDLE 128.0        /* from here on light is as it is: exposures are fitted to what is about as bright */
#define BESIDE 16           /* levels next to 0 */
#define PILE_MIN 1e-3       /* of a channel's values */
#define TOLD_MIN 4.0
#define TOLD_MAX 48.0

static bool is_black(const uint8_t *px) { return px[0] <= BESIDE && px[1] <= BESIDE && px[2] <= BESIDE; }

/* The part of a row between the first and the last pixel that show anything: a picture may have black bars, and a
 * fisheye's is a circle in black. */
static void without_surround(int *from, int *to, const struct image *rgb, int y)
{
    for (*from = 0; *from < rgb->width_px && is_black(image_u8(rgb, *from, y)); ++*from) continue;
    for (*to = rgb->width_px; *to > *from && is_black(image_u8(rgb, *to - 1, y)); --*to) continue;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void blacks_measure(struct blacks *blacks, const struct image *rgb)
{
    size_t count[3][BESIDE + 1] = { { 0 } }, n = 0;
    for (int y = 0, from, to; y < rgb->height_px; y++) {
        without_surround(&from, &to, rgb, y);
        n += (size_t)(to - from);
        for (int x = from; x < to; x++)
            for (int c = 0; c < 3; c++) {
                uint8_t level = image_u8(rgb, x, y)[c];
                if (level <= BESIDE) count[c][level]++;
            }
    }
    *blacks = (struct blacks){ 0 };
    double sorted[3];
    for (int c = 0; c < 3; c++) {
        double beside = 0;
        for (int level = 1; level <= BESIDE; level++) beside += (double)count[c][level] / BESIDE;
        if ((double)count[c][0] > PILE_MIN * (double)n) blacks->channel[c] = (double)count[c][0] / (beside + 1);
        sorted[c] = blacks->channel[c];
    }
    qsort(sorted, 3, sizeof *sorted, ascending);
    if (sorted[1] >= TOLD_MIN && sorted[1] <= TOLD_MAX) blacks->level = sorted[1];
}

double blacks_crush(double black, double level)
{
    if (level >= MIDDLE) return level;
    return level > black ? (level - black) * MIDDLE / (MIDDLE - black) : 0;
}

double blacks_lift(double black, double level)
{
    return level < MIDDLE ? black + level * (MIDDLE - black) / MIDDLE : level;
}

void blacks_lift_image(struct image *linear, const struct image *rgb, double black)
{
    float light[256];
    for (int i = 0; i < 256; i++) light[i] = linear_from_srgb((float)blacks_lift(black, i) / 255);
    size_t n = 3 * (size_t)rgb->width_px * (size_t)rgb->height_px;
    for (size_t i = 0; i < n; i++) ((float *)linear->data)[i] = light[((const uint8_t *)rgb->data)[i]];
}

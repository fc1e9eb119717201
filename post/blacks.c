#include "post/blacks.h"

#include "lib/rect.h"

#include <stdlib.h>

#define MIDDLE 128.0        /* from here on light is as it is: exposures are fitted to what is about as bright */
#define BESIDE 16           /* levels next to 0 */
#define PILE_MIN 1e-3       /* of a channel's values */
#define TOLD_MIN 4.0
#define TOLD_MAX 48.0

/* Rows from the first to the last that show anything: a picture may have black bars. Columns likewise. */
static struct rect without_bars(const struct image *rgb)
{
    struct rect r = { rgb->width_px, rgb->height_px, 0, 0 };
    for (int y = 0; y < rgb->height_px; y++) {
        const uint8_t *px = image_u8(rgb, 0, y);
        for (int x = 0; x < rgb->width_px; x++, px += 3) {
            if (px[0] <= BESIDE && px[1] <= BESIDE && px[2] <= BESIDE) continue;
            if (x < r.x0) r.x0 = x;
            if (x >= r.x1) r.x1 = x + 1;
            if (y < r.y0) r.y0 = y;
            r.y1 = y + 1;
        }
    }
    return r;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void blacks_measure(struct blacks *blacks, const struct image *rgb)
{
    size_t count[3][BESIDE + 1] = { { 0 } }, n = 0;
    struct rect r = without_bars(rgb);
    for (int y = r.y0; y < r.y1; y++)
        for (int x = r.x0; x < r.x1; x++, n++)
            for (int c = 0; c < 3; c++) {
                uint8_t level = image_u8(rgb, x, y)[c];
                if (level <= BESIDE) count[c][level]++;
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

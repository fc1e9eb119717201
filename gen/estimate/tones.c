#include "gen/estimate/tones.h"

#include <math.h>
#include <stdlib.h>

/* Working pixels across: a person's shadow is wide enough, and grain and lens blur are gone. */
#define WORKING_WIDTH 600
/* What is darker than this says more of the camera than of the light. */
#define BLACK 0.002f

/* Mean linear light of a box; false where a part of it is clipped. */
static bool box_mean(float rgb[3], const struct image *linear, int x0, int y0, int size)
{
    bool good = true;
    double sum[3] = { 0 };
    for (int y = y0; y < y0 + size; y++)
        for (int x = x0; x < x0 + size; x++) {
            const float *p = image_f32(linear, x, y);
            good = good && p[0] < 1 && p[1] < 1 && p[2] < 1;
            for (int c = 0; c < 3; c++) sum[c] += (double)p[c];
        }
    for (int c = 0; c < 3; c++) rgb[c] = (float)(sum[c] / (size * size));
    return good && rgb[0] > BLACK && rgb[1] > BLACK && rgb[2] > BLACK;
}

static void smooth(struct tones *t, const float *mean, const uint8_t *good)
{
    int w = t->width_px, h = t->height_px;
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            double sum[3] = { 0 };
            int n = 0;
            bool all = true;
            for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < h; v++)
                for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < w; u++, n++) {
                    size_t i = (size_t)v * (size_t)w + (size_t)u;
                    all = all && good[i];
                    for (size_t c = 0; c < 3; c++) sum[c] += (double)mean[3 * i + c];
                }
            size_t at = (size_t)y * (size_t)w + (size_t)x;
            t->good[at] = all;
            for (size_t c = 0; c < 3; c++) t->ln[3 * at + c] = logf(fmaxf((float)(sum[c] / n), BLACK / 2));
        }
}

bool tones_of(struct tones *tones, const struct image *photograph, struct error *err)
{
    struct image linear;
    if (!image_linear_from_srgb(&linear, photograph, err)) return false;
    int reduction = photograph->width_px / WORKING_WIDTH;
    if (reduction < 1) reduction = 1;
    struct tones t = { photograph->width_px / reduction, photograph->height_px / reduction, reduction, NULL, NULL };
    size_t n = (size_t)t.width_px * (size_t)t.height_px;
    float *mean = malloc(3 * n * sizeof *mean + 1);
    uint8_t *good = malloc(n + 1);
    t.ln = malloc(3 * n * sizeof *t.ln + 1);
    t.good = malloc(n + 1);
    bool ok = mean && good && t.ln && t.good;
    if (ok) {
        for (int y = 0; y < t.height_px; y++)
            for (int x = 0; x < t.width_px; x++) {
                size_t i = (size_t)y * (size_t)t.width_px + (size_t)x;
                good[i] = box_mean(mean + 3 * i, &linear, x * reduction, y * reduction, reduction);
            }
        smooth(&t, mean, good);
    }
    free(mean);
    free(good);
    image_release(&linear);
    if (ok) {
        *tones = t;
        return true;
    }
    tones_release(&t);
    return error_set(err, ERR_MEMORY, "no memory for a photograph of %d x %d pixels", photograph->width_px, photograph->height_px);
}

void tones_release(struct tones *tones)
{
    free(tones->ln);
    free(tones->good);
    *tones = (struct tones){ 0 };
}

#include "compare_hand.h"

#include "post/edge.h"

#include <math.h>
#include <stdlib.h>

enum { OUTLINE_PX = 2, INSIDE_PX = 1, BANDS = 8, BAND_PIXELS_MIN = 1000 };

static double luma_of(double r, double g, double b) { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }

static double luma_srgb(const struct image *srgb, int x, int y)
{
    const uint8_t *p = image_u8(srgb, x, y);
    return luma_of(p[0], p[1], p[2]);
}

static double luma_light(const struct image *light, int x, int y)
{
    double v[3];
    for (int c = 0; c < 3; c++) v[c] = 255 * (double)srgb_from_linear(fminf(fmaxf(image_f32(light, x, y)[c], 0), 1));
    return luma_of(v[0], v[1], v[2]);
}

static bool inside(const struct image *owner, int x, int y)
{
    uint8_t id = *image_u8(owner, x, y);
    if (!id || x < INSIDE_PX || y < INSIDE_PX || x >= owner->width_px - INSIDE_PX || y >= owner->height_px - INSIDE_PX) return false;
    for (int v = y - INSIDE_PX; v <= y + INSIDE_PX; v++)
        for (int u = x - INSIDE_PX; u <= x + INSIDE_PX; u++)
            if (*image_u8(owner, u, v) != id) return false;
    return true;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, size_t n)
{
    qsort(values, n, sizeof *values, ascending);
    return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

/* By brightness, what sensor and file added: to the truth's light, and to the tool's picture without. */
static void compare_grain(struct comparison *to, const struct picture_input *in)
{
    static const double rounding = 0.2126 * 0.2126 / 12 + 0.7152 * 0.7152 / 12 + 0.0722 * 0.0722 / 12; /* of the picture without */
    double n[BANDS] = { 0 }, truth[BANDS] = { 0 }, ours[BANDS] = { 0 }, ratios[BANDS];
    size_t bands = 0;
    for (int y = 0; y < in->owner.height_px; y++)
        for (int x = 0; x < in->owner.width_px; x++) {
            if (!inside(&in->owner, x, y)) continue;
            double clean = luma_light(&in->truth_light, x, y);
            int band = (int)(clean * BANDS / 256);
            n[band]++;
            truth[band] += pow(luma_srgb(&in->truth, x, y) - clean, 2);
            ours[band] += pow(luma_srgb(&in->result, x, y) - luma_srgb(&in->plain, x, y), 2);
        }
    for (size_t b = 0; b < BANDS; b++) {
        if (n[b] < BAND_PIXELS_MIN) continue;
        double ratio = ratios[bands++] = sqrt(fmax(ours[b] / n[b] - rounding, 0) / (truth[b] / n[b]));
        if (bands == 1 || fabs(log(ratio)) > fabs(log(to->grain_worst))) to->grain_worst = ratio;
    }
    if (bands) to->grain = median(ratios, bands);
}

static bool compare_edges(struct comparison *to, const struct picture_input *in, struct error *err)
{
    struct image near;
    size_t edges;
    if (!image_init(&near, in->owner.width_px, in->owner.height_px, 1, PIXEL_U8, err)) return false;
    for (int y = OUTLINE_PX; y < near.height_px - OUTLINE_PX; y++)
        for (int x = OUTLINE_PX; x < near.width_px - OUTLINE_PX; x++)
            for (int k = 0; k < (2 * OUTLINE_PX + 1) * (2 * OUTLINE_PX + 1); k++)
                if (*image_u8(&in->owner, x + k % (2 * OUTLINE_PX + 1) - OUTLINE_PX, y + k / (2 * OUTLINE_PX + 1) - OUTLINE_PX))
                    *image_u8(&near, x, y) = 1;
    bool ok = edges_compare(&to->edge_width, &edges, &in->result, &in->truth, &near, err);
    if (ok) to->edges = (double)edges;
    image_release(&near);
    return ok;
}

bool compare_hand(struct comparison *to, const struct picture_input *in, struct error *err)
{
    to->edges = to->edge_width = to->grain = to->grain_worst = NAN;
    if (!in->plain.data) return true;
    compare_grain(to, in);
    return compare_edges(to, in, err);
}

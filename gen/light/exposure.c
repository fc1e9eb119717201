#include "gen/light/exposure.h"

#include "lib/luminance.h"

#include <stdlib.h>

#define SATURATED_SHARE_MAX 0.01
#define SPREAD_MAX 4.0
#define SAMPLES_MIN 20

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Of sorted values; the mean of the two middle ones of an even count. */
static double median(const double *sorted, size_t n)
{
    return (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
}

struct exposure exposure_given(const double k[3], int width_px, int height_px)
{
    return (struct exposure){ .k = { k[0], k[1], k[2] }, .at_px = { width_px / 2.0, height_px / 2.0 } };
}

static bool check_radiance(const double ground_radiance[3], struct error *err)
{
    for (int c = 0; c < 3; c++)
        if (!(ground_radiance[c] > 0))
            return error_set(err, ERR_INPUT, "the rendered ground has no radiance (%g %g %g): no exposure can be fitted to it",
                             ground_radiance[0], ground_radiance[1], ground_radiance[2]);
    return true;
}

static bool is_saturated(const uint8_t *px)
{
    return px[0] == 255 || px[1] == 255 || px[2] == 255;
}

/* Linear values of pixels, to be sorted: (4,n) R, G, B, luminance. */
struct values { double *value; size_t n; double of_level[256]; };

static bool values_init(struct values *v, size_t n, struct error *err)
{
    v->n = n;
    v->value = malloc(4 * n * sizeof *v->value);
    for (int i = 0; i < 256; i++) v->of_level[i] = (double)linear_from_srgb((float)i / 255);
    return v->value || error_set(err, ERR_MEMORY, "no memory for %zu pixels to fit an exposure to", n);
}

static void values_set(struct values *v, size_t i, const uint8_t *px)
{
    double rgb[3] = { v->of_level[px[0]], v->of_level[px[1]], v->of_level[px[2]] };
    for (size_t c = 0; c < 3; c++) v->value[c * v->n + i] = rgb[c];
    v->value[3 * v->n + i] = luminance_of(rgb);
}

/* The medians of the first `used` pixels, and k from them; the values are sorted after. */
static struct exposure fit(struct values *v, size_t used, const double ground_radiance[3], bool white_balance)
{
    struct exposure e = { .fitted = true };
    for (size_t c = 0; c < 4; c++) qsort(v->value + c * v->n, used, sizeof *v->value, compare);
    double bright = median(v->value + 3 * v->n, used);
    for (size_t c = 0; c < 3; c++) {
        e.median[c] = median(v->value + c * v->n, used);
        e.k[c] = white_balance ? e.median[c] / ground_radiance[c] : bright / luminance_of(ground_radiance);
    }
    return e;
}

static bool is_black(const struct exposure *e)
{
    return !(e->k[0] > 0 && e->k[1] > 0 && e->k[2] > 0);
}

bool exposure_fit(struct exposure *exposure, const struct image *photograph, struct rect p,
                  const double ground_radiance[3], bool white_balance, struct error *err)
{
    if (rect_is_empty(p) || p.x0 < 0 || p.y0 < 0 || p.x1 > photograph->width_px || p.y1 > photograph->height_px)
        return error_set(err, ERR_INPUT, "exposure patch %d,%d to %d,%d: lies outside the picture of %d x %d pixels, or is empty",
                         p.x0, p.y0, p.x1, p.y1, photograph->width_px, photograph->height_px);
    struct values values;
    size_t n = rect_area(p), saturated = 0, at = 0;
    if (!check_radiance(ground_radiance, err) || !values_init(&values, n, err)) return false;
    for (int y = p.y0; y < p.y1; y++)
        for (int x = p.x0; x < p.x1; x++) {
            const uint8_t *px = image_u8(photograph, x, y);
            saturated += is_saturated(px);
            values_set(&values, at++, px);
        }
    struct exposure e = fit(&values, n, ground_radiance, white_balance);
    const double *bright = values.value + 3 * n;
    double low = bright[n / 10], high = bright[n - 1 - n / 10], share = (double)saturated / (double)n;
    e.patch_px = p;
    e.at_px = (struct vec2){ (p.x0 + p.x1) / 2.0, (p.y0 + p.y1) / 2.0 };
    free(values.value);

    const char *advice = "choose a patch of evenly lit ground";
    if (share > SATURATED_SHARE_MAX)
        return error_set(err, ERR_INPUT, "exposure patch %d,%d to %d,%d: %.1f %% of it is saturated: %s, or give the exposure",
                         p.x0, p.y0, p.x1, p.y1, 100 * share, advice);
    if (is_black(&e))
        return error_set(err, ERR_INPUT, "exposure patch %d,%d to %d,%d: is black: %s, or give the exposure",
                         p.x0, p.y0, p.x1, p.y1, advice);
    if (high > SPREAD_MAX * low)
        return error_set(err, ERR_INPUT, "exposure patch %d,%d to %d,%d: its bright parts are %.1f times as bright as its dark ones: %s",
                         p.x0, p.y0, p.x1, p.y1, high / (low > 1e-4 ? low : 1e-4), advice);
    *exposure = e;
    return true;
}

bool exposure_fit_samples(struct exposure *exposure, const struct image *photograph, const struct vec2 *sample_px,
                          size_t n, const double ground_radiance[3], bool white_balance, struct error *err)
{
    struct values values;
    struct vec2 mean = { 0, 0 };
    size_t used = 0;
    if (!check_radiance(ground_radiance, err) || !values_init(&values, n + 1, err)) return false;
    for (size_t i = 0; i < n; i++) {
        struct vec2 q = sample_px[i];
        if (!(q.x >= 0 && q.y >= 0 && q.x < photograph->width_px && q.y < photograph->height_px)) continue;
        const uint8_t *px = image_u8(photograph, (int)q.x, (int)q.y);
        if (is_saturated(px)) continue;
        values_set(&values, used++, px);
        mean = (struct vec2){ mean.x + (q.x - mean.x) / (double)used, mean.y + (q.y - mean.y) / (double)used };
    }
    struct exposure e = { 0 };
    if (used >= SAMPLES_MIN) e = fit(&values, used, ground_radiance, white_balance);
    e.samples = used;
    e.at_px = mean;
    free(values.value);
    if (used < SAMPLES_MIN)
        return error_set(err, ERR_INPUT, "%zu of %zu pixels of sunlit ground are in the picture and not saturated, at least %d "
                         "are needed: give an exposure patch, or the exposure", used, n, SAMPLES_MIN);
    if (is_black(&e))
        return error_set(err, ERR_INPUT, "most of %zu pixels of sunlit ground are black: give an exposure patch, or the exposure", used);
    *exposure = e;
    return true;
}

bool exposure_clear(struct exposure *exposure, double transmission, const double haze[3],
                    const double ground_radiance[3], bool white_balance, struct error *err)
{
    double own[3];
    for (int c = 0; c < 3; c++) {
        own[c] = (exposure->median[c] - haze[c] * (1 - transmission)) / transmission;
        if (!(own[c] > 0))
            return error_set(err, ERR_INPUT, "the ground that the exposure is fitted to is darker than the haze before it: "
                             "weather.haze is too bright, or weather.visibility_m too short");
    }
    for (int c = 0; c < 3; c++)
        exposure->k[c] = white_balance ? own[c] / ground_radiance[c] : luminance_of(own) / luminance_of(ground_radiance);
    return true;
}

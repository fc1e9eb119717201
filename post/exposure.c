#include "post/exposure.h"

#include "lib/file.h"
#include "post/window.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#define SATURATED_SHARE_MAX 0.01
#define SPREAD_MAX 4.0

/* Rec.709 */
static const double luminance_weight[3] = { 0.2126, 0.7152, 0.0722 };

static double luminance(const double v[3])
{
    return luminance_weight[0] * v[0] + luminance_weight[1] * v[1] + luminance_weight[2] * v[2];
}

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

struct exposure exposure_given(double k)
{
    return (struct exposure){ .k = { k, k, k } };
}

bool exposure_fit(struct exposure *exposure, const struct image *photograph, struct rect p,
                  const double ground_radiance[3], bool white_balance, struct error *err)
{
    if (!window_inside(p, photograph->width_px, photograph->height_px))
        return error_set(err, ERR_INPUT, "exposure patch %d,%d to %d,%d: lies outside the picture of %d x %d pixels, or is empty",
                         p.x0, p.y0, p.x1, p.y1, photograph->width_px, photograph->height_px);
    for (int c = 0; c < 3; c++)
        if (!(ground_radiance[c] > 0))
            return error_set(err, ERR_INPUT, "the rendered ground has no radiance (%g %g %g): no exposure can be fitted to it",
                             ground_radiance[0], ground_radiance[1], ground_radiance[2]);

    double of_level[256];
    for (int i = 0; i < 256; i++) of_level[i] = (double)linear_from_srgb((float)i / 255);
    size_t n = (size_t)(p.x1 - p.x0) * (size_t)(p.y1 - p.y0), saturated = 0, at = 0;
    double *values = malloc(4 * n * sizeof *values), *bright = values + 3 * n; /* R, G, B, luminance */
    if (!values) return error_set(err, ERR_MEMORY, "no memory for an exposure patch of %zu pixels", n);
    for (int y = p.y0; y < p.y1; y++)
        for (int x = p.x0; x < p.x1; x++, at++) {
            const uint8_t *px = image_u8(photograph, x, y);
            saturated += px[0] == 255 || px[1] == 255 || px[2] == 255;
            double rgb[3] = { of_level[px[0]], of_level[px[1]], of_level[px[2]] };
            for (size_t c = 0; c < 3; c++) values[c * n + at] = rgb[c];
            bright[at] = luminance(rgb);
        }
    for (size_t c = 0; c < 4; c++) qsort(values + c * n, n, sizeof *values, compare);

    struct exposure e = { .fitted = true, .patch_px = p };
    for (size_t c = 0; c < 3; c++) e.median[c] = median(values + c * n, n);
    double low = bright[n / 10], high = bright[n - 1 - n / 10], share = (double)saturated / (double)n;
    for (size_t c = 0; c < 3; c++)
        e.k[c] = white_balance ? e.median[c] / ground_radiance[c] : median(bright, n) / luminance(ground_radiance);
    free(values);

    const char *advice = "choose a patch of evenly lit ground";
    if (share > SATURATED_SHARE_MAX)
        return error_set(err, ERR_INPUT, "exposure patch %d,%d to %d,%d: %.1f %% of it is saturated: %s, or give the exposure",
                         p.x0, p.y0, p.x1, p.y1, 100 * share, advice);
    if (!(e.k[0] > 0 && e.k[1] > 0 && e.k[2] > 0))
        return error_set(err, ERR_INPUT, "exposure patch %d,%d to %d,%d: is black: %s, or give the exposure",
                         p.x0, p.y0, p.x1, p.y1, advice);
    if (high > SPREAD_MAX * low)
        return error_set(err, ERR_INPUT, "exposure patch %d,%d to %d,%d: its bright parts are %.1f times as bright as its dark ones: %s",
                         p.x0, p.y0, p.x1, p.y1, high / (low > 1e-4 ? low : 1e-4), advice);
    *exposure = e;
    return true;
}

bool exposure_write(const char *path, const struct exposure *e, struct error *err)
{
    json_t *json = json_pack("{s:[f,f,f], s:b}", "exposure", e->k[0], e->k[1], e->k[2], "fitted", (int)e->fitted);
    if (json && e->fitted) {
        const struct rect *p = &e->patch_px;
        json_object_set_new(json, "patch_px", json_pack("[i,i,i,i]", p->x0, p->y0, p->x1, p->y1));
        json_object_set_new(json, "patch_median_linear", json_pack("[f,f,f]", e->median[0], e->median[1], e->median[2]));
    }
    char *text = json ? json_dumps(json, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) : NULL;
    bool ok = text ? file_write(path, text, strlen(text), err) : error_set(err, ERR_MEMORY, "no memory for %s", path);
    free(text);
    json_decref(json);
    return ok;
}

#include "gen/trace/polygon.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool polygon_init(struct polygon *polygon, const struct vec2 *points_px, size_t count)
{
    double *scratch = malloc((count + 1) * sizeof *scratch);
    if (!scratch) return false;
    *polygon = (struct polygon){ points_px, count, scratch };
    return true;
}

void polygon_release(struct polygon *polygon)
{
    free(polygon->crossings_px);
    *polygon = (struct polygon){ 0 };
}

static int clamp_px(double x, int high)
{
    return x <= 0 ? 0 : x >= high ? high : (int)x;
}

struct rect polygon_bounds(const struct polygon *polygon, int width_px, int height_px)
{
    double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    for (size_t i = 0; i < polygon->count; i++) {
        x0 = fmin(x0, polygon->points_px[i].x);
        y0 = fmin(y0, polygon->points_px[i].y);
        x1 = fmax(x1, polygon->points_px[i].x);
        y1 = fmax(y1, polygon->points_px[i].y);
    }
    struct rect r = { clamp_px(floor(x0), width_px), clamp_px(floor(y0), height_px), clamp_px(ceil(x1), width_px),
                      clamp_px(ceil(y1), height_px) };
    return r.x0 < r.x1 && r.y0 < r.y1 ? r : (struct rect){ 0, 0, 0, 0 };
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Where the horizontal line at y enters and leaves: an even number of x, ascending. */
static size_t crossings(const struct polygon *polygon, double y)
{
    size_t n = 0;
    for (size_t i = 0; i < polygon->count; i++) {
        struct vec2 a = polygon->points_px[i], b = polygon->points_px[i + 1 < polygon->count ? i + 1 : 0];
        if ((a.y <= y) == (b.y <= y)) continue;
        polygon->crossings_px[n++] = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
    }
    qsort(polygon->crossings_px, n, sizeof *polygon->crossings_px, ascending);
    return n;
}

/* The first k >= 0 with x0 + (k + 0.5) * step >= x, at most n. */
static int first_from(double x, int x0, double step, int n)
{
    double k = ceil((x - x0) / step - 0.5);
    return k <= 0 ? 0 : k >= n ? n : (int)k;
}

void polygon_row_centres(const struct polygon *polygon, bool *inside, int y, int x0, int x1)
{
    int n = x1 - x0;
    memset(inside, 0, (size_t)n * sizeof *inside);
    size_t count = crossings(polygon, y + 0.5);
    for (size_t c = 0; c + 1 < count; c += 2) {
        int to = first_from(polygon->crossings_px[c + 1], x0, 1, n);
        for (int k = first_from(polygon->crossings_px[c], x0, 1, n); k < to; k++) inside[k] = true;
    }
}

void polygon_row_samples(const struct polygon *polygon, uint64_t *samples, int y, int x0, int x1)
{
    int n = 8 * (x1 - x0);
    memset(samples, 0, (size_t)(x1 - x0) * sizeof *samples);
    for (int j = 0; j < 8; j++) {
        size_t count = crossings(polygon, y + (j + 0.5) / 8);
        for (size_t c = 0; c + 1 < count; c += 2) {
            int to = first_from(polygon->crossings_px[c + 1], x0, 1.0 / 8, n);
            for (int k = first_from(polygon->crossings_px[c], x0, 1.0 / 8, n); k < to; k++)
                samples[k / 8] |= (uint64_t)1 << (8 * j + k % 8);
        }
    }
}

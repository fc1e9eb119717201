#include "post/grain.h"

#include <math.h>
#include <stdlib.h>

#define REACH_PX 4 /* of the filter that makes neighbours alike */
#define SIDE_PX (2 * REACH_PX + 1)
#define PERIOD_PX 16
#define LEVEL_STEP (256.0 / GRAIN_LEVELS)

typedef float filter[SIDE_PX][SIDE_PX];

/* A filter whose own autocorrelation is that of the grain: its response is the square root of the
 * grain's spectrum, without what the cut-off of the lags makes negative. */
static void make_filter(filter f, const double correlation[GRAIN_LAGS][GRAIN_LAGS])
{
    static const int lag = GRAIN_LAG_PX;
    const double turn = 2 * M_PI / PERIOD_PX;
    double response[PERIOD_PX][PERIOD_PX], energy = 0;
    for (int v = 0; v < PERIOD_PX; v++)
        for (int u = 0; u < PERIOD_PX; u++) {
            double power = 0;
            for (int dy = -lag; dy <= lag; dy++)
                for (int dx = -lag; dx <= lag; dx++) power += correlation[lag + dy][lag + dx] * cos(turn * (u * dx + v * dy));
            response[v][u] = sqrt(fmax(power, 0));
        }
    for (int y = -REACH_PX; y <= REACH_PX; y++)
        for (int x = -REACH_PX; x <= REACH_PX; x++) {
            double sum = 0;
            for (int v = 0; v < PERIOD_PX; v++)
                for (int u = 0; u < PERIOD_PX; u++) sum += response[v][u] * cos(turn * (u * x + v * y));
            f[y + REACH_PX][x + REACH_PX] = (float)sum;
            energy += sum * sum;
        }
    for (int i = 0; i < SIDE_PX * SIDE_PX; i++) f[i / SIDE_PX][i % SIDE_PX] /= (float)sqrt(energy);
}

/* Which part of three independent draws each colour gets at a brightness: l l^T is its covariance. */
static void factor(double l[3][3], const struct grain *grain, double level)
{
    double at = fmin(fmax(level / LEVEL_STEP - 0.5, 0), GRAIN_LEVELS - 1), t = at - (int)at;
    int low = (int)at, high = low < GRAIN_LEVELS - 1 ? low + 1 : low;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j <= i; j++) {
            double v = (1 - t) * grain->covariance[low][i][j] + t * grain->covariance[high][i][j];
            for (int k = 0; k < j; k++) v -= l[i][k] * l[j][k];
            if (j == i) l[i][j] = sqrt(fmax(v, 0));
            else l[i][j] = l[j][j] > 1e-6 ? v / l[j][j] : 0;
        }
}

struct adding {
    filter filters[3];
    const struct grain *grain;
    float *white[3];    /* draws for the window and REACH_PX round it, NaN where not yet drawn */
    int stride;
    struct draw_key key;
    struct rect window_px;
    int width_px;
};

static float white_at(struct adding *a, int color, int x, int y)
{
    float *w = &a->white[color][(size_t)(y + REACH_PX) * (size_t)a->stride + (size_t)(x + REACH_PX)];
    if (isnan(*w)) {
        int64_t pixel = ((int64_t)a->window_px.y0 + y + REACH_PX) * (a->width_px + 2 * REACH_PX) + a->window_px.x0 + x + REACH_PX;
        a->key.entity = (uint32_t)color;
        *w = (float)draw_normal(a->key, (uint32_t)pixel);
    }
    return *w;
}

static double filtered(struct adding *a, int color, int x, int y)
{
    float sum = 0;
    for (int dy = -REACH_PX; dy <= REACH_PX; dy++)
        for (int dx = -REACH_PX; dx <= REACH_PX; dx++) {
            float w = a->filters[color][dy + REACH_PX][dx + REACH_PX];
            if (fabsf(w) > 1e-4f) sum += w * white_at(a, color, x + dx, y + dy);
        }
    return (double)sum;
}

static void add_at(float *px, struct adding *a, double amount, int x, int y)
{
    double l[3][3], drawn[3], colors[3];
    factor(l, a->grain, (double)(px[0] + px[1] + px[2]) / 3);
    for (int c = 0; c < 3; c++) drawn[c] = filtered(a, c, x, y);
    for (int c = 0; c < 3; c++) {
        colors[c] = 0;
        for (int k = 0; k <= c; k++) colors[c] += l[c][k] * drawn[k];
    }
    /* The three colours are orthonormal: their transpose leads back. */
    static const double back[3][3] = {
        { 0.5773502691896258, 0.7071067811865476, 0.4082482904638630 },
        { 0.5773502691896258, 0, -0.8164965809277260 },
        { 0.5773502691896258, -0.7071067811865476, 0.4082482904638630 },
    };
    for (int c = 0; c < 3; c++)
        px[c] += (float)(amount * (back[c][0] * colors[0] + back[c][1] * colors[1] + back[c][2] * colors[2]));
}

bool grain_add(struct image *levels, const struct image *cover, const struct grain *grain, struct draw_key key,
               struct rect window_px, int width_px, struct error *err)
{
    int w = levels->width_px, h = levels->height_px;
    size_t n = (size_t)(w + 2 * REACH_PX) * (size_t)(h + 2 * REACH_PX);
    struct adding a = { .grain = grain, .stride = w + 2 * REACH_PX, .key = key, .window_px = window_px, .width_px = width_px };
    float *white = malloc(3 * n * sizeof *white);
    if (!white) return error_set(err, ERR_MEMORY, "no memory for grain");
    for (size_t i = 0; i < 3 * n; i++) white[i] = NAN;
    for (int c = 0; c < 3; c++) {
        a.white[c] = white + (size_t)c * n;
        make_filter(a.filters[c], grain->correlation[c]);
    }
    a.key.purpose = DRAW_GRAIN;
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            double share = (double)*image_f32(cover, x, y);
            if (share > 0) add_at(image_f32(levels, x, y), &a, sqrt(1 - (1 - share) * (1 - share)), x, y);
        }
    free(white);
    return true;
}

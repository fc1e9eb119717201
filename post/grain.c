#include "post/grain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LEVEL_STEP (256.0 / GRAIN_LEVELS)
#define PATCHES_MIN 12    /* at a level, to tell anything about it */
#define PATCHES_USED 160  /* at a level; more tell nothing new */
#define FLATTEST 0.005    /* this share of the halves of patches at a level tells how much noise there may be, */
#define FLATTEST_MIN 12   /* as few as that */
#define FLATTEST_MAX 160  /* and no more */
#define SPREAD 0.15       /* relative standard deviation of a patch's variance where there is noise alone, which
                           * neighbours share: 0.09 for 253 independent pixels */
#define VARIANCE_MIN 0.01 /* below, rounding hides what there is */
#define DARKER 128.0      /* levels down which a camera's noise at most doubles: of light it grows as the root, and the tone curve */
#define BRIGHTER 512.0    /* makes that nearly even, or less up to the bright. And levels up which it does; */
#define SHADOWS 64        /* but a curve that presses what is darker than this presses its noise with it */

typedef double colors[3];

static const double opponent[3][3] = {
    { 0.5773502691896258, 0.5773502691896258, 0.5773502691896258 },
    { 0.7071067811865476, 0, -0.7071067811865476 },
    { 0.4082482904638630, -0.8164965809277260, 0.4082482904638630 },
};

/* --- measuring --- */

static int by_variance(const void *a, const void *b)
{
    const struct flat_patch *p = *(const struct flat_patch *const *)a, *q = *(const struct flat_patch *const *)b;
    double v = flat_patch_variance(p), w = flat_patch_variance(q);
    if (v != w) return v < w ? -1 : 1;
    return p < q ? -1 : p > q;
}

/* Variance of one half of a patch, and of the other. */
struct half { double variance, other; };

static int by_half(const void *a, const void *b)
{
    const struct half *p = a, *q = b;
    if (p->variance != q->variance) return p->variance < q->variance ? -1 : 1;
    return (p->other > q->other) - (p->other < q->other);
}

static int by_other(const void *a, const void *b)
{
    double x = ((const struct half *)a)->other, y = ((const struct half *)b)->other;
    return (x > y) - (x < y);
}

static int level_of(const struct flat_patch *p)
{
    int level = (int)(p->level / LEVEL_STEP);
    return level < GRAIN_LEVELS ? level : GRAIN_LEVELS - 1;
}

/* Sums over patches that show noise alone. */
struct sums { double covariance[3][3], product[3][GRAIN_LAGS][GRAIN_LAGS]; size_t patches; };

/* Take constant, slopes and curvatures of light out of a patch, which are the place's. */
static void flatten(colors v[FLAT_SIDE_PX * FLAT_SIDE_PX])
{
    enum { SHAPES = 6, SIDE = FLAT_SIDE_PX };
    const double middle = (SIDE - 1) / 2.0, square = (SIDE * SIDE - 1) / 12.0; /* mean of the squared distances */
    for (int s = 0; s < SHAPES; s++) {
        double shape[SIDE * SIDE], norm = 0, along[3] = { 0 };
        for (int i = 0; i < SIDE * SIDE; i++) {
            double x = i % SIDE - middle, y = i / SIDE - middle;
            shape[i] = s == 0 ? 1 : s == 1 ? x : s == 2 ? y : s == 3 ? x * y : s == 4 ? x * x - square : y * y - square;
            norm += shape[i] * shape[i];
            for (int c = 0; c < 3; c++) along[c] += v[i][c] * shape[i];
        }
        for (int i = 0; i < SIDE * SIDE; i++)
            for (int c = 0; c < 3; c++) v[i][c] -= along[c] / norm * shape[i];
    }
}

static void residual(colors out[FLAT_SIDE_PX * FLAT_SIDE_PX], const struct image *rgb, const struct flat_patch *p)
{
    for (int i = 0; i < FLAT_SIDE_PX * FLAT_SIDE_PX; i++) {
        const uint8_t *px = image_u8(rgb, p->x + i % FLAT_SIDE_PX, p->y + i / FLAT_SIDE_PX);
        for (int c = 0; c < 3; c++) out[i][c] = opponent[c][0] * px[0] + opponent[c][1] * px[1] + opponent[c][2] * px[2];
    }
    flatten(out);
}

static void add_patch(struct sums *s, const struct image *rgb, const struct flat_patch *p)
{
    const int side = FLAT_SIDE_PX, lag = GRAIN_LAG_PX;
    colors v[FLAT_SIDE_PX * FLAT_SIDE_PX];
    residual(v, rgb, p);
    s->patches++;
    for (int i = 0; i < side * side; i++)
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) s->covariance[a][b] += v[i][a] * v[i][b] / (side * side);
    for (int c = 0; c < 3; c++)
        for (int dy = 0; dy <= lag; dy++)
            for (int dx = -lag; dx <= lag; dx++) {
                double sum = 0;
                int x0 = dx < 0 ? -dx : 0, x1 = dx > 0 ? side - dx : side;
                for (int y = 0; y + dy < side; y++)
                    for (int x = x0; x < x1; x++) sum += v[y * side + x][c] * v[(y + dy) * side + x + dx][c];
                sum /= (side - dy) * (x1 - x0);
                s->product[c][lag + dy][lag + dx] += sum;
                if (dy > 0) s->product[c][lag - dy][lag - dx] += sum;
            }
}

/* The six shapes took noise with them: of what pixels share, nearly 6/n of all its products is missing from each;
 * less by what ends at a patch's edge, where these shapes are large (found with noise of known correlation).
 * Returns by how much the variance was too small. */
static double give_back(double product[GRAIN_LAGS][GRAIN_LAGS])
{
    enum { NEAR = 2 }; /* pixels over which nearly all is shared */
    const double lost = 4.2 / (FLAT_SIDE_PX * FLAT_SIDE_PX), lags = (2 * NEAR + 1) * (2 * NEAR + 1);
    double all = 0, before = product[GRAIN_LAG_PX][GRAIN_LAG_PX];
    for (int dy = -NEAR; dy <= NEAR; dy++)
        for (int dx = -NEAR; dx <= NEAR; dx++) all += product[GRAIN_LAG_PX + dy][GRAIN_LAG_PX + dx];
    double missing = fmax(lost * all / (1 - lost * lags), 0);
    for (int i = 0; i < GRAIN_LAGS * GRAIN_LAGS; i++) product[i / GRAIN_LAGS][i % GRAIN_LAGS] += missing;
    return before > 0 ? 1 + missing / before : 1;
}

/* The level's covariance, and its products in units of its variance. */
static void finish_level(double covariance[3][3], struct sums *s)
{
    const double rounding = 1.0 / 12;
    double grown[3], n = (double)s->patches;
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < GRAIN_LAGS * GRAIN_LAGS; i++) s->product[c][i / GRAIN_LAGS][i % GRAIN_LAGS] /= n;
        grown[c] = give_back(s->product[c]);
        double *middle = &s->product[c][GRAIN_LAG_PX][GRAIN_LAG_PX];
        *middle = fmax(*middle - rounding, 0);
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            covariance[a][b] = a == b ? s->product[a][GRAIN_LAG_PX][GRAIN_LAG_PX] : s->covariance[a][b] / n * sqrt(grown[a] * grown[b]);
}

/* Variance of a patch with noise alone: what is flat by luck in one half is hardly so in the other, what is flat because nothing
 * is there is so in both. In: n patches of one level; halves, room for 2 n */
static double envelope_of(const struct flat_patch **patches, size_t n, struct half *halves)
{
    for (size_t i = 0; i < 2 * n; i++)
        halves[i] = (struct half){ patches[i / 2]->variance[i % 2], patches[i / 2]->variance[1 - i % 2] };
    qsort(halves, 2 * n, sizeof *halves, by_half);
    size_t flattest = (size_t)fmin(fmax(2 * FLATTEST * (double)n, FLATTEST_MIN), FLATTEST_MAX);
    qsort(halves, flattest, sizeof *halves, by_other);
    return (halves[(flattest - 1) / 2].other + halves[flattest / 2].other) / 2;
}

/* Of the patches of one level, sorted by variance, use those that noise alone explains. */
static void measure_level(struct sums *sums, const struct image *rgb, const struct flat_patch **sorted, size_t n, struct half *halves)
{
    *sums = (struct sums){ .patches = 0 };
    if (n < PATCHES_MIN) return;
    double envelope = envelope_of(sorted, n, halves);
    size_t used = 0;
    while (used < n && flat_patch_variance(sorted[used]) <= envelope * (1 + 2 * SPREAD)) used++;
    size_t wanted = used < PATCHES_USED ? used : PATCHES_USED;
    for (size_t i = 0; i < wanted; i++) add_patch(sums, rgb, sorted[i * used / wanted]);
}

/* Of the brightness, from a pixel to the next. */
static double next_alike(const double product[GRAIN_LAGS][GRAIN_LAGS])
{
    const int m = GRAIN_LAG_PX;
    return product[m][m] > 0 ? (product[m][m + 1] + product[m + 1][m]) / 2 / product[m][m] : 1;
}

/* A camera's noise is as alike from pixel to pixel at every level; texture, more so, is added to it. So the
 * least alike quarter of the levels tells how the noise is, and elsewhere the noise is what differs as much
 * from a pixel to the next as it must. */
static void without_texture(struct grain *g, const struct sums sums[GRAIN_LEVELS])
{
    double alike[GRAIN_LEVELS], sorted[GRAIN_LEVELS], weight[3] = { 0 }, noise;
    int n = 0;
    for (int i = 0; i < GRAIN_LEVELS; i++) {
        alike[i] = next_alike(sums[i].product[0]);
        if (!g->seen[i] || g->covariance[i][0][0] < VARIANCE_MIN) continue;
        int k = n++;
        for (; k > 0 && sorted[k - 1] > alike[i]; k--) sorted[k] = sorted[k - 1];
        sorted[k] = alike[i];
    }
    noise = n > 0 ? sorted[n / 4] : 0;
    for (int i = 0; i < GRAIN_LEVELS; i++) {
        if (!g->seen[i] || g->covariance[i][0][0] < VARIANCE_MIN) continue;
        double scale = fmin((1 - alike[i]) / (1 - noise), 1);
        for (int c = 0; c < 3; c++) {
            double variance = g->covariance[i][c][c], share = (double)sums[i].patches;
            if (alike[i] > noise || variance < VARIANCE_MIN) continue;
            weight[c] += share;
            for (int k = 0; k < GRAIN_LAGS * GRAIN_LAGS; k++)
                g->correlation[c][k / GRAIN_LAGS][k % GRAIN_LAGS] += share * sums[i].product[c][k / GRAIN_LAGS][k % GRAIN_LAGS] / variance;
        }
        for (int k = 0; k < 9; k++) g->covariance[i][k / 3][k % 3] *= scale;
    }
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < GRAIN_LAGS * GRAIN_LAGS; k++)
            if (weight[c] > 0) g->correlation[c][k / GRAIN_LAGS][k % GRAIN_LAGS] /= weight[c];
        g->correlation[c][GRAIN_LAG_PX][GRAIN_LAG_PX] = 1;
    }
}

static double doubling(int from, int to) { return to > from && from * LEVEL_STEP >= SHADOWS ? BRIGHTER : DARKER; }

/* Where no flat patch is this bright, texture remains: noise grows only so fast with brightness. The darkest and
 * the brightest level, where there is no room for noise on one side, say nothing of the others. */
static void bound_by_neighbours(struct grain *g)
{
    double variance[GRAIN_LEVELS];
    for (int i = 0; i < GRAIN_LEVELS; i++) variance[i] = g->covariance[i][0][0];
    for (int i = 0; i < GRAIN_LEVELS; i++) {
        double most = variance[i];
        for (int j = 1; j < GRAIN_LEVELS - 1; j++)
            if (g->seen[j])
                most = fmin(most, fmax(variance[j], 0.02) * exp2(2 * abs(i - j) * LEVEL_STEP / doubling(j, i)));
        for (int k = 0; k < 9 && most < variance[i]; k++) g->covariance[i][k / 3][k % 3] *= most / variance[i];
    }
}

/* Levels that the photograph does not have: between those that it has. */
static void fill_levels(struct grain *g)
{
    for (int i = 0; i < GRAIN_LEVELS; i++) {
        int low = i, high = i;
        while (low >= 0 && !g->seen[low]) low--;
        while (high < GRAIN_LEVELS && !g->seen[high]) high++;
        if (low < 0) low = high;
        if (high == GRAIN_LEVELS) high = low;
        double t = high > low ? (double)(i - low) / (high - low) : 0;
        for (int k = 0; k < 9; k++)
            g->covariance[i][k / 3][k % 3] = (1 - t) * g->covariance[low][k / 3][k % 3] + t * g->covariance[high][k / 3][k % 3];
    }
}

bool grain_measure(struct grain *grain, const struct image *rgb, const struct flat_patches *patches, struct error *err)
{
    struct grain g = { .patches = 0 };
    struct sums sums[GRAIN_LEVELS];
    const struct flat_patch **sorted = malloc((patches->count + 1) * sizeof *sorted);
    struct half *halves = malloc((2 * patches->count + 1) * sizeof *halves);
    bool ok = (sorted && halves) || error_set(err, ERR_MEMORY, "no memory for the grain of a photograph");
    for (int level = 0; ok && level < GRAIN_LEVELS; level++) {
        size_t n = 0;
        for (size_t i = 0; i < patches->count; i++)
            if (level_of(&patches->patch[i]) == level) sorted[n++] = &patches->patch[i];
        qsort(sorted, n, sizeof *sorted, by_variance);
        measure_level(&sums[level], rgb, sorted, n, halves);
        g.seen[level] = sums[level].patches > 0;
        g.patches += sums[level].patches;
        if (g.seen[level]) finish_level(g.covariance[level], &sums[level]);
    }
    free(halves);
    free(sorted);
    if (g.patches > 0) {
        without_texture(&g, sums);
        bound_by_neighbours(&g);
        fill_levels(&g);
    }
    if (ok) *grain = g;
    return ok;
}

struct grain grain_white(double sigma)
{
    struct grain g = { .patches = 0 };
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < GRAIN_LEVELS; i++) g.covariance[i][c][c] = sigma * sigma;
        g.correlation[c][GRAIN_LAG_PX][GRAIN_LAG_PX] = 1;
    }
    return g;
}

/* Two levels next to a brightness, and the way from one to the other. */
static double between(int *low, int *high, double level)
{
    double at = fmin(fmax(level / LEVEL_STEP - 0.5, 0), GRAIN_LEVELS - 1);
    *low = (int)at;
    *high = *low < GRAIN_LEVELS - 1 ? *low + 1 : *low;
    return at - *low;
}

double grain_sigma(const struct grain *grain, double level, int channel)
{
    int low, high;
    double t = between(&low, &high, level), variance = 0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            variance += opponent[a][channel] * opponent[b][channel] *
                        ((1 - t) * grain->covariance[low][a][b] + t * grain->covariance[high][a][b]);
    return sqrt(fmax(variance, 0));
}

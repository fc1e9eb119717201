#include "post/grain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LEVEL_STEP (256.0 / GRAIN_LEVELS)
#define PATCHES_MIN 12    /* at a level, to tell anything about it */
#define PATCHES_USED 160  /* at a level; more tell nothing new */
#define FLATTEST 0.005    /* this share of the halves of patches at a level tells its noise, */
#define FLATTEST_MIN 12   /* as few as that, whose median has a standard deviation of 9 %, */
#define FLATTEST_MAX 160  /* and no more: 2 % */
#define SPREAD 0.15       /* relative standard deviation of a patch's variance where there is noise alone, which
                           * neighbours share: 0.09 for 253 independent pixels */
#define VARIANCE_MIN 0.01 /* below, rounding hides what there is */
#define ALIKE_MAX 0.95    /* noise from a pixel to the next: more is what rounding leaves of very little */
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

/* Half of a patch, and what the other half has. */
struct half { const struct flat_patch *patch; double variance, other; };

static int compare_halves(const void *a, const void *b)
{
    const struct half *p = a, *q = b;
    if (p->variance != q->variance) return p->variance < q->variance ? -1 : 1;
    return p->patch != q->patch ? (p->patch < q->patch ? -1 : 1) : (p->other > q->other) - (p->other < q->other);
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double variance_of(const struct flat_patch *p) { return (p->variance[0] + p->variance[1]) / 2; }

static int level_of(const struct flat_patch *p)
{
    int level = (int)(p->level / LEVEL_STEP);
    return level < GRAIN_LEVELS ? level : GRAIN_LEVELS - 1;
}

/* Sums over patches that show noise alone. */
struct sums {
    double covariance[3][3], product[3][GRAIN_LAGS][GRAIN_LAGS];
    double scale; /* these patches may be flatter than noise is: by that they are too small */
    size_t patches;
};

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
    double grown[3], n = (double)s->patches / s->scale;
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

/* Of noise alone: what is flat by luck in one half is not in the other, what is flat because nothing is there is in both. In: n sorted halves */
static double noise_in(const struct half *sorted, size_t n)
{
    double others[FLATTEST_MAX];
    size_t flattest = (size_t)fmin(fmax(FLATTEST * (double)n, FLATTEST_MIN), FLATTEST_MAX);
    for (size_t i = 0; i < flattest; i++) others[i] = sorted[i].other;
    qsort(others, flattest, sizeof *others, compare_doubles);
    return (others[(flattest - 1) / 2] + others[flattest / 2]) / 2;
}

/* Of the patches of one level, use those that noise alone explains. halves: room for two of each patch */
static void measure_level(struct sums *sums, const struct image *rgb, const struct flat_patches *patches, int level, struct half *halves)
{
    const struct flat_patch *end = patches->patch + patches->count;
    size_t n = 0, alone = 0, each, k = 0;
    double all = 0;
    *sums = (struct sums){ .patches = 0 };
    for (const struct flat_patch *p = patches->patch; p < end; p++)
        for (int h = 0; h < 2 && level_of(p) == level; h++) halves[n++] = (struct half){ p, p->variance[h], p->variance[1 - h] };
    if (n < 2 * PATCHES_MIN) return;
    qsort(halves, n, sizeof *halves, compare_halves);
    double noise = noise_in(halves, n), most = noise * (1 + 2 * SPREAD);
    for (const struct flat_patch *p = patches->patch; p < end; p++) alone += level_of(p) == level && variance_of(p) <= most;
    each = alone / PATCHES_USED + 1;
    for (const struct flat_patch *p = patches->patch; p < end; p++)
        if (level_of(p) == level && variance_of(p) <= most && k++ % each == 0) {
            add_patch(sums, rgb, p);
            all += variance_of(p);
        }
    sums->scale = all > 0 ? noise * (double)sums->patches / all : 1;
}

/* From a pixel to the next. */
static double next_alike(const double product[GRAIN_LAGS][GRAIN_LAGS])
{
    const int m = GRAIN_LAG_PX;
    return product[m][m] > 0 ? (product[m][m + 1] + product[m + 1][m]) / 2 / product[m][m] : 1;
}

/* Multiply variances, each colour's with its own. */
static void scale_level(double covariance[3][3], const double by[3])
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) covariance[a][b] *= sqrt(by[a] * by[b]);
}

/* A camera's noise is as alike from pixel to pixel at every level; texture, more so, is added to it. So the
 * least alike quarter of the levels tells how the noise of a colour is, and elsewhere the noise is what differs as much
 * from a pixel to the next as it must. Out: by, what variances are to be multiplied with */
static void without_texture(double by[GRAIN_LEVELS], struct grain *g, const struct sums sums[GRAIN_LEVELS], int color)
{
    double alike[GRAIN_LEVELS], sorted[GRAIN_LEVELS], weight = 0, (*correlation)[GRAIN_LAGS] = g->correlation[color];
    size_t n = 0;
    for (int i = 0; i < GRAIN_LEVELS; i++) {
        by[i] = 1;
        alike[i] = next_alike(sums[i].product[color]);
        if (g->seen[i] && g->covariance[i][color][color] >= VARIANCE_MIN) sorted[n++] = alike[i];
    }
    qsort(sorted, n, sizeof *sorted, compare_doubles);
    for (int i = 0; i < GRAIN_LEVELS; i++) {
        double variance = g->covariance[i][color][color], share = (double)sums[i].patches, noise = n > 0 ? sorted[n / 4] : 0;
        if (!g->seen[i] || variance < VARIANCE_MIN) continue;
        if (noise < ALIKE_MAX) by[i] = fmin(fmax((1 - alike[i]) / (1 - noise), 0), 1);
        if (alike[i] > noise) continue;
        weight += share;
        for (int k = 0; k < GRAIN_LAGS * GRAIN_LAGS; k++)
            correlation[k / GRAIN_LAGS][k % GRAIN_LAGS] += share * sums[i].product[color][k / GRAIN_LAGS][k % GRAIN_LAGS] / variance;
    }
    for (int k = 0; k < GRAIN_LAGS * GRAIN_LAGS && weight > 0; k++) correlation[k / GRAIN_LAGS][k % GRAIN_LAGS] /= weight;
    correlation[GRAIN_LAG_PX][GRAIN_LAG_PX] = 1;
}

static double doubling(int from, int to) { return to > from && from * LEVEL_STEP >= SHADOWS ? BRIGHTER : DARKER; }

/* Where no flat patch is this bright, texture remains: noise grows only so fast with brightness. The darkest and
 * the brightest level, where there is no room for noise on one side, say nothing of the others. In/out: by, as above */
static void bound_by_neighbours(double by[GRAIN_LEVELS], const struct grain *g, int color)
{
    double bounded[GRAIN_LEVELS];
    for (int i = 0; i < GRAIN_LEVELS; i++) {
        double variance = g->covariance[i][color][color] * by[i], most = variance;
        for (int j = 1; j < GRAIN_LEVELS - 1; j++)
            if (g->seen[j])
                most = fmin(most, fmax(g->covariance[j][color][color] * by[j], 0.02) * exp2(2 * abs(i - j) * LEVEL_STEP / doubling(j, i)));
        bounded[i] = most < variance ? by[i] * most / variance : by[i];
    }
    memcpy(by, bounded, sizeof bounded);
}

/* What is left of what was measured. */
static void keep_noise(struct grain *g, const struct sums sums[GRAIN_LEVELS])
{
    double by[3][GRAIN_LEVELS];
    for (int c = 0; c < 3; c++) {
        without_texture(by[c], g, sums, c);
        bound_by_neighbours(by[c], g, c);
    }
    for (int i = 0; i < GRAIN_LEVELS; i++) scale_level(g->covariance[i], (double[3]){ by[0][i], by[1][i], by[2][i] });
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
    struct half *halves = malloc((2 * patches->count + 1) * sizeof *halves);
    if (!halves) return error_set(err, ERR_MEMORY, "no memory for the grain of a photograph");
    for (int level = 0; level < GRAIN_LEVELS; level++) {
        measure_level(&sums[level], rgb, patches, level, halves);
        g.seen[level] = sums[level].patches > 0;
        g.patches += sums[level].patches;
        if (g.seen[level]) finish_level(g.covariance[level], &sums[level]);
    }
    free(halves);
    if (g.patches > 0) {
        keep_noise(&g, sums);
        fill_levels(&g);
    }
    *grain = g;
    return true;
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

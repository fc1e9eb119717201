#include "gen/estimate/shade.h"

#include <math.h>
#include <stdlib.h>

/* What shade can be, in ln: between nearly black and nearly lit; not bluer than any sky. */
#define DEEPEST -4.0
#define BLUEST 1.6
/* Of blue over red, green's share: what daylight's colours allow, and cameras make of them. */
#define GREEN_MIN 0.1
#define GREEN_MAX 0.75
/* As far as this, shadows of one photograph differ; what is less deep by more has sun in it. */
#define DEPTH_WIDTH 0.3
#define SHALLOW_WIDTH 0.2
#define BLUE_WIDTH 0.25
#define BIN 0.1
/* A cell with this share of the fullest one is full. */
#define FULL 0.4
enum { DEPTH_BINS = 40, BLUE_BINS = 18, PLACE_EDGES_MIN = 3, ROUNDS = 3 };

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median_of(double *v, size_t n)
{
    qsort(v, n, sizeof *v, ascending);
    return (v[(n - 1) / 2] + v[n / 2]) / 2;
}

/* Median of absolute differences, in standard deviations of a normal distribution. */
static double spread_of(double *v, size_t n, double median)
{
    for (size_t i = 0; i < n; i++) v[i] = fabs(v[i] - median);
    return 1.4826 * median_of(v, n);
}

static double blue_of(const struct shade_sample *s) { return (double)s->ln[2] - (double)s->ln[0]; }
static double depth_of(const struct shade_sample *s) { return (double)s->ln[1]; }

static bool can_be_shade(const struct shade_sample *s, double bluer)
{
    double blue = blue_of(s), green = (double)s->ln[1] - (double)s->ln[0];
    return blue > bluer && blue < BLUEST && depth_of(s) > DEEPEST && s->ln[2] < 0 && green > GREEN_MIN * blue && green < GREEN_MAX * blue;
}

/* How many are in a cell of depth and blueness and in its neighbours, each as much as daylight allows it. */
static void fill(double sum[DEPTH_BINS][BLUE_BINS], const struct shade_sample *s, size_t n, double bluer, const struct daylight_locus *locus)
{
    double count[DEPTH_BINS + 2][BLUE_BINS + 2] = { 0 };
    for (size_t i = 0; i < n; i++) {
        if (!can_be_shade(&s[i], bluer)) continue;
        int a = (int)(-depth_of(&s[i]) / BIN), b = (int)(blue_of(&s[i]) / BIN);
        if (a >= 0 && a < DEPTH_BINS && b >= 0 && b < BLUE_BINS)
            count[a + 1][b + 1] += daylight_locus_likelihood(locus, -(a + 0.5) * BIN, (b + 0.5) * BIN);
    }
    for (int a = 0; a < DEPTH_BINS; a++)
        for (int b = 0; b < BLUE_BINS; b++) {
            sum[a][b] = 0;
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 3; k++) sum[a][b] += count[a + i][b + k];
        }
}

/* Between leaves, and in penumbra, sun gets into the shade: such edges lie anywhere between light and shade, but none
 * is deeper than the shade itself. So, of the full cells, that of the deepest. */
static bool deepest(double *depth, double *blue, const struct shade_sample *s, size_t n, double bluer, const struct daylight_locus *locus)
{
    double sum[DEPTH_BINS][BLUE_BINS], most = 0, best = 0;
    fill(sum, s, n, bluer, locus);
    for (int a = 0; a < DEPTH_BINS; a++)
        for (int b = 0; b < BLUE_BINS; b++) most = fmax(most, sum[a][b]);
    for (int a = DEPTH_BINS - 1; a >= 0 && !(best > 0); a--)
        for (int b = 0; b < BLUE_BINS; b++) {
            /* The top of the first full row and those behind it. */
            for (int deeper = 0; deeper < 3 && a - deeper >= 0 && sum[a][b] > FULL * most; deeper++) {
                if (sum[a - deeper][b] <= best) continue;
                best = sum[a - deeper][b];
                *depth = -(a - deeper + 0.5) * BIN;
                *blue = (b + 0.5) * BIN;
            }
        }
    return most > 0;
}

static size_t take_members(bool *member, const struct shade_sample *s, size_t n, double bluer, double depth, double blue)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        double shallower = depth_of(&s[i]) - depth;
        member[i] = can_be_shade(&s[i], bluer) && shallower > -DEPTH_WIDTH && shallower < SHALLOW_WIDTH && fabs(blue_of(&s[i]) - blue) < BLUE_WIDTH;
        count += member[i];
    }
    return count;
}

static int by_place(const void *a, const void *b)
{
    const struct shade_sample *x = a, *y = b;
    return (x->place > y->place) - (x->place < y->place);
}

/* Every place counts alike: its edges are not independent of each other.
 * In: samples in the order of their places; scratch (2 n) */
static void measure(struct shade *shade, const struct shade_sample *s, const bool *member, size_t n, size_t least, double *scratch)
{
    double *values = scratch, *middle = scratch + n;
    for (size_t c = 0; c < 3; c++) {
        size_t places = 0;
        for (size_t i = 0, end; i < n; i = end) {
            size_t k = 0;
            for (end = i; end < n && s[end].place == s[i].place; end++)
                if (member[end]) values[k++] = (double)s[end].ln[c];
            if (k >= least) middle[places++] = median_of(values, k);
        }
        shade->places = places;
        if (!places) return;
        double median = median_of(middle, places), spread = spread_of(middle, places, median);
        shade->ratio[c] = exp(median);
        /* Of a median; half a grey level of the photograph is never known. */
        shade->sigma[c] = shade->ratio[c] * fmax(1.2533 * spread / sqrt((double)places), 0.01);
    }
}

/* In: samples in the order of their places */
static void count_surfaces(size_t places[SHADE_SURFACES], const struct shade_sample *s, const bool *member, size_t n)
{
    for (int surface = 0; surface < SHADE_SURFACES; surface++)
        for (size_t i = 0, end; i < n; i = end) {
            size_t k = 0;
            for (end = i; end < n && s[end].place == s[i].place; end++) k += member[end] && s[end].surface == surface;
            places[surface] += k >= PLACE_EDGES_MIN;
        }
}

bool shade_find(struct shade *shade, struct shade_sample *samples, size_t n, double bluer, const struct daylight_locus *locus,
                struct error *err)
{
    struct shade found = { 0 };
    double *scratch = malloc((2 * n + 2) * sizeof *scratch), depth = 0, blue = 0;
    bool *member = calloc(n + 1, sizeof *member);
    bool ok = scratch && member;
    if (ok && n) qsort(samples, n, sizeof *samples, by_place);
    if (ok && deepest(&depth, &blue, samples, n, bluer, locus)) {
        for (int round = 0; round < ROUNDS; round++) {
            size_t count = take_members(member, samples, n, bluer, depth, blue), k = 0;
            if (!count) break;
            found.edges = count;
            for (size_t i = 0; i < n; i++)
                if (member[i]) scratch[k++] = depth_of(&samples[i]);
            depth = median_of(scratch, k);
            k = 0;
            for (size_t i = 0; i < n; i++)
                if (member[i]) scratch[k++] = blue_of(&samples[i]);
            blue = median_of(scratch, k);
        }
        measure(&found, samples, member, n, PLACE_EDGES_MIN, scratch);
        size_t as_deep = 0;
        for (size_t i = 0; i < n; i++) as_deep += fabs(depth_of(&samples[i]) - depth) < DEPTH_WIDTH;
        found.share = (double)found.edges / (double)n;
        found.purity = (double)found.edges / fmax(1, (double)as_deep);
        found.likelihood = daylight_locus_likelihood(locus, depth, blue);
        count_surfaces(found.surface_places, samples, member, n);
    }
    free(member);
    free(scratch);
    if (!ok) return error_set(err, ERR_MEMORY, "no memory for %zu edges of shadows", n);
    *shade = found;
    return true;
}

bool shade_is(const struct shade *shade, const struct shade_sample *s)
{
    return shade->places && fabs(depth_of(s) - log(shade->ratio[1])) < DEPTH_WIDTH &&
           fabs(blue_of(s) - log(shade->ratio[2] / shade->ratio[0])) < BLUE_WIDTH;
}

bool shade_agrees(const struct shade *a, const struct shade *b)
{
    struct shade_sample other = { 0 };
    for (int c = 0; c < 3; c++) other.ln[c] = (float)log(b->ratio[c]);
    return b->places && shade_is(a, &other);
}

bool shade_of_marks(struct shade *shade, const struct shade_sample *samples, size_t n, struct error *err)
{
    struct shade found = { .edges = n, .share = 1, .purity = 1, .likelihood = 1 };
    double *scratch = malloc((2 * n + 2) * sizeof *scratch);
    bool *all = malloc(n * sizeof *all + 1);
    bool ok = scratch && all;
    if (ok) {
        for (size_t i = 0; i < n; i++) all[i] = true;
        measure(&found, samples, all, n, 1, scratch);
        *shade = found;
    }
    free(scratch);
    free(all);
    return ok || error_set(err, ERR_MEMORY, "no memory for %zu marked pairs", n);
}

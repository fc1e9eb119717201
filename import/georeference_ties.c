#include "import/georeference.h"

#include "import/svd.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* All triples of up to 50 ties are fewer. With half of the ties wrong, as many draws miss a good triple
 * of a flight about never; the number is set by wanting good ones far apart. */
#define DRAWS 20000
/* Beyond it, things stand visibly askew: 5 m in height over 100 m, and shadows beside the real ones. */
#define TURN_LIMIT_RAD (3 * 3.14159265358979323846 / 180)

static double squared_error(const struct similarity *s, const struct tie *tie)
{
    struct vec3 e = vec3_sub(tie->p_enu_m, similarity_apply(*s, tie->p_reconstruction));
    return vec3_dot(e, e);
}

/* ---- the search ---- */

struct search {
    const struct tie *ties;
    size_t n;
    double inlier_m2, best_cost;
    struct similarity best;
    bool found;
};

static void try_triple(struct search *search, const size_t triple[3])
{
    struct similarity s;
    if (!similarity_fit(&s, search->ties, triple, 3)) return;
    double cost = 0;
    for (size_t i = 0; i < search->n && (!search->found || cost < search->best_cost); i++)
        cost += fmin(squared_error(&s, &search->ties[i]), search->inlier_m2);
    if (search->found && cost >= search->best_cost) return;
    search->best = s;
    search->best_cost = cost;
    search->found = true;
}

/* Steele, Lea, Flood 2014 (SplitMix64). */
static size_t draw(uint64_t *state, size_t n)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (size_t)((z ^ z >> 31) % n);
}

static void search_triples(struct search *search)
{
    size_t n = search->n;
    if (n <= 50) {
        for (size_t i = 0; i < n; i++)
            for (size_t j = i + 1; j < n; j++)
                for (size_t k = j + 1; k < n; k++) try_triple(search, (size_t[]){ i, j, k });
        return;
    }
    uint64_t state = 1;
    for (int t = 0; t < DRAWS; t++) {
        size_t triple[3] = { draw(&state, n), draw(&state, n), draw(&state, n) };
        if (triple[0] != triple[1] && triple[0] != triple[2] && triple[1] != triple[2]) try_triple(search, triple);
    }
}

/* Inliers by the similarity, in order; returns how many. */
static size_t inliers_of(size_t *inliers, const struct search *search, const struct similarity *s)
{
    size_t count = 0;
    for (size_t i = 0; i < search->n; i++)
        if (squared_error(s, &search->ties[i]) <= search->inlier_m2) inliers[count++] = i;
    return count;
}

/* Least squares over the inliers, and the inliers again, until they are the same. */
static size_t refine(struct similarity *s, size_t *inliers, size_t *next, const struct search *search)
{
    size_t count = inliers_of(inliers, search, s);
    for (int round = 0; round < 20 && count >= 3; round++) {
        struct similarity better;
        if (!similarity_fit(&better, search->ties, inliers, count)) break;
        size_t next_count = inliers_of(next, search, &better);
        if (next_count < count) break; /* those at the rim would go one by one */
        *s = better;
        bool same = next_count == count && !memcmp(inliers, next, count * sizeof *inliers);
        memcpy(inliers, next, next_count * sizeof *inliers);
        count = next_count;
        if (same) break;
    }
    return count;
}

/* ---- what is refused ---- */

static bool refuse_contradiction(const struct search *search, size_t agreeing, double inlier_m, struct error *err)
{
    char names[600] = "";
    size_t used = 0, named = 0, bad = 0;
    for (size_t i = 0; i < search->n; i++) {
        double error_m = search->found ? sqrt(squared_error(&search->best, &search->ties[i])) : NAN;
        if (error_m <= inlier_m) continue;
        bad++;
        if (named == 8 || used > sizeof names - 150) continue;
        named++;
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%.100s", used ? ", " : "", search->ties[i].name);
        if (search->found) used += (size_t)snprintf(names + used, sizeof names - used, " (%.3g m off)", error_m);
    }
    if (bad > named) snprintf(names + used, sizeof names - used, " and %zu more", bad - named);
    return error_set(err, ERR_INPUT,
                     "the positions contradict each other: no more than %zu of %zu agree within %.3g m with the "
                     "reconstruction's shape, and it takes 3 and half of them. These do not: %s",
                     agreeing, search->n, inlier_m, names);
}

/* Beneath it, a length is arithmetic's noise. */
static double to_mm(double m) { return round(m * 1000) / 1000; }

/* How far the inliers lie apart, and how surely that settles the turns. Their spread is taken from the
 * reconstruction, which is the more precise: of positions in one line, noise makes a band. */
static bool refuse_line(const struct search *search, const struct similarity *s, const size_t *inliers, size_t count,
                        double inlier_m, struct error *err)
{
    struct vec3 mean = { 0 };
    for (size_t i = 0; i < count; i++)
        mean = vec3_add(mean, vec3_scale(search->ties[inliers[i]].p_reconstruction, 1 / (double)count));
    struct mat3 scatter = { { { 0 } } }, axes, same;
    double d[3], error_m2 = 0;
    for (size_t i = 0; i < count; i++) {
        struct vec3 p = vec3_scale(vec3_sub(search->ties[inliers[i]].p_reconstruction, mean), s->scale);
        double a[3] = { p.x, p.y, p.z };
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) scatter.m[r][c] += a[r] * a[c];
        error_m2 += squared_error(s, &search->ties[inliers[i]]);
    }
    svd3(&axes, d, &same, scatter);

    double low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) {
            struct vec3 p = vec3_sub(search->ties[inliers[i]].p_reconstruction, mean);
            double at_m = s->scale * vec3_dot(mat3_column(axes, k), p);
            low[k] = fmin(low[k], at_m);
            high[k] = fmax(high[k], at_m);
        }

    /* Seven numbers were fitted. The few residuals that are left say little of the noise: a position's
     * allowance, taken as three deviations, counts as one more. */
    double prior_m = inlier_m / 3, freedom = 3 * (double)count - 7;
    double noise_m = sqrt((error_m2 + prior_m * prior_m) / (freedom + 1));
    /* A turn by a radian about an axis moves the points by their distance from it. */
    double about_line = noise_m / sqrt(d[1] + d[2]), about_rest = noise_m / sqrt(d[0] + d[2]);
    bool one_point = !(about_rest <= TURN_LIMIT_RAD);
    if (!one_point && about_line <= TURN_LIMIT_RAD) return true;
    char uncertain[80] = "is not determined at all";
    double turn = one_point ? about_rest : about_line;
    if (turn < 1) snprintf(uncertain, sizeof uncertain, "is known to %.2g deg only", turn / TURN_LIMIT_RAD * 3);
    return error_set(err, ERR_INPUT,
                     "the positions lie %s: %zu of them spread over %.3g m along and %.3g m across, with a noise of "
                     "%.2g m, so the turn %s %s (3 deg are wanted). Fly a second line beside the first, or give "
                     "control points off it",
                     one_point ? "at one point" : "on one line", count, to_mm(high[0] - low[0]), to_mm(high[1] - low[1]), noise_m,
                     one_point ? "to north" : "about that line", uncertain);
}

bool georeference_ties(struct similarity *enu_from_reconstruction, struct tie_residual *residuals, double *rms_m,
                       const struct tie *ties, size_t n, double inlier_m, struct error *err)
{
    if (n < 3)
        return error_set(err, ERR_INPUT, "%zu position%s given%s%s%s%s: scale, turn and place take at least 3 that are not on one line",
                         n, n == 1 ? " is" : "s are", n ? ", " : "", n ? ties[0].name : "", n > 1 ? " and " : "",
                         n > 1 ? ties[1].name : "");
    if (!(inlier_m > 0) || !isfinite(inlier_m))
        return error_set(err, ERR_INPUT, "positions cannot agree within %.9g m; give a distance above 0", inlier_m);
    for (size_t i = 0; i < n; i++)
        if (!isfinite(vec3_norm(ties[i].p_reconstruction)) || !isfinite(vec3_norm(ties[i].p_enu_m)))
            return error_set(err, ERR_INPUT, "the position of %s is not finite", ties[i].name);

    size_t *inliers = malloc(n * sizeof *inliers), *next = malloc(n * sizeof *next);
    bool good = false;
    if (!inliers || !next) {
        error_set(err, ERR_MEMORY, "no memory for %zu positions", n);
        goto out;
    }
    struct search search = { .ties = ties, .n = n, .inlier_m2 = inlier_m * inlier_m };
    search_triples(&search);
    size_t count = search.found ? refine(&search.best, inliers, next, &search) : 0;
    if (count < 3 || 2 * count < n) {
        refuse_contradiction(&search, count, inlier_m, err);
        goto out;
    }
    if (!refuse_line(&search, &search.best, inliers, count, inlier_m, err)) goto out;

    double sum_m2 = 0;
    for (size_t i = 0; i < count; i++) sum_m2 += squared_error(&search.best, &ties[inliers[i]]);
    for (size_t i = 0; i < n; i++) {
        struct vec3 e = vec3_sub(ties[i].p_enu_m, similarity_apply(search.best, ties[i].p_reconstruction));
        residuals[i] = (struct tie_residual){
            .horizontal_m = hypot(e.x, e.y),
            .vertical_m = e.z,
            .inlier = vec3_dot(e, e) <= search.inlier_m2,
        };
    }
    *enu_from_reconstruction = search.best;
    *rms_m = sqrt(sum_m2 / (double)count);
    good = true;
out:
    free(inliers);
    free(next);
    return good;
}

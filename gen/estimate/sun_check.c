#include "gen/estimate/sun_check.h"

#include <math.h>
#include <stdlib.h>

#define DEG (180 / M_PI)
/* Looked at: these steps about the sun, and as many finer ones about the best. */
enum { STEPS = 8, PARTS = 6, EDGES_MAX = 3000 };
#define COARSE_DEG 2.0
#define FINE_DEG 0.4
#define NEAR_M 0.3
#define FAR_M 1000

static struct vec3 turned(struct vec3 sun, double azimuth_deg, double elevation_deg)
{
    double azimuth = atan2(sun.x, sun.y) + azimuth_deg / DEG, elevation = asin(fmin(1, sun.z)) + elevation_deg / DEG;
    return vec3(cos(elevation) * sin(azimuth), cos(elevation) * cos(azimuth), sin(elevation));
}

/* Of every so many edges: those told right, less those told the wrong way round. */
static double agreement(const struct static_mesh *mesh, struct vec3 sun, const struct shadow_sides *s, size_t n, size_t step)
{
    long sum = 0;
    size_t count = 0;
    if (sun.z < 0.02) return -1;
    for (size_t i = 0; i < n; i += step, count++)
        sum += static_mesh_blocks(mesh, s[i].shade_m, sun, NEAR_M, FAR_M) - static_mesh_blocks(mesh, s[i].lit_m, sun, NEAR_M, FAR_M);
    return count ? (double)sum / (double)count : 0;
}

struct grid { double about[2], step; double score[2 * STEPS + 1][2 * STEPS + 1]; };

static void fill(struct grid *g, const struct static_mesh *mesh, struct vec3 sun, const struct shadow_sides *s, size_t n, size_t step)
{
    for (int a = -STEPS; a <= STEPS; a++)
        for (int e = -STEPS; e <= STEPS; e++)
            g->score[a + STEPS][e + STEPS] =
                agreement(mesh, turned(sun, g->about[0] + a * g->step, g->about[1] + e * g->step), s, n, step);
}

/* The middle of what is nearly as good as the best. */
static void peak(double at[2], double *best, const struct grid *g)
{
    double top = -1, low = 1, sum = 0, mean[2] = { 0 };
    for (int a = 0; a <= 2 * STEPS; a++)
        for (int e = 0; e <= 2 * STEPS; e++) {
            top = fmax(top, g->score[a][e]);
            low = fmin(low, g->score[a][e]);
        }
    for (int a = 0; a <= 2 * STEPS; a++)
        for (int e = 0; e <= 2 * STEPS; e++) {
            double weight = fmax(0, g->score[a][e] - (top - 0.1 * (top - low)));
            sum += weight;
            mean[0] += weight * (a - STEPS);
            mean[1] += weight * (e - STEPS);
        }
    for (int k = 0; k < 2; k++) at[k] = g->about[k] + (sum > 0 ? mean[k] / sum : 0) * g->step;
    *best = top;
}

static void search(double at[2], double *best, const struct static_mesh *mesh, struct vec3 sun, const struct shadow_sides *s, size_t n)
{
    struct grid g = { .step = COARSE_DEG };
    fill(&g, mesh, sun, s, n, 4);
    peak(at, best, &g);
    g = (struct grid){ .about = { at[0], at[1] }, .step = FINE_DEG };
    fill(&g, mesh, sun, s, n, 1);
    peak(at, best, &g);
}

/* Those in whose neighbourhood the place casts an edge, with the sun somewhere hereabouts: of the others it knows nothing. */
static size_t keep_cast(struct shadow_sides *kept, const struct static_mesh *mesh, struct vec3 sun, const struct shadow_sides *s, size_t n, size_t step)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i += step) {
        bool cast = false;
        for (int a = -STEPS; a <= STEPS && !cast; a += 2)
            for (int e = -STEPS; e <= STEPS && !cast; e += 2) {
                struct vec3 there = turned(sun, a * COARSE_DEG, e * COARSE_DEG);
                cast = there.z > 0.02 && static_mesh_blocks(mesh, s[i].shade_m, there, NEAR_M, FAR_M) !=
                                             static_mesh_blocks(mesh, s[i].lit_m, there, NEAR_M, FAR_M);
            }
        if (cast) kept[count++] = s[i];
    }
    return count;
}

bool sun_check(struct sun_check *check, bool *done, const struct static_mesh *mesh, struct vec3 sun, const struct shadow_sides *sides,
               size_t n, struct error *err)
{
    size_t thin = n / EDGES_MAX + 1;
    struct shadow_sides *kept = malloc((n / thin + 2) * sizeof *kept);
    if (!kept) return error_set(err, ERR_MEMORY, "no memory for %zu edges of shadows", n);
    struct sun_check c = { .edges = keep_cast(kept, mesh, sun, sides, n, thin) };
    *done = c.edges >= SUN_CHECK_EDGES_MIN;
    if (*done) {
        double at[2], mean[2] = { 0 }, square[2] = { 0 };
        search(at, &c.agree_there, mesh, sun, kept, c.edges);
        c.agree = agreement(mesh, sun, kept, c.edges, 1);
        c.azimuth_off_deg = at[0];
        c.elevation_off_deg = at[1];
        c.at_limit = fmax(fabs(at[0]), fabs(at[1])) > (STEPS - 1) * COARSE_DEG;
        /* Parts of what was seen by themselves: how much the answers differ. */
        for (size_t part = 0; part < PARTS; part++) {
            double there[2], ignored;
            size_t from = c.edges * part / PARTS, to = c.edges * (part + 1) / PARTS;
            search(there, &ignored, mesh, sun, kept + from, to - from);
            for (int k = 0; k < 2; k++) {
                mean[k] += there[k] / PARTS;
                square[k] += there[k] * there[k] / PARTS;
            }
        }
        c.azimuth_sigma_deg = sqrt(fmax(0, square[0] - mean[0] * mean[0]) / (PARTS - 1));
        c.elevation_sigma_deg = sqrt(fmax(0, square[1] - mean[1] * mean[1]) / (PARTS - 1));
        *check = c;
    }
    free(kept);
    return true;
}

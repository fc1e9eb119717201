#include "gen/estimate/shadow_edges.h"

#include "lib/luminance.h"

#include <math.h>
#include <stdlib.h>

enum { SCALES = 2, FAR_PX = 9 };
static const int side_px[SCALES][2] = { { 5, FAR_PX }, { 3, 5 } };
/* Less contrast than this is grain and wear. */
#define CONTRAST_MIN 0.25
/* A side changes by no more than this share of the edge's contrast, and no more than that. */
#define UNEVEN_SHARE 0.3
#define UNEVEN_MAX 0.25

static double luminance_step(const float *to, const float *from)
{
    return luminance_of_f32(to) - luminance_of_f32(from);
}

static double unevenness(const float *a, const float *b)
{
    double most = 0;
    for (int c = 0; c < 3; c++) most = fmax(most, fabs((double)a[c] - (double)b[c]));
    return most;
}

/* The edge through (x, y) across one direction. Returns its contrast, 0 for none. */
static double across(struct shadow_edge *edge, const struct tones *t, const struct ground_view *view, int x, int y,
                     const double direction[2], const int side[2])
{
    int u[2] = { (int)lround(direction[0] * side[0]), (int)lround(direction[0] * side[1]) };
    int v[2] = { (int)lround(direction[1] * side[0]), (int)lround(direction[1] * side[1]) };
    int lit = 1;
    double step = luminance_step(tones_at(t, x + u[1], y + v[1]), tones_at(t, x - u[1], y - v[1]));
    if (step < 0) lit = -1;
    step = fabs(step);
    if (step < CONTRAST_MIN) return 0;
    const float *bright = tones_at(t, x + lit * u[1], y + lit * v[1]), *dark = tones_at(t, x - lit * u[1], y - lit * v[1]);
    double uneven = fmin(UNEVEN_MAX, UNEVEN_SHARE * step);
    if (unevenness(bright, tones_at(t, x + lit * u[0], y + lit * v[0])) > uneven ||
        unevenness(dark, tones_at(t, x - lit * u[0], y - lit * v[0])) > uneven)
        return 0;
    struct vec3 p;
    if (!tones_good(t, x + u[1], y + v[1]) || !tones_good(t, x - u[1], y - v[1]) ||
        !ground_view_at(&p, view, x + u[1], y + v[1]) || !ground_view_at(&p, view, x - u[1], y - v[1]))
        return 0;
    for (int c = 0; c < 3; c++) {
        edge->ln[c] = dark[c] - bright[c];
        edge->lit[c] = bright[c];
    }
    edge->lit_px[0] = (int16_t)(x + lit * u[1]);
    edge->lit_px[1] = (int16_t)(y + lit * v[1]);
    edge->shade_px[0] = (int16_t)(x - lit * u[1]);
    edge->shade_px[1] = (int16_t)(y - lit * v[1]);
    return step;
}

bool shadow_edges_find(struct shadow_edge **out, size_t *count, const struct tones *t, const struct ground_view *view,
                       struct error *err)
{
    static const double direction[4][2] = { { 1, 0 }, { 0, 1 }, { 0.707, 0.707 }, { 0.707, -0.707 } };
    struct shadow_edge *edges = NULL;
    size_t n = 0, room = 0;
    for (int y = FAR_PX; y < t->height_px - FAR_PX; y++)
        for (int x = FAR_PX; x < t->width_px - FAR_PX; x++) {
            struct shadow_edge best = { 0 };
            double contrast = 0;
            for (int i = 0; i < 4 * SCALES && !(i == 4 && contrast > 0); i++) {
                struct shadow_edge edge;
                double is = across(&edge, t, view, x, y, direction[i % 4], side_px[i / 4]);
                if (is <= contrast) continue;
                contrast = is;
                best = edge;
            }
            if (!(contrast > 0)) continue;
            if (n == room) {
                room = room ? 2 * room : 4096;
                struct shadow_edge *grown = realloc(edges, room * sizeof *grown);
                if (!grown) {
                    free(edges);
                    return error_set(err, ERR_MEMORY, "no memory for the edges of a photograph");
                }
                edges = grown;
            }
            edges[n++] = best;
        }
    *out = edges;
    *count = n;
    return true;
}

#include "cast/outline.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

enum { CHUNK = OUTLINE_STEPS + 1 };

static void toward(double out[2], const struct corner *a, const struct corner *b, double length)
{
    double du = b->u - a->u, dv = b->v - a->v, part = fmin(0.5, length / fmax(hypot(du, dv), 1e-9));
    out[0] = a->u + part * du, out[1] = a->v + part * dv;
}

static void add(struct outline *outline, double u, double v)
{
    double *last = outline->count ? outline->p[outline->count - 1] : NULL;
    if (last && hypot(u - last[0], v - last[1]) < 1e-6) return;
    outline->p[outline->count][0] = u, outline->p[outline->count++][1] = v;
}

void outline_make(struct outline *outline, const struct corner *corner, int count)
{
    outline->count = 0;
    for (int n = 0; n < count; n++)
        if (corner[n].cut < 0) count = n;
    assert(count >= 3 && count <= OUTLINE_CORNERS);
    for (int i = 0; i < count; i++) {
        const struct corner *c = &corner[i];
        double a[2], b[2];
        toward(a, c, &corner[(i + count - 1) % count], c->cut);
        toward(b, c, &corner[(i + 1) % count], c->cut);
        for (int k = 0; k <= OUTLINE_STEPS; k++) { /* a parabola that touches both sides */
            double t = (double)k / OUTLINE_STEPS, s = 1 - t;
            add(outline, s * s * a[0] + 2 * s * t * c->u + t * t * b[0], s * s * a[1] + 2 * s * t * c->v + t * t * b[1]);
        }
    }
    add(outline, outline->p[0][0], outline->p[0][1]);
    for (int i = 0, k = 0; i + 1 < outline->count; i += CHUNK, k++) {
        double low[2] = { 1e9, 1e9 }, high[2] = { -1e9, -1e9 };
        for (int j = i; j <= i + CHUNK && j < outline->count; j++)
            for (int c = 0; c < 2; c++) {
                low[c] = fmin(low[c], outline->p[j][c]);
                high[c] = fmax(high[c], outline->p[j][c]);
            }
        outline->ring[k].u = (low[0] + high[0]) / 2, outline->ring[k].v = (low[1] + high[1]) / 2;
        outline->ring[k].r = hypot(high[0] - low[0], high[1] - low[1]) / 2 + 1e-9;
    }
}

double outline_distance(const struct outline *outline, double u, double v)
{
    double best = 1e18, best_r = 1e9;
    bool inside = false;
    for (int i = 0, k = 0; i + 1 < outline->count; i += CHUNK, k++) {
        double du = u - outline->ring[k].u, dv = v - outline->ring[k].v, r = outline->ring[k].r, reach = best_r + r;
        bool far = du * du + dv * dv > reach * reach;
        if (far && fabs(dv) > r) continue;
        for (int j = i; j < i + CHUNK && j + 1 < outline->count; j++) {
            const double *a = outline->p[j], *b = outline->p[j + 1];
            double eu = b[0] - a[0], ev = b[1] - a[1], wu = u - a[0], wv = v - a[1];
            if ((a[1] > v) != (b[1] > v) && wu < eu * wv / ev) inside = !inside;
            if (far) continue;
            double t = fmin(fmax((wu * eu + wv * ev) / (eu * eu + ev * ev), 0), 1), pu = wu - t * eu, pv = wv - t * ev;
            best = fmin(best, pu * pu + pv * pv);
        }
        best_r = sqrt(best);
    }
    return inside ? -best_r : best_r;
}

bool outline_span(double v[2], const struct outline *outline, double u)
{
    v[0] = 1e18, v[1] = -1e18;
    for (int i = 0; i + 1 < outline->count; i++) {
        const double *a = outline->p[i], *b = outline->p[i + 1];
        if ((a[0] > u) == (b[0] > u)) continue;
        double at = a[1] + (b[1] - a[1]) * (u - a[0]) / (b[0] - a[0]);
        v[0] = fmin(v[0], at), v[1] = fmax(v[1], at);
    }
    return v[0] <= v[1];
}

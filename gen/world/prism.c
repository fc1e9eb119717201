/* A prism is sheared along its axis until that is upright: then it is a polygon over a span of
 * heights, and what is convex is beside a polygon exactly when a line along an edge of one of the
 * two parts them. */
#include "gen/world/prism.h"

#include <math.h>

/* How far the prism's outline moves sideways in a metre of height. */
static struct vec2 slope(const struct prism *prism)
{
    return (struct vec2){ prism->axis.x / prism->axis.z, prism->axis.y / prism->axis.z };
}

struct box3 prism_bounds(const struct prism *prism)
{
    struct vec2 s = slope(prism);
    struct box3 box = { { INFINITY, INFINITY, prism->base_m + prism->below_m },
                        { -INFINITY, -INFINITY, prism->base_m + prism->above_m } };
    for (size_t i = 0; i < prism->corners; i++) {
        double x = prism->corner_m[i].x, y = prism->corner_m[i].y, from = prism->below_m, to = prism->above_m;
        box.low[0] = fmin(box.low[0], x + fmin(s.x * from, s.x * to));
        box.low[1] = fmin(box.low[1], y + fmin(s.y * from, s.y * to));
        box.high[0] = fmax(box.high[0], x + fmax(s.x * from, s.x * to));
        box.high[1] = fmax(box.high[1], y + fmax(s.y * from, s.y * to));
    }
    return box;
}

bool prism_contains(const struct prism *prism, struct vec3 p)
{
    double h = p.z - prism->base_m;
    if (!(h >= prism->below_m && h <= prism->above_m)) return false;
    struct vec2 s = slope(prism);
    double x = p.x - s.x * h, y = p.y - s.y * h;
    for (size_t i = 0; i < prism->corners; i++) {
        struct vec2 a = prism->corner_m[i], b = prism->corner_m[(i + 1) % prism->corners];
        if ((b.x - a.x) * (y - a.y) < (b.y - a.y) * (x - a.x)) return false;
    }
    return true;
}

/* p[..][2] as height over the base, x and y as they are seen along the axis. */
struct sheared { double x, y, h; };

/* What of a triangle lies between two heights: at most five corners. Returns how many. */
static int clip_heights(struct sheared out[5], const struct sheared in[3], double below, double above)
{
    struct sheared kept[4];
    int n = 0, m = 0;
    for (int i = 0; i < 3; i++) {
        struct sheared a = in[i], b = in[(i + 1) % 3];
        if (a.h >= below) kept[n++] = a;
        if ((a.h >= below) != (b.h >= below)) {
            double t = (below - a.h) / (b.h - a.h);
            kept[n++] = (struct sheared){ a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), below };
        }
    }
    for (int i = 0; i < n; i++) {
        struct sheared a = kept[i], b = kept[(i + 1) % n];
        if (a.h <= above) out[m++] = a;
        if ((a.h <= above) != (b.h <= above)) {
            double t = (above - a.h) / (b.h - a.h);
            out[m++] = (struct sheared){ a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), above };
        }
    }
    return m;
}

/* Do the polygon's corners and the points lie on two sides of a line across (nx, ny)? */
static bool parted(const struct prism *prism, const struct sheared *points, int n, double nx, double ny)
{
    double low = INFINITY, high = -INFINITY, prism_low = INFINITY, prism_high = -INFINITY;
    for (int i = 0; i < n; i++) {
        double at = nx * points[i].x + ny * points[i].y;
        low = fmin(low, at);
        high = fmax(high, at);
    }
    for (size_t i = 0; i < prism->corners; i++) {
        double at = nx * prism->corner_m[i].x + ny * prism->corner_m[i].y;
        prism_low = fmin(prism_low, at);
        prism_high = fmax(prism_high, at);
    }
    return high < prism_low || prism_high < low;
}

bool prism_meets_triangle(const struct prism *prism, const float *const corner_m[3])
{
    struct vec2 s = slope(prism);
    struct sheared in[3], points[5];
    for (int c = 0; c < 3; c++) {
        double h = (double)corner_m[c][2] - prism->base_m;
        in[c] = (struct sheared){ (double)corner_m[c][0] - s.x * h, (double)corner_m[c][1] - s.y * h, h };
    }
    int n = clip_heights(points, in, prism->below_m, prism->above_m);
    if (n == 0) return false;
    for (size_t i = 0; i < prism->corners; i++) {
        struct vec2 a = prism->corner_m[i], b = prism->corner_m[(i + 1) % prism->corners];
        if (parted(prism, points, n, b.y - a.y, a.x - b.x)) return false;
    }
    for (int i = 0; i < n; i++) {
        struct sheared a = points[i], b = points[(i + 1) % n];
        if (parted(prism, points, n, b.y - a.y, a.x - b.x)) return false;
    }
    return true;
}

/* Lies all of the prism, between two heights, on the far side of the box's side towards (nx, ny)? */
static bool beyond(const struct prism *prism, const struct box3 *box, double from, double to, double nx, double ny)
{
    double nearest = INFINITY;
    struct vec2 s = slope(prism);
    for (size_t i = 0; i < prism->corners; i++)
        nearest = fmin(nearest, nx * prism->corner_m[i].x + ny * prism->corner_m[i].y);
    nearest += fmin((nx * s.x + ny * s.y) * from, (nx * s.x + ny * s.y) * to);
    return fmax(nx * box->low[0], nx * box->high[0]) + fmax(ny * box->low[1], ny * box->high[1]) < nearest;
}

bool prism_may_meet_box(const struct prism *prism, const struct box3 *box)
{
    double from = fmax(box->low[2] - prism->base_m, prism->below_m), to = fmin(box->high[2] - prism->base_m, prism->above_m);
    if (!(from <= to)) return false;
    if (beyond(prism, box, from, to, 1, 0) || beyond(prism, box, from, to, -1, 0) || beyond(prism, box, from, to, 0, 1) ||
        beyond(prism, box, from, to, 0, -1))
        return false;
    struct vec2 s = slope(prism); /* along the shadow, its two sides part best */
    if (beyond(prism, box, from, to, -s.y, s.x) || beyond(prism, box, from, to, s.y, -s.x)) return false;
    for (size_t i = 0; i < prism->corners; i++) {
        struct vec2 a = prism->corner_m[i], b = prism->corner_m[(i + 1) % prism->corners];
        if (beyond(prism, box, from, to, a.y - b.y, b.x - a.x)) return false;
    }
    return true;
}

#include "gen/world/path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The curve is an interpolating spline of circles: at each point the circle through it and its two
 * neighbours; between two points one circle is faded into the next. Direction and curvature are
 * continuous, and points of a circle give the circle.
 * Src: Yuksel 2020, A class of C2 interpolating splines (circular interpolation) */

#define TOUCH_M 0.05         /* nearer points are one */
#define STRAIGHT_BULGE_M 0.5 /* off the straight line between two points, */
#define BEND_BULGE_M 1.5     /* and where both turn the same way: an arc is meant */
#define CORNER_M 8.0         /* a corner may begin to bend this far before its point */
#define SPLINE_STEP_M 0.02
#define REFINEMENTS 64

static struct vec2 sub(struct vec2 a, struct vec2 b) { return (struct vec2){ a.x - b.x, a.y - b.y }; }
static struct vec2 mix(struct vec2 a, struct vec2 b, double t)
{
    return (struct vec2){ a.x + t * (b.x - a.x), a.y + t * (b.y - a.y) };
}
static double dot(struct vec2 a, struct vec2 b) { return a.x * b.x + a.y * b.y; }
static double cross(struct vec2 a, struct vec2 b) { return a.x * b.y - a.y * b.x; }
static double distance(struct vec2 a, struct vec2 b) { return hypot(a.x - b.x, a.y - b.y); }
/* The turn from one direction to another, to the left positive. */
static double turn_from_to(struct vec2 a, struct vec2 b) { return atan2(cross(a, b), dot(a, b)); }

static double turn_at(const struct vec2 *p, size_t n, size_t i)
{
    return i == 0 || i + 1 == n ? 0 : turn_from_to(sub(p[i], p[i - 1]), sub(p[i + 1], p[i]));
}

/* How far the circle at point i swings out over the chord to its neighbour j. */
static double bulge(const struct vec2 *p, size_t n, size_t i, size_t j)
{
    if (i == 0 || i + 1 == n) return 0;
    double chord = distance(p[i], p[j]), other = distance(p[i], p[2 * i - j]);
    double share = fabs(turn_at(p, n, i)) * chord / (chord + other);
    return chord / 2 * tan(share / 2);
}

/* Where between points i and i + 1 one more is wanted, as a part of the way from i; 0: nowhere. */
static double wanted_between(const struct vec2 *p, size_t n, size_t i)
{
    double length = distance(p[i], p[i + 1]);
    double turn[2] = { turn_at(p, n, i), turn_at(p, n, i + 1) };
    /* An end has no turn of its own: it goes on with its neighbour's. */
    bool arc = (i == 0 || i + 2 == n || turn[0] * turn[1] > 0) && fmax(fabs(turn[0]), fabs(turn[1])) < M_PI / 3;
    double swing[2] = { bulge(p, n, i, i + 1), bulge(p, n, i + 1, i) };
    double worst = fmax(swing[0], swing[1]), allowed = arc ? BEND_BULGE_M : STRAIGHT_BULGE_M;
    if (length > CORNER_M && worst > allowed) {
        double part = fmin(fmax(CORNER_M / length, allowed / worst), 0.5);
        return swing[0] >= swing[1] ? part : 1 - part;
    }
    /* In a hairpin the circle runs away unless both legs are alike. */
    if (i > 0 && fabs(turn[0]) > M_PI / 2 && length > 1.5 * distance(p[i - 1], p[i]))
        return distance(p[i - 1], p[i]) / length;
    if (i + 2 < n && fabs(turn[1]) > M_PI / 2 && length > 1.5 * distance(p[i + 1], p[i + 2]))
        return 1 - distance(p[i + 1], p[i + 2]) / length;
    return 0;
}

/* Points that differ, with more between them where the curve would leave the straight line too far.
 * Returns NULL without memory, or with *n = 1 when fewer than 2 points differ. */
static struct vec2 *knots_create(const struct vec2 *point_m, size_t *n)
{
    struct vec2 *p = malloc(*n * sizeof *p);
    if (!p) return NULL;
    size_t count = 1;
    p[0] = point_m[0];
    for (size_t i = 1; i < *n; i++)
        if (distance(point_m[i], p[count - 1]) > TOUCH_M) p[count++] = point_m[i];
    if (count > 1) p[count - 1] = distance(point_m[*n - 1], p[count - 1]) <= TOUCH_M ? point_m[*n - 1] : p[count - 1];
    *n = count;

    bool added = count > 1;
    for (int pass = 0; added && pass < REFINEMENTS; pass++) {
        struct vec2 *finer = malloc(2 * *n * sizeof *finer);
        if (!finer) {
            free(p);
            return NULL;
        }
        size_t used = 0;
        added = false;
        for (size_t i = 0; i < *n; i++) {
            finer[used++] = p[i];
            double part = i + 1 < *n ? wanted_between(p, *n, i) : 0;
            if (part > 0) finer[used++] = mix(p[i], p[i + 1], part);
            added = added || part > 0;
        }
        free(p);
        p = finer;
        *n = used;
    }
    return p;
}

/* On the circle through a, b, c: from b (t = 0) towards c (t = 1). */
static struct vec2 on_circle(struct vec2 a, struct vec2 b, struct vec2 c, double t)
{
    struct vec2 in = sub(b, a), out = sub(c, b);
    double turn = turn_from_to(in, out), chord = hypot(out.x, out.y);
    /* Inscribed angles: the arc over a chord is twice the angle that the chord is seen under. */
    double half_arc = atan2(chord * sin(turn), hypot(in.x, in.y) + chord * cos(turn));
    if (fabs(half_arc) < 1e-7) return mix(b, c, t);
    double length = chord * sin(half_arc * t) / sin(half_arc), side = half_arc * (1 - t);
    double x = out.x / chord, y = out.y / chord;
    /* Seen from b the chord to the point at t lies to the right of that to c, in a left bend. */
    return (struct vec2){ b.x + length * (x * cos(side) + y * sin(side)),
                          b.y + length * (y * cos(side) - x * sin(side)) };
}

static struct vec2 on_spline(const struct vec2 *p, size_t n, size_t i, double t)
{
    bool first = i == 0, last = i + 2 == n;
    if (first && last) return mix(p[0], p[1], t);
    if (first) return on_circle(p[2], p[1], p[0], 1 - t);
    struct vec2 from = on_circle(p[i - 1], p[i], p[i + 1], t);
    if (last) return from;
    double fade = sin(M_PI / 2 * t);
    return mix(from, on_circle(p[i + 2], p[i + 1], p[i], 1 - t), fade * fade);
}

static size_t spline_steps(const struct vec2 *p, size_t i)
{
    return (size_t)ceil(distance(p[i], p[i + 1]) / SPLINE_STEP_M);
}

/* Walk along the spline: its length, and where out_m is given the n points of equal steps along it. */
static double walk(const struct vec2 *knots, size_t knot_count, struct vec2 *out_m, size_t n, double step_m)
{
    double gone = 0;
    size_t next = 0;
    struct vec2 at = knots[0];
    for (size_t i = 0; i + 1 < knot_count; i++) {
        size_t steps = spline_steps(knots, i);
        for (size_t k = 1; k <= steps; k++) {
            struct vec2 to = on_spline(knots, knot_count, i, (double)k / (double)steps);
            double length = distance(at, to);
            for (; out_m && next < n && (double)next * step_m <= gone + length; next++)
                out_m[next] = mix(at, to, length > 0 ? ((double)next * step_m - gone) / length : 0);
            gone += length;
            at = to;
        }
    }
    if (out_m)
        for (; next < n; next++) out_m[next] = at;
    return gone;
}

bool path_create(struct path *path, const struct vec2 *point_m, size_t n, struct error *err)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(point_m[i].x) || !isfinite(point_m[i].y))
            return error_set(err, ERR_INPUT, "point %zu of the path is not finite", i + 1);
    if (n < 2) return error_set(err, ERR_INPUT, "a path needs 2 points or more, here %s %zu", n == 1 ? "is" : "are", n);
    size_t knot_count = n;
    struct vec2 *knots = knots_create(point_m, &knot_count);
    struct path new = { 0 };
    bool good = false;
    if (!knots) {
        error_set(err, ERR_MEMORY, "no memory for a path of %zu points", n);
        goto out;
    }
    if (knot_count < 2) {
        error_set(err, ERR_INPUT, "the %zu points of the path are all one place; a path needs 2 that differ", n);
        goto out;
    }
    double length = walk(knots, knot_count, NULL, 0, 0);
    new.n = (size_t)ceil(length / PATH_STEP_M) + 1;
    if (new.n < 3) new.n = 3;
    new.point_m = malloc(new.n * sizeof *new.point_m);
    new.s_m = malloc(new.n * sizeof *new.s_m);
    if (!new.point_m || !new.s_m) {
        error_set(err, ERR_MEMORY, "no memory for a path of %.0f m", length);
        goto out;
    }
    double step = length / (double)(new.n - 1);
    walk(knots, knot_count, new.point_m, new.n, step);
    for (size_t i = 0; i < new.n; i++) new.s_m[i] = (double)i * step;
    *path = new;
    new = (struct path){ 0 };
    good = true;
out:
    path_release(&new);
    free(knots);
    return good;
}

void path_release(struct path *path)
{
    free(path->point_m);
    free(path->s_m);
    *path = (struct path){ 0 };
}

double path_length(const struct path *path)
{
    return path->s_m[path->n - 1];
}

/* The tangent at sample i: that of the parabola through it and its neighbours. */
static struct vec2 tangent(const struct path *path, size_t i)
{
    const struct vec2 *p = path->point_m;
    double step = path->s_m[1];
    size_t a = i == 0 ? 0 : i + 1 == path->n ? i - 2 : i - 1;
    double u = (double)i - (double)a - 1; /* -1, 0 or 1 from the parabola's middle */
    return (struct vec2){ ((p[a + 2].x - p[a].x) / 2 + u * (p[a].x - 2 * p[a + 1].x + p[a + 2].x)) / step,
                          ((p[a + 2].y - p[a].y) / 2 + u * (p[a].y - 2 * p[a + 1].y + p[a + 2].y)) / step };
}

/* The curvature at sample i: how the direction turns from the step before to the step after. */
static double curvature(const struct path *path, size_t i)
{
    const struct vec2 *p = path->point_m;
    if (i == 0) i = 1;
    if (i + 1 == path->n) i--;
    return turn_from_to(sub(p[i], p[i - 1]), sub(p[i + 1], p[i])) / path->s_m[1];
}

/* The curve itself, without an offset. tangent need not have unit length. */
static struct vec2 curve_at(const struct path *path, double s_m, struct vec2 *direction, double *bend)
{
    double u = fmin(fmax(s_m / path->s_m[1], 0), (double)(path->n - 1));
    size_t i = (size_t)u;
    if (i + 2 > path->n) i = path->n - 2;
    double t = u - (double)i, step = path->s_m[1];
    struct vec2 t0 = tangent(path, i), t1 = tangent(path, i + 1), p0 = path->point_m[i], p1 = path->point_m[i + 1];
    *direction = mix(t0, t1, t);
    *bend = curvature(path, i) * (1 - t) + curvature(path, i + 1) * t;
    double h1 = t * t * (3 - 2 * t), g0 = t * (1 - t) * (1 - t) * step, g1 = t * t * (t - 1) * step;
    return (struct vec2){ p0.x + h1 * (p1.x - p0.x) + g0 * t0.x + g1 * t1.x,
                          p0.y + h1 * (p1.y - p0.y) + g0 * t0.y + g1 * t1.y };
}

struct path_point path_at(const struct path *path, double s_m, double offset_m)
{
    struct vec2 along;
    double bend;
    struct vec2 p = curve_at(path, s_m, &along, &bend);
    double length = hypot(along.x, along.y);
    return (struct path_point){ .p_m = { p.x - offset_m * along.y / length, p.y + offset_m * along.x / length },
                                .heading_rad = atan2(along.x, along.y), .curvature = bend };
}

double path_project(const struct path *path, double *s_m, double *offset_m, struct vec2 p_m)
{
    /* A sample that is D away tells that none nearer than B lies within D - B along the curve. */
    double step = path->s_m[1], best = INFINITY, s = 0;
    for (size_t i = 0; i < path->n;) {
        double d = distance(p_m, path->point_m[i]);
        if (d < best) {
            best = d;
            s = path->s_m[i];
        }
        i += (size_t)fmax(1, floor((d - best) / step));
    }
    struct vec2 along, at;
    double bend;
    for (int k = 0; k < 4; k++) {
        at = curve_at(path, s, &along, &bend);
        double length = hypot(along.x, along.y);
        double aside = cross(along, sub(p_m, at)) / length, ahead = dot(along, sub(p_m, at)) / length;
        /* Newton's step, held to the neighbourhood: at the bend's centre it has no end. */
        double move = ahead / fmax(1 - bend * aside, 0.1);
        s = fmin(fmax(s + fmin(fmax(move, -step), step), 0), path_length(path));
    }
    at = curve_at(path, s, &along, &bend);
    *s_m = s;
    *offset_m = cross(along, sub(p_m, at)) / hypot(along.x, along.y);
    return distance(p_m, at);
}

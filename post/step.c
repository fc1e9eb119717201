#include "post/step.h"

#include <math.h>
#include <string.h>

#define ALONG_MIN_PX 4.0      /* half the length of edge that is looked at */
#define ALONG_MAX_PX 12.0
#define ALONG_WIDE_PX 5.0     /* of what is blurred: slant or not */
#define PHASES 0.5            /* half of the way that a slant must go, in px across, to sample an edge everywhere */
#define BEYOND_PX 1.5         /* so far past the window nothing else may begin */
#define REACH_PX 13           /* of the longest window */
#define POINTS_MAX ((2 * REACH_PX + 1) * (2 * REACH_PX + 1))
#define STEP_MIN 0.01
#define STRAIGHT_MIN 0.8      /* 1: light changes in one direction only */
#define SHARPENING_SPREAD 0.5 /* what is known of it beforehand: a standard deviation, */
#define NOISE 0.02            /* and that of a pixel, in units of the step */
#define FAR 4.5               /* standard deviations from which on a step is level */
#define BINS_PER_PX 4         /* that the slant samples */
#define BINS_HALF_PX 16
#define BINS (2 * BINS_HALF_PX * BINS_PER_PX)

enum { LOW, STEP, AT, ANGLE, SIGMA, SHARPENING, PARAMETERS };

struct point { double x, y, light; bool beyond; };
struct points { struct point point[POINTS_MAX]; int count; };

struct model {
    double low, step, at, angle, sigma, sharpening;
    bool sharpened;
    double across_x, across_y, wide; /* of angle and sigma */
};

/* Sums of the normal equations. */
struct normal { double a[PARAMETERS][PARAMETERS + 1], misfit; int points; };

static bool solve(double x[PARAMETERS], struct normal n)
{
    for (int i = 0; i < PARAMETERS; i++) {
        int pivot = i;
        for (int k = i + 1; k < PARAMETERS; k++)
            if (fabs(n.a[k][i]) > fabs(n.a[pivot][i])) pivot = k;
        if (!(fabs(n.a[pivot][i]) > 1e-12)) return false;
        for (int j = 0; j <= PARAMETERS; j++) {
            double swap = n.a[i][j];
            n.a[i][j] = n.a[pivot][j];
            n.a[pivot][j] = swap;
        }
        for (int k = i + 1; k < PARAMETERS; k++) {
            double by = n.a[k][i] / n.a[i][i];
            for (int j = i; j <= PARAMETERS; j++) n.a[k][j] -= by * n.a[i][j];
        }
    }
    for (int i = PARAMETERS - 1; i >= 0; i--) {
        x[i] = n.a[i][PARAMETERS];
        for (int j = i + 1; j < PARAMETERS; j++) x[i] -= n.a[i][j] * x[j];
        x[i] /= n.a[i][i];
    }
    return true;
}

static void take_points(struct points *to, const struct image *light, int x0, int y0, double angle, double across_px, double along_px)
{
    double c = cos(angle), s = sin(angle);
    to->count = 0;
    for (int dy = -REACH_PX; dy <= REACH_PX; dy++)
        for (int dx = -REACH_PX; dx <= REACH_PX; dx++) {
            double across = fabs(dx * c + dy * s);
            int x = x0 + dx, y = y0 + dy;
            if (across > across_px + BEYOND_PX || fabs(dy * c - dx * s) > along_px) continue;
            if (x < 0 || y < 0 || x >= light->width_px || y >= light->height_px) continue;
            to->point[to->count++] = (struct point){ dx, dy, (double)*image_f32(light, x, y), across > across_px };
        }
}

static double bell(double q) { return fabs(q) < FAR ? exp(-q * q / 2) / sqrt(2 * M_PI) : 0; }
static double rising(double q) { return q > FAR ? 1 : q < -FAR ? 0 : erfc(-q * M_SQRT1_2) / 2; }

static void follow(struct model *m)
{
    m->across_x = cos(m->angle);
    m->across_y = sin(m->angle);
    m->wide = hypot(m->sigma, STEP_SHARPENING_PX);
}

/* Returns by how much the point is brighter than the model. Out: slope of the model by each parameter; t_px */
static double compare_point(double slope[PARAMETERS], double *t_px, const struct model *m, const struct point *p)
{
    double t = p->x * m->across_x + p->y * m->across_y - m->at, u = p->y * m->across_x - p->x * m->across_y;
    double q = t / m->sigma, r = t / m->wide, phi = rising(q), more = m->sharpened ? phi - rising(r) : 0;
    double shape = phi + m->sharpening * more, own = m->step * (1 + m->sharpening) * bell(q) / m->sigma;
    double other = m->sharpened ? m->step * m->sharpening * bell(r) / m->wide : 0, rise = own - other;
    slope[LOW] = 1;
    slope[STEP] = shape;
    slope[AT] = -rise;
    slope[ANGLE] = rise * u;
    slope[SIGMA] = -own * q + other * r * m->sigma / m->wide;
    slope[SHARPENING] = m->sharpened ? m->step * more : 0;
    *t_px = t;
    return p->light - m->low - m->step * shape;
}

static void compare_with(struct normal *n, const struct points *points, const struct model *m)
{
    *n = (struct normal){ .points = 0 };
    for (int k = 0; k < points->count; k++) {
        if (points->point[k].beyond) continue;
        double d[PARAMETERS], t, off = compare_point(d, &t, m, &points->point[k]);
        for (int i = 0; i < PARAMETERS; i++) {
            for (int j = 0; j < PARAMETERS; j++) n->a[i][j] += d[i] * d[j];
            n->a[i][PARAMETERS] += d[i] * off;
        }
        n->misfit += off * off;
        n->points++;
    }
    double known = pow(NOISE * m->step / SHARPENING_SPREAD, 2);
    n->a[SHARPENING][SHARPENING] += known;
    n->a[SHARPENING][PARAMETERS] -= known * m->sharpening;
}

/* What the place has beside its edge is the same all along it. So the points at one distance count as one that is off:
 * a covariance by clusters, after Liang and Zeger (1986). */
static double error_of(int parameter, const struct points *points, const struct model *m, const struct normal *n)
{
    struct normal unit = *n;
    double row[PARAMETERS], sums[BINS] = { 0 }, variance = 0;
    bool seen[BINS] = { false };
    int bins = 0;
    for (int i = 0; i < PARAMETERS; i++) unit.a[i][PARAMETERS] = i == parameter;
    if (!solve(row, unit)) return INFINITY;
    for (int k = 0; k < points->count; k++) {
        if (points->point[k].beyond) continue;
        double d[PARAMETERS], t, off = compare_point(d, &t, m, &points->point[k]), by = 0;
        int bin = (int)floor((t + BINS_HALF_PX) * BINS_PER_PX);
        if (bin < 0 || bin >= BINS) continue;
        for (int i = 0; i < PARAMETERS; i++) by += row[i] * d[i] * off;
        sums[bin] += by;
        seen[bin] = true;
    }
    for (int b = 0; b < BINS; b++) {
        bins += seen[b];
        variance += sums[b] * sums[b];
    }
    int free = m->sharpened ? PARAMETERS : PARAMETERS - 1;
    return bins > free ? sqrt(variance * bins / (bins - free)) : INFINITY;
}

/* The worse side's. */
static double light_beside(const struct points *points, const struct model *m)
{
    double sum[2] = { 0 };
    int n[2] = { 0 };
    for (int k = 0; k < points->count; k++) {
        if (!points->point[k].beyond) continue;
        double d[PARAMETERS], t, off = compare_point(d, &t, m, &points->point[k]);
        sum[t > 0] += off;
        n[t > 0]++;
    }
    if (n[0] == 0 || n[1] == 0) return INFINITY;
    return fmax(fabs(sum[0] / n[0]), fabs(sum[1] / n[1])) / fabs(m->step);
}

/* Mean of the light on one side of the edge. */
static double side_of(const struct image *light, int x, int y, double angle, double t_px)
{
    double sum = 0;
    int n = 0;
    for (int u = -2; u <= 2; u++)
        for (int k = 0; k < 2; k++, n++) {
            double t = t_px > 0 ? t_px - k : t_px + k, dx = t * cos(angle) - u * sin(angle), dy = t * sin(angle) + u * cos(angle);
            int at_x = x + (int)lrint(dx), at_y = y + (int)lrint(dy);
            at_x = at_x < 0 ? 0 : at_x >= light->width_px ? light->width_px - 1 : at_x;
            at_y = at_y < 0 ? 0 : at_y >= light->height_px ? light->height_px - 1 : at_y;
            sum += (double)*image_f32(light, at_x, at_y);
        }
    return sum / n;
}

double step_contrast(const struct image *light, int x, int y, double angle, double across_px)
{
    return fabs(side_of(light, x, y, angle, across_px) - side_of(light, x, y, angle, -across_px));
}

/* From the squares of its differences. */
bool step_direction(double *angle, const struct image *light, int x, int y)
{
    double xx = 0, xy = 0, yy = 0;
    for (int dy = -3; dy <= 3; dy++)
        for (int dx = -3; dx <= 3; dx++) {
            double gx = (double)(*image_f32(light, x + dx + 1, y + dy) - *image_f32(light, x + dx - 1, y + dy));
            double gy = (double)(*image_f32(light, x + dx, y + dy + 1) - *image_f32(light, x + dx, y + dy - 1));
            xx += gx * gx;
            xy += gx * gy;
            yy += gy * gy;
        }
    *angle = atan2(2 * xy, xx - yy) / 2;
    return hypot(2 * xy, xx - yy) > STRAIGHT_MIN * (xx + yy);
}

static double length_for(double angle, double across_px)
{
    double slant = fmin(fabs(tan(angle)), 1 / fabs(tan(angle)));
    return fmin(fmax(PHASES / slant, ALONG_MIN_PX), across_px < STEP_WIDE_PX ? ALONG_MAX_PX : ALONG_WIDE_PX);
}

/* In/out: m. Returns false where it runs away. */
static bool converge(struct model *m, const struct points *points, double angle)
{
    for (int k = 0; k < 16; k++) {
        struct normal n;
        double by[PARAMETERS];
        compare_with(&n, points, m);
        if (!solve(by, n)) return false;
        m->low += by[LOW];
        m->step += by[STEP];
        m->at += fmin(fmax(by[AT], -1), 1);
        m->angle += fmin(fmax(by[ANGLE], -0.1), 0.1);
        m->sigma = fmin(fmax(m->sigma + by[SIGMA], m->sigma / 1.5), m->sigma * 1.5);
        m->sharpening = fmin(fmax(m->sharpening + by[SHARPENING], -3), 3);
        follow(m);
        if (m->sigma < 0.1 || m->sigma > 5 || fabs(m->at) > 3 || fabs(m->angle - angle) > 0.4) return false;
        if (fabs(by[SIGMA]) < 1e-4 && fabs(by[AT]) < 1e-3) break;
    }
    return true;
}

bool step_fit(struct step *step, const struct image *light, int x, int y, double angle, double across_px, bool sharpened)
{
    double low = side_of(light, x, y, angle, -across_px), high = side_of(light, x, y, angle, across_px);
    struct model m = { .low = low, .step = high - low, .angle = angle, .sigma = 0.8, .sharpened = sharpened };
    struct points points;
    struct normal n;
    if (fabs(m.step) < STEP_MIN) return false;
    follow(&m);
    take_points(&points, light, x, y, angle, across_px, length_for(angle, across_px));
    if (!converge(&m, &points, angle)) return false;
    compare_with(&n, &points, &m);
    /* Both sides must be in view for a blur this wide. */
    if (2.2 * m.sigma + fabs(m.at) >= across_px) return false;
    *step = (struct step){
        .low = m.low, .high = m.low + m.step, .at_px = m.at, .angle = m.angle, .sigma_px = m.sigma, .sharpening = m.sharpening,
        .sigma_error_px = error_of(SIGMA, &points, &m, &n),
        .sharpening_error = sharpened ? error_of(SHARPENING, &points, &m, &n) : INFINITY, .beside = light_beside(&points, &m),
        .misfit = sqrt(n.misfit / n.points) / fabs(m.step),
    };
    return true;
}

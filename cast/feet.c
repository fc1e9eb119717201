#include "cast/feet.h"

#include <stdlib.h>

static double radians(double deg) { return deg * M_PI / 180; }

double curve_at(knots knot, int n, double x)
{
    int i = 0;
    while (i + 2 < n && x > knot[i + 1][0]) i++;
    double slope[2], h = knot[i + 1][0] - knot[i][0], rise = (knot[i + 1][1] - knot[i][1]) / h;
    for (int k = 0; k < 2; k++) {
        int at = i + k;
        double before = at > 0 ? (knot[at][1] - knot[at - 1][1]) / (knot[at][0] - knot[at - 1][0]) : rise;
        double after = at + 1 < n ? (knot[at + 1][1] - knot[at][1]) / (knot[at + 1][0] - knot[at][0]) : rise;
        slope[k] = before * after > 0 ? 2 * before * after / (before + after) : 0;
    }
    double t = (x - knot[i][0]) / h, s = 1 - t;
    return s * s * (1 + 2 * t) * knot[i][1] + t * t * (1 + 2 * s) * knot[i + 1][1] + h * s * t * (s * slope[0] - t * slope[1]);
}

struct sole sole_create(const struct body *body, const struct hull *hull, int shoe_piece, int side)
{
    struct vec3 ankle = body->at[LIMB(side, FOOT)], toes = vec3_sub(body->at[LIMB(side, TOES)], ankle);
    struct sole sole = { malloc((hull->points + 1) * sizeof *sole.p), 0, { toes.x, toes.z } };
    if (!sole.p) abort();
    for (size_t i = 0; i < hull->points; i++) {
        struct vec3 p = hull->point[i];
        double weight[JOINT_COUNT];
        if (hull->piece[i] != shoe_piece || p.z > 0.5 * ankle.z) continue;
        bind_point(weight, body, p, 0);
        double *to = sole.p[sole.count++];
        to[0] = p.x - ankle.x, to[1] = p.z - ankle.z, to[2] = weight[LIMB(side, TOES)];
    }
    return sole;
}

void sole_release(struct sole *sole)
{
    free(sole->p);
    *sole = (struct sole){ 0 };
}

static void lift_2d(double out[2], double x, double z, double angle)
{
    out[0] = x * cos(angle) - z * sin(angle);
    out[1] = x * sin(angle) + z * cos(angle);
}

/* Where a point of the sole is, from the ankle. */
static void sole_point(double out[2], const struct sole *sole, size_t i, double pitch, double bend)
{
    const double *p = sole->p[i];
    double foot[2], toe[2], knuckle[2];
    lift_2d(foot, p[0], p[1], pitch);
    lift_2d(knuckle, sole->toe[0], sole->toe[1], pitch);
    lift_2d(toe, p[0] - sole->toe[0], p[1] - sole->toe[1], pitch + bend);
    for (int k = 0; k < 2; k++) out[k] = (1 - p[2]) * foot[k] + p[2] * (knuckle[k] + toe[k]);
}

static size_t lowest(double *z, const struct sole *sole, double pitch, double bend)
{
    size_t best = 0;
    *z = 1e9;
    for (size_t i = 0; i < sole->count; i++) {
        double p[2];
        sole_point(p, sole, i, pitch, bend);
        if (p[1] < *z) *z = p[1], best = i;
    }
    return best;
}

double foot_low(const struct sole *sole, double pitch, double bend)
{
    double z;
    lowest(&z, sole, pitch, bend);
    return z;
}

/* The foot lies flat under the body; from there it rolls over its lowest point, forward and back in time. */
static void stand(struct step *step, const struct sole *sole, int flat, int last, double advance, double under_x)
{
    double low;
    step[flat].x = under_x;
    for (int way = -1; way <= 1; way += 2)
        for (int i = flat; i >= 0 && i <= last; i += way) {
            size_t at = lowest(&low, sole, step[i].pitch, step[i].bend);
            step[i].z = -low;
            int next = i + way;
            if (next < 0 || next > last) break;
            double here[2], there[2];
            sole_point(here, sole, at, step[i].pitch, step[i].bend);
            sole_point(there, sole, at, step[next].pitch, step[next].bend);
            step[next].x = step[i].x + here[0] - there[0] - way * advance;
        }
}

static double hermite(double a, double va, double b, double vb, double t)
{
    double s = 1 - t;
    return s * s * (1 + 2 * t) * a + t * t * (1 + 2 * s) * b + s * t * (s * va - t * vb);
}

/* From the ground to the ground, the lowest point above it. */
static void swing(struct step *step, const struct sole *sole, int last, const struct curve *clearance, double leg_m)
{
    const struct step off = step[last], on = step[0];
    double steps = STEPS - last, leaves = off.x - step[last - 1].x, lands = step[1].x - on.x;
    for (int i = last + 1; i < STEPS; i++) {
        double t = (i - last) / steps, low;
        step[i].x = hermite(off.x, steps * leaves, on.x, steps * lands, t);
        lowest(&low, sole, step[i].pitch, step[i].bend);
        step[i].z = leg_m * curve_at(clearance->knot, clearance->count, t) - low;
    }
}

void roll_foot(struct step *step, const struct sole *sole, const struct roll *roll, double stride_m, double leg_m, double under_x)
{
    int last = (int)lround(roll->stands * STEPS);
    for (int i = 0; i < STEPS; i++) {
        step[i].pitch = radians(curve_at(roll->pitch.knot, roll->pitch.count, (double)i / STEPS));
        step[i].bend = radians(curve_at(roll->bend.knot, roll->bend.count, (double)i / STEPS));
    }
    stand(step, sole, (int)lround(roll->under * STEPS), last, stride_m / STEPS, under_x);
    swing(step, sole, last, &roll->clearance, leg_m);
}

struct step step_at(const struct step *step, double part)
{
    double q = (part - floor(part)) * STEPS, t = q - floor(q);
    const struct step *a = &step[(int)q % STEPS], *b = &step[((int)q + 1) % STEPS];
    return (struct step){ a->x + t * (b->x - a->x), a->z + t * (b->z - a->z), a->pitch + t * (b->pitch - a->pitch), a->bend + t * (b->bend - a->bend) };
}

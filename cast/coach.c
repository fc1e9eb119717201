#include "cast/coach.h"

#include <math.h>

double round_both(double a, double b, double r)
{
    return fmin(fmax(a, b), -r) + hypot(fmax(a + r, 0), fmax(b + r, 0));
}

static double smooth(double a, double b, double x)
{
    double t = fmin(fmax((x - a) / (b - a), 0), 1);
    return t * t * (3 - 2 * t);
}

void coach_make(struct coach *c, const struct coach_spec *spec)
{
    c->spec = spec;
    outline_make(&c->side, spec->side, OUTLINE_CORNERS);
    c->x[0] = 1e9, c->x[1] = -1e9;
    for (int i = 0; i < c->side.count; i++) {
        c->x[0] = fmin(c->x[0], c->side.p[i][0]);
        c->x[1] = fmax(c->x[1], c->side.p[i][0]);
    }
}

double coach_belt(const struct coach *c, double x)
{
    return c->spec->belt[0] + (c->spec->belt[1] - c->spec->belt[0]) * (c->x[1] - x) / (c->x[1] - c->x[0]);
}

double coach_half_width(const struct coach *c, double x, double z)
{
    const struct coach_spec *s = c->spec;
    double belt = coach_belt(c, x), t = z - belt, in = 0, middle = (c->x[0] + c->x[1]) / 2, half = (c->x[1] - c->x[0]) / 2;
    if (z < s->tuck_z) in += s->tuck * pow((s->tuck_z - z) / (s->tuck_z - 0.1), 2);
    in += s->shoulder * smooth(-0.09, 0.01, t);
    double above = 0.03 * log1p(exp(fmin(t / 0.03, 40))), end = (x - middle) / half; /* 0 below the belt, without a kink */
    if (t > 1) above = t;
    in += s->tumble * above + s->bulge * above * above + above * (end > 0 ? s->house[0] : s->house[1]) * end * end;
    double hollow = (z - (belt - s->scallop_drop)) / 0.085;
    in += s->scallop * exp(-hollow * hollow);
    for (int k = 0; k < 2; k++) {
        double from = s->taper_from[k], at = (x - from) / (c->x[!k] - from);
        if (at > 0) in += s->taper[k] * pow(at, 2.2);
    }
    for (int a = 0; a < c->axles && s->flare > 0; a++) {
        double d = (hypot(x - c->axle_x[a], z - c->axle_z) - c->arch_r) / 0.055;
        if (t < 0) in -= s->flare * exp(-d * d) * smooth(0, -0.15, t);
    }
    return s->half_width - in;
}

/* A point as the outline sees it: ends lie back and the roof falls towards the sides. */
static struct vec2 seen_from_side(const struct coach *c, struct vec3 p)
{
    const struct coach_spec *s = c->spec;
    double middle = (c->x[0] + c->x[1]) / 2, y2 = p.y * p.y, way = (p.x - middle) / 0.5;
    double sweep = way > 0 ? s->sweep[0] * smooth(0, 1, way) : -s->sweep[1] * smooth(0, 1, -way);
    return (struct vec2){ p.x + sweep * y2, p.z + s->crown * y2 * smooth(s->crown_z - 0.25, s->crown_z + 0.25, p.z) };
}

static double at(const void *self, struct vec3 p)
{
    const struct coach *c = self;
    struct vec2 q = seen_from_side(c, p);
    double end = fmax(smooth(c->x[1] - 0.55, c->x[1] - 0.1, p.x), smooth(c->x[0] + 0.55, c->x[0] + 0.1, p.x));
    double r = c->spec->round + (c->spec->round_end - c->spec->round) * end;
    return round_both(outline_distance(&c->side, q.x, q.y), fabs(p.y) - coach_half_width(c, p.x, p.z), r);
}

struct form coach_form(const struct coach *coach) { return (struct form){ at, coach }; }

double coach_end(const struct coach *c, double sign, double y, double z)
{
    double in = 0.5 * (c->x[0] + c->x[1]), out = sign > 0 ? c->x[1] + 0.1 : c->x[0] - 0.1;
    for (int i = 0; i < 40; i++) {
        double mid = 0.5 * (in + out);
        if (at(c, vec3(mid, y, z)) < 0) in = mid;
        else out = mid;
    }
    return in;
}

/* --- marks --- */

static double beside_lines(const struct mark *m, const struct coach *c, struct vec3 p, double a)
{
    double t = p.z - coach_belt(c, p.x);
    return round_both(p.x - (m->a[2] + m->a[3] * t) , m->a[4] + m->a[5] * t - p.x, a);
}

static double mark_at(const void *self, struct vec3 p)
{
    const struct mark *m = self;
    const struct coach *c = m->coach;
    struct vec2 q = seen_from_side(c, p);
    double y = fabs(p.y), r, way, d;
    switch (m->kind) {
    case MARK_SIDE:
        return outline_distance(&m->outline, p.x, p.z);
    case MARK_FRONT:
    case MARK_REAR:
        r = c->spec->half_width, way = m->kind == MARK_FRONT ? 1 : -1;
        return outline_distance(&m->outline, r * atan2(y, way * (p.x - c->x[way > 0]) + r), p.z);
    case MARK_TOP:
        return fmax(outline_distance(&m->outline, p.x, y), m->a[0] - p.z);
    case MARK_BOTTOM:
        return p.z - m->a[0];
    case MARK_PANE: {
        double u = q.x - m->a[0], v = q.y - m->a[1], along = u * m->a[2] + v * m->a[3], over = fabs(u * m->a[3] - v * m->a[2]);
        double ends = fmax(-along, along - m->a[4]);
        d = round_both(ends, y - coach_half_width(c, p.x, p.z) + m->a[5], m->a[6]);
        return fmax(d, over - 0.25);
    }
    case MARK_WINDOW:
        d = round_both(coach_belt(c, p.x) + m->a[0] - p.z, fmax(outline_distance(&c->side, q.x, q.y) + m->a[1], p.z - m->a[7]), m->a[6]);
        return round_both(d, beside_lines(m, c, p, m->a[6]), m->a[6]);
    case MARK_DOOR:
        d = round_both(m->a[0] - p.z, outline_distance(&c->side, q.x, q.y) + m->a[1], m->a[6]);
        d = round_both(d, beside_lines(m, c, p, m->a[6]), m->a[6]);
        for (int a = 0; a < c->axles; a++)
            d = round_both(d, c->arch_r + 0.07 - hypot(p.x - c->axle_x[a], p.z - c->axle_z), 0.02);
        return d;
    case MARK_WHEEL:
        return round_both(hypot(p.x - m->a[0], p.z - m->a[1]) - m->a[2], m->a[3] - y, 0.03);
    case MARK_CABIN:
        return fmax(m->a[2] - p.z, fmax(p.x - m->a[0], m->a[1] - p.x));
    }
    return 1;
}

struct form mark_form(const struct mark *mark) { return (struct form){ mark_at, mark }; }

struct mark mark_outline(const struct coach *coach, enum mark_kind kind, const struct corner *corner, int count)
{
    struct mark m = { .coach = coach, .kind = kind, .a = { -1e9 } };
    outline_make(&m.outline, corner, count);
    return m;
}

struct mark mark_pane(const struct coach *coach, struct vec2 low, struct vec2 high, double pillar, double round)
{
    double u = high.x - low.x, v = high.y - low.y, length = hypot(u, v);
    return (struct mark){ .coach = coach, .kind = MARK_PANE, .a = { low.x, low.y, u / length, v / length, length, pillar, round } };
}

struct mark mark_window(const struct coach *coach, double sill, double frame, double top_z, double front_x, double front_lean, double rear_x, double rear_lean, double round)
{
    return (struct mark){ .coach = coach, .kind = MARK_WINDOW, .a = { sill, frame, front_x, front_lean, rear_x, rear_lean, round, top_z > 0 ? top_z : 1e9 } };
}

struct mark mark_door(const struct coach *coach, double bottom_z, double frame, double front_x, double front_lean, double rear_x, double rear_lean, double round)
{
    return (struct mark){ .coach = coach, .kind = MARK_DOOR, .a = { bottom_z, frame, front_x, front_lean, rear_x, rear_lean, round } };
}

struct mark mark_wheel(const struct coach *coach, int axle, double inner_y, double more_r)
{
    return (struct mark){ .coach = coach, .kind = MARK_WHEEL, .a = { coach->axle_x[axle], coach->axle_z, coach->arch_r + more_r, inner_y } };
}

struct mark mark_cabin(const struct coach *coach, double front_x, double rear_x, double floor_z)
{
    return (struct mark){ .coach = coach, .kind = MARK_CABIN, .a = { front_x, rear_x, floor_z } };
}

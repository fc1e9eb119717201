/* How people move: each at his own speed and place on the width, stepping aside for others in time. */
#include "gen/motion/crowd.h"

#include <math.h>
#include <stddef.h>

#define WIDEST_M 1.5          /* nobody strays farther from the middle of a wide path */
#define EDGE_M 0.02
#define AHEAD_M 7.0
#define ONCOMING_M 12.0       /* nobody overtakes on the left with one coming this near */
#define SPACE_M 0.08          /* beside each other */
#define TOUCHING_M 0.04       /* no nearer, whatever is meant */
#define CHOICES 8             /* places to either side that are weighed */
#define TURN_RAD_S 1.5

double walk_range(const struct track *track, double width_m)
{
    return fmin(fmax((track->width_m - width_m) / 2 - EDGE_M, 0), WIDEST_M);
}

double walk_aside(double width_m)
{
    return (width_m + SPACE_M) / 2;
}

/* Another as this one sees him: x forward, y to the left in the lane's direction, speeds alike. */
struct sight { double x, y, vx, vy, length, width; };

static struct sight see(const struct body *body, const struct body *other)
{
    struct sight sight = { .length = (body->length_m + other->length_m) / 2,
                           .width = (body->width_m + other->width_m) / 2 };
    if (body->track == other->track) {
        sight.x = body->direction * (other->s_m - body->s_m);
        sight.y = other->offset_m - body->offset_m;
        sight.vx = body->direction * other->direction * other->speed_m_s;
        sight.vy = other->lateral_m_s;
        return sight;
    }
    double heading = path_at(&body->track->path, body->s_m, 0).heading_rad;
    double dx = other->p_m.x - body->p_m.x, dy = other->p_m.y - body->p_m.y;
    double turn = other->heading_rad - heading;
    sight.x = body->direction * (dx * sin(heading) + dy * cos(heading));
    sight.y = dy * sin(heading) - dx * cos(heading);
    sight.vx = body->direction * other->speed_m_s * cos(turn);
    sight.vy = -other->speed_m_s * sin(turn);
    /* Who goes across is as wide as he is long. */
    double across = fabs(sin(turn)), along = fabs(cos(turn));
    sight.length = (body->length_m + other->length_m * along + other->width_m * across) / 2;
    sight.width = (body->width_m + other->width_m * along + other->length_m * across) / 2;
    return sight;
}

/* How much one stands in the way of going on at an offset: the sooner, the more. */
static double hindrance(const struct body *body, struct sight sight, double offset)
{
    double step = offset - body->offset_m, wide = sight.width + SPACE_M;
    if (sight.x > AHEAD_M || sight.x < -sight.length) return 0;
    if (sight.x < sight.length) { /* beside: neither into him nor through him */
        bool through = fabs(sight.y) > 1e-9 && step * sight.y > 0 && fabs(step) > fabs(sight.y) - wide;
        return through || fabs(sight.y - step) < sight.width ? 20 : 0;
    }
    double closing = body->wish_m_s - sight.vx;
    if (closing < 0.05) return 0;
    double time = (sight.x - sight.length) / closing;
    if (time > 8 || fabs(sight.y + sight.vy * fmin(time, 2) - step) >= wide) return 0;
    return 2 / (0.3 + time);
}

static bool is_met(const struct crowd *crowd, const struct body *body)
{
    for (size_t i = 0; i < crowd->count; i++) {
        const struct body *other = &crowd->bodies[i];
        double ahead = body->direction * (other->s_m - body->s_m);
        if (other->track == body->track && other->direction != body->direction && ahead > -other->length_m && ahead < ONCOMING_M)
            return true;
    }
    return false;
}

/* The offset to aim for: near the wished one and the present one, out of others' way. Those who meet keep
 * to the right: two rows that met face to face would stand for ever. */
static double choose_offset(const struct crowd *crowd, const struct body *body)
{
    bool right_only = is_met(crowd, body);
    double least = walk_aside(body->width_m);
    double range = walk_range(body->track, body->width_m), best = INFINITY, chosen = body->offset_m;
    for (int k = -CHOICES; k <= CHOICES; k++) {
        double offset = range * k / CHOICES, off = offset - body->wish_offset_m, worst = 0;
        if (right_only && -body->direction * offset < fmin(least, range)) continue;
        for (size_t i = 0; i < crowd->count; i++) {
            const struct body *other = &crowd->bodies[i];
            if (other == body || !other->is_person) continue;
            if (hypot(other->p_m.x - body->p_m.x, other->p_m.y - body->p_m.y) > AHEAD_M + 2) continue;
            worst = fmax(worst, hindrance(body, see(body, other), offset));
        }
        double cost = 0.5 * off * off + 0.3 * fabs(offset - body->offset_m) + 0.15 * fabs(offset - body->aim_offset_m) + worst;
        if (cost < best) {
            best = cost;
            chosen = offset;
        }
        if (range <= 0) break;
    }
    return chosen;
}

/* As fast as those allow who are right ahead, and the crossing. */
static double allowed_speed(const struct crowd *crowd, const struct body *body)
{
    double v = body->wish_m_s;
    for (size_t i = 0; i < crowd->count; i++) {
        const struct body *other = &crowd->bodies[i];
        if (other == body || !other->is_person) continue;
        if (hypot(other->p_m.x - body->p_m.x, other->p_m.y - body->p_m.y) > AHEAD_M) continue;
        struct sight sight = see(body, other);
        if (sight.x <= 0 || fabs(sight.y) > sight.width + SPACE_M / 2) continue;
        double gap = sight.x - sight.length;
        v = fmin(v, fmax(0, fmax(sight.vx, 0) + (gap - 0.3) / (sight.vx < 0 ? 1.6 : 0.8)));
    }
    return fmin(v, sqrt(2 * fmax(0, crossing_room(crowd, body) - 0.15)));
}

static bool is_free(const struct crowd *crowd, const struct body *was, const struct body *now)
{
    for (size_t i = 0; i < crowd->count; i++) {
        const struct body *other = &crowd->bodies[i];
        if (!other->is_person || other == was || !bodies_touch(now, other, TOUCHING_M)) continue;
        return false;
    }
    return true;
}

/* One step at these speeds, the lane's own bend taken into account. */
static struct body stepped(const struct body *body, double speed, double lateral)
{
    struct body now = *body;
    double bend = path_at(&body->track->path, body->s_m, 0).curvature;
    now.speed_m_s = speed;
    now.lateral_m_s = lateral;
    now.s_m += body->direction * speed * CROWD_STEP_S / fmax(1 - bend * body->offset_m, 0.3);
    now.offset_m += lateral * CROWD_STEP_S;
    now.gone_m += hypot(speed, lateral) * CROWD_STEP_S;
    double heading = body->heading_rad;
    body_place(&now);
    double turn = remainder(now.heading_rad - heading, 2 * M_PI), most = TURN_RAD_S * CROWD_STEP_S;
    now.heading_rad = heading + fmin(fmax(turn, -most), most);
    return now;
}

static void walk(const struct crowd *crowd, struct body *body)
{
    body->aim_offset_m = choose_offset(crowd, body);
    double v = body->speed_m_s, change = (allowed_speed(crowd, body) - v) / 0.3;
    v = fmax(0, v + fmin(fmax(change, -3), 1) * CROWD_STEP_S);
    v = fmin(v, fmax(0, crossing_room(crowd, body) - 0.1) / CROWD_STEP_S);
    double most = 0.1 + 0.3 * v, lateral = (body->aim_offset_m - body->offset_m) / 0.7;
    change = fmin(fmax(lateral, -most), most) - body->lateral_m_s;
    lateral = body->lateral_m_s + fmin(fmax(change, -1.2 * CROWD_STEP_S), 1.2 * CROWD_STEP_S);

    const double tries[4][2] = { { v, lateral }, { v, 0 }, { 0, lateral }, { 0, 0 } };
    struct body now = *body;
    for (int k = 0; k < 4; k++) {
        now = stepped(body, tries[k][0], tries[k][1]);
        if (k == 3) now.heading_rad = body->heading_rad; /* who stands does not turn into another */
        if (k == 3 || is_free(crowd, body, &now)) break;
    }
    *body = now;
    body->left = body_progress(body) + body->length_m / 2 >= body_end(body);
}

void crowd_walk(struct crowd *crowd)
{
    for (size_t i = 0; i < crowd->count; i++)
        if (crowd->bodies[i].is_person) walk(crowd, &crowd->bodies[i]);
}

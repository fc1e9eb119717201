/* How people move: each at his own speed and place on the width, stepping aside for others in time.
 * Those on other tracks are none of their business: crossings keep them apart. */
#include "gen/motion/crowd.h"

#include <math.h>
#include <stddef.h>

#define WIDEST_M 1.5          /* nobody strays farther from the middle of a wide path */
#define EDGE_M 0.02
#define AHEAD_M 7.0
#define SPACE_M 0.04          /* beside each other */
#define BEHIND_M 0.2          /* in file */
#define CHOICES 8             /* places to either side that are weighed */
#define ASIDE_RAD 0.2         /* a sidestep turns one by no more */
#define SLOW_M_S 0.4          /* slower than this a sidestep turns one less */
#define TURN_RAD_S 1.5
#define ACCELERATION_M_S2 1.0
#define BRAKING_M_S2 3.0
#define LATERAL_M_S2 1.2

/* The room that one needs along and across, whichever way he is turned in a sidestep: who is turned
 * must not lock himself between others. */
static double berth_length(const struct body *body)
{
    return body->length_m * cos(ASIDE_RAD) + body->width_m * sin(ASIDE_RAD);
}
static double berth_width(double length_m, double width_m)
{
    return width_m * cos(ASIDE_RAD) + length_m * sin(ASIDE_RAD);
}

double walk_range(const struct track *track, double width_m)
{
    return fmin(fmax((track->width_m - width_m) / 2 - EDGE_M, 0), WIDEST_M);
}

double walk_aside(double length_m, double width_m)
{
    return (berth_width(length_m, width_m) + SPACE_M) / 2;
}

/* Another on the track as this one sees him: x forward, y to the left of the track, speeds alike. */
struct sight { double x, y, vx, vy, length, width; };

static bool see(struct sight *sight, const struct body *body, const struct body *other)
{
    if (other->id == body->id || other->track != body->track || fabs(other->s_m - body->s_m) > 2 * AHEAD_M) return false;
    /* On the inside of a bend the track's length is less of a way. */
    double bend = path_at(&body->track->path, (body->s_m + other->s_m) / 2, 0).curvature;
    double way = fmax(1 - bend * (body->offset_m + other->offset_m) / 2, 0.3);
    *sight = (struct sight){
        .x = body->direction * (other->s_m - body->s_m) * way,
        .y = other->offset_m - body->offset_m,
        .vx = body->direction * other->direction * other->speed_m_s,
        .vy = other->lateral_m_s,
        .length = (berth_length(body) + berth_length(other)) / 2,
        .width = (berth_width(body->length_m, body->width_m) + berth_width(other->length_m, other->width_m)) / 2,
    };
    return true;
}

bool walkers_touch(const struct body *a, const struct body *b, double along_m)
{
    struct sight sight;
    return see(&sight, a, b) && fabs(sight.x) < sight.length + along_m && fabs(sight.y) < sight.width;
}

/* How much one stands in the way of going on at an offset: the sooner, the more. */
static double hindrance(const struct body *body, struct sight sight, double offset)
{
    double step = offset - body->offset_m, wide = sight.width + SPACE_M;
    if (sight.x > AHEAD_M || sight.x < -sight.length) return 0;
    if (sight.x < sight.length) { /* beside: neither into him nor through him */
        bool through = step * sight.y > 0 && fabs(step) > fabs(sight.y) - sight.width;
        return through ? 20 : 0;
    }
    double closing = body->wish_m_s - sight.vx;
    if (closing < 0.05) return 0;
    double time = (sight.x - sight.length) / closing;
    if (time > 8 || fabs(sight.y + sight.vy * fmin(time, 2) - step) >= wide) return 0;
    return 2 / (0.3 + time);
}

/* Does anybody come towards him, however far? */
static bool is_met(const struct crowd *crowd, const struct body *body)
{
    for (size_t i = 0; i < crowd->count; i++) {
        const struct body *other = &crowd->bodies[i];
        if (other->track == body->track && other->direction != body->direction &&
            body->direction * (other->s_m - body->s_m) > -berth_length(other))
            return true;
    }
    return false;
}

/* The offset to aim for: near the wished one and the present one, out of others' way. Those who meet keep to
 * their right half. Only with nobody ahead is the other half free for overtaking: so no two who overtake
 * ever come face to face with others beside them, to stand for ever. */
static double choose_offset(const struct crowd *crowd, const struct body *body)
{
    double range = walk_range(body->track, body->width_m), best = INFINITY, chosen = body->offset_m;
    double least = is_met(crowd, body) ? fmin(walk_aside(body->length_m, body->width_m), range) : -range;
    for (int k = -CHOICES; k <= CHOICES; k++) {
        double offset = range * k / CHOICES, off = offset - body->wish_offset_m, worst = 0;
        if (-body->direction * offset < least) continue;
        for (size_t i = 0; i < crowd->count; i++) {
            struct sight sight;
            if (see(&sight, body, &crowd->bodies[i])) worst = fmax(worst, hindrance(body, sight, offset));
        }
        double cost = 0.5 * off * off + 0.3 * fabs(offset - body->offset_m) + 0.15 * fabs(offset - body->aim_offset_m) + worst;
        if (cost < best) {
            best = cost;
            chosen = offset;
        }
    }
    return chosen;
}

/* As fast as those allow who are right ahead, and the crossing. */
static double allowed_speed(const struct crowd *crowd, const struct body *body)
{
    double v = fmin(body->wish_m_s, walk_first_speed(crowd, body));
    for (size_t i = 0; i < crowd->count; i++) {
        struct sight sight;
        if (!see(&sight, body, &crowd->bodies[i])) continue;
        if (sight.x <= 0 || sight.x > AHEAD_M || fabs(sight.y) >= sight.width) continue;
        double gap = sight.x - sight.length, share = sight.vx < 0 ? 1.6 : 0.8;
        v = fmin(v, fmax(0, fmax(sight.vx, 0) + (gap - BEHIND_M) / share));
    }
    return v;
}

double walk_first_speed(const struct crowd *crowd, const struct body *body)
{
    return fmin(body->wish_m_s, sqrt(2 * ACCELERATION_M_S2 * fmax(0, crossing_room(crowd, body) - 0.15)));
}

static bool is_free(const struct crowd *crowd, const struct body *body)
{
    for (size_t i = 0; i < crowd->count; i++)
        if (walkers_touch(body, &crowd->bodies[i], 0)) return false;
    return true;
}

/* One step at these speeds, the track's own bend taken into account. */
static struct body stepped(const struct body *body, double speed, double lateral)
{
    struct body now = *body;
    double bend = path_at(&body->track->path, body->s_m, 0).curvature;
    now.speed_m_s = speed;
    now.lateral_m_s = lateral;
    now.s_m += body->direction * speed * CROWD_STEP_S / fmax(1 - bend * body->offset_m, 0.3);
    now.offset_m += lateral * CROWD_STEP_S;
    now.gone_m += hypot(speed, lateral) * CROWD_STEP_S;
    body_place(&now);
    double aside = body->direction * atan2(lateral, fmax(speed, SLOW_M_S));
    double turn = remainder(now.heading_rad - aside - body->heading_rad, 2 * M_PI), most = TURN_RAD_S * CROWD_STEP_S;
    now.heading_rad = body->heading_rad + fmin(fmax(turn, -most), most);
    return now;
}

static double held_to(double value, double most) { return fmin(fmax(value, -most), most); }

static void walk(const struct crowd *crowd, struct body *body)
{
    body->aim_offset_m = choose_offset(crowd, body);
    double v = body->speed_m_s, change = (allowed_speed(crowd, body) - v) / 0.3;
    v = fmax(0, v + fmin(fmax(change, -BRAKING_M_S2), ACCELERATION_M_S2) * CROWD_STEP_S);
    v = fmin(v, fmax(0, crossing_room(crowd, body) - 0.1) / CROWD_STEP_S);
    double lateral = held_to((body->aim_offset_m - body->offset_m) / 0.7, tan(ASIDE_RAD) * fmax(v, SLOW_M_S));
    lateral = body->lateral_m_s + held_to(lateral - body->lateral_m_s, LATERAL_M_S2 * CROWD_STEP_S);

    /* Less and less of what is meant, until nobody is touched. */
    const double tries[4][2] = { { v, lateral }, { v, 0 }, { 0, lateral }, { 0, 0 } };
    struct body now = *body;
    for (int k = 0; k < 4; k++) {
        now = stepped(body, tries[k][0], tries[k][1]);
        if (is_free(crowd, &now)) break;
    }
    *body = now;
    body->left = body_progress(body) + body->length_m / 2 >= body_end(body);
}

void crowd_walk(struct crowd *crowd)
{
    for (size_t i = 0; i < crowd->count; i++)
        if (crowd->bodies[i].is_person) walk(crowd, &crowd->bodies[i]);
}

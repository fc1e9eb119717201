/* How vehicles move: the intelligent driver model, along one lane.
 * Src: Treiber, Hennecke, Helbing 2000, Congested traffic states in empirical observations and
 *      microscopic simulations, Phys. Rev. E 62, 1805 */
#include "gen/motion/crowd.h"

#include <math.h>
#include <stddef.h>

#define ACCELERATION_M_S2 1.5
#define BRAKING_M_S2 1.7      /* comfortable */
#define FIRST_BRAKING_M_S2 0.5 /* of one that appears */
#define HEADWAY_S 1.4
#define LINE_GAP_M 0.5        /* before a crossing that is taken */
#define TOUCHING_M 0.5        /* no nearer, whatever the model says */

static const struct body *leader_of(const struct crowd *crowd, const struct body *body)
{
    const struct body *leader = NULL;
    for (size_t i = 0; i < crowd->count; i++) {
        const struct body *other = &crowd->bodies[i];
        if (other->track == body->track && other->s_m > body->s_m && (!leader || other->s_m < leader->s_m)) leader = other;
    }
    return leader;
}

static double gap_between(const struct body *body, const struct body *leader)
{
    return leader->s_m - body->s_m - (leader->length_m + body->length_m) / 2;
}

/* The model's braking for what is gap_m ahead and comes nearer at closing_m_s. */
static double yield_m_s2(double speed_m_s, double closing_m_s, double gap_m)
{
    double wanted = STANDING_GAP_M + fmax(0, speed_m_s * HEADWAY_S + speed_m_s * closing_m_s /
                                                                         (2 * sqrt(ACCELERATION_M_S2 * BRAKING_M_S2)));
    double ratio = wanted / fmax(gap_m, 0.1);
    return ACCELERATION_M_S2 * ratio * ratio;
}

static double wished_speed(const struct body *body)
{
    return fmin(body->wish_m_s, body->wish_share * track_limit(body->track, body->s_m));
}

static double acceleration(const struct crowd *crowd, const struct body *body, const struct body *leader)
{
    double v = body->speed_m_s, ratio = v / wished_speed(body), yield = 0;
    if (leader) yield = yield_m_s2(v, v - leader->speed_m_s, gap_between(body, leader));
    /* A line to stop at is a vehicle that stands a little farther on. */
    double room = crossing_room(crowd, body);
    if (isfinite(room)) yield = fmax(yield, yield_m_s2(v, v, room + STANDING_GAP_M - LINE_GAP_M));
    return fmax(ACCELERATION_M_S2 * (1 - ratio * ratio * ratio * ratio), -BRAKING_M_S2) - yield;
}

double drive_first_speed(const struct crowd *crowd, const struct body *body)
{
    struct body asking = *body;
    const struct body *leader = leader_of(crowd, body);
    double slow = 0, fast = fmin(wished_speed(body), track_bend_speed(body->track, body->s_m));
    for (int k = 0; k < 20; k++) {
        asking.speed_m_s = k == 0 ? fast : (slow + fast) / 2;
        if (acceleration(crowd, &asking, leader) < -FIRST_BRAKING_M_S2) fast = asking.speed_m_s;
        else slow = asking.speed_m_s;
    }
    return slow;
}

static void drive(const struct crowd *crowd, struct body *body)
{
    const struct body *leader = leader_of(crowd, body);
    double v = fmax(0, body->speed_m_s + acceleration(crowd, body, leader) * CROWD_STEP_S);
    v = fmin(v, track_bend_speed(body->track, body->s_m + v * CROWD_STEP_S));
    double room = crossing_room(crowd, body);
    if (leader) room = fmin(room, gap_between(body, leader) - TOUCHING_M);
    v = fmin(v, fmax(0, room) / CROWD_STEP_S);
    body->speed_m_s = v;
    body->s_m += v * CROWD_STEP_S;
    body->gone_m += v * CROWD_STEP_S;
    body_place(body);
    body->left = body->s_m + body->length_m / 2 >= body->track->end_m;
}

/* Everybody sees where the others were before or are after the step: a leader never goes back, so that
 * neither brings a follower too near. */
void crowd_drive(struct crowd *crowd)
{
    for (size_t i = 0; i < crowd->count; i++)
        if (!crowd->bodies[i].is_person) drive(crowd, &crowd->bodies[i]);
}

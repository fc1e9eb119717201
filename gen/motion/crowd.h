/* Everybody who is about at one moment, and what they need to know of each other. */
#ifndef STAFFAGE_GEN_CROWD_H
#define STAFFAGE_GEN_CROWD_H

#include "gen/motion/crossing.h"
#include "gen/motion/track.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define CROWD_STEP_S 0.05

struct body {
    uint16_t id;
    bool is_person;
    double length_m, width_m;
    const struct track *track;
    int direction;              /* 1; -1: a person who walks against the track */
    double s_m, offset_m;       /* of the middle: along the track, and to its left */
    double speed_m_s;           /* forward */
    double lateral_m_s;         /* of the offset */
    double wish_m_s;            /* a person's speed; a vehicle's where no law holds it lower */
    double wish_share;          /* a vehicle's speed as a share of the law's */
    double wish_offset_m;
    double aim_offset_m;        /* where a person is stepping to */
    double gone_m;
    struct vec2 p_m;            /* world */
    double heading_rad;
    bool left;                  /* came to the end of its track */
    /* Crossings of the track in the order in which it comes to them: it holds held_from to held_to - 1
     * and stands in the queue for held_to when its ticket is not 0. */
    size_t held_from, held_to;
    uint64_t ticket;
};

struct crowd {
    struct body *bodies;        /* (count) by id */
    size_t count;
    struct track *tracks;       /* (track_count) */
    size_t track_count;
    struct crossings crossings;
    uint64_t tickets;
};

/* How far a body is on its way: s_m seen in its own direction. */
static inline double body_progress(const struct body *body) { return body->direction * body->s_m; }
/* Where the body must be gone. */
static inline double body_end(const struct body *body)
{
    return body->direction > 0 ? body->track->end_m : -body->track->begin_m;
}
/* Set p_m and heading_rad from the place on the track. */
void body_place(struct body *body);

/* One step of everybody's, from crossings to leaving: the vehicles' (drive.c) and the people's (walk.c). */
void crowd_drive(struct crowd *crowd);
void crowd_walk(struct crowd *crowd);

/* How fast a body may begin at its place: no faster than it can keep up. */
double drive_first_speed(const struct crowd *crowd, const struct body *body);
double walk_first_speed(const struct crowd *crowd, const struct body *body);

/* How far from the middle of its track a person this wide may be. */
double walk_range(const struct track *track, double width_m);
/* How far to his right one is who passes another that does as much; a track with less range is walked one way. */
double walk_aside(double length_m, double width_m);
/* Do two people on a track need the same room, along_m more of it along? */
bool walkers_touch(const struct body *a, const struct body *b, double along_m);

#endif

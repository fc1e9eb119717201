/* Who drives and walks where, at any moment: a scenario made by a seed.
 *
 * Vehicles follow the lanes of the network at a set speed, slow down in bends, keep their distance
 * (intelligent driver model); people walk along footways and sidewalks in both directions and out of step. Where
 * lanes come too near each other, who comes first goes first. Who leaves at the end of a lane
 * is followed by a new one elsewhere, so that `count` are about at any time. It is computed once, in
 * small steps, and read at any time: the same for any order of frames. */
#ifndef STAFFAGE_GEN_TRAFFIC_H
#define STAFFAGE_GEN_TRAFFIC_H

#include "gen/world/road.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* One kind of vehicle or person to choose from. */
struct mover_kind {
    size_t model;            /* the caller's index */
    double weight;           /* > 0: how often it is drawn */
    double length_m, width_m;
};
struct traffic_options {
    const struct mover_kind *vehicles, *people; /* (vehicle_kinds), (people_kinds) borrowed */
    size_t vehicle_kinds, people_kinds;
    size_t vehicle_count, people_count;         /* about at any time */
    double vehicle_speed_m_s, people_speed_m_s; /* mean wished speed; each has his own, people 15 % spread, vehicles 10 % */
    double lateral_m_s2;     /* comfort in bends: v^2 * curvature at most this; 2 */
    size_t color_count;      /* colours are numbered; 0: none is drawn */
    uint16_t first_id;       /* of the first mover */
    uint64_t seed;
};

struct traffic;

/* In:  begin_s to end_s: the time that will be asked for
 * Err: ERR_INPUT without a place: vehicles or people wanted and no lane for them; more than fit onto the lanes
 *      (says how many would) */
bool traffic_create(struct traffic **traffic, const struct road_network *roads, const struct traffic_options *options,
                    double begin_s, double end_s, struct error *err);
void traffic_destroy(struct traffic *traffic);

/* One of them at a moment. */
struct mover {
    uint16_t id;             /* the same through the scenario; never given twice */
    bool is_person;
    size_t kind;             /* index into vehicles or people */
    int color;               /* -1: none */
    struct vec2 p_m;         /* middle of the body, world */
    double heading_rad;      /* clockwise from +y */
    double speed_m_s, wish_m_s; /* as it goes now; as it would where nothing is in its way */
    double distance_m;       /* gone since it appeared: drives its gait */
    double phase;            /* 0..1: people are out of step */
};
/* All ids that appear within [begin_s, end_s]: ids run from first_id to first_id + count - 1. */
size_t traffic_mover_count(const struct traffic *traffic);
/* Who is there at t_s, by id.
 * Out: movers (traffic_mover_count at most). Returns how many. */
size_t traffic_at(const struct traffic *traffic, struct mover *movers, double t_s);

#endif

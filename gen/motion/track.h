/* What one follows: a lane as a curve of its own, joined with the lanes that go on from it. */
#ifndef STAFFAGE_GEN_TRACK_H
#define STAFFAGE_GEN_TRACK_H

#include "gen/world/road.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

#define TRACK_STEP_M 0.5

struct track {
    enum road_use use;
    struct path path;             /* in the direction of driving; people walk both ways */
    double width_m;               /* of the narrowest lane in it */
    double begin_m, end_m;        /* the part that is used; bodies stay within it wholly */
    double *limit_m_s;            /* (samples) at every TRACK_STEP_M: the law's, INFINITY where none is known */
    double *bend_m_s;             /* (samples) as fast as bends allow, here or so soon that one must brake */
    size_t samples;
    size_t crossing_first, crossing_count; /* in the crowd's crossings, ascending along the track */
};

/* All lanes of a network as tracks. Lanes that end where another begins, in the same direction, are one.
 * In:  lateral_m_s2: v^2 * curvature at most; braking_m_s2: how hard one brakes for a bend
 * Out: tracks (*count), each to be released and the array freed by the caller */
bool tracks_create(struct track **tracks, size_t *count, const struct road_network *roads, double lateral_m_s2,
                   double braking_m_s2, struct error *err);
void tracks_destroy(struct track *tracks, size_t count);

double track_limit(const struct track *track, double s_m);
/* Between samples: as the braking goes, v^2 is linear along the track. */
double track_bend_speed(const struct track *track, double s_m);
/* The tightest bends to the left and to the right (1/m, 0: none) within around_m of s_m. */
void track_bends(const struct track *track, double *left, double *right, double s_m, double around_m);

#endif

/* How one on foot goes a way: from rest or already on it, at one speed, to rest at its end. */
#ifndef STAFFAGE_GEN_JOURNEY_H
#define STAFFAGE_GEN_JOURNEY_H

#include <stdbool.h>

struct journey {
    double length_m;        /* to where he stands, at least 0 */
    double speed_m_s;       /* on the way, above 0; less where the way is too short for it */
    bool from_rest;         /* at time 0 he sets out; otherwise he is on his way, and was before */
};

/* At a time: the way gone (below 0 before time 0, if he was on his way), how fast he goes, and how long he has been at rest or
 * yet will be (below 0: in so long he will be, or so long ago he was). */
struct journey_now { double gone_m, speed_m_s, rest_s; };
struct journey_now journey_at(const struct journey *journey, double time_s);

#endif

/* What a rigged model can do, and which of it suits a speed: standing, walking slowly, walking, running. */
#ifndef STAFFAGE_GEN_REPERTOIRE_H
#define STAFFAGE_GEN_REPERTOIRE_H

#include "gen/model/model.h"
#include "gen/model/rig.h"
#include "gen/motion/gait.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

enum pace { PACE_STAND, PACE_SLOW_WALK, PACE_WALK, PACE_RUN, PACE_COUNT };

/* Animations are known by the words in their names: stand, idle; walk, with slow; run, jog. Where none has such a
 * name, the first is for all speeds. */
struct repertoire {
    bool has[PACE_COUNT];
    size_t animation[PACE_COUNT];
    struct gait gait[PACE_COUNT];   /* of those that there are */
    double run_m_s;                 /* faster than this one runs */
};

/* Err: ERR_INPUT at the model's path, as gait_create */
bool repertoire_create(struct repertoire *repertoire, const struct model *model, struct error *err);
void repertoire_release(struct repertoire *repertoire);

/* Who moves at a speed that he would like to go at, or a part of it. */
struct pace_now {
    double speed_m_s, wish_m_s;
    double distance_m;              /* gone; below 0: backwards */
    double phase;                   /* 0..1: who is out of step with others */
    double time_s;
};
/* What the model does then. Who goes at his wished speed keeps to one animation; who comes to a halt passes over
 * into standing on the last of his way. */
struct posture repertoire_posture(const struct repertoire *repertoire, const struct pace_now *now);

#endif

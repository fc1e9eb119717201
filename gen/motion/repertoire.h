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

/* Animations are known by the words in their names: stand, idle; walk, with slow; run, jog; halt. Where none has such a
 * name, the first is for all speeds. */
struct repertoire {
    bool has[PACE_COUNT];
    size_t animation[PACE_COUNT];
    struct gait gait[PACE_COUNT];   /* of those that there are */
    double run_m_s;                 /* faster than this one runs */
    bool halts;
    double halt_s;
    size_t halt;                    /* from the middle of a step to where standing begins, played once */
};

/* Err: ERR_INPUT at the model's path, as gait_create */
bool repertoire_create(struct repertoire *repertoire, const struct model *model, struct error *err);
void repertoire_release(struct repertoire *repertoire);

/* Of the animation for who is on his way at a speed that he likes. */
const struct gait *repertoire_gait(const struct repertoire *repertoire, double speed_m_s);

/* Who moves at a speed that he would like to go at, or a part of it. */
struct pace_now {
    double speed_m_s, wish_m_s;
    double distance_m;              /* gone; below 0: backwards */
    double phase;                   /* 0..1: who is out of step with others */
    double time_s;
};
/* How much he stands, 0 to 1, as far as speeds tell: who goes at his wished speed does not, and who comes to a halt does so more
 * and more on the last of his way. */
double pace_stands(const struct pace_now *now);
/* What the model does then. Who is on his way keeps to one animation.
 * In: stands  0 to 1: how much of it is standing */
struct posture repertoire_posture(const struct repertoire *repertoire, const struct pace_now *now, double stands);
/* What one does who comes to rest where his gait meets standing, or sets out from there.
 * In: rest_s  how long he has been at rest, or yet will be; below 0: in so long he will be, or so long ago he was */
struct posture repertoire_rest(const struct repertoire *repertoire, const struct pace_now *now, double rest_s);

#endif

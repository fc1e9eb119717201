/* How a rigged model walks: its own animations, played by the distance gone, so that no foot slides. */
#ifndef STAFFAGE_GEN_GAIT_H
#define STAFFAGE_GEN_GAIT_H

#include "gen/model/model.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Of one animation: what the body must move forward, at each time of the loop, for the planted
 * foot to stay where it is. */
struct gait {
    double duration_s;    /* of one loop of the animation */
    double stride_m;      /* gone in one loop */
    double *advance_m;    /* (samples + 1) distance gone at times i / samples * duration, 0 to stride_m, ascending */
    int samples;
    bool walks;           /* false: feet stay (somebody stands): time runs by itself */
    /* Where in the loop, as way from its beginning, both feet are nearest to those of who comes to stand; and how far to the
     * left he must be for the foot on the ground to be the same. */
    double meet_m, meet_aside_m;
};

/* Measure one of the model's animations.
 * In:  standing  the same model as it begins to stand, or NULL: nowhere is nearest
 * Err: ERR_INPUT at the model's path: it has no animation; no foot is ever on the ground; it walks
 *      backwards, so that its front axis cannot be right */
bool gait_create(struct gait *gait, const struct model *model, size_t animation, const struct model *standing, struct error *err);
void gait_release(struct gait *gait);
/* The animation's time (0 to duration_s) after a distance, from a phase (0..1) of the loop. For whom
 * stays it is the phase's time alone: add the time that passes, model_pose loops it. */
double gait_time(const struct gait *gait, double distance_m, double phase);

#endif

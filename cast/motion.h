/* Motion on the spot: loops of walking, running, standing; and the step that brings one from walking to standing. */
#ifndef STAFFAGE_CAST_MOTION_H
#define STAFFAGE_CAST_MOTION_H

#include "cast/body.h"
#include "cast/feet.h"
#include "cast/person.h"

enum motion { WALK, SLOW_WALK, RUN, STAND, HALT, MOTION_COUNT };
enum { MOST_KEYS = 48 };

struct clip {
    const char *name;
    double duration_s, stride_m;                  /* stride: what a loop goes; 0: nowhere */
    int keys;                                     /* and one more, which in a loop is the first again */
    struct quat turn[JOINT_COUNT][MOST_KEYS + 1]; /* of a joint against its parent */
    struct vec3 hips[MOST_KEYS + 1];
};

/* In: sole (2) of the left and the right shoe */
void make_clip(struct clip *clip, enum motion motion, const struct person *person, const struct body *body, const struct sole *sole);

#endif

/* A loop of a walk on the spot: two steps, with feet that roll over the ground as it passes by. */
#ifndef STAFFAGE_CAST_WALK_H
#define STAFFAGE_CAST_WALK_H

#include "cast/mesh.h"
#include "cast/skeleton.h"

enum { WALK_KEYS = 48 };

struct walk {
    double duration_s;
    struct quat turn[JOINT_COUNT][WALK_KEYS + 1]; /* of a joint against its parent; the last key is the first */
    struct vec3 hips[WALK_KEYS + 1];              /* body measures */
};

/* The shoes of the model, in READY stance, are what touches the ground. */
void make_walk(struct walk *walk, const struct skeleton *skeleton, const struct model *model);

#endif

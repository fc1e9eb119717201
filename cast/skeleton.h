/* The joints of a person, and how skin and cloth follow them. */
#ifndef STAFFAGE_CAST_SKELETON_H
#define STAFFAGE_CAST_SKELETON_H

#include "lib/vec.h"
#include "cast/mesh.h"

/* The trunk, then the same limbs on the left and on the right: LIMB(side, THIGH), side 0 is left. */
enum joint { HIPS, SPINE, CHEST, HEAD, LIMBS };
enum limb { UPPER_ARM, FOREARM, HAND, THIGH, SHIN, FOOT, TOES, LIMB_COUNT };
#define LIMB(side, limb) ((int)LIMBS + (side) * LIMB_COUNT + (int)(limb))
enum { JOINT_COUNT = LIMBS + 2 * LIMB_COUNT };

/* In the body's own measures: about 1.78 m high. All joints are bound without a turn. */
struct skeleton {
    struct vec3 at[JOINT_COUNT];
    double scale, ground_z;  /* a point of the model is (p - (0, 0, ground_z)) * scale */
    double stride;           /* of a walk's loop, two steps */
};

extern const char *const walker_joint_name[JOINT_COUNT];
int walker_joint_parent(int joint); /* -1 for HIPS; less than the joint */

struct binding { int joint[4]; double weight[4]; }; /* weights sum to 1 */
struct binding walker_bind_point(const struct skeleton *skeleton, enum part part, struct vec3 p);

#endif

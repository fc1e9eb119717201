/* A body's posture in the making: how each joint is turned. */
#ifndef STAFFAGE_CAST_POSE_H
#define STAFFAGE_CAST_POSE_H

#include "cast/body.h"
#include "cast/hull.h"
#include "cast/person.h"

struct body_pose { struct mat3 turn[JOINT_COUNT]; struct vec3 hips; }; /* against the world; where HIPS is */

static inline double radians(double deg) { return deg * M_PI / 180; }

/* A turn about the left axis that lifts what points forward; and the other two. */
static inline struct mat3 lift(double angle) { return mat3_from_quat((struct quat){ cos(angle / 2), 0, -sin(angle / 2), 0 }); }
static inline struct mat3 turn_left(double angle) { return mat3_from_quat((struct quat){ cos(angle / 2), 0, 0, sin(angle / 2) }); }
static inline struct mat3 lean_right(double angle) { return mat3_from_quat((struct quat){ cos(angle / 2), sin(angle / 2), 0, 0 }); }
static inline struct mat3 then(struct mat3 outer, struct mat3 inner) { return mat3_multiply(outer, inner); }

/* A share of the way from one turn to another. */
struct mat3 turn_between(struct mat3 a, struct mat3 b, double share);

/* Two bones from a joint whose place is `from` to a target, which stay as long as they are: the joint between them points to `middle`.
 * Turns `upper` and `lower`, which begin at those joints; `lower` ends at `end`. In: middle_bound  where it points as bound */
void pose_bones(struct body_pose *pose, const struct body *body, int upper, int lower, int end, struct vec3 from, struct vec3 target, struct vec3 middle,
                struct vec3 middle_bound);
/* Joints that take half of a bend. */
void pose_halves(struct body_pose *pose);
/* Where joints are. Out: at (JOINT_COUNT) takes a point, seen from a joint as bound, to where it is */
void pose_joints(struct pose at[JOINT_COUNT], const struct body_pose *pose, const struct body *body);
/* Where a joint is whose parents' turns are known. */
struct vec3 pose_place(const struct body_pose *pose, const struct body *body, int joint);
/* A point of a garment where the joints take it. */
struct vec3 pose_point(const struct pose at[JOINT_COUNT], const struct body *body, const struct garment *garment, struct vec3 p);

#endif

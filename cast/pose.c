#include "cast/pose.h"

static struct mat3 frame(struct vec3 along, struct vec3 hinge) { return mat3_from_columns(along, hinge, vec3_cross(along, hinge)); }

void pose_bones(struct body_pose *pose, const struct body *b, int upper, int lower, int end, struct vec3 from, struct vec3 target, struct vec3 middle,
                struct vec3 middle_bound)
{
    const struct vec3 *at = b->at;
    struct vec3 first = vec3_sub(at[lower], at[upper]), second = vec3_sub(at[end], at[lower]), way = vec3_sub(target, from);
    double a = vec3_norm(first), c = vec3_norm(second), length = fmin(vec3_norm(way), 0.9995 * (a + c));
    struct vec3 hinge_bound = vec3_unit(vec3_cross(middle_bound, vec3_unit(vec3_sub(at[end], at[upper]))));
    struct vec3 down = vec3_unit(way), hinge = vec3_unit(vec3_cross(middle, down)), front = vec3_cross(down, hinge);
    double angle = acos(fmin(fmax((a * a + length * length - c * c) / (2 * a * length), -1), 1));
    struct vec3 now = vec3_add(vec3_scale(down, cos(angle)), vec3_scale(front, sin(angle)));
    struct vec3 then_now = vec3_unit(vec3_sub(vec3_scale(down, length), vec3_scale(now, a)));
    pose->turn[upper] = then(frame(now, hinge), mat3_transpose(frame(vec3_unit(first), hinge_bound)));
    pose->turn[lower] = then(frame(then_now, hinge), mat3_transpose(frame(vec3_unit(second), hinge_bound)));
}

struct mat3 turn_between(struct mat3 a, struct mat3 b, double share)
{
    struct quat q = quat_from_mat3(then(mat3_transpose(a), b)); /* w >= 0 */
    double half = share * acos(fmin(q.w, 1)), n = sqrt(q.x * q.x + q.y * q.y + q.z * q.z), s = n > 1e-12 ? sin(half) / n : 0;
    return then(a, mat3_from_quat((struct quat){ cos(half), s * q.x, s * q.y, s * q.z }));
}

void pose_halves(struct body_pose *pose)
{
    for (int side = 0; side < 2; side++) {
        struct mat3 *turn = &pose->turn[LIMB(side, 0)];
        turn[ELBOW] = turn_between(turn[UPPER_ARM], turn[FOREARM], 0.5);
        turn[KNEE] = turn_between(turn[THIGH], turn[SHIN], 0.5);
        turn[HIP] = turn_between(pose->turn[HIPS], turn[THIGH], 0.5);
    }
}

struct vec3 pose_place(const struct body_pose *pose, const struct body *b, int joint)
{
    int parent = joint_parent(joint);
    if (parent < 0) return pose->hips;
    return vec3_add(pose_place(pose, b, parent), mat3_apply(pose->turn[parent], vec3_sub(b->at[joint], b->at[parent])));
}

void pose_joints(struct pose at[JOINT_COUNT], const struct body_pose *pose, const struct body *b)
{
    for (int j = 0; j < JOINT_COUNT; j++) at[j] = (struct pose){ pose->turn[j], pose_place(pose, b, j) };
}

struct vec3 pose_point(const struct pose at[JOINT_COUNT], const struct body *b, const struct garment *g, struct vec3 from)
{
    double w[JOINT_COUNT] = { 0 };
    struct vec3 p = { 0, 0, 0 };
    if (g->joint >= 0) w[g->joint] = 1;
    else bind_point(w, b, from, g->drape);
    for (int j = 0; j < JOINT_COUNT; j++)
        if (w[j] > 0) p = vec3_add(p, vec3_scale(pose_apply(at[j], vec3_sub(from, b->at[j])), w[j]));
    return p;
}

#include "cast/walk.h"

#include <assert.h>
#include <stdlib.h>

/* Of a leg's loop, from where its heel comes down: until when it stands, and when it is under the body. */
#define STANDS 0.62
#define UNDER 0.255
enum { STEPS = 248, STAND_STEPS = 154 }; /* a fine grid of the loop; the foot stands for the first 62 % */
_Static_assert(STAND_STEPS * 100 >= STEPS * 62 && (STAND_STEPS - 1) * 100 < STEPS * 62, "the stand ends on the grid");

static double radians(double deg) { return deg * PI / 180; }

/* A turn about the left axis that lifts what points forward. */
static struct mat3 lift(double angle) { return mat3_from_quat((struct quat){ cos(angle / 2), 0, -sin(angle / 2), 0 }); }
static struct mat3 turn_left(double angle) { return mat3_from_quat((struct quat){ cos(angle / 2), 0, 0, sin(angle / 2) }); }
static struct mat3 lean_right(double angle) { return mat3_from_quat((struct quat){ cos(angle / 2), sin(angle / 2), 0, 0 }); }

/* A smooth closed or open curve through knots of rising x, level at each extreme (monotone cubic). */
static double through(const double (*knot)[2], int n, double x)
{
    int i = 0;
    while (i + 2 < n && x > knot[i + 1][0]) i++;
    double slope[2], h = knot[i + 1][0] - knot[i][0], rise = (knot[i + 1][1] - knot[i][1]) / h;
    for (int k = 0; k < 2; k++) {
        int at = i + k;
        double before = at > 0 ? (knot[at][1] - knot[at - 1][1]) / (knot[at][0] - knot[at - 1][0]) : rise;
        double after = at + 1 < n ? (knot[at + 1][1] - knot[at][1]) / (knot[at + 1][0] - knot[at][0]) : rise;
        slope[k] = before * after > 0 ? 2 * before * after / (before + after) : 0;
    }
    double t = (x - knot[i][0]) / h, s = 1 - t;
    return s * s * (1 + 2 * t) * knot[i][1] + t * t * (1 + 2 * s) * knot[i + 1][1] + h * s * t * (s * slope[0] - t * slope[1]);
}
#define THROUGH(knots, x) through(knots, sizeof knots / sizeof *knots, x)

/* Degrees, over a leg's loop: the foot against the ground, and the toes against the foot; up is above 0. */
static const double foot_pitch[][2] = { { 0, 20 }, { 0.09, 0 }, { 0.30, 0 }, { 0.42, -9 }, { 0.52, -30 }, { 0.62, -58 },
                                        { 0.68, -60 }, { 0.85, 2 }, { 0.94, 20 }, { 1, 20 } };
static const double toe_bend[][2] = { { 0, 4 }, { 0.09, 0 }, { 0.30, 0 }, { 0.42, 9 }, { 0.52, 28 }, { 0.62, 30 },
                                      { 0.72, 6 }, { 0.9, 6 }, { 1, 4 } };

/* --- a foot --- */

/* Points of the shoe seen from the side, from the ankle, and how much each follows the toes. */
struct sole { double (*p)[3]; size_t count; double toe[2]; };

static struct sole find_sole(const struct skeleton *skeleton, const struct model *model)
{
    struct vec3 ankle = skeleton->at[LIMB(0, FOOT)], toes = vec3_sub(skeleton->at[LIMB(0, TOES)], ankle);
    struct sole sole = { malloc(3 * model->count * sizeof *sole.p), 0, { toes.x, toes.z } };
    if (!sole.p) abort();
    for (size_t i = 0; i < 3 * model->count; i++) {
        const struct triangle *t = &model->triangles[i / 3];
        struct vec3 p = vec3_scale(t->p[i % 3], 1 / skeleton->scale);
        p.z += skeleton->ground_z;
        if (t->part != SHOE || p.y < 0) continue;
        struct binding b = walker_bind_point(skeleton, SHOE, p);
        double *to = sole.p[sole.count++];
        to[0] = p.x - ankle.x, to[1] = p.z - ankle.z, to[2] = 0;
        for (int k = 0; k < 4; k++)
            if (b.joint[k] == LIMB(0, TOES)) to[2] = b.weight[k];
    }
    return sole;
}

static void lift_2d(double out[2], double x, double z, double angle)
{
    out[0] = x * cos(angle) - z * sin(angle);
    out[1] = x * sin(angle) + z * cos(angle);
}

/* Where a point of the sole is, from the ankle. */
static void sole_point(double out[2], const struct sole *sole, size_t i, double pitch, double bend)
{
    const double *p = sole->p[i];
    double foot[2], toe[2], knuckle[2];
    lift_2d(foot, p[0], p[1], pitch);
    lift_2d(knuckle, sole->toe[0], sole->toe[1], pitch);
    lift_2d(toe, p[0] - sole->toe[0], p[1] - sole->toe[1], pitch + bend);
    for (int k = 0; k < 2; k++) out[k] = (1 - p[2]) * foot[k] + p[2] * (knuckle[k] + toe[k]);
}

static size_t lowest(double *z, const struct sole *sole, double pitch, double bend)
{
    size_t best = 0;
    *z = 1e9;
    for (size_t i = 0; i < sole->count; i++) {
        double p[2];
        sole_point(p, sole, i, pitch, bend);
        if (p[1] < *z) *z = p[1], best = i;
    }
    return best;
}

struct step { double x, z, pitch, bend; }; /* of an ankle, under a body that stays */

/* The foot lies flat under the body; from there it rolls over its lowest point, forward and back in time. */
static void stand(struct step *step, const struct sole *sole, double stride, double ground_z, double under_x)
{
    int flat = (int)(UNDER * STEPS);
    double low;
    lowest(&low, sole, 0, 0);
    step[flat].x = under_x;
    for (int way = -1; way <= 1; way += 2)
        for (int i = flat; i >= 0 && i <= STAND_STEPS; i += way) {
            size_t at = lowest(&low, sole, step[i].pitch, step[i].bend);
            step[i].z = ground_z - low;
            int next = i + way;
            if (next < 0 || next > STAND_STEPS) break;
            double here[2], there[2];
            sole_point(here, sole, at, step[i].pitch, step[i].bend);
            sole_point(there, sole, at, step[next].pitch, step[next].bend);
            step[next].x = step[i].x + here[0] - there[0] - way * stride / STEPS;
        }
}

static double hermite(double a, double va, double b, double vb, double t)
{
    double s = 1 - t;
    return s * s * (1 + 2 * t) * a + t * t * (1 + 2 * s) * b + s * t * (s * va - t * vb);
}

/* From the ground to the ground, the lowest point just above it. */
static void swing(struct step *step, const struct sole *sole, double ground_z)
{
    static const double clearance[][2] = { { 0, 0 }, { 0.25, 0.035 }, { 0.55, 0.018 }, { 0.8, 0.022 }, { 1, 0 } };
    const struct step off = step[STAND_STEPS], on = step[0];
    double steps = STEPS - STAND_STEPS, leaves = off.x - step[STAND_STEPS - 1].x, lands = step[1].x - on.x;
    for (int i = STAND_STEPS + 1; i < STEPS; i++) {
        double t = (i - STAND_STEPS) / steps, low;
        step[i].x = hermite(off.x, steps * leaves, on.x, steps * lands, t);
        lowest(&low, sole, step[i].pitch, step[i].bend);
        step[i].z = ground_z + THROUGH(clearance, t) - low;
    }
}

/* --- the body --- */

struct pose_now { struct mat3 turn[JOINT_COUNT]; struct vec3 hips; }; /* against the world */

static struct vec3 hip_of(const struct pose_now *pose, const struct skeleton *s, int side)
{
    return vec3_add(pose->hips, mat3_apply(pose->turn[HIPS], vec3_sub(s->at[LIMB(side, THIGH)], s->at[HIPS])));
}

/* The trunk and arms at a part p of the loop, which begins as the left heel comes down. */
static void pose_trunk(struct pose_now *pose, const struct skeleton *s, double p)
{
    double a = 2 * PI * p, lean = radians(2.5);
    pose->turn[HIPS] = mat3_multiply(turn_left(radians(-6) * cos(a)), mat3_multiply(lean_right(radians(3) * sin(a)), lift(-lean)));
    pose->turn[SPINE] = mat3_multiply(turn_left(radians(-1) * cos(a)), lift(-lean * 1.2));
    pose->turn[CHEST] = mat3_multiply(turn_left(radians(6) * cos(a)), mat3_multiply(lean_right(radians(-1) * sin(a)), lift(-lean * 1.4)));
    pose->turn[HEAD] = turn_left(radians(1) * cos(a));
    pose->hips = vec3(s->at[HIPS].x + 0.008 * cos(2 * a), 0.016 * sin(a), 0);
    for (int side = 0; side < 2; side++) {
        double out = side ? -1 : 1, forward = -cos(a - 0.25) * out; /* the left arm is back as the left heel comes down */
        struct mat3 hang = mat3_multiply(pose->turn[CHEST], lean_right(out * radians(4)));
        pose->turn[LIMB(side, UPPER_ARM)] = mat3_multiply(hang, lift(radians(2 + 21 * forward)));
        struct mat3 inward = mat3_multiply(turn_left(-out * radians(14 + 8 * forward)), lean_right(-out * radians(6)));
        pose->turn[LIMB(side, FOREARM)] = mat3_multiply(pose->turn[LIMB(side, UPPER_ARM)], mat3_multiply(inward, lift(radians(17 + 13 * forward))));
        pose->turn[LIMB(side, HAND)] = mat3_multiply(pose->turn[LIMB(side, FOREARM)], lift(radians(6)));
    }
}

static struct vec3 ankle_of(const struct skeleton *s, const struct step *step, int side)
{
    return vec3(step->x, s->at[LIMB(side, THIGH)].y * 0.9, step->z);
}

/* How high the hips may be for a leg of the given share of its length to reach the ankle. */
static double reach(const struct pose_now *pose, const struct skeleton *s, const struct step *step, int side, double share)
{
    const struct vec3 *at = &s->at[LIMB(side, THIGH)];
    double leg = share * (vec3_norm(vec3_sub(at[1], at[0])) + vec3_norm(vec3_sub(at[2], at[1])));
    struct vec3 hip = hip_of(pose, s, side), ankle = ankle_of(s, step, side);
    double x = hip.x - ankle.x, y = hip.y - ankle.y, room = leg * leg - x * x - y * y;
    assert(room > 0);
    return ankle.z + sqrt(room) - (hip.z - pose->hips.z);
}

/* Two bones, as lift() would bend them, from the hip to the ankle. */
static void pose_leg(struct pose_now *pose, const struct skeleton *s, const struct step *step, int side)
{
    const struct vec3 *at = &s->at[LIMB(side, THIGH)];
    double out = side ? -1 : 1, thigh = vec3_norm(vec3_sub(at[1], at[0])), shin = vec3_norm(vec3_sub(at[2], at[1]));
    struct vec3 bound = vec3_unit(vec3_sub(at[2], at[0])), hinge_bound = vec3_unit(vec3_cross(vec3(1, 0, 0), bound));
    struct vec3 hip = hip_of(pose, s, side), way = vec3_sub(ankle_of(s, step, side), hip);
    double length = fmin(vec3_norm(way), 0.9995 * (thigh + shin));
    struct vec3 down = vec3_unit(way), ahead = mat3_apply(turn_left(out * radians(5)), mat3_column(pose->turn[HIPS], 0));
    struct vec3 hinge = vec3_unit(vec3_cross(ahead, down)), front = vec3_cross(down, hinge);
    double c = (thigh * thigh + length * length - shin * shin) / (2 * thigh * length), bend = acos(fmin(fmax(c, -1), 1));
    struct vec3 upper = vec3_add(vec3_scale(down, cos(bend)), vec3_scale(front, sin(bend)));
    struct vec3 lower = vec3_unit(vec3_sub(vec3_scale(down, length), vec3_scale(upper, thigh)));
    struct vec3 bones[2][2] = { { vec3_unit(vec3_sub(at[1], at[0])), upper }, { vec3_unit(vec3_sub(at[2], at[1])), lower } };
    for (int k = 0; k < 2; k++) {
        struct mat3 from = mat3_from_columns(bones[k][0], hinge_bound, vec3_cross(bones[k][0], hinge_bound));
        struct mat3 to = mat3_from_columns(bones[k][1], hinge, vec3_cross(bones[k][1], hinge));
        pose->turn[LIMB(side, THIGH + k)] = mat3_multiply(to, mat3_transpose(from));
    }
    pose->turn[LIMB(side, FOOT)] = mat3_multiply(turn_left(out * radians(4)), lift(step->pitch));
    pose->turn[LIMB(side, TOES)] = mat3_multiply(pose->turn[LIMB(side, FOOT)], lift(step->bend));
}

static void write_key(struct walk *walk, const struct pose_now *pose, int key)
{
    walk->hips[key] = pose->hips;
    for (int j = 0; j < JOINT_COUNT; j++) {
        int parent = walker_joint_parent(j);
        struct mat3 local = parent < 0 ? pose->turn[j] : mat3_multiply(mat3_transpose(pose->turn[parent]), pose->turn[j]);
        walk->turn[j][key] = quat_from_mat3(local);
    }
}

void make_walk(struct walk *walk, const struct skeleton *s, const struct model *model)
{
    struct step steps[STEPS] = { { 0 } };
    struct sole sole = find_sole(s, model);
    for (int i = 0; i < STEPS; i++) {
        steps[i].pitch = radians(THROUGH(foot_pitch, (double)i / STEPS));
        steps[i].bend = radians(THROUGH(toe_bend, (double)i / STEPS));
    }
    stand(steps, &sole, s->stride, s->ground_z, s->at[HIPS].x);
    swing(steps, &sole, s->ground_z);
    free(sole.p);

    /* The hips rise and sink once a step; as high as lets the standing legs reach the ground. */
    const double sink = 0.02;
    double height = 1e9;
    struct pose_now pose;
#define RISE(p) (-sink * cos(4 * PI * ((p) - 0.04)))
    for (int i = 0; i < STEPS; i++) {
        double p = (double)i / STEPS;
        pose_trunk(&pose, s, p);
        for (int side = 0; side < 2; side++) {
            int at = (i + side * STEPS / 2) % STEPS;
            height = fmin(height, reach(&pose, s, &steps[at], side, at <= STAND_STEPS ? 0.995 : 0.999) - RISE(p));
        }
    }
    walk->duration_s = 1;
    for (int key = 0; key <= WALK_KEYS; key++) {
        double p = (double)(key % WALK_KEYS) / WALK_KEYS;
        pose_trunk(&pose, s, p);
        pose.hips.z = height + RISE(p);
        for (int side = 0; side < 2; side++) {
            double q = fmod(p + 0.5 * side, 1) * STEPS, part = q - floor(q);
            const struct step *a = &steps[(int)q], *b = &steps[((int)q + 1) % STEPS];
            struct step step = { a->x + part * (b->x - a->x), a->z + part * (b->z - a->z),
                                 a->pitch + part * (b->pitch - a->pitch), a->bend + part * (b->bend - a->bend) };
            pose_leg(&pose, s, &step, side);
        }
        write_key(walk, &pose, key);
    }
#undef RISE
}

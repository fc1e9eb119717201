#include "cast/motion.h"

#include "cast/pose.h"

#include <assert.h>
#include <string.h>

#define CURVE(k) { k, (int)(sizeof k / sizeof *k) }

/* Feet of a walk, of a slow one and of a run. Src: Perry, Burnfield 2010, Gait analysis (phases, angles);
 * Novacheck 1998, The biomechanics of running */
static const double walk_pitch[][2] = { { 0, 20 }, { 0.09, 0 }, { 0.30, 0 }, { 0.42, -6 }, { 0.52, -22 }, { 0.62, -52 }, { 0.68, -57 }, { 0.85, 2 }, { 0.94, 20 }, { 1, 20 } };
static const double walk_bend[][2] = { { 0, 4 }, { 0.09, 0 }, { 0.30, 0 }, { 0.42, 6 }, { 0.52, 20 }, { 0.62, 28 }, { 0.72, 6 }, { 0.9, 6 }, { 1, 4 } };
static const double walk_clear[][2] = { { 0, 0 }, { 0.25, 0.038 }, { 0.55, 0.02 }, { 0.8, 0.024 }, { 1, 0 } };
static const double slow_pitch[][2] = { { 0, 12 }, { 0.08, 0 }, { 0.36, 0 }, { 0.48, -7 }, { 0.58, -26 }, { 0.66, -45 }, { 0.72, -46 }, { 0.87, 0 }, { 0.95, 12 }, { 1, 12 } };
static const double slow_bend[][2] = { { 0, 3 }, { 0.08, 0 }, { 0.36, 0 }, { 0.48, 7 }, { 0.58, 24 }, { 0.66, 26 }, { 0.76, 5 }, { 0.9, 5 }, { 1, 3 } };
static const double slow_clear[][2] = { { 0, 0 }, { 0.25, 0.028 }, { 0.55, 0.017 }, { 0.8, 0.02 }, { 1, 0 } };
static const double run_pitch[][2] = { { 0, 9 }, { 0.05, 0 }, { 0.16, 0 }, { 0.23, -12 }, { 0.30, -38 }, { 0.36, -56 }, { 0.46, -95 }, { 0.58, -92 }, { 0.78, -22 }, { 0.92, 8 }, { 1, 9 } };
static const double run_bend[][2] = { { 0, 4 }, { 0.05, 0 }, { 0.16, 0 }, { 0.23, 11 }, { 0.30, 29 }, { 0.36, 24 }, { 0.46, 2 }, { 0.9, 5 }, { 1, 4 } };
static const double run_clear[][2] = { { 0, 0 }, { 0.20, 0.12 }, { 0.45, 0.21 }, { 0.68, 0.13 }, { 0.88, 0.05 }, { 1, 0 } };

static const struct gait {
    const char *name;
    double froude, stride;            /* speed^2 / (g leg); stride in legs (hip to ground) */
    struct roll roll;
    double bounce, low;               /* of the hips: shares of the leg; when they are lowest */
    double lean, sway, yaw, roll_deg; /* degrees, but sway: share of the leg */
    double arm, arm_bend, arm_bend_swing, narrow; /* swing, elbow; how far apart the feet, in hips */
} gaits[] = {
    [WALK] = { "walk", 0.205, 1.53, { 0.62, 0.255, CURVE(walk_pitch), CURVE(walk_bend), CURVE(walk_clear) },
               0.020, 0.04, 2.5, 0.018, 6, 3, 20, 16, 12, 0.62 },
    [SLOW_WALK] = { "slow_walk", 0.075, 1.16, { 0.665, 0.27, CURVE(slow_pitch), CURVE(slow_bend), CURVE(slow_clear) },
                    0.013, 0.05, 2, 0.026, 4, 2.5, 11, 12, 6, 0.75 },
    [RUN] = { "run", 0.95, 2.36, { 0.36, 0.09, CURVE(run_pitch), CURVE(run_bend), CURVE(run_clear) },
              0.030, 0.165, 8, 0.008, 8, 3.5, 32, 82, 14, 0.35 },
};

/* How high a foot is lifted to be set down beside the other: share of the leg. */
#define HALT_LIFT 0.035

static double leg_length(const struct body *b) { return b->at[LIMB(0, HIP)].z; }

/* What makes each move in a way of his own: from -1 to 1. */
static double habit(const struct person *person, int which)
{
    double sum = 0;
    for (const char *c = person->name; *c; c++) sum += (unsigned char)*c * (1 + which) + which * 7;
    double x = sin(12.9898 * sum + 78.233 * which) * 43758.5453;
    return 2 * (x - floor(x)) - 1;
}

/* From the bound arm to one that hangs, free of hips and clothes; angles out, forward, elbow, how far it is turned in. */
static void pose_arm(struct body_pose *pose, const struct body *b, int side, double out, double forward, double bend, double in)
{
    double way = side ? -1 : 1;
    struct mat3 down = lean_right(way * (out - radians(21)));
    struct mat3 shoulder = then(pose->turn[CHEST], turn_left(-way * 0.15 * forward));
    pose->turn[LIMB(side, SHOULDER)] = shoulder;
    struct mat3 upper = then(then(pose->turn[CHEST], then(lift(forward), turn_left(-way * in))), down);
    struct mat3 fore = then(upper, then(lean_right(-way * radians(3)), lift(bend)));
    pose->turn[LIMB(side, UPPER_ARM)] = upper;
    pose->turn[LIMB(side, FOREARM)] = fore;
    pose->turn[LIMB(side, HAND)] = then(fore, then(lean_right(-way * radians(4)), lift(radians(3))));
    (void)b;
}

/* How far out an arm must hang for the wrist to pass the hips and what is worn about them. */
static double arm_out(const struct person *person, const struct body *b)
{
    const struct vec3 *at = &b->at[LIMB(0, 0)];
    double arm = vec3_norm(vec3_sub(at[HAND], at[UPPER_ARM])), hips = b->trunk.station[2].side + 0.055 + (person->top == COAT || person->top == OPEN_COAT ? 0.04 : 0);
    return fmin(fmax(asin(fmin((hips - at[UPPER_ARM].y) / arm, 0.4)), radians(4)), radians(17));
}

/* What hangs from a hand hangs down; an umbrella is held up. */
static void pose_held(struct body_pose *pose, const struct person *person, const struct body *b, double swing)
{
    pose->turn[HELD] = then(turn_left(radians(10)), lift(swing));
    if (person->carried != UMBRELLA) return;
    pose_arm(pose, b, 1, radians(9), radians(14), radians(118), radians(12));
    pose->turn[LIMB(1, HAND)] = then(pose->turn[LIMB(1, FOREARM)], lift(radians(-10)));
    pose->turn[HELD] = then(lean_right(radians(-7)), lift(radians(-9)));
}

/* Hands that do something else than swing. sway: -1 to 1, with the steps. */
static void pose_hands(struct body_pose *pose, const struct person *person, const struct body *b, double sway)
{
    for (int side = 0; side < 2 && person->hands == IN_POCKETS; side++) {
        pose_arm(pose, b, side, arm_out(person, b) + radians(8), radians(-17 + 2 * sway * (side ? -1 : 1)), radians(45 + 4 * habit(person, 23 + side)), radians(32));
        pose->turn[LIMB(side, HAND)] = then(pose->turn[LIMB(side, FOREARM)], then(lean_right(radians(side ? 48 : -48)), lift(radians(-6))));
    }
    if (person->hands == AT_PHONE) {
        pose_arm(pose, b, 1, radians(7), radians(16 + sway), radians(98), radians(30));
        pose->turn[HEAD] = then(pose->turn[HEAD], lift(radians(-17)));
        pose->turn[NECK] = then(pose->turn[NECK], lift(radians(-7)));
    }
}

/* Trunk and arms at a part p of the loop, which begins as the left foot comes down. */
static void pose_trunk(struct body_pose *pose, const struct person *person, const struct body *b, const struct gait *g, double p)
{
    double a = 2 * M_PI * p, lean = radians(g->lean + 1.2 * habit(person, 0)), yaw = radians(g->yaw), leg = leg_length(b);
    bool female = b->measures.sex == FEMALE;
    double roll = radians(g->roll_deg * (female ? 1.4 : 1)), run = g->arm_bend > 45 ? 1 : 0;
    pose->turn[HIPS] = then(turn_left(-yaw * cos(a)), then(lean_right(roll * sin(a)), lift(-0.6 * lean)));
    pose->turn[SPINE] = then(turn_left(-0.2 * yaw * cos(a)), then(lean_right(0.1 * roll * sin(a)), lift(-lean)));
    pose->turn[CHEST] = then(turn_left(yaw * (0.9 + 0.4 * run) * cos(a)), then(lean_right(-0.4 * roll * sin(a)), lift(-1.2 * lean)));
    pose->turn[NECK] = then(turn_left(0.4 * yaw * cos(a)), lift(-0.9 * lean));
    pose->turn[HEAD] = then(turn_left(0.15 * yaw * cos(a) + radians(4 * habit(person, 1))), then(lean_right(radians(2 * habit(person, 2))), lift(radians(-3 + 3 * habit(person, 3) + 0.8 * cos(2 * a)))));
    pose->hips = vec3(b->at[HIPS].x + 0.009 * leg * cos(2 * a), g->sway * leg * sin(a), 0);
    double held = 0;
    for (int side = 0; side < 2; side++) {
        double way = side ? -1 : 1, forward = -cos(a - 0.25) * way; /* the left arm is back as the left foot comes down */
        double own = 1 + 0.22 * habit(person, 4 + side), bend = g->arm_bend * (1 + 0.15 * habit(person, 6 + side));
        if (side == 1 && person->carried == HANDBAG) own *= 0.35, bend *= 0.6, held = forward;
        double ahead = radians(own * g->arm * (forward + 0.12) - (run > 0 ? 12 : 0));
        pose_arm(pose, b, side, arm_out(person, b) + radians(6 * run), ahead, radians(bend + own * g->arm_bend_swing * forward), radians(run > 0 ? 28 : 9));
    }
    if (run == 0) pose_hands(pose, person, b, sin(a));
    pose_held(pose, person, b, radians(6) * held);
}

/* How high the hips may be for a leg of the given share of its length to reach the ankle. */
static double reach(const struct body_pose *pose, const struct body *b, struct vec3 ankle, int side, double share)
{
    const struct vec3 *at = &b->at[LIMB(side, 0)];
    double leg = share * (vec3_norm(vec3_sub(at[KNEE], at[THIGH])) + vec3_norm(vec3_sub(at[FOOT], at[KNEE])));
    struct vec3 hip = pose_place(pose, b, LIMB(side, HIP));
    double x = hip.x - ankle.x, y = hip.y - ankle.y, room = leg * leg - x * x - y * y;
    assert(room > 0);
    return ankle.z + sqrt(room) - (hip.z - pose->hips.z);
}

/* foot: how its toes point out. */
static void pose_leg(struct body_pose *pose, const struct body *b, struct vec3 ankle, int side, double pitch, double bend, double out_rad)
{
    double way_out = side ? -1 : 1;
    struct vec3 ahead = mat3_apply(turn_left(way_out * (0.7 * out_rad)), mat3_column(pose->turn[HIPS], 0));
    pose_bones(pose, b, LIMB(side, THIGH), LIMB(side, SHIN), LIMB(side, FOOT), pose_place(pose, b, LIMB(side, HIP)), ankle, ahead, vec3(1, 0, 0));
    pose->turn[LIMB(side, FOOT)] = then(turn_left(way_out * out_rad), lift(pitch));
    pose->turn[LIMB(side, TOES)] = then(pose->turn[LIMB(side, FOOT)], lift(bend));
}

static void write_key(struct clip *clip, struct body_pose *pose, int key)
{
    pose_halves(pose);
    clip->hips[key] = pose->hips;
    for (int j = 0; j < JOINT_COUNT; j++) {
        int parent = joint_parent(j);
        struct mat3 local = parent < 0 ? pose->turn[j] : then(mat3_transpose(pose->turn[parent]), pose->turn[j]);
        clip->turn[j][key] = quat_from_mat3(local);
    }
}

static struct vec3 ankle_of(const struct body *b, const struct gait *g, const struct step *step, int side)
{
    return vec3(step->x, b->at[LIMB(side, HIP)].y * g->narrow, step->z);
}

static double toes_out(const struct person *person) { return radians(5 + 3 * habit(person, 8)); }

/* One who walks: his feet over the loop, and how high his hips are in the mean. */
struct walker { const struct gait *gait; struct step steps[2][STEPS]; double stride_m, height_m, toes_out; };

static double rise(const struct gait *g, double leg, double p) { return -g->bounce * leg * cos(4 * M_PI * (p - g->low)); }

static void make_walker(struct walker *w, const struct gait *g, const struct person *person, const struct body *b, const struct sole *sole)
{
    struct body_pose pose = { 0 };
    double leg = leg_length(b);
    w->gait = g;
    w->stride_m = g->stride * leg * (1 + 0.03 * habit(person, 9));
    w->height_m = 1e9, w->toes_out = toes_out(person);
    for (int side = 0; side < 2; side++) roll_foot(w->steps[side], &sole[side], &g->roll, w->stride_m, leg, b->at[HIPS].x + (g->lean > 5 ? 0.03 : 0.0) * leg);
    /* As high as lets the standing legs reach the ground. */
    for (int i = 0; i < STEPS; i++) {
        double p = (double)i / STEPS;
        pose_trunk(&pose, person, b, g, p);
        for (int side = 0; side < 2; side++) {
            double part = p + 0.5 * side;
            struct step step = step_at(w->steps[side], part);
            bool stands = part - floor(part) <= g->roll.stands;
            w->height_m = fmin(w->height_m, reach(&pose, b, ankle_of(b, g, &step, side), side, stands ? (g->lean > 5 ? 1.0 : 0.998) : 0.9995) - rise(g, leg, p));
        }
    }
}

static void pose_walker(struct body_pose *pose, const struct walker *w, const struct person *person, const struct body *b, double p)
{
    pose_trunk(pose, person, b, w->gait, p);
    pose->hips.z = w->height_m + rise(w->gait, leg_length(b), p);
    for (int side = 0; side < 2; side++) {
        struct step step = step_at(w->steps[side], p + 0.5 * side);
        pose_leg(pose, b, ankle_of(b, w->gait, &step, side), side, step.pitch, step.bend, w->toes_out);
    }
}

static void make_gait(struct clip *clip, const struct gait *g, const struct person *person, const struct body *b, const struct sole *sole)
{
    struct walker walker;
    struct body_pose pose = { 0 };
    make_walker(&walker, g, person, b, sole);
    clip->name = g->name;
    clip->stride_m = walker.stride_m;
    clip->duration_s = walker.stride_m / sqrt(g->froude * 9.81 * leg_length(b));
    clip->keys = MOST_KEYS;
    for (int key = 0; key <= clip->keys; key++) {
        pose_walker(&pose, &walker, person, b, (double)(key % clip->keys) / clip->keys);
        write_key(clip, &pose, key);
    }
}

/* The foot that is ahead when one stands is the one that stays as he halts: where it is in the middle of its step. */
static int first_foot(const struct person *person) { return habit(person, 10) > 0 ? 0 : 1; }

/* Stand on both feet, the weight on one and then on the other; look around a little. p: from 0 to 1
 * Out: out_rad (2) how the feet point out, ankle (2) */
static void pose_stander(struct body_pose *pose, struct vec3 *ankle, double *out_rad, const struct person *person, const struct body *b, double p)
{
    static const double weight[][2] = { { 0, 1 }, { 0.30, 0.85 }, { 0.45, -0.7 }, { 0.60, -1 }, { 0.82, -0.8 }, { 1, 1 } }; /* 1: on the left foot */
    int first = first_foot(person);
    double leg = leg_length(b), mirror = first ? -1 : 1, ahead = 0.045 * leg * (1 + 0.8 * habit(person, 11)), a = 2 * M_PI * p;
    double on = mirror * curve_at(weight, 6, p), breath = sin(3 * a), height = 1e9;
    double roll = radians(3.6 * on), turn = radians(4 * on + 4 * habit(person, 13));
    pose->turn[HIPS] = then(turn_left(0.7 * turn), then(lean_right(roll), lift(radians(1))));
    pose->turn[SPINE] = then(turn_left(0.4 * turn), lean_right(0.2 * roll));
    pose->turn[CHEST] = then(turn_left(-0.4 * turn), then(lean_right(-0.8 * roll), lift(radians(1 + 0.5 * breath))));
    pose->turn[NECK] = then(turn_left(radians(6 * sin(a + 1))), lift(radians(-2)));
    pose->turn[HEAD] = then(turn_left(radians(7 * habit(person, 14) + 13 * sin(a + 1) + 4 * sin(2 * a))), then(lean_right(radians(2.5 * on)), lift(radians(-5 + 4 * habit(person, 15) + 2 * sin(a)))));
    for (int side = 0; side < 2; side++) {
        double way = side ? -1 : 1, easy = 0.5 - 0.5 * way * on;
        pose_arm(pose, b, side, arm_out(person, b) + radians(2 * easy), radians(3 + 5 * habit(person, 16 + side) + 2.5 * easy), radians(11 + 6 * habit(person, 18 + side) + 3 * sin(a + side)), radians(12));
    }
    pose_hands(pose, person, b, 0.5 * sin(a));
    pose_held(pose, person, b, radians(2 * sin(a)));
    /* The foot that is ahead lies as it does in the middle of a step. */
    struct vec3 at[2], shift;
    for (int side = 0; side < 2; side++) {
        double way = side ? -1 : 1;
        out_rad[side] = side == first ? toes_out(person) : radians(9 + 5 * habit(person, 21 + side));
        at[side] = vec3(b->at[LIMB(side, FOOT)].x + way * mirror * ahead, b->at[LIMB(side, FOOT)].y * (1.0 + 0.12 * habit(person, 20)), b->at[LIMB(side, FOOT)].z);
    }
    shift = vec3(b->at[HIPS].x - at[first].x, b->at[LIMB(first, HIP)].y * gaits[WALK].narrow - at[first].y, 0);
    pose->hips = vec3_add(vec3(b->at[HIPS].x - 0.01, 0.045 * leg * on, 0), shift);
    for (int side = 0; side < 2; side++) {
        ankle[side] = vec3_add(at[side], shift);
        height = fmin(height, reach(pose, b, ankle[side], side, 0.996));
    }
    pose->hips.z = height;
    for (int side = 0; side < 2; side++) pose_leg(pose, b, ankle[side], side, 0, 0, out_rad[side]);
}

static void make_stand(struct clip *clip, const struct person *person, const struct body *b)
{
    struct body_pose pose = { 0 };
    struct vec3 ankle[2];
    double out_rad[2];
    clip->name = "stand";
    clip->duration_s = 7 + 1.5 * habit(person, 12);
    clip->keys = 32;
    for (int key = 0; key <= clip->keys; key++) {
        pose_stander(&pose, ankle, out_rad, person, b, (double)(key % clip->keys) / clip->keys);
        write_key(clip, &pose, key);
    }
}

/* From the middle of a step to where standing begins: one foot stays, the other is lifted a little and set down. */
static void make_halt(struct clip *clip, const struct person *person, const struct body *b, const struct sole *sole)
{
    struct walker walker;
    struct body_pose from = { 0 }, to = { 0 }, pose;
    struct vec3 set_down[2];
    double out_rad[2], leg = leg_length(b);
    int first = first_foot(person), other = !first;
    make_walker(&walker, &gaits[WALK], person, b, sole);
    double p = walker.gait->roll.under + 0.5 * first;
    struct step begin = step_at(walker.steps[other], p + 0.5 * other), stays = step_at(walker.steps[first], p + 0.5 * first);
    double clear = begin.z + foot_low(&sole[other], begin.pitch, begin.bend);
    pose_walker(&from, &walker, person, b, p);
    pose_stander(&to, set_down, out_rad, person, b, 0);
    clip->name = "halt";
    clip->duration_s = 0.5 * sqrt(leg / 0.93);
    clip->keys = 16;
    for (int key = 0; key <= clip->keys; key++) {
        double t = (double)key / clip->keys, u = t * t * (3 - 2 * t), pitch = (1 - u) * (1 - u) * begin.pitch, bend = (1 - u) * (1 - u) * begin.bend;
        struct vec3 ankle[2];
        pose = from;
        for (int j = 0; j < JOINT_COUNT; j++) pose.turn[j] = turn_between(from.turn[j], to.turn[j], u);
        pose.hips = vec3_add(vec3_scale(from.hips, 1 - u), vec3_scale(to.hips, u));
        for (int side = 0; side < 2; side++) {
            struct step step = side == other ? begin : stays;
            ankle[side] = vec3_add(vec3_scale(ankle_of(b, walker.gait, &step, side), 1 - u), vec3_scale(set_down[side], u));
        }
        ankle[other].z = (1 - u) * (clear - foot_low(&sole[other], pitch, bend)) + u * set_down[other].z + 4 * t * (1 - t) * HALT_LIFT * leg;
        for (int side = 0; side < 2; side++) pose.hips.z = fmin(pose.hips.z, reach(&pose, b, ankle[side], side, 0.9995));
        for (int side = 0; side < 2; side++)
            pose_leg(&pose, b, ankle[side], side, side == other ? pitch : 0, side == other ? bend : 0, (1 - u) * walker.toes_out + u * out_rad[side]);
        write_key(clip, &pose, key);
    }
}

void make_clip(struct clip *clip, enum motion motion, const struct person *person, const struct body *body, const struct sole *sole)
{
    memset(clip, 0, sizeof *clip);
    if (motion == STAND) make_stand(clip, person, body);
    else if (motion == HALT) make_halt(clip, person, body, sole);
    else make_gait(clip, &gaits[motion], person, body, sole);
}

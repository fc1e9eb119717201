#include "cast/body.h"

#include <string.h>

const char *const joint_name[JOINT_COUNT] = {
    "hips", "spine", "chest", "neck", "head",
    "left shoulder", "left upper arm", "left elbow", "left forearm", "left hand",
    "left hip", "left thigh", "left knee", "left shin", "left foot", "left toes",
    "right shoulder", "right upper arm", "right elbow", "right forearm", "right hand",
    "right hip", "right thigh", "right knee", "right shin", "right foot", "right toes",
    "held"
};

int joint_parent(int joint)
{
    if (joint < LIMBS) return joint - 1;
    if (joint == HELD) return LIMB(1, HAND);
    int limb = (joint - LIMBS) % LIMB_COUNT;
    return limb == SHOULDER ? CHEST : limb == HIP ? HIPS : joint - 1;
}

/* --- tables: centimetres at the mean stature and mass of ANSUR II; t of the trunk in shares of stature --- */

static const struct mean { double stature_m, mass_kg, shoulder_y, hip_y, foot_share; } means[] = {
    [MALE] = { 1.756, 85.5, 18.4, 8.8, 0.154 }, [FEMALE] = { 1.629, 67.8, 15.9, 8.7, 0.151 }
};
enum { TRUNK_ROWS = 12 };
static const struct station trunks[][TRUNK_ROWS] = {
    [MALE] = { { 0.462, 9.5, 7.5, 8.5, -1 }, { 0.49, 16.4, 10.5, 12.0, -1 }, { 0.525, 17.6, 10.8, 12.6, 0 }, { 0.565, 17.0, 11.2, 11.5, 0.5 },
               { 0.61, 16.0, 11.8, 10.2, 1.2 }, { 0.65, 16.0, 11.8, 10.2, 0.8 }, { 0.70, 17.0, 12.2, 11.2, 0 }, { 0.74, 17.8, 12.2, 12.0, -0.6 },
               { 0.775, 17.6, 10.8, 12.0, -1.0 }, { 0.805, 14.2, 8.2, 10.2, -1.4 }, { 0.832, 9.4, 6.2, 7.8, -1.8 }, { 0.858, 6.4, 5.5, 6.2, -1.6 } },
    [FEMALE] = { { 0.462, 9.0, 7.0, 8.0, -1 }, { 0.49, 16.6, 10.0, 12.4, -1 }, { 0.525, 17.6, 10.2, 12.8, 0 }, { 0.565, 16.4, 10.3, 11.2, 0.6 },
                 { 0.61, 14.3, 10.4, 9.2, 1.2 }, { 0.65, 13.2, 10.0, 8.8, 0.8 }, { 0.70, 14.0, 10.2, 9.6, 0 }, { 0.74, 14.9, 10.4, 10.2, -0.6 },
                 { 0.775, 15.0, 9.2, 10.2, -1.0 }, { 0.805, 12.2, 7.0, 8.8, -1.4 }, { 0.832, 8.0, 5.2, 6.6, -1.8 }, { 0.858, 5.4, 4.7, 5.2, -1.6 } }
};
static const struct station thighs[] = { { 0, 8.8, 8.6, 9.4, 0 }, { 0.14, 9.4, 9.3, 9.6, 0 }, { 0.32, 9.0, 9.1, 8.7, 0 }, { 0.6, 7.6, 7.8, 7.2, 0.2 },
                                         { 0.85, 6.0, 6.5, 5.7, 0.3 }, { 1, 5.7, 6.3, 5.4, 0.3 } };
static const struct station shins[] = { { 0, 5.7, 6.2, 5.5, 0.2 }, { 0.12, 5.5, 5.5, 5.8, 0 }, { 0.3, 5.9, 4.9, 7.0, -0.4 }, { 0.5, 5.2, 4.5, 6.1, -0.5 },
                                        { 0.75, 3.9, 3.8, 4.2, -0.4 }, { 0.92, 3.4, 3.6, 4.0, -0.2 }, { 1, 3.6, 4.0, 4.6, 0 } };
static const struct station upper_arms[] = { { 0, 5.3, 5.4, 5.6, 0 }, { 0.22, 5.3, 5.6, 5.6, 0 }, { 0.5, 4.9, 5.4, 5.1, 0 }, { 0.8, 4.4, 4.4, 4.5, 0 }, { 1, 4.3, 4.0, 4.4, 0 } };
static const struct station forearms[] = { { 0, 4.3, 4.2, 4.3, 0 }, { 0.2, 4.4, 4.7, 4.3, 0 }, { 0.5, 3.7, 4.1, 3.8, 0 }, { 0.85, 2.3, 3.0, 2.9, 0 }, { 1, 2.0, 2.8, 2.8, 0 } };
#define COUNT(a) ((int)(sizeof(a) / sizeof *(a)))

/* Straight lines between what is known at ages 6, 10, 13 and of the grown. */
static double by_age(double age, double six, double ten, double thirteen, double grown)
{
    static const double ages[] = { 6, 10, 13, 18 };
    const double values[] = { six, ten, thirteen, grown };
    if (age <= 6) return six;
    for (int i = 1; i < 4; i++)
        if (age < ages[i]) return values[i - 1] + (values[i] - values[i - 1]) * (age - ages[i - 1]) / (ages[i] - ages[i - 1]);
    return grown;
}

static void place_joints(struct body *b, double hip_share)
{
    double h = b->measures.stature_m, age = b->measures.age_years, up = b->sole_m;
    const struct mean *mean = &means[b->measures.sex];
    double wide = h / mean->stature_m * (0.75 + 0.25 * fmin(b->girth, 1.3)) / 100;
    double hip_z = hip_share * h, trunk = b->chin_z - up - hip_z; /* shares of it: as between 0.52 and 0.87 of the grown */
#define RISE(share) (up + hip_z + trunk * ((share) - 0.52) / 0.35)
    b->crotch_z = up + hip_z * 0.475 / 0.52;
    b->waist_z = RISE(0.615);
    b->neck_z = RISE(0.858);
    b->at[HIPS] = vec3(0, 0, RISE(0.545)), b->at[SPINE] = vec3(0, 0, RISE(0.61)), b->at[CHEST] = vec3(-0.01 * h, 0, RISE(0.70));
    b->at[NECK] = vec3(-0.012 * h, 0, RISE(0.85)), b->at[HEAD] = vec3(-0.002 * h, 0, b->chin_z + 0.2 * b->head_m);
    double arm = by_age(age, 0.93, 0.96, 0.98, 1), out = 21 * M_PI / 180;
    struct vec3 way = vec3(0, sin(out), -cos(out));
    for (int side = 0; side < 2; side++) {
        struct vec3 *at = &b->at[LIMB(side, 0)];
        at[SHOULDER] = vec3(-0.008 * h, 0.022 * h, RISE(0.80));
        at[UPPER_ARM] = vec3(-0.012 * h, mean->shoulder_y * wide, RISE(0.790));
        at[ELBOW] = at[FOREARM] = vec3_add(at[UPPER_ARM], vec3_scale(way, 0.170 * arm * h));
        at[HAND] = vec3_add(at[FOREARM], vec3_scale(way, 0.151 * arm * h));
        at[HIP] = at[THIGH] = vec3(0, mean->hip_y * wide, up + hip_z);
        at[KNEE] = at[SHIN] = vec3(0.006 * h, mean->hip_y * wide, up + hip_z * 0.285 / 0.52);
        at[FOOT] = vec3(-0.004 * h, mean->hip_y * wide, up + hip_z * 0.039 / 0.52);
        at[TOES] = vec3(at[FOOT].x + 0.62 * b->foot_m, at[FOOT].y, up + 0.12 * b->foot_m);
        for (int k = 0; side && k < LIMB_COUNT; k++) at[k].y = -at[k].y;
    }
    const struct vec3 *hand = &b->at[LIMB(1, 0)];
    b->at[HELD] = vec3_add(hand[HAND], vec3_scale(vec3_sub(hand[HAND], hand[FOREARM]), 0.45));
#undef RISE
}

/* A table row in metres; more or less mass shows before all in front, then at the sides. */
static struct station scaled(const struct station *row, double size, double side, double front, double back)
{
    return (struct station){ row->t, row->side * size * side, row->front * size * front, row->back * size * back, row->shift * size };
}

static struct solid limb(const struct station *rows, int count, struct vec3 a, struct vec3 b, double size)
{
    struct shape one = { 0 };
    struct station made[STATIONS];
    for (int i = 0; i < count; i++) made[i] = scaled(&rows[i], size, 1, 1, 1);
    return *add_tube(&one, JOIN, 0.03, a, b, vec3(1, 0, 0), made, count);
}

static void make_flesh(struct body *b, double hip_share)
{
    double h = b->measures.stature_m, g = b->girth, grown = by_age(b->measures.age_years, 0, 0.1, 0.5, 1);
    bool female = b->measures.sex == FEMALE;
    double size = h / means[b->measures.sex].stature_m / 100, up = b->sole_m;
    double hip_z = hip_share * h, trunk = b->chin_z - up - hip_z;
    struct station rows[TRUNK_ROWS];
    struct shape one = { 0 };
    for (int i = 0; i < TRUNK_ROWS; i++) {
        struct station man = trunks[MALE][i], row = trunks[b->measures.sex][i];
        man.side *= 0.93; /* boys and girls have the same figure */
        if (female) {
            row.side = grown * row.side + (1 - grown) * man.side * 0.93;
            row.front = grown * row.front + (1 - grown) * man.front * 0.93;
            row.back = grown * row.back + (1 - grown) * man.back * 0.93;
        }
        double belly = ramp(0.50, 0.60, row.t) * ramp(0.76, 0.64, row.t), top = ramp(0.76, 0.83, row.t);
        double side = pow(g, 1 + 0.35 * belly - 0.45 * top), front = pow(g, 1.1 + 1.0 * belly - 0.5 * top), back = pow(g, 1 - 0.3 * top);
        if (g < 1) front = pow(g, 1.1 + 0.2 * belly - 0.5 * top);
        rows[i] = scaled(&row, size, side, front, back);
        rows[i].t = (rows[i].t - trunks[0][0].t) / (trunks[0][TRUNK_ROWS - 1].t - trunks[0][0].t);
    }
#define RISE(share) (up + hip_z + trunk * ((share) - 0.52) / 0.35)
    struct vec3 low = vec3(0, 0, RISE(0.462)), high = vec3(0, 0, RISE(0.858));
    b->trunk = *add_tube(&one, JOIN, 0, low, high, vec3(1, 0, 0), rows, TRUNK_ROWS);
    b->trunk.square = 0.35;

    struct vec3 shoulder = b->at[LIMB(0, UPPER_ARM)];
    double round = 4.3 * size * sqrt(g);
    struct vec3 top = vec3_add(shoulder, vec3(-0.004, -0.02, -0.004)), nape = vec3(-0.016 * h, 0.02, RISE(0.822));
    b->girdle = *add_rod(&one, JOIN, 0.05, nape, 1.15 * round, top, 0.94 * round);
    double full = grown * (0.6 + 0.5 * fmin(g, 1.4));
    b->bust = *add_ball(&one, JOIN, 0.045, vec3(7.6 * size * g, 7.0 * size * sqrt(g), RISE(0.722)),
                        vec3_scale(vec3(6.2, 6.2, 6.4), size * (female ? full : 0.1)));
    b->seat = *add_ball(&one, JOIN, 0.05, vec3(-6.0 * size * g, 7.6 * size * g, RISE(0.508)),
                        vec3_scale(vec3(8.6, 8.2, 8.8), size * g * (female ? 1.0 : 0.95)));
    double thick = (female && grown > 0.5 ? 5.2 : 6.1) * size * sqrt(g);
    double head = b->head_m / 0.225;
    thick = 0.6 * thick + 0.4 * head * (female ? 0.050 : 0.058);
    b->neck = *add_rod(&one, JOIN, 0.03, vec3(-0.016 * h, 0, RISE(0.835)), 1.08 * thick, vec3(b->at[HEAD].x - 0.002, 0, b->at[HEAD].z + 0.02), thick);
#undef RISE
    const struct vec3 *p = &b->at[LIMB(0, 0)];
    double slim = female ? 0.92 : 1, legs = female ? 1.0 : 1;
    b->upper_arm = limb(upper_arms, COUNT(upper_arms), p[UPPER_ARM], p[ELBOW], size * g * slim);
    b->forearm = limb(forearms, COUNT(forearms), p[FOREARM], p[HAND], size * sqrt(g) * slim);
    b->thigh = limb(thighs, COUNT(thighs), p[THIGH], p[KNEE], size * g * legs);
    b->shin = limb(shins, COUNT(shins), p[SHIN], p[FOOT], size * (0.4 + 0.6 * g));
}

struct body make_body(const struct measures *m, double sole_m)
{
    const struct mean *mean = &means[m->sex];
    struct body b = { .measures = *m, .sole_m = sole_m };
    double h = m->stature_m, age = m->age_years;
    double grown_head = (m->sex == MALE ? 0.229 : 0.215) * sqrt(h / mean->stature_m);
    b.head_m = age >= 18 ? grown_head : by_age(age, 0.195, 0.204, 0.211, grown_head);
    b.chin_z = sole_m + h - b.head_m;
    b.foot_m = mean->foot_share * h * by_age(age, 1.02, 1.04, 1.03, 1);
    double index = m->mass_kg / (h * h * h), usual = mean->mass_kg / pow(mean->stature_m, 3);
    b.girth = sqrt(index / usual);
    double hip_share = by_age(age, 0.488, 0.508, 0.516, 0.52);
    place_joints(&b, hip_share);
    make_flesh(&b, hip_share);
    return b;
}

/* --- how skin and cloth follow --- */

/* How far p lies along the limb that bends at a joint, from the middle of the bend. */
static double along(struct vec3 p, struct vec3 above, struct vec3 joint, struct vec3 below)
{
    struct vec3 way = vec3_add(vec3_unit(vec3_sub(joint, above)), vec3_unit(vec3_sub(below, joint)));
    return vec3_dot(vec3_sub(p, joint), vec3_unit(way));
}

/* Share a weight between what is before a bend, half-way through, and behind it. */
static void bend(double weight[JOINT_COUNT], int before, int half, int behind, double w, double far, double reach)
{
    double begun = ramp(-reach, 0.15 * reach, far), done = ramp(-0.15 * reach, reach, far);
    weight[before] += w * (1 - begun);
    weight[half] += w * (begun - done);
    weight[behind] += w * done;
}

static double nearest(const struct solid *a, const struct solid *b, struct vec3 p)
{
    return fmin(solid_field(a, p), solid_field(b, p));
}

static void bind_trunk(double w[JOINT_COUNT], const struct body *b, struct vec3 p, double share)
{
    double h = b->measures.stature_m;
    double head = ramp(b->at[HEAD].z - 0.02 * h, b->at[HEAD].z + 0.03 * h, p.z), neck = ramp(b->at[NECK].z - 0.02 * h, b->at[NECK].z + 0.025 * h, p.z);
    double chest = ramp(b->at[CHEST].z - 0.05 * h, b->at[CHEST].z + 0.04 * h, p.z), spine = ramp(b->at[SPINE].z - 0.05 * h, b->at[SPINE].z + 0.04 * h, p.z);
    double out = ramp(0.045 * h, 0.11 * h, fabs(p.y)) * ramp(b->at[CHEST].z + 0.02 * h, b->at[LIMB(0, SHOULDER)].z, p.z) * (1 - neck);
    w[HEAD] += share * head;
    w[NECK] += share * (neck - head);
    w[LIMB(p.y < 0, SHOULDER)] += share * fmax(chest - neck, 0) * out;
    w[CHEST] += share * fmax(chest - neck, 0) * (1 - out);
    w[SPINE] += share * fmax(spine - chest, 0);
    w[HIPS] += share * (1 - spine);
}

static void bind_arm(double w[JOINT_COUNT], const struct body *b, struct vec3 p, int side, double share)
{
    const struct vec3 *at = &b->at[LIMB(side, 0)];
    struct vec3 tip = vec3_add(at[HAND], vec3_sub(at[HAND], at[FOREARM]));
    double h = b->measures.stature_m, hand = ramp(-0.012 * h, 0.014 * h, along(p, at[FOREARM], at[HAND], tip));
    w[LIMB(side, HAND)] += share * hand;
    bend(w, LIMB(side, UPPER_ARM), LIMB(side, ELBOW), LIMB(side, FOREARM), share * (1 - hand), along(p, at[UPPER_ARM], at[ELBOW], at[HAND]), 0.032 * h);
}

static void bind_leg(double w[JOINT_COUNT], const struct body *b, struct vec3 p, int side, double share, double drape)
{
    const struct vec3 *at = &b->at[LIMB(side, 0)];
    double h = b->measures.stature_m;
    double toes = ramp(-0.012 * h, 0.012 * h, p.x - at[TOES].x) * ramp(at[FOOT].z + 0.03 * h, at[FOOT].z, p.z);
    double foot = fmax(ramp(0.012 * h, -0.014 * h, p.z - at[FOOT].z), toes);
    w[LIMB(side, TOES)] += share * toes;
    w[LIMB(side, FOOT)] += share * (foot - toes);
    share *= 1 - foot;
    double far = at[KNEE].z - p.z, hang = 0.75 * drape * ramp(0.30 * h, 0.10 * h, far);
    double knee[JOINT_COUNT] = { 0 };
    bend(knee, THIGH, KNEE, SHIN, 1, along(p, at[THIGH], at[KNEE], at[FOOT]), 0.04 * h);
    double shin = knee[SHIN] * (1 - hang), half = knee[KNEE] * (1 - hang);
    w[LIMB(side, SHIN)] += share * shin;
    w[LIMB(side, KNEE)] += share * half;
    bend(w, HIPS, LIMB(side, HIP), LIMB(side, THIGH), share * (1 - shin - half), at[HIP].z - 0.005 * h - p.z, (0.05 + 0.05 * drape) * h);
}

void bind_point(double w[JOINT_COUNT], const struct body *b, struct vec3 p, double drape)
{
    double h = b->measures.stature_m;
    memset(w, 0, JOINT_COUNT * sizeof *w);
    int side = p.y < 0;
    struct vec3 left = vec3(p.x, fabs(p.y), p.z), right = vec3(p.x, -fabs(p.y), p.z);
    double arm = nearest(&b->upper_arm, &b->forearm, left), trunk = nearest(&b->trunk, &b->neck, left);
    struct vec3 tip = vec3_sub(left, b->at[LIMB(0, HAND)]), way = vec3_unit(vec3_sub(b->at[LIMB(0, HAND)], b->at[LIMB(0, FOREARM)]));
    double reach = vec3_dot(tip, way); /* hands go on where the forearm ends */
    if (reach > 0) arm = fmin(arm, vec3_norm(vec3_sub(tip, vec3_scale(way, fmin(reach, 0.12 * h)))) - 0.03 * h);
    double hip_z = b->at[LIMB(0, HIP)].z, leg = nearest(&b->thigh, &b->shin, left), body = fmin(trunk, leg);
    /* At the shoulder arm and trunk are one; a hand that hangs beside the hips moves no cloth there. */
    double apart_at = ramp(0.06 * h, 0.16 * h, vec3_norm(vec3_sub(left, b->at[LIMB(0, UPPER_ARM)])));
    double soft = (0.026 - 0.020 * apart_at) * h, bias = 0.012 * h * apart_at;
    double armed = ramp(-soft, soft, body - arm - bias) * ramp(-0.02 * h, 0.03 * h, left.y - 0.5 * b->at[LIMB(0, UPPER_ARM)].y);
    if (armed > 0) bind_arm(w, b, p, side, armed);
    if (p.z > hip_z + 0.1 * h) {
        bind_trunk(w, b, p, 1 - armed);
        return;
    }
    /* The legs: apart below the crotch, one cloth above it and in a skirt. */
    double other = nearest(&b->thigh, &b->shin, right);
    double apart = fmax(0.006 * h, 0.035 * h * ramp(b->crotch_z - 0.05 * h, b->crotch_z + 0.01 * h, p.z)) + 0.09 * h * drape;
    double own = ramp(-apart, apart, other - leg);
    double high = ramp(hip_z + 0.06 * h, hip_z + 0.1 * h, p.z);
    bind_trunk(w, b, p, (1 - armed) * high);
    bind_leg(w, b, p, side, (1 - armed) * (1 - high) * own, drape);
    bind_leg(w, b, p, !side, (1 - armed) * (1 - high) * (1 - own), drape);
}

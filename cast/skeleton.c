#include "cast/skeleton.h"

const char *const walker_joint_name[JOINT_COUNT] = {
    "hips", "spine", "chest", "head",
    "left upper arm", "left forearm", "left hand", "left thigh", "left shin", "left foot", "left toes",
    "right upper arm", "right forearm", "right hand", "right thigh", "right shin", "right foot", "right toes"
};

int walker_joint_parent(int joint)
{
    if (joint < LIMBS) return joint - 1;
    int limb = (joint - LIMBS) % LIMB_COUNT;
    return limb == UPPER_ARM ? CHEST : limb == THIGH ? HIPS : joint - 1;
}

/* From 0 at a to 1 at b. */
static double ramp(double a, double b, double x)
{
    double t = fmin(fmax((x - a) / (b - a), 0), 1);
    return t * t * (3 - 2 * t);
}

/* How far p lies along the limb that bends at a joint, from the middle of the bend. */
static double along(struct vec3 p, struct vec3 above, struct vec3 joint, struct vec3 below)
{
    struct vec3 way = vec3_add(vec3_unit(vec3_sub(joint, above)), vec3_unit(vec3_sub(below, joint)));
    return vec3_dot(vec3_sub(p, joint), vec3_unit(way));
}

static void add(double weight[JOINT_COUNT], int joint, double w) { weight[joint] += w; }

static void bind_trunk(double w[JOINT_COUNT], const struct skeleton *s, struct vec3 p)
{
    /* Below the belt a jacket lies on the thighs, and is pushed by them. */
    double chest = ramp(s->at[CHEST].z - 0.10, s->at[CHEST].z + 0.06, p.z), left = ramp(-0.07, 0.07, p.y);
    double spine = ramp(s->at[SPINE].z - 0.10, s->at[SPINE].z + 0.06, p.z), skirt = 0.6 * ramp(1.0, 0.82, p.z);
    add(w, CHEST, chest);
    add(w, SPINE, spine - chest);
    add(w, HIPS, (1 - spine) * (1 - skirt));
    add(w, LIMB(0, THIGH), (1 - spine) * skirt * left);
    add(w, LIMB(1, THIGH), (1 - spine) * skirt * (1 - left));
}

static void bind_legs(double w[JOINT_COUNT], const struct skeleton *s, struct vec3 p)
{
    double hip_z = s->at[LIMB(0, THIGH)].z, thigh = ramp(hip_z + 0.04, hip_z - 0.10, p.z), left = ramp(-0.035, 0.035, p.y);
    double share[2] = { left, 1 - left };
    add(w, HIPS, 1 - thigh);
    for (int side = 0; side < 2; side++) {
        const struct vec3 *at = &s->at[LIMB(side, THIGH)];
        double shin = ramp(-0.06, 0.06, along(p, at[0], at[1], at[2]));
        add(w, LIMB(side, THIGH), thigh * share[side] * (1 - shin));
        add(w, LIMB(side, SHIN), thigh * share[side] * shin);
    }
}

struct binding walker_bind_point(const struct skeleton *s, enum part part, struct vec3 p)
{
    double w[JOINT_COUNT] = { 0 }, t;
    int side = p.y < 0;
    const struct vec3 *arm = &s->at[LIMB(side, UPPER_ARM)], *toes = &s->at[LIMB(side, TOES)];
    switch (part) {
    case TRUNK: bind_trunk(w, s, p); break;
    case LEGS: bind_legs(w, s, p); break;
    case HEAD_PART:
        t = ramp(s->at[HEAD].z - 0.03, s->at[HEAD].z + 0.07, p.z);
        add(w, HEAD, t);
        add(w, CHEST, 1 - t);
        break;
    case ARM:
        t = ramp(-0.05, 0.05, along(p, arm[0], arm[1], arm[2]));
        add(w, LIMB(side, UPPER_ARM), 1 - t);
        add(w, LIMB(side, FOREARM), t);
        break;
    case FIST: add(w, LIMB(side, HAND), 1); break;
    case SHOE:
        t = ramp(-0.02, 0.02, p.x - toes->x);
        add(w, LIMB(side, TOES), t);
        add(w, LIMB(side, FOOT), 1 - t);
        break;
    }
    struct binding binding = { { 0 }, { 0 } };
    double total = 0;
    for (int k = 0; k < 4; k++) { /* the four heaviest */
        int best = 0;
        for (int j = 1; j < JOINT_COUNT; j++)
            if (w[j] > w[best]) best = j;
        if (w[best] < 1e-3) break;
        binding.joint[k] = best;
        binding.weight[k] = w[best];
        total += w[best];
        w[best] = 0;
    }
    for (int k = 0; k < 4; k++) binding.weight[k] /= total;
    return binding;
}

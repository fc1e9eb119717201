/* A body from few measures: its joints, and the solids of its flesh, standing upright with the arms a
 * little out. Metres; x forward, y left, z up, the ground at 0. */
#ifndef STAFFAGE_CAST_BODY_H
#define STAFFAGE_CAST_BODY_H

#include "cast/field.h"
#include "lib/vec.h"

/* The trunk, then the same limbs on the left and on the right: LIMB(side, THIGH), side 0 is left. What bends far
 * has a joint before it that takes half of the bend, so that no flesh is pinched. */
enum joint { HIPS, SPINE, CHEST, NECK, HEAD, LIMBS };
enum limb { SHOULDER, UPPER_ARM, ELBOW, FOREARM, HAND, HIP, THIGH, KNEE, SHIN, FOOT, TOES, LIMB_COUNT };
#define LIMB(side, limb) ((int)LIMBS + (side) * LIMB_COUNT + (int)(limb))
enum { HELD = LIMBS + 2 * LIMB_COUNT /* what the right hand holds */, JOINT_COUNT };

extern const char *const joint_name[JOINT_COUNT];
int joint_parent(int joint); /* -1 for HIPS; less than the joint */

enum sex { MALE, FEMALE };
struct measures { enum sex sex; double age_years, stature_m /* barefoot */, mass_kg; };

/* Of the left side where there are two. */
struct body {
    struct measures measures;
    double sole_m;                   /* of the shoes: what the feet stand on */
    double crotch_z, waist_z, neck_z, chin_z, head_m /* chin to top */, foot_m;
    double girth;                    /* how wide limbs are against the mean of the tables */
    struct vec3 at[JOINT_COUNT];
    struct solid trunk, girdle, bust, seat, neck;
    struct solid upper_arm, forearm, thigh, shin;
};

/* Src: Drillis, Contini 1966, Body segment parameters (lengths as shares of stature); Gordon et al. 2014, ANSUR II
 * (breadths, depths and girths of adults); Snyder et al. 1977, Anthropometry of infants, children and youths (heads);
 * Fredriks et al. 2005, sitting height (legs of children) */
struct body make_body(const struct measures *measures, double sole_m);

/* Out: weight (JOINT_COUNT) how much a point of skin or cloth follows each joint; sum 1.
 * In:  drape  0: close to the legs; 1: hangs around both, as a skirt does */
void bind_point(double weight[JOINT_COUNT], const struct body *body, struct vec3 p, double drape);

#endif

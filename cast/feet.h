/* How a foot rolls over the ground that passes under a body on the spot. */
#ifndef STAFFAGE_CAST_FEET_H
#define STAFFAGE_CAST_FEET_H

#include "cast/body.h"
#include "cast/hull.h"

enum { STEPS = 240 };  /* a fine grid of a leg's loop, from where its foot comes down */

/* Points of a shoe seen from the side, from the ankle, and how much each follows the toes. */
struct sole { double (*p)[3]; size_t count; double toe[2]; };
/* In: shoe_piece  which of the hull's it is */
struct sole sole_create(const struct body *body, const struct hull *hull, int shoe_piece, int side);
void sole_release(struct sole *sole);

typedef const double (*knots)[2]; /* (n) of rising x: a smooth curve, level at each extreme */
double curve_at(knots knot, int n, double x);

struct curve { const double (*knot)[2]; int count; };
struct roll {                    /* over the loop, from 0 to 1 */
    double stands, under;        /* until when the foot stands; when it lies flat under the body */
    struct curve pitch, bend;    /* degrees: foot against the ground, toes against the foot; up is above 0 */
    struct curve clearance;      /* over the swing: shares of the leg, what is lowest above the ground */
};
struct step { double x, z, pitch, bend; }; /* of the ankle, from below the hips; radians */

/* Out: step (STEPS) */
void roll_foot(struct step *step, const struct sole *sole, const struct roll *roll, double stride_m, double leg_m, double under_x);
/* How high above the ankle the lowest point of a foot lies: below 0. */
double foot_low(const struct sole *sole, double pitch, double bend);
/* Between two of them. */
struct step step_at(const struct step *step, double part);

#endif

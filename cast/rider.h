/* Who rides a cycle: a body of limbs that blend into one another, posed by its joints. */
#ifndef STAFFAGE_CAST_RIDER_H
#define STAFFAGE_CAST_RIDER_H

#include "cast/vehicle.h"

/* Joints of the left side, and of the right where the two differ (knee and ankle). */
struct rider {
    struct vec3 hip, chest, neck, head;         /* in the middle */
    struct vec3 shoulder, elbow, hand;          /* left; the right arm is its mirror image */
    struct vec3 knee[2], ankle[2], toe[2];      /* left, right */
    double hip_half;                            /* half the distance of the hip joints */
    bool full_helmet;
};
void add_rider(struct shell *shell, const struct rider *rider, enum level level);

#endif

/* Simple solids that vehicles are fitted out with. All are closed; axes x forward, y left, z up. */
#ifndef STAFFAGE_CAST_PART_H
#define STAFFAGE_CAST_PART_H

#include "cast/shell.h"

/* A box with bevelled edges. */
void part_box(struct shell *shell, struct vec3 at, struct vec3 half, double bevel_m, int material);
/* From a ball (round 1) towards a box (round 0); n points round it. */
void part_blob(struct shell *shell, struct vec3 at, struct vec3 half, double round, int n, int material);
/* A round tube through points; radius of the first and the last. n points round it. */
void part_tube(struct shell *shell, const struct vec3 *p, int count, double r0, double r1, int n, int material);
void part_rod(struct shell *shell, struct vec3 a, struct vec3 b, double r, int n, int material);
/* A body of revolution about y, through a profile that runs from its left end (+y) to its right; a radius
 * of 0 at both ends closes it, a profile that ends where it began is a ring. */
struct ring { double r, y; int material; }; /* material of the piece that begins here */
void part_lathe(struct shell *shell, struct vec3 at, const struct ring *profile, int count, int n, double crease_deg);
/* A flat plate with an outline in its plane, thick from 0 to `thickness` along across(u, v): u to the
 * right of v as seen from outside. The outline runs counter-clockwise and is seen whole from its middle. */
void part_plate(struct shell *shell, struct vec3 at, struct vec3 u, struct vec3 v, const double (*outline)[2], int count,
                double thickness_m, int material);
/* Turn points from `first` on about a place; angles in degrees, about y (bow down), then z (to the left). */
void part_turn(struct shell *shell, size_t first_point, struct vec3 about, double pitch_deg, double yaw_deg, double roll_deg);

#endif

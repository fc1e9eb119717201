/* Solids as functions of space: below 0 inside, about as many metres as the surface is away.
 * A shape is a list of solids that blend into one another, in order. */
#ifndef STAFFAGE_CAST_FIELD_H
#define STAFFAGE_CAST_FIELD_H

#include "lib/vec.h"

#include <stdbool.h>

/* A cross-section of a tube: half-widths to the sides, to the front and to the back, and how far its
 * middle lies in front of the axis. t: 0 at the tube's beginning, 1 at its end. */
struct station { double t, side, front, back, shift; };

enum solid_kind { BALL, TUBE, BOX, HALF };
enum blend { JOIN, CUT, KEEP };         /* add it; take it away; take away what is outside of it */

enum { STATIONS = 16 };
struct solid {
    enum solid_kind kind;
    enum blend blend;
    double soft_m;                      /* width of the blend with what came before; 0: an edge */
    struct vec3 at;                     /* middle; a tube's beginning; a point of the half space's face */
    struct mat3 axes;                   /* columns: its own front, left and up (tubes run up; half spaces lie below) */
    struct vec3 half;                   /* ball, box: half sizes */
    double round_m;                     /* box: radius of its edges */
    double length_m;                    /* tube */
    double square;                      /* tube: 0 an ellipse, 1 nearly a rectangle */
    double cap_m[2];                    /* tube: how far its two ends bulge; 0: as a ball would */
    int count;                          /* tube: stations, by t */
    struct station station[STATIONS], slope[STATIONS];
    struct vec3 bound;                  /* a ball around it: to know from afar that it does not matter */
    double bound_m;
};

/* Where cloth lies in folds. */
struct crease { struct vec3 at; double reach_m, depth_m; };

enum { SOLIDS = 64, CREASES = 12 };
struct shape {
    struct solid solid[SOLIDS];
    int count;
    struct crease crease[CREASES];
    int crease_count;
    double folds_m;                     /* depth of folds everywhere */
    double seed;
};

double field(const struct shape *shape, struct vec3 p);
/* Unit, out of the shape. */
struct vec3 field_normal(const struct shape *shape, struct vec3 p, double step_m);
double solid_field(const struct solid *solid, struct vec3 p);

/* Each appends a solid; its axes are the world's unless told. */
struct solid *add_ball(struct shape *shape, enum blend blend, double soft_m, struct vec3 at, struct vec3 half);
struct solid *add_box(struct shape *shape, enum blend blend, double soft_m, struct vec3 at, struct vec3 half, double round_m);
/* What lies below the face through `at`, against its normal. */
struct solid *add_half(struct shape *shape, enum blend blend, double soft_m, struct vec3 at, struct vec3 normal);
/* From a to b; front: about where its front is. */
struct solid *add_tube(struct shape *shape, enum blend blend, double soft_m, struct vec3 a, struct vec3 b, struct vec3 front,
                       const struct station *station, int count);
/* A round one. */
struct solid *add_rod(struct shape *shape, enum blend blend, double soft_m, struct vec3 a, double ra, struct vec3 b, double rb);
/* From a to b along knots of a bent one. */
void add_chain(struct shape *shape, enum blend blend, double soft_m, const struct vec3 *knot, const double *radius, int count);
/* Append a copy of a solid that was made before. */
struct solid *add_solid(struct shape *shape, const struct solid *solid);
void add_crease(struct shape *shape, struct vec3 at, double reach_m, double depth_m);
/* After its stations or sizes were changed. */
void solid_settle(struct solid *solid);
/* Turn it about its middle or beginning: about its left axis, front up. */
void solid_tip(struct solid *solid, double angle_rad);
/* The mirror image across y = 0. */
struct solid solid_mirrored(const struct solid *solid);

/* A box around all that is joined. */
void shape_bounds(struct vec3 *low, struct vec3 *high, const struct shape *shape);

/* From 0 to 1 in all of space, smooth; a step of 1 is the size of a spot. */
double noise(struct vec3 p, double seed);
/* From 0 at a to 1 at b, level at both. */
double ramp(double a, double b, double x);

#endif

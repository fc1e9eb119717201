/* A coachwork: the smooth body of a car, a cab or a van, as a solid. It is what lies within its outline as
 * seen from the side and within its half width, which depends on height and length; edges are rounded. */
#ifndef STAFFAGE_CAST_COACH_H
#define STAFFAGE_CAST_COACH_H

#include "cast/outline.h"
#include "cast/shell.h"

struct coach_spec {
    struct corner side[OUTLINE_CORNERS];   /* x forward, z up; ends at a corner of cut -1 */
    double half_width;
    double belt[2];                        /* height of the window sills, at the foremost and the rearmost point */
    double tumble, bulge;                  /* how windows lean in: slope, and slope more per metre */
    double shoulder;                       /* ledge below the windows */
    double tuck, tuck_z;                   /* how far the sill stays behind, and below which height that begins */
    double scallop, scallop_drop;          /* hollow along the flank, this far below the belt */
    double taper[2], taper_from[2];        /* front, rear: how far the half width is less at the very end, from which x on */
    double house[2];                       /* front, rear: how much more windows lean in at the ends */
    double sweep[2];                       /* front, rear: how far the ends lie back, times y squared */
    double crown, crown_z;                 /* fall of roof and bonnet, times y squared, above a height */
    double round, round_end;               /* radius of edges, in the middle and at the ends */
    double flare;                          /* of the wheel arches */
};

struct coach {
    const struct coach_spec *spec;
    struct outline side;
    double x[2];                           /* rear, front */
    double axle_x[4], axle_z, arch_r;
    int axles;
};

void coach_make(struct coach *coach, const struct coach_spec *spec);
struct form coach_form(const struct coach *coach);
double coach_half_width(const struct coach *coach, double x, double z);
double coach_belt(const struct coach *coach, double x);
/* Where the body begins in direction `sign` along x, at a place (y, z). */
double coach_end(const struct coach *coach, double sign, double y, double z);

/* Two solids' common part, with an edge of radius r. */
double round_both(double a, double b, double r);

/* ---- lines on it ---- */

enum mark_kind {
    MARK_SIDE,      /* an outline seen from the side: u = x, v = z */
    MARK_FRONT,     /* an outline wrapped around the nose: u = distance from the middle along a round corner, v = z */
    MARK_REAR,      /* the same at the tail */
    MARK_TOP,       /* an outline seen from above: u = x, v = y */
    MARK_BOTTOM,
    MARK_PANE,      /* a screen: on the outline from point 0 to point 1, within a distance of the flank */
    MARK_WINDOW,    /* a side window: between belt and roof, and between two leaning lines */
    MARK_DOOR,      /* a door: down to a height, up to the roof, and between two leaning lines; not over wheels */
    MARK_WHEEL,     /* a wheel arch */
    MARK_CABIN      /* what windows look into */
};
struct mark {
    const struct coach *coach;
    enum mark_kind kind;
    struct outline outline;
    double a[9];    /* see mark_*() */
};
struct form mark_form(const struct mark *mark);
struct mark mark_outline(const struct coach *coach, enum mark_kind kind, const struct corner *corner, int count);
struct mark mark_pane(const struct coach *coach, struct vec2 low, struct vec2 high, double pillar, double round);
struct mark mark_window(const struct coach *coach, double sill, double frame, double top_z, double front_x, double front_lean, double rear_x, double rear_lean, double round);
struct mark mark_door(const struct coach *coach, double bottom_z, double frame, double front_x, double front_lean, double rear_x, double rear_lean, double round);
struct mark mark_wheel(const struct coach *coach, int axle, double inner_y, double more_r);
struct mark mark_cabin(const struct coach *coach, double front_x, double rear_x, double floor_z);

#endif

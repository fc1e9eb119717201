/* A closed curve in a plane, from corners that are rounded off. */
#ifndef STAFFAGE_CAST_OUTLINE_H
#define STAFFAGE_CAST_OUTLINE_H

/* cut: how far from the corner, along both sides, the rounding begins; half a side at most. */
struct corner { double u, v, cut; };

enum { OUTLINE_CORNERS = 40, OUTLINE_STEPS = 8 };
struct outline {
    double p[OUTLINE_CORNERS * (OUTLINE_STEPS + 1) + 1][2]; /* the first comes again as the last */
    int count;
    struct { double u, v, r; } ring[OUTLINE_CORNERS + 1];    /* around every OUTLINE_STEPS + 1 sides, to pass over those far away */
};

/* The corners run round once, either way; the list ends before the first corner of cut < 0, or at the count. */
void outline_make(struct outline *outline, const struct corner *corner, int count);
/* Distance to the curve in metres, negative inside. */
double outline_distance(const struct outline *outline, double u, double v);
/* The smallest and largest v of the curve at u, or false beside it. */
_Bool outline_span(double v[2], const struct outline *outline, double u);

#endif

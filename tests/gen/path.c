#include "gen/world/path.h"

#include "tests/tap.h"

static struct path make(const struct vec2 *point_m, size_t n)
{
    struct path path = { 0 };
    struct error err = ERROR_NONE;
    if (!path_create(&path, point_m, n, &err)) {
        printf("Bail out! %s\n", err.text);
        exit(1);
    }
    return path;
}

static double turned(double to, double from) { return remainder(to - from, 2 * M_PI); }

/* Largest turn and largest change of curvature over any 1 cm, and the largest curvature. */
static void roughness(const struct path *path, double *turn, double *change, double *most)
{
    *turn = *change = *most = 0;
    struct path_point last = path_at(path, 0, 0);
    for (double s = 0.01; s < path_length(path); s += 0.01) {
        struct path_point at = path_at(path, s, 0);
        *turn = fmax(*turn, fabs(turned(at.heading_rad, last.heading_rad)));
        *change = fmax(*change, fabs(at.curvature - last.curvature));
        *most = fmax(*most, fabs(at.curvature));
        last = at;
    }
}

/* The farthest of the given points from the curve. */
static double miss(const struct path *path, const struct vec2 *p, size_t n)
{
    double worst = 0, s, offset;
    for (size_t i = 0; i < n; i++) worst = fmax(worst, path_project(path, &s, &offset, p[i]));
    return worst;
}

int main(void)
{
    enum { ARC = 10 };
    const double radius = 20;
    struct vec2 arc[ARC];
    for (int i = 0; i < ARC; i++) /* three quarters of a circle, to the left from east, at uneven steps */
        arc[i] = (struct vec2){ radius * sin(M_PI / 6 * (i + 0.2 * (i % 2))),
                                radius * (1 - cos(M_PI / 6 * (i + 0.2 * (i % 2)))) };
    struct path path = make(arc, ARC);
    NEAR(path_length(&path), radius * M_PI / 6 * 9.2, 1e-3, "points of a circle give the circle's length");
    double off = 0, heading = 0, bend = 0, aside = 0, back = 0;
    for (double s = 0; s < path_length(&path); s += 0.37) {
        struct path_point at = path_at(&path, s, 0), left = path_at(&path, s, 3);
        off = fmax(off, hypot(at.p_m.x - radius * sin(s / radius), at.p_m.y - radius * (1 - cos(s / radius))));
        heading = fmax(heading, fabs(turned(at.heading_rad, M_PI / 2 - s / radius)));
        bend = fmax(bend, fabs(at.curvature - 1 / radius));
        aside = fmax(aside, fabs(hypot(left.p_m.x, left.p_m.y - radius) - (radius - 3)));
        double s_back, offset_back, distance = path_project(&path, &s_back, &offset_back, left.p_m);
        back = fmax(back, fmax(fabs(s_back - s), fmax(fabs(offset_back - 3), fabs(distance - 3))));
    }
    NEAR(off, 0, 1e-3, "every point lies on the circle, at its arc length");
    NEAR(heading, 0, 1e-3, "its heading is the circle's, clockwise from +y");
    NEAR(bend, 0, 1e-3, "its curvature is the circle's, positive to the left");
    NEAR(aside, 0, 1e-3, "an offset is to the left: here towards the centre");
    NEAR(back, 0, 1e-4, "the projection of a point at (s, offset) is (s, offset)");
    bool steps = path.s_m[0] == 0;
    for (size_t i = 1; i < path.n; i++) {
        double chord = hypot(path.point_m[i].x - path.point_m[i - 1].x, path.point_m[i].y - path.point_m[i - 1].y);
        steps = steps && chord <= PATH_STEP_M && fabs(path.s_m[i] - path.s_m[i - 1] - chord) < 1e-4;
    }
    OK(steps, "samples are at most PATH_STEP_M apart and carry their arc length");
    struct path_point before = path_at(&path, -5, 0), after = path_at(&path, 1e6, 0);
    OK(before.p_m.x == arc[0].x && hypot(after.p_m.x - arc[ARC - 1].x, after.p_m.y - arc[ARC - 1].y) < 1e-6,
       "beyond its ends is at its ends");
    path_release(&path);

    /* A long street, a corner, a long street. */
    static const struct vec2 corner[3] = { { 0, 0 }, { 80, 0 }, { 80, 60 } };
    double turn, change, most;
    path = make(corner, 3);
    roughness(&path, &turn, &change, &most);
    OK(turn < 0.01 && change < 0.01, "a right angle is a bend without a jump in direction (%.4f) or curvature (%.4f)",
       turn, change);
    OK(most > 0.1 && most < 0.35, "that a car can take: radius %.1f m", 1 / most);
    NEAR(miss(&path, corner, 3), 0, 1e-3, "through its point");
    double swing = 0, far = 0;
    for (double s = 0; s < path_length(&path); s += 0.1) {
        struct vec2 p = path_at(&path, s, 0).p_m;
        double d = fmin(fabs(p.y), fabs(p.x - 80));
        swing = fmax(swing, d);
        if (p.x < 80 - 17 || p.y > 17) far = fmax(far, d);
    }
    OK(far < 0.05 && swing < 1.2, "and the streets stay straight: %.2f m in the bend, %.3f m beyond it", swing, far);
    path_release(&path);

    static const struct vec2 gentle[5] = { { 0, 0 }, { 12, 1 }, { 22, 4 }, { 33, 4.5 }, { 45, 2 } };
    path = make(gentle, 5);
    roughness(&path, &turn, &change, &most);
    OK(turn < 0.002 && change < 0.002 && most < 0.06, "a winding road is smooth: radius %.0f m at least", 1 / most);
    NEAR(miss(&path, gentle, 5), 0, 1e-3, "and goes through every point");
    path_release(&path);

    static const struct vec2 uneven[6] = { { 0, 0 }, { 60, 0 }, { 62, 0.5 }, { 62.01, 0.5 }, { 64, 2 }, { 110, 60 } };
    path = make(uneven, 6);
    roughness(&path, &turn, &change, &most);
    OK(turn < 0.01 && most < 0.5, "points 2 m and 60 m apart do not make it swing (radius %.1f m)", 1 / most);
    far = 0;
    for (double s = 0; s < 50; s += 0.1) far = fmax(far, fabs(path_at(&path, s, 0).p_m.y));
    OK(far < 0.3, "and the long part stays straight (%.2f m)", far);
    path_release(&path);

    static const struct vec2 hairpin[4] = { { 0, 0 }, { 40, 0 }, { 5, 0.5 }, { 5, 30 } };
    path = make(hairpin, 4);
    roughness(&path, &turn, &change, &most);
    OK(turn < 0.02 && path_length(&path) > 103 && path_length(&path) < 125, "a hairpin is turned in a small loop, %.0f m",
       path_length(&path));
    path_release(&path);

    static const struct vec2 line[2] = { { 3, 4 }, { 3, 14 } };
    path = make(line, 2);
    struct path_point middle = path_at(&path, 2.5, -1);
    OK(fabs(middle.p_m.x - 4) < 1e-9 && fabs(middle.p_m.y - 6.5) < 1e-9 && middle.heading_rad == 0 && middle.curvature == 0,
       "two points make a straight line; north is heading 0 and right of it is east");
    double s, offset;
    NEAR(path_project(&path, &s, &offset, (struct vec2){ 0, 18 }), 5, 1e-9, "the distance past the end is to the end");
    OK(s == path_length(&path) && fabs(offset - 3) < 1e-9, "and the projection is the end, with its offset");
    path_release(&path);

    static const struct vec2 same[3] = { { 1, 1 }, { 1, 1 }, { 1, 1 } }, lost[2] = { { 0, 0 }, { NAN, 1 } };
    struct error err = ERROR_NONE;
    OK(!path_create(&path, same, 3, &err) && err.code == ERR_INPUT && strstr(err.text, "3 points") && !path.n,
       "points that are all one are refused");
    err = ERROR_NONE;
    OK(!path_create(&path, same, 1, &err) && err.code == ERR_INPUT, "one point is refused");
    err = ERROR_NONE;
    OK(!path_create(&path, lost, 2, &err) && err.code == ERR_INPUT && strstr(err.text, "point 2"),
       "a point that is nowhere is refused by its number");
    return tap_done();
}

/* The sedan: sheets bent over a few curves, all of them seen from the left side and mirrored. */
#include "cast/mesh.h"

#include <stdlib.h>

#define COUNT(a) (sizeof(a) / sizeof *(a))

/* A smooth curve through knots of falling or rising x (cubic, Catmull-Rom). */
static double curve(const double (*knot)[2], size_t n, double x)
{
    double sign = knot[n - 1][0] > knot[0][0] ? 1 : -1;
    size_t i = 0;
    while (i + 2 < n && sign * (x - knot[i + 1][0]) > 0) i++;
    double x0 = knot[i][0], x1 = knot[i + 1][0], y0 = knot[i][1], y1 = knot[i + 1][1], h = x1 - x0;
    double straight = (y1 - y0) / h;
    double d0 = i ? (y1 - knot[i - 1][1]) / (x1 - knot[i - 1][0]) : straight;
    double d1 = i + 2 < n ? (knot[i + 2][1] - y0) / (knot[i + 2][0] - x0) : straight;
    double t = fmin(fmax((x - x0) / h, 0), 1), s = 1 - t;
    return s * s * (1 + 2 * t) * y0 + t * t * (1 + 2 * s) * y1 + h * s * t * (s * d0 - t * d1);
}
#define CURVE(knots, x) curve(knots, COUNT(knots), x)

static const double half_length = 2.3, half_width = 0.9, floor_z = 0.2;
static const double axle_x[2] = { 1.42, -1.28 }, axle_z = 0.32, arch_r = 0.375;

/* From nose to tail: the height of the shoulder where sides and top meet. */
static const double shoulder[][2] = { { 2.3, 0.66 }, { 2.0, 0.735 }, { 1.6, 0.80 }, { 1.0, 0.89 }, { 0.4, 0.925 },
                                      { -1.0, 0.955 }, { -1.8, 0.985 }, { -2.15, 0.985 }, { -2.3, 0.96 } };
/* From floor to shoulder: how far flanks, nose and tail stay behind the outermost line. */
static const double flank_inset[][2] = { { 0, 0.055 }, { 0.12, 0.02 }, { 0.4, 0 }, { 0.65, 0.004 }, { 0.75, 0.012 },
                                         { 0.9, 0.035 }, { 1, 0.075 } };
static const double nose_inset[][2] = { { 0, 0.13 }, { 0.12, 0.05 }, { 0.4, 0 }, { 0.55, 0.01 }, { 0.7, 0.05 },
                                        { 0.88, 0.12 }, { 1, 0.24 } };
static const double tail_inset[][2] = { { 0, 0.12 }, { 0.12, 0.04 }, { 0.4, 0 }, { 0.55, 0.01 }, { 0.75, 0.04 },
                                        { 0.92, 0.06 }, { 1, 0.10 } };
static const double level[] = { 0, 0.10, 0.25, 0.45, 0.58, 0.68, 0.80, 0.91, 1 };
static const double across[] = { 1, 0.93, 0.915, 0.75, 0.5, 0.25, 0 }; /* of the half width, shoulder to middle */
static const double nose_across[] = { 0, 0.2, 0.4, 0.55, 0.68, 0.8, 0.89 };
enum { LEVELS = COUNT(level) - 1, ACROSS = COUNT(across) - 1, NOSE = COUNT(nose_across), ARCH = 10 };

struct body { double x[64]; int last; }; /* stations, nose to tail */

static struct body body_stations(void)
{
    static const double doors[] = { 0.90, 0.884, 0.6, 0.3, 0, -0.33, -0.346, -0.6 };
    struct body body = { .last = 0 };
    for (int i = 0; i < NOSE; i++) body.x[body.last++] = half_length * pow(1 - nose_across[i] * nose_across[i], 1 / 9.0);
    for (int a = 0; a < 2; a++) {
        body.x[body.last++] = axle_x[a] + arch_r + 0.004;
        for (int k = 0; k <= ARCH; k++) body.x[body.last++] = axle_x[a] + arch_r * cos(PI * k / ARCH);
        body.x[body.last++] = axle_x[a] - arch_r - 0.004;
        for (size_t i = 0; !a && i < COUNT(doors); i++) body.x[body.last++] = doors[i];
    }
    for (int i = NOSE; i-- > 0;) body.x[body.last++] = -half_length * pow(1 - nose_across[i] * nose_across[i], 1 / 9.0);
    body.last--;
    return body;
}

static double plan_y(double x) { return half_width * sqrt(fmax(0, 1 - pow(fabs(x) / half_length, 9))); }

/* Height of the lower edge: the floor, but over the wheels. */
static double lower_edge(double x)
{
    for (int a = 0; a < 2; a++) {
        double d = x - axle_x[a];
        if (fabs(d) <= arch_r + 0.001) return axle_z + sqrt(fmax(0, arch_r * arch_r - d * d));
    }
    return floor_z;
}

static struct vec3 side_point(const void *shape, int i, int j)
{
    const struct body *body = shape;
    double x = body->x[i], top = CURVE(shoulder, x), low = lower_edge(x);
    double z = low + level[j] * (top - low), t = (z - floor_z) / (top - floor_z);
    double end = x > 0 ? -CURVE(nose_inset, t) : CURVE(tail_inset, t);
    double y = plan_y(x);
    return vec3(x + end * pow(fabs(x) / half_length, 7), y - y / half_width * CURVE(flank_inset, t), z);
}

static enum material side_material(const void *shape, int i, int j)
{
    const struct body *body = shape;
    int end = i < body->last / 2 ? i : body->last - 1 - i; /* stations from the nearer end */
    bool front = i == end;
    double v = level[j];
    if (body->x[i] - body->x[i + 1] < 0.02 && fabs(body->x[i]) < 1 && v > 0.05) return TRIM; /* between the doors */
    if (front && end >= 3 && end <= 5 && v > 0.57 && v < 0.75) return HEADLIGHT;
    if (!front && end >= 4 && end <= 6 && v > 0.6 && v < 0.85) return TAIL_LIGHT;
    if (front && end <= 2 && v > 0.5 && v < 0.6) return TRIM;              /* grille */
    if (front && end <= 3 && v > 0.05 && v < 0.2) return TRIM;              /* intake */
    return v < 0.05 ? TRIM : PAINT;
}

static double deck_z(const struct body *body, int i, double part)
{
    struct vec3 edge = side_point(body, i, LEVELS);
    return edge.z + 0.05 * (1 - part * part) * edge.y / half_width;
}

static bool in_cabin(double x) { return x < 0.7 && x > -1.3; }

static struct vec3 deck_point(const void *shape, int i, int j)
{
    struct vec3 edge = side_point(shape, i, LEVELS);
    bool sunk = in_cabin(edge.x) && j >= 2;
    return vec3(edge.x, edge.y * across[j], sunk ? 0.45 : deck_z(shape, i, across[j]));
}

static enum material deck_material(const void *shape, int i, int j)
{
    double x = side_point(shape, i, LEVELS).x;
    if (x < 0.95 && x > -1.62) return j >= 1 ? INTERIOR : PAINT;
    return j == 1 && i > 1 && x < 1.95 && x > -2.0 ? TRIM : PAINT; /* the gap beside bonnet and boot lid */
}

static struct vec3 floor_point(const void *shape, int i, int j)
{
    struct vec3 edge = side_point(shape, i, 0);
    double y = j == 3 ? edge.y : j == 0 ? 0 : fmin(edge.y, 0.6);
    return vec3(edge.x, y, j < 2 ? floor_z : edge.z);
}

static enum material underside(const void *shape, int i, int j)
{
    (void)shape, (void)i, (void)j;
    return UNDERSIDE;
}

/* The cabin: from the windscreen's middle round to the rear window's, at the belt and at the roof. */
static const struct { double belt[2], roof[2]; enum material material; } pillar[] = {
    { { 1.06, 0.00 }, { 0.30, 0.00 }, GLASS }, { { 1.01, 0.40 }, { 0.27, 0.33 }, GLASS },
    { { 0.84, 0.70 }, { 0.16, 0.55 }, PAINT }, { { 0.70, 0.765 }, { 0.04, 0.595 }, GLASS },
    { { -0.28, 0.79 }, { -0.30, 0.61 }, TRIM }, { { -0.36, 0.79 }, { -0.37, 0.61 }, GLASS },
    { { -1.18, 0.765 }, { -1.02, 0.59 }, PAINT }, { { -1.52, 0.70 }, { -1.16, 0.55 }, GLASS },
    { { -1.70, 0.40 }, { -1.27, 0.33 }, GLASS }, { { -1.76, 0.00 }, { -1.30, 0.00 }, GLASS }
};
static const double pane[] = { 0, 0.07, 0.35, 0.65, 0.94, 1 };
enum { PILLARS = COUNT(pillar) - 1, STEPS = 3, PANES = COUNT(pane) - 1, ROOF = 5 };

/* Both rims as smooth closed curves; beyond the middle they go on mirrored. */
static struct vec3 rim(bool roof, int i)
{
    double part = (double)(i % STEPS) / STEPS, knot[4][2];
    for (int k = 0; k < 4; k++) {
        int at = i / STEPS + k - 1, back = abs(PILLARS - abs(at)), real = PILLARS - back;
        const double *p = roof ? pillar[real].roof : pillar[real].belt;
        knot[k][0] = p[0], knot[k][1] = at < 0 || at > PILLARS ? -p[1] : p[1];
    }
    double out[2];
    for (int c = 0; c < 2; c++) {
        double a = knot[0][c], b = knot[1][c], d = knot[2][c], e = knot[3][c];
        out[c] = b + part / 2 * (d - a + part * (2 * a - 5 * b + 4 * d - e + part * (3 * (b - d) + e - a)));
    }
    double x = out[0], belt_z = CURVE(shoulder, x) + 0.05 * (1 - pow(out[1] / 0.83, 2));
    return vec3(x, out[1], roof ? 1.375 : belt_z - 0.015);
}

static struct vec3 cabin_point(const void *shape, int i, int j)
{
    (void)shape;
    double t = pane[j];
    struct vec3 a = rim(false, i), b = rim(true, i);
    struct vec3 p = vec3_add(vec3_scale(a, 1 - t), vec3_scale(b, t));
    struct vec3 out = vec3_unit(vec3((p.x + 0.25) * 0.5, p.y, 0.35));
    out.y *= fmin(1, fabs(p.y) * 4);
    return vec3_add(p, vec3_scale(out, 0.035 * sin(PI * t)));
}

static enum material cabin_material(const void *shape, int i, int j)
{
    (void)shape;
    enum material own = pillar[i / STEPS].material;
    if (j == PANES - 1) return PAINT;
    return j == 0 && own == GLASS ? TRIM : own;
}

static struct vec3 roof_point(const void *shape, int i, int j)
{
    (void)shape;
    struct vec3 edge = rim(true, i);
    double part = 1 - (double)j / ROOF;
    return vec3(edge.x, edge.y * part, edge.z + 0.075 * (1 - part * part) * (1 - pow((edge.x + 0.5) / 0.8, 4)));
}

static enum material painted(const void *shape, int i, int j)
{
    (void)shape, (void)i, (void)j;
    return PAINT;
}

/* A body of revolution: a wheel about y, outer face at +y. */
static const struct { double r, y; enum material material; } wheel_profile[] = {
    { 0.00, 0.085, RIM }, { 0.045, 0.088, RIM }, { 0.06, 0.07, RIM }, { 0.195, 0.082, RIM }, { 0.215, 0.092, RUBBER },
    { 0.235, 0.104, RUBBER }, { 0.285, 0.104, RUBBER }, { 0.312, 0.085, RUBBER }, { 0.32, 0.05, RUBBER },
    { 0.32, -0.06, RUBBER }, { 0.29, -0.10, UNDERSIDE }, { 0.00, -0.10, UNDERSIDE }
};
enum { RINGS = COUNT(wheel_profile) - 1, TURN = 30 };

static struct vec3 wheel_point(const void *shape, int i, int j)
{
    const struct vec3 *centre = shape;
    double a = 2 * PI * (i % TURN) / TURN, r = wheel_profile[j].r, y = wheel_profile[j].y;
    if (j == 2 && (i % 6 == 0 || i % 6 > 3)) y -= 0.04; /* between five spokes */
    return vec3_add(*centre, vec3(r * cos(a), y, r * sin(a)));
}

static enum material wheel_material(const void *shape, int i, int j)
{
    (void)shape;
    return j == 2 && i % 6 > 3 ? UNDERSIDE : wheel_profile[j].material;
}

enum { BALL = 12 };
struct ball { struct vec3 centre, radius; double round; enum material material; };

/* From a ball (round 1) towards a box (round 0). */
static struct vec3 ball_point(const void *shape, int i, int j)
{
    const struct ball *ball = shape;
    double a = 2 * PI * (i % BALL) / BALL, b = 2 * PI * j / BALL - PI / 2;
    double c[3] = { cos(a) * cos(b), sin(a) * cos(b), sin(b) };
    for (int k = 0; k < 3; k++) c[k] = fabs(c[k]) < 1e-9 ? 0 : copysign(pow(fabs(c[k]), ball->round), c[k]);
    return vec3_add(ball->centre, vec3(c[0] * ball->radius.x, c[1] * ball->radius.y, c[2] * ball->radius.z));
}

static enum material ball_material(const void *shape, int i, int j)
{
    (void)i, (void)j;
    return ((const struct ball *)shape)->material;
}

static void add_balls(struct model *model, const struct ball *balls, size_t n)
{
    for (size_t k = 0; k < n; k++) /* one with y > 0 is a pair */
        for (int side = 1; side >= (balls[k].centre.y > 0 ? -1 : 1); side -= 2)
            add_sheet(model, BALL, BALL / 2, side, ball_point, ball_material, &balls[k]);
}

void make_sedan(struct model *model)
{
    static const struct ball details[] = {
        { { 0.62, 0.93, 0.985 }, { 0.06, 0.10, 0.07 }, 0.7, PAINT },          /* mirrors */
        { { -0.22, 0.878, 0.80 }, { 0.10, 0.02, 0.018 }, 0.6, PAINT },        /* handles */
        { { -0.98, 0.876, 0.82 }, { 0.10, 0.02, 0.018 }, 0.6, PAINT },
        { { -0.20, 0.36, 0.80 }, { 0.13, 0.25, 0.36 }, 0.5, INTERIOR },       /* seats */
        { { -0.24, 0.36, 1.20 }, { 0.06, 0.13, 0.09 }, 0.6, INTERIOR },
        { { 0.10, 0.36, 0.55 }, { 0.28, 0.25, 0.12 }, 0.5, INTERIOR },
        { { -1.15, 0.00, 0.80 }, { 0.15, 0.62, 0.28 }, 0.4, INTERIOR },
        { { -1.25, 0.36, 1.08 }, { 0.05, 0.13, 0.08 }, 0.6, INTERIOR },
        { { 0.78, 0.00, 0.86 }, { 0.20, 0.68, 0.10 }, 0.5, INTERIOR },        /* dashboard */
        { { 2.295, 0.00, 0.42 }, { 0.02, 0.26, 0.055 }, 0.2, PLATE_FRONT },
        { { -2.285, 0.00, 0.62 }, { 0.02, 0.26, 0.055 }, 0.2, PLATE_REAR }
    };
    struct body body = body_stations();
    for (int side = 1; side >= -1; side -= 2) {
        add_sheet(model, body.last, LEVELS, side, side_point, side_material, &body);
        add_sheet(model, body.last, ACROSS, side, deck_point, deck_material, &body);
        add_sheet(model, body.last, 3, side, floor_point, underside, &body);
        add_sheet(model, PILLARS * STEPS, PANES, side, cabin_point, cabin_material, NULL);
        add_sheet(model, PILLARS * STEPS, ROOF, side, roof_point, painted, NULL);
        for (int a = 0; a < 2; a++) {
            struct vec3 hub = vec3(axle_x[a], 0.775, axle_z);
            add_sheet(model, TURN, RINGS, side, wheel_point, wheel_material, &hub);
        }
    }
    add_balls(model, details, COUNT(details));
}

#include "cast/wheel.h"

#include "cast/coat.h"
#include "cast/part.h"

#define COUNT(a) (int)(sizeof(a) / sizeof *(a))

static void add_tyre(struct shell *s, const struct wheel_spec *w, double y, int n, enum level level)
{
    double R = w->diameter_m / 2, r = w->rim_diameter_m / 2, h = w->width_m / 2, wall = R - r;
    const struct ring fine[] = {
        { r - 0.012, y + 0.80 * h, w->coat }, { r + 0.006, y + 0.84 * h, TYRE }, { r + 0.015, y + 0.86 * h, TYRE },
        { r + 0.40 * wall, y + 1.00 * h, TYRE }, { r + 0.72 * wall, y + 0.97 * h, TYRE }, { R - 0.05 * wall, y + 0.84 * h, TYRE },
        { R, y + 0.70 * h, TYRE }, { R, y - 0.70 * h, TYRE }, { R - 0.05 * wall, y - 0.84 * h, TYRE }, { r + 0.45 * wall, y - 1.00 * h, TYRE },
        { r - 0.012, y - 0.80 * h, RIM_DARK }, { r - 0.03, y, RIM_DARK }, { r - 0.012, y + 0.80 * h, RIM_DARK } };
    const struct ring coarse[] = {
        { r - 0.012, y + 0.80 * h, w->coat }, { r + 0.006, y + 0.84 * h, TYRE }, { r + 0.6 * wall, y + 1.00 * h, TYRE }, { R, y + 0.70 * h, TYRE },
        { R, y - 0.70 * h, TYRE }, { r + 0.6 * wall, y - 1.00 * h, TYRE }, { r - 0.012, y - 0.80 * h, RIM_DARK }, { r - 0.012, y + 0.80 * h, RIM_DARK } };
    if (level == NEAR) part_lathe(s, vec3(0, 0, 0), fine, COUNT(fine), n, 50);
    else part_lathe(s, vec3(0, 0, 0), coarse, COUNT(coarse), n, 60);
}

/* A plate from the hub to the rim, seen flat along the axle. */
static void add_spoke(struct shell *s, double angle, double r0, double r1, double w0, double w1, double y, double thick, int coat)
{
    struct vec3 u = vec3(sin(angle), 0, cos(angle)), v = vec3_cross(vec3(0, 1, 0), u);
    const double outline[][2] = { { r0, -w0 }, { r1, -w1 }, { r1, w1 }, { r0, w0 } };
    part_plate(s, vec3(0, y - thick, 0), u, v, outline, 4, thick, coat);
}

static void add_disc(struct shell *s, double r, double y, double thick, double dome, int n, int coat)
{
    const struct ring profile[] = { { 0, y + dome, coat }, { 0.55 * r, y + 0.75 * dome, coat }, { r, y, coat }, { r, y - thick, coat }, { 0, y - thick, coat } };
    part_lathe(s, vec3(0, 0, 0), profile, COUNT(profile), n, 40);
}

/* From far off a wheel is its outline and a disc of another colour; one with spokes stays open. */
static void add_far(struct shell *s, const struct wheel_spec *w)
{
    enum { SIDES = 12 };
    double R = w->diameter_m / 2, r = w->rim_diameter_m / 2, h = w->width_m / 2, inner = w->rim == TWIN_RIM ? -1.12 * w->width_m - h : -h;
    double face = w->rim == TWIN_RIM ? -0.5 * h : 0.6 * h;
    int disc = w->coat == RIM_COAT ? STEEL : w->coat; /* with the dark between its spokes */
    const struct ring wheel[] = { { 0, face, disc }, { r, face, TYRE }, { r + 0.01, 0.95 * h, TYRE }, { R, 0.8 * h, TYRE }, { R, inner, TYRE }, { 0, inner, TYRE } };
    const struct ring tyre[] = { { r, 0.8 * h, TYRE }, { R, 0.7 * h, TYRE }, { R, -0.7 * h, TYRE }, { r, -0.8 * h, TYRE }, { r, 0.8 * h, TYRE } };
    if (w->rim == CAST_RIM || w->rim == WIRE_RIM) part_lathe(s, vec3(0, 0, 0), tyre, COUNT(tyre), SIDES, 60);
    else part_lathe(s, vec3(0, 0, 0), wheel, COUNT(wheel), SIDES, 50);
    for (int k = 0; k < w->spokes && w->rim == CAST_RIM; k++) add_spoke(s, 2 * PI * k / w->spokes, 0, r, 0.04, 0.03, 0.012, 0.024, w->coat);
}

static void add_rim(struct shell *s, const struct wheel_spec *w, double middle_y, int n, enum level level)
{
    double r = w->rim_diameter_m / 2 - 0.01, h = w->width_m / 2, y = middle_y;
    switch (w->rim) {
    case ALLOY_RIM:
        add_disc(s, r, y - 0.1 * h, 0.02, 0, n, RIM_DARK);
        add_disc(s, 0.66 * r, y + 0.05 * h, 0.02, 0, n, STEEL);
        for (int k = 0; k < w->spokes; k++) {
            double a = 2 * PI * (k + 0.5) / w->spokes, fork = 0.11 * PI * 5 / w->spokes;
            for (int side = -1; side <= 1; side += 2)
                add_spoke(s, a + side * fork, 0.16 * r, 1.01 * r, 0.030, 0.022, y + 0.66 * h, 0.035, w->coat);
        }
        add_disc(s, 0.28 * r, y + 0.68 * h, 0.05, 0.008, level == NEAR ? n / 2 : 8, w->coat);
        if (level == NEAR) add_disc(s, 0.13 * r, y + 0.70 * h, 0.02, 0.006, n / 2, TRIM_COAT);
        break;
    case STEEL_RIM:
        add_disc(s, r, y + 0.45 * h, 0.03, 0.035, n, w->coat);
        for (int k = 0; k < w->spokes && level == NEAR; k++) {
            double a = 2 * PI * k / w->spokes;
            add_spoke(s, a, 0.66 * r, 0.86 * r, 0.022, 0.028, y + 0.45 * h + 0.018, 0.012, RIM_DARK);
        }
        add_disc(s, 0.3 * r, y + 0.45 * h + 0.035, 0.02, 0.02, level == NEAR ? n / 2 : 8, TRIM_COAT);
        break;
    case TRUCK_RIM:
    case TWIN_RIM: {
        double hub = w->rim == TRUCK_RIM ? y + 0.75 * h : y - 0.35 * h, face = w->rim == TRUCK_RIM ? y + 0.55 * h : y - 0.55 * h;
        const struct ring dish[] = { { 0, hub + 0.06, w->coat }, { 0.26 * r, hub + 0.055, w->coat }, { 0.32 * r, hub, w->coat }, { 0.60 * r, face, w->coat },
                                     { 0.66 * r, face - 0.015, w->coat }, { 0.9 * r, face - 0.05, w->coat }, { r, face - 0.05, w->coat },
                                     { r, face - 0.08, RIM_DARK }, { 0, face - 0.08, RIM_DARK } };
        part_lathe(s, vec3(0, 0, 0), dish, COUNT(dish), n, 35);
        for (int k = 0; k < 10 && level == NEAR; k++) {
            double a = 2 * PI * k / 10;
            part_rod(s, vec3(0.47 * r * sin(a), face - 0.02, 0.47 * r * cos(a)), vec3(0.47 * r * sin(a), face + 0.06, 0.47 * r * cos(a)), 0.016, 6, STEEL);
            add_spoke(s, a + PI / 10, 0.72 * r, 0.88 * r, 0.03, 0.035, face - 0.022, 0.01, RIM_DARK);
        }
        break;
    }
    case CAST_RIM:
    case WIRE_RIM: {
        int spokes = level == NEAR ? w->spokes : w->rim == WIRE_RIM ? 12 : w->spokes;
        for (int k = 0; k < spokes; k++) {
            double a = 2 * PI * k / spokes, b = w->rim == WIRE_RIM ? a + (k % 2 ? 0.35 : -0.35) : a;
            double lean = w->rim == WIRE_RIM ? (k % 4 < 2 ? 0.03 : -0.03) : 0;
            if (w->rim == CAST_RIM) add_spoke(s, a, 0.12 * r, r, 0.028, 0.018, y + 0.012, 0.024, w->coat);
            else part_rod(s, vec3(0.02 * sin(a), y + lean, 0.02 * cos(a)), vec3(r * sin(b), y, r * cos(b)), 0.0014, 3, w->coat);
        }
        part_rod(s, vec3(0, y - 0.05, 0), vec3(0, y + 0.05, 0), w->rim == CAST_RIM ? 0.045 : 0.02, level == NEAR ? 16 : 8, STEEL);
        if (w->rim == CAST_RIM) add_disc(s, 0.60 * r, y + 0.055, 0.006, 0, n, STEEL);
        break;
    }
    }
}

void wheel_make(struct shell *s, const struct wheel_spec *w, enum level level)
{
    if (level == FAR) {
        add_far(s, w);
        return;
    }
    int n = level == NEAR ? 32 : 16;
    bool twin = w->rim == TWIN_RIM;
    double apart = twin ? 1.12 * w->width_m : 0; /* the inner one's middle behind the outer one's */
    add_tyre(s, w, 0, n, level);
    if (twin) add_tyre(s, w, -apart, n, level);
    add_rim(s, w, 0, n, level);
}

void vehicle_add_axle(struct vehicle *v, const struct wheel_spec *w, const char *left, const char *right, double x, double outer_y, enum level level)
{
    struct vec3 hub = vec3(x, outer_y - w->width_m / 2, w->diameter_m / 2);
    for (int side = 0; side < 2; side++) {
        struct shell *shell = &v->wheel_shell[v->wheels];
        struct shell made = { 0 };
        wheel_make(&made, w, level);
        shell_append(shell, &made, vec3(0, 0, 0), side);
        shell_release(&made);
        v->wheel[v->wheels] = (struct wheel){ side ? right : left, vec3(hub.x, side ? -hub.y : hub.y, hub.z), v->wheels, w->diameter_m / 2 };
        v->wheels++;
    }
}

void vehicle_add_wheel(struct vehicle *v, const struct wheel_spec *w, const char *name, double x, enum level level)
{
    wheel_make(&v->wheel_shell[v->wheels], w, level);
    v->wheel[v->wheels] = (struct wheel){ name, vec3(x, 0, w->diameter_m / 2), v->wheels, w->diameter_m / 2 };
    v->wheels++;
}

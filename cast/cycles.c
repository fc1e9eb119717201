/* Cycles, with their riders. x runs forward from the middle, z up, in metres. */
#include "cast/coat.h"
#include "cast/occupant.h"
#include "cast/part.h"
#include "cast/wheel.h"

#define COUNT(a) (int)(sizeof(a) / sizeof *(a))

static int sides(enum level level, int near) { return level == NEAR ? near : level == MIDDLE ? near / 2 + 1 : 3; }

/* The same rod on both sides. */
static void rods(struct shell *s, struct vec3 a, struct vec3 b, double r, int n, int coat)
{
    part_rod(s, a, b, r, n, coat);
    part_rod(s, vec3(a.x, -a.y, a.z), vec3(b.x, -b.y, b.z), r, n, coat);
}

/* A strip bent around a wheel, from one angle to another (degrees from straight up, forward). */
static void add_mudguard(struct shell *s, double x, double z, double r, double from_deg, double to_deg, double half_y, enum level level, int coat)
{
    int n = level == NEAR ? 14 : 5;
    size_t first = s->faces_count;
    static const double section[][2] = { { 0, -1 }, { 0.35, -0.6 }, { 0.45, 0 }, { 0.35, 0.6 }, { 0, 1 }, { 0.15, 0.55 }, { 0.25, 0 }, { 0.15, -0.55 } };
    enum { RING = COUNT(section) };
    uint32_t start = (uint32_t)s->points;
    for (int i = 0; i <= n; i++)
        for (int k = 0; k < RING; k++) {
            double a = (from_deg + (to_deg - from_deg) * i / n) * PI / 180, q = r + section[k][0] * 0.06;
            shell_point(s, vec3(x + q * sin(a), section[k][1] * half_y, z + q * cos(a)), vec3(0, 0, 1));
        }
    bool turn = to_deg > from_deg;
    for (uint32_t i = 0; i < (uint32_t)n; i++)
        for (uint32_t k = 0; k < RING; k++) {
            uint32_t a = start + i * RING + k, b = start + i * RING + (k + 1) % RING;
            if (turn) shell_quad(s, a, a + RING, b + RING, b, coat);
            else shell_quad(s, a, b, b + RING, a + RING, coat);
        }
    for (int end = 0; end < 2; end++) {
        uint32_t o = start + (uint32_t)(end * n) * RING;
        bool flip = (end == 0) == turn;
        static const uint32_t cap[6][3] = { { 0, 1, 7 }, { 1, 6, 7 }, { 1, 2, 6 }, { 2, 3, 6 }, { 3, 5, 6 }, { 3, 4, 5 } };
        for (int k = 0; k < 6; k++) shell_face(s, o + cap[k][0], o + cap[k][flip ? 1 : 2], o + cap[k][flip ? 2 : 1], coat);
    }
    shell_smooth(s, first, 50);
}

static void make_motorcycle(struct vehicle *v, const struct vehicle_spec *spec, enum level level)
{
    (void)spec;
    struct shell *s = &v->body;
    const double front = 0.70, rear = -0.71, rf = 0.30, rr = 0.312;
    int n = sides(level, 12), m = level == NEAR ? 24 : level == MIDDLE ? 12 : 8;
    static const struct wheel_spec front_wheel = { 0.600, 0.120, 0.432, CAST_RIM, 5, RIM_DARK }, rear_wheel = { 0.624, 0.160, 0.432, CAST_RIM, 5, RIM_DARK };
    struct vec3 top = vec3(0.43, 0.095, 0.98);
    rods(s, vec3(front, 0.095, rf), vec3(0.545, 0.095, 0.70), 0.028, n, TRIM_COAT);
    rods(s, vec3(0.56, 0.095, 0.66), top, 0.021, n, BRIGHT);
    part_box(s, vec3(0.445, 0, 0.955), vec3(0.05, 0.12, 0.018), 0.01, TRIM_COAT);
    part_box(s, vec3(0.495, 0, 0.80), vec3(0.05, 0.12, 0.018), 0.01, TRIM_COAT);
    for (int k = -1; k <= 1; k += 2) {
        const struct vec3 bar[] = { { 0.44, 0, 1.0 }, { 0.45, k * 0.10, 1.01 }, { 0.43, k * 0.22, 1.06 }, { 0.37, k * 0.38, 1.045 } };
        part_tube(s, bar, COUNT(bar), 0.014, 0.014, sides(level, 8), TRIM_COAT);
        part_rod(s, vec3(0.405, k * 0.27, 1.055), vec3(0.365, k * 0.39, 1.043), 0.019, sides(level, 10), TYRE);
        part_rod(s, vec3(0.41, k * 0.25, 1.06), vec3(0.40, k * 0.32, 1.20), 0.007, sides(level, 5), TRIM_COAT);
        part_blob(s, vec3(0.40, k * 0.33, 1.22), vec3(0.018, 0.065, 0.042), 0.7, m, TRIM_COAT);
        if (level != FAR) {
            part_blob(s, vec3(0.60, k * 0.17, 0.86), vec3(0.035, 0.028, 0.022), 0.8, m / 2, TURN_LAMP);
            part_blob(s, vec3(-0.86, k * 0.15, 0.86), vec3(0.035, 0.028, 0.022), 0.8, m / 2, TURN_LAMP);
        }
    }
    part_blob(s, vec3(0.60, 0, 0.90), vec3(0.085, 0.115, 0.11), 0.75, m, PAINT_COAT);         /* headlamp in its shell */
    part_blob(s, vec3(0.655, 0, 0.895), vec3(0.035, 0.085, 0.08), 0.8, m, LAMP);
    part_blob(s, vec3(0.50, 0, 1.04), vec3(0.05, 0.08, 0.035), 0.6, m, TRIM_COAT);
    part_blob(s, vec3(0.20, 0, 0.86), vec3(0.275, 0.155, 0.14), 0.72, m, PAINT_COAT);           /* tank */
    part_blob(s, vec3(0.32, 0, 0.72), vec3(0.16, 0.18, 0.12), 0.75, m, PAINT_COAT);             /* shrouds */
    part_blob(s, vec3(-0.24, 0, 0.80), vec3(0.26, 0.135, 0.05), 0.6, m, TRIM_COAT);              /* seats */
    part_blob(s, vec3(-0.58, 0, 0.87), vec3(0.19, 0.11, 0.045), 0.65, m, TRIM_COAT);
    size_t first = s->points;
    part_blob(s, vec3(-0.60, 0, 0.80), vec3(0.32, 0.115, 0.065), 0.75, m, PAINT_COAT);           /* tail */
    part_turn(s, first, vec3(-0.6, 0, 0.8), -10, 0, 0);
    part_blob(s, vec3(-0.90, 0, 0.87), vec3(0.03, 0.08, 0.03), 0.6, m, REAR_LAMP);
    part_blob(s, vec3(-0.28, 0, 0.66), vec3(0.24, 0.14, 0.12), 0.6, m, TRIM_COAT);
    part_blob(s, vec3(0.10, 0, 0.46), vec3(0.26, 0.17, 0.15), 0.55, m, STEEL);                  /* engine */
    first = s->points;
    part_box(s, vec3(0.24, 0, 0.60), vec3(0.10, 0.155, 0.13), 0.03, STEEL);
    if (level == NEAR)
        for (int k = 0; k < 6; k++) part_box(s, vec3(0.24, 0, 0.51 + 0.035 * k), vec3(0.115, 0.165, 0.006), 0.003, STEEL);
    part_turn(s, first, vec3(0.24, 0, 0.6), 20, 0, 0);
    part_box(s, vec3(0.43, 0, 0.60), vec3(0.025, 0.17, 0.14), 0.01, TRIM_COAT);                  /* radiator */
    part_rod(s, vec3(0.0, -0.19, 0.44), vec3(0.0, 0.19, 0.44), 0.085, m, STEEL);
    rods(s, vec3(0.46, 0.05, 0.88), vec3(-0.16, 0.13, 0.50), 0.026, n, TRIM_COAT);              /* frame */
    rods(s, vec3(0.46, 0.05, 0.80), vec3(0.28, 0.13, 0.34), 0.020, n, TRIM_COAT);
    rods(s, vec3(-0.10, 0.13, 0.62), vec3(-0.72, 0.09, 0.80), 0.016, n, TRIM_COAT);
    rods(s, vec3(-0.13, 0.13, 0.44), vec3(rear, 0.125, rr), 0.030, n, STEEL);
    rods(s, vec3(-0.15, 0.17, 0.36), vec3(-0.15, 0.27, 0.34), 0.016, n, TRIM_COAT);              /* rests */
    const struct vec3 pipe[] = { { 0.36, -0.08, 0.46 }, { 0.38, -0.10, 0.30 }, { 0.24, -0.13, 0.22 }, { -0.1, -0.15, 0.22 }, { -0.28, -0.18, 0.28 } };
    part_tube(s, pipe, COUNT(pipe), 0.024, 0.03, n, STEEL);
    part_rod(s, vec3(-0.24, -0.18, 0.27), vec3(-0.66, -0.20, 0.46), 0.055, m / 2 * 2, STEEL);
    add_mudguard(s, front, rf, rf + 0.012, -62, 38, 0.070, level, PAINT_COAT);
    add_mudguard(s, rear, rr, rr + 0.02, -85, -35, 0.075, level, TRIM_COAT);
    if (level != FAR) rods(s, vec3(-0.22, 0.09, 0.62), vec3(-0.36, 0.09, 0.42), 0.03, n, TRIM_COAT);
    part_rod(s, vec3(-0.82, 0, 0.80), vec3(-0.98, 0, 0.60), 0.018, 6, TRIM_COAT);
    first = s->points;
    part_box(s, vec3(-1.0, 0, 0.58), vec3(0.004, 0.09, 0.05), 0.002, PLATE_WHITE);
    part_turn(s, first, vec3(-1.0, 0, 0.58), 18, 0, 0);
    vehicle_add_wheel(v, &front_wheel, "wheel_front", front, level);
    vehicle_add_wheel(v, &rear_wheel, "wheel_rear", rear, level);
    const struct seat seat = { .hips = { -0.24, 0, 0.93 }, .lean_deg = 20, .nod_deg = 6, .elbows_out = 1.0, .knees_out = 0.35, .toes_deg = { -12, -12 },
                               .wrist = { { 0.32, 0.33, 1.08 }, { 0.32, -0.33, 1.08 } }, .ankle = { { -0.20, 0.21, 0.45 }, { -0.20, -0.21, 0.45 } } };
    crew_seat(s, v->crew, MOTORCYCLIST, &seat, level != NEAR);
}

static void make_bicycle(struct vehicle *v, const struct vehicle_spec *spec, enum level level)
{
    (void)spec;
    struct shell *s = &v->body;
    const double front = 0.555, rear = -0.525, r = 0.348;
    int n = sides(level, 10);
    static const struct wheel_spec wheel = { 0.696, 0.036, 0.628, WIRE_RIM, 32, BRIGHT };
    const struct vec3 crank = { -0.08, 0, 0.285 }, head[2] = { { 0.375, 0, 0.66 }, { 0.335, 0, 0.80 } };
    part_rod(s, crank, vec3(-0.275, 0, 0.88), 0.016, n, PAINT_COAT);
    part_rod(s, crank, head[0], 0.019, n, PAINT_COAT);
    part_rod(s, vec3(-0.235, 0, 0.755), head[1], 0.016, n, PAINT_COAT);
    part_rod(s, head[0], vec3(0.325, 0, 0.84), 0.021, n, PAINT_COAT);
    part_rod(s, vec3(0.326, 0, 0.83), vec3(0.30, 0, 0.99), 0.013, n, BRIGHT);
    rods(s, vec3(-0.235, 0.02, 0.76), vec3(rear, 0.062, r), 0.009, n, PAINT_COAT);
    rods(s, vec3(crank.x, 0.03, crank.z), vec3(rear, 0.062, r), 0.010, n, PAINT_COAT);
    rods(s, vec3(0.378, 0.045, 0.645), vec3(front, 0.05, r), 0.012, n, PAINT_COAT);
    part_box(s, vec3(0.380, 0, 0.655), vec3(0.025, 0.058, 0.018), 0.01, PAINT_COAT);
    part_rod(s, vec3(-0.275, 0, 0.86), vec3(-0.292, 0, 0.93), 0.012, n, BRIGHT);
    part_blob(s, vec3(-0.29, 0, 0.945), vec3(0.13, 0.07, 0.03), 0.7, level == NEAR ? 16 : 6, TRIM_COAT);
    for (int k = -1; k <= 1; k += 2) {
        const struct vec3 bar[] = { { 0.315, 0, 0.99 }, { 0.33, k * 0.10, 1.0 }, { 0.30, k * 0.22, 1.03 }, { 0.22, k * 0.285, 1.03 } };
        part_tube(s, bar, COUNT(bar), 0.012, 0.012, sides(level, 8), BRIGHT);
        part_rod(s, vec3(0.265, k * 0.25, 1.03), vec3(0.15, k * 0.295, 1.025), 0.016, sides(level, 8), TYRE);
        double down = k > 0 ? -1 : 1; /* the left pedal is down */
        struct vec3 pedal = vec3(crank.x - down * 0.03, k * 0.125, crank.z + down * 0.167);
        part_rod(s, vec3(crank.x, k * 0.065, crank.z), vec3(pedal.x, k * 0.075, pedal.z), 0.010, sides(level, 6), BRIGHT);
        part_box(s, pedal, vec3(0.045, 0.045, 0.012), 0.005, TRIM_COAT);
    }
    add_mudguard(s, front, r, r + 0.012, -75, 30, 0.026, level, PAINT_COAT);
    add_mudguard(s, rear, r, r + 0.012, -100, 40, 0.026, level, PAINT_COAT);
    part_rod(s, vec3(crank.x, -0.07, crank.z), vec3(crank.x, 0.07, crank.z), 0.018, n, BRIGHT);
    part_rod(s, vec3(crank.x, -0.045, crank.z), vec3(crank.x, -0.049, crank.z), 0.085, level == NEAR ? 28 : 10, STEEL);
    if (level != FAR) {
        part_rod(s, vec3(rear, -0.042, r), vec3(rear, -0.05, r), 0.04, 12, STEEL);
        for (int k = -1; k <= 1; k += 2) part_rod(s, vec3(crank.x, -0.047, crank.z + k * 0.08), vec3(rear, -0.047, r + k * 0.036), 0.004, 4, FLOOR);
        const double rack_z = r + 0.40;
        for (int k = -1; k <= 1; k += 2) {
            part_rod(s, vec3(-0.30, k * 0.05, rack_z), vec3(-0.70, k * 0.055, rack_z), 0.006, 5, TRIM_COAT);
            part_rod(s, vec3(-0.56, k * 0.055, rack_z), vec3(rear, k * 0.068, r), 0.006, 5, TRIM_COAT);
        }
        for (int k = 0; k < 4; k++) part_rod(s, vec3(-0.36 - 0.11 * k, -0.052, rack_z), vec3(-0.36 - 0.11 * k, 0.052, rack_z), 0.005, 5, TRIM_COAT);
        part_blob(s, vec3(0.42, 0, 0.82), vec3(0.04, 0.03, 0.03), 0.8, 12, LAMP);
        part_blob(s, vec3(-0.715, 0, rack_z - 0.02), vec3(0.012, 0.035, 0.018), 0.6, 10, REAR_LAMP);
    }
    vehicle_add_wheel(v, &wheel, "wheel_front", front, level);
    vehicle_add_wheel(v, &wheel, "wheel_rear", rear, level);
    const struct seat seat = { .hips = { -0.27, 0, 1.02 }, .lean_deg = 16, .nod_deg = 4, .elbows_out = 0.7, .knees_out = 0.08, .toes_deg = { -8, -12 },
                               .wrist = { { 0.12, 0.27, 1.07 }, { 0.12, -0.27, 1.07 } }, .ankle = { { -0.13, 0.115, 0.20 }, { -0.19, -0.115, 0.53 } } };
    crew_seat(s, v->crew, CYCLIST, &seat, level != NEAR);
}

static const struct vehicle_spec motorcycle = { "motorcycle", CLASS_MOTORCYCLE, { 2.07, 0.79, 1.77, 0.79, 1.41, 0, 0.16, 0.60 },
    "published dimensions of a best-selling standard motorcycle (Honda CB500F), with a rider", make_motorcycle, NULL, NULL, 1 };
static const struct vehicle_spec bicycle = { "bicycle", CLASS_BICYCLE, { 1.82, 0.70, 1.88, 0.59, 1.08, 0, 0.27, 0.696 },
    "dimensions of a city bicycle with 700C wheels (ISO 37-622 tyres), with a rider", make_bicycle, NULL, NULL, 1 };

const struct vehicle_spec *const cycles[] = { &motorcycle, &bicycle };
const int cycle_count = sizeof cycles / sizeof *cycles;

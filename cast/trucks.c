/* Trucks: a cab, and what stands behind it on the frame. x runs forward from the middle, z up, in metres. */
#include "cast/car.h"
#include "cast/part.h"

#define END { 0, 0, -1 }
#define ACROSS(trace, kind, coat, depth, low, low_half, high, high_half, round) \
    { trace, kind, coat, depth, { { -(low_half), low, round }, { low_half, low, round }, { high_half, high, round }, { -(high_half), high, round }, END }, true }

static const struct wheel_spec wheel_small = { 0.81, 0.22, 0.50, TRUCK_RIM, 10, WHITE_PANEL }, twin_small = { 0.81, 0.22, 0.50, TWIN_RIM, 10, WHITE_PANEL };
static const struct wheel_spec wheel_large = { 1.03, 0.29, 0.58, TRUCK_RIM, 10, RIM_COAT }, twin_large = { 1.03, 0.27, 0.58, TWIN_RIM, 10, RIM_COAT };

/* --- what many have --- */

static void box(struct shell *s, double x0, double x1, double half_y, double z0, double z1, double bevel, int coat)
{
    part_box(s, vec3((x0 + x1) / 2, 0, (z0 + z1) / 2), vec3(fabs(x1 - x0) / 2, half_y, (z1 - z0) / 2), bevel, coat);
}

/* The same on both sides, from y0 out to y1. */
static void boxes(struct shell *s, double x0, double x1, double y0, double y1, double z0, double z1, double bevel, int coat)
{
    for (int side = -1; side <= 1; side += 2)
        part_box(s, vec3((x0 + x1) / 2, side * (y0 + y1) / 2, (z0 + z1) / 2), vec3(fabs(x1 - x0) / 2, (y1 - y0) / 2, (z1 - z0) / 2), bevel, coat);
}

static void add_frame(struct shell *s, double front_x, double rear_x, double z, double axle_x, double wheel_r)
{
    boxes(s, front_x, rear_x, 0.36, 0.44, z - 0.26, z, 0.01, FLOOR);
    part_rod(s, vec3(axle_x, -0.9, wheel_r), vec3(axle_x, 0.9, wheel_r), 0.09, 10, FLOOR);
    part_blob(s, vec3(axle_x, 0, wheel_r), vec3(0.2, 0.22, 0.2), 0.8, 10, FLOOR);
}

static void add_rear_lamps(struct shell *s, double x, double y, double z, double half_y, double half_z)
{
    for (int side = -1; side <= 1; side += 2) part_box(s, vec3(x, side * y, z), vec3(0.02, half_y, half_z), 0.01, REAR_LAMP);
}

static void add_axles(struct vehicle *v, const struct wheel_spec *front, const struct wheel_spec *rear, double front_x, double front_y, double rear_x,
                      double rear_y, double second_x, enum level level)
{
    vehicle_add_axle(v, front, "wheel_front_left", "wheel_front_right", front_x, front_y, level);
    vehicle_add_axle(v, rear, "wheel_rear_left", "wheel_rear_right", rear_x, rear_y, level);
    if (second_x != 0) vehicle_add_axle(v, rear, "wheel_rear2_left", "wheel_rear2_right", second_x, rear_y, level);
}

/* A panel that stands a little proud of a box's side. */
static void add_side_panel(struct shell *s, double x0, double x1, double y, double z0, double z1, int coat)
{
    boxes(s, x0, x1, y, y + 0.012, z0, z1, 0.005, coat);
}

static void add_lamp_bar(struct shell *s, double x, double z, double half_y, enum level level)
{
    box(s, x - 0.14, x + 0.14, half_y, z, z + 0.04, 0.015, TRIM_COAT);
    for (int side = -1; side <= 1; side += 2)
        part_box(s, vec3(x, side * 0.62 * half_y, z + 0.10), vec3(0.13, 0.34 * half_y, 0.06), 0.03, side < 0 ? RED_LAMP : BLUE_LAMP);
    if (level != FAR) part_box(s, vec3(x, 0, z + 0.09), vec3(0.12, 0.24 * half_y, 0.05), 0.02, LAMP);
}

/* --- box truck --- */

static const struct car_spec box_cab = {
    .coach = { .side = { { 3.42, 0.36, 0.08 }, { 3.49, 0.50, 0.08 }, { 3.50, 0.95, 0.15 }, { 3.44, 1.28, 0.14 }, { 3.02, 2.12, 0.22 }, { 2.80, 2.23, 0.20 },
                         { 1.98, 2.25, 0.15 }, { 1.85, 2.15, 0.10 }, { 1.82, 1.2, 0.1 }, { 1.82, 0.72, 0.06 }, { 1.90, 0.60, 0.06 }, { 2.9, 0.40, 0.1 }, END },
               .half_width = 1.02, .belt = { 1.26, 1.26 }, .tumble = 0.11, .bulge = 0.02, .shoulder = 0.02, .tuck = 0.03, .tuck_z = 0.60,
               .scallop = 0.012, .scallop_drop = 0.35, .taper = { 0.09, 0.01 }, .taper_from = { 2.9, 2.2 }, .house = { 0.06, 0.0 },
               .sweep = { 0.12, 0.0 }, .crown = 0.05, .crown_z = 1.5, .round = 0.09, .round_end = 0.13 },
    .axle_x = { 2.43, -9 }, .arch_gap = 0.07, .arch_inner_y = 0.62, .wheel = { 0.81, 0.22, 0.50, TRUCK_RIM, 10, WHITE_PANEL },
    .screen = { { CLEAR_WINDOW, { 3.42, 1.32 }, { 3.05, 2.06 }, 0.08, 0.08 } },
    .window = { { CLEAR_WINDOW, 3.30, -0.42, 2.12, -0.02 } }, .window_sill = -0.03, .window_frame = 0.16, .window_round = 0.06,
    .door = { { 3.22, -0.25, 2.02, 0, 2.16 } }, .door_bottom = 0.58, .door_frame = 0.09, .handle_z = 1.10,
    .decal = { { FILL, MARK_FRONT, LAMP, 0, { { 0.62, 0.70, 0.03 }, { 0.92, 0.70, 0.05 }, { 1.04, 0.72, 0.03 }, { 1.02, 0.86, 0.03 }, { 0.62, 0.86, 0.03 }, END }, true },
               ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.03, 0.90, 0.72, 1.08, 0.72, 0.03), ACROSS(FILL, MARK_FRONT, TRIM_COAT, 0, 0.40, 0.70, 0.62, 0.74, 0.04) },
    .skirt_z = 0.56, .seat_x = { 2.35 }, .seat_z = 1.02, .cabin = { 3.6, 1.84, 1.05 },
    .mirror = { 3.22, 1.16, 1.62 }, .mirror_coat = TRIM_COAT, .mirror_half = { 0.05, 0.09, 0.22 }, .plate_z = { 0.52, 0 }, .wiper_x = 3.44, .wiper_z = 1.35 };

static void make_box_truck(struct vehicle *v, const struct vehicle_spec *spec, enum level level)
{
    (void)spec;
    struct shell *s = &v->body;
    car_body(s, &box_cab, level);
    vehicle_add_driver(v, &box_cab, level);
    add_frame(s, 1.9, -3.35, 0.92, -1.38, 0.405);
    const double half = 1.22, front = 1.62, rear = -3.46, low = 1.0, top = 3.25;
    box(s, front, rear, half, low, top, 0.035, WHITE_PANEL);
    boxes(s, 0.9, -0.35, 0.62, 0.98, 0.45, 0.85, 0.05, FLOOR);      /* tank and batteries */
    add_rear_lamps(s, -3.47, 0.98, 0.78, 0.12, 0.05);
    boxes(s, -1.95, -1.97, 0.66, 1.14, 0.25, 0.9, 0.005, GAP);      /* mud flaps */
    box(s, -3.38, -3.46, 1.15, 0.50, 0.60, 0.02, STEEL);
    if (level != FAR) {
        const double edge = 0.05;
        boxes(s, front + 0.01, rear - 0.005, half - 0.02, half + 0.008, low, low + 2 * edge, 0.006, SILVER_PANEL);
        boxes(s, front + 0.01, rear - 0.005, half - 0.02, half + 0.008, top - 1.6 * edge, top + 0.004, 0.006, SILVER_PANEL);
        boxes(s, front - 0.05, front + 0.012, half - 0.05, half + 0.009, low, top, 0.006, SILVER_PANEL);
        boxes(s, rear - 0.012, rear + 0.07, half - 0.06, half + 0.009, low, top, 0.006, SILVER_PANEL);
        for (int k = 0; k < 9 && level == NEAR; k++) {              /* a roller door, in the frame of the rear */
            double z = low + 0.13 + k * 0.225;
            box(s, rear - 0.004, rear - 0.012, half - 0.12, z, z + 0.215, 0.004, WHITE_PANEL);
        }
        for (int k = 0; k < 5; k++) part_box(s, vec3(front + 0.012, (k - 2) * 0.4, top - 0.05), vec3(0.015, 0.05, 0.02), 0.008, TURN_LAMP);
        add_side_panel(s, 0.55, 0.10, 1.21, low + 0.02, low + 0.06, REAR_LAMP);
        boxes(s, 0.5, -0.4, 1.10, 1.14, 0.50, 0.58, 0.01, SILVER_PANEL);
        boxes(s, 0.5, -0.4, 1.10, 1.14, 0.72, 0.80, 0.01, SILVER_PANEL);
        if (level == NEAR) part_box(s, vec3(-3.47, -0.55, 0.78), vec3(0.012, 0.152, 0.076), 0.004, PLATE_WHITE);
    }
    add_axles(v, &wheel_small, &twin_small, box_cab.axle_x[0], 0.945, -1.38, 1.06, 0, level);
}

/* --- ambulance --- */

static const struct car_spec ambulance_cab = {
    .coach = { .side = { { 3.22, 0.34, 0.10 }, { 3.34, 0.42, 0.08 }, { 3.40, 0.66, 0.12 }, { 3.37, 0.94, 0.10 }, { 3.27, 1.10, 0.12 }, { 2.85, 1.28, 0.30 },
                         { 2.48, 1.38, 0.14 }, { 1.76, 2.06, 0.22 }, { 1.50, 2.16, 0.25 }, { 0.92, 2.20, 0.1 }, { 0.85, 2.1, 0.05 }, { 0.85, 0.70, 0.05 }, { 1.0, 0.50, 0.1 }, { 2.2, 0.34, 0.3 }, END },
               .half_width = 1.02, .belt = { 1.30, 1.30 }, .tumble = 0.12, .bulge = 0.04, .shoulder = 0.02, .tuck = 0.04, .tuck_z = 0.60,
               .scallop = 0.016, .scallop_drop = 0.40, .taper = { 0.14, 0.0 }, .taper_from = { 2.1, 1.0 }, .house = { 0.14, 0.0 },
               .sweep = { 0.18, 0.0 }, .crown = 0.05, .crown_z = 1.4, .round = 0.09, .round_end = 0.12, .flare = 0.014 },
    .axle_x = { 2.33, -9 }, .arch_gap = 0.06, .arch_inner_y = 0.66, .wheel = { 0.78, 0.225, 0.46, TRUCK_RIM, 10, RIM_COAT },
    .screen = { { CLEAR_WINDOW, { 2.47, 1.39 }, { 1.76, 2.05 }, 0.09, 0.09 } },
    .window = { { CLEAR_WINDOW, 2.36, -0.80, 1.20, -0.03 } }, .window_sill = 0.0, .window_frame = 0.14, .window_round = 0.06,
    .door = { { 1.94, -0.02, 1.12, -0.03, 1.22 } }, .door_bottom = 0.52, .door_frame = 0.08, .handle_z = 1.16,
    .decal = { { LAMP_HOUSE, MARK_FRONT, REFLECTOR, 0.05, { { 0.58, 0.90, 0.04 }, { 0.84, 0.90, 0.05 }, { 1.10, 1.00, 0.04 }, { 1.06, 1.17, 0.05 }, { 0.80, 1.11, 0.06 }, { 0.58, 1.03, 0.03 }, END }, true },
               ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.035, 0.76, 0.50, 1.02, 0.52, 0.05), ACROSS(FILL, MARK_FRONT, BRIGHT, 0, 0.46, 1.3, 0.68, 1.3, 0.05),
               { FILL, MARK_SIDE, ORANGE_PANEL, 0, { { 1.92, 0.98, 0.01 }, { 0.7, 0.98, 0.01 }, { 0.7, 1.20, 0.01 }, { 2.5, 1.20, 0.01 }, END }, true },
               { LINE, MARK_TOP, GAP, 0.008, { { 3.27, 0.0, 0.01 }, { 3.2, 0.52, 0.2 }, { 2.9, 0.75, 0.15 }, { 2.44, 0.80, 0.03 }, { 2.44, -0.80, 0.03 }, { 2.9, -0.75, 0.15 }, { 3.2, -0.52, 0.2 }, END }, false } },
    .skirt_z = 0.48, .seat_x = { 1.35 }, .seat_z = 0.92, .cabin = { 2.55, 0.86, 0.98 },
    .mirror = { 2.02, 1.18, 1.46 }, .mirror_coat = TRIM_COAT, .mirror_half = { 0.08, 0.10, 0.17 }, .plate_z = { 0.58, 0 }, .wiper_x = 2.42, .wiper_z = 1.42 };

static void make_ambulance(struct vehicle *v, const struct vehicle_spec *spec, enum level level)
{
    (void)spec;
    struct shell *s = &v->body;
    car_body(s, &ambulance_cab, level);
    vehicle_add_driver(v, &ambulance_cab, level);
    const double half = 1.19, front = 0.98, rear = -3.36, low = 0.62, top = 2.72;
    add_frame(s, 1.2, -3.3, 0.72, -1.68, 0.39);
    /* The box stands over the wheels: three pieces beside and above them. */
    box(s, front, rear, half, 0.98, top, 0.05, PAINT_COAT);
    box(s, front, -1.14, half, low - 0.12, 1.0, 0.03, PAINT_COAT);
    box(s, -2.22, rear, half, low - 0.12, 1.0, 0.03, PAINT_COAT);
    box(s, -1.12, -2.24, 0.80, low, 1.0, 0.03, GAP);
    box(s, rear + 0.02, rear - 0.06, 1.10, 0.44, 0.56, 0.02, SILVER_PANEL);
    add_side_panel(s, front - 0.02, rear + 0.02, half - 0.002, 1.04, 1.26, ORANGE_PANEL);
    add_lamp_bar(s, 1.25, 2.18, 0.62, level);
    for (int k = 0; k < 3 && level != FAR; k++)
        boxes(s, front - 0.25 - 1.75 * k, front - 0.60 - 1.75 * k, half - 0.004, half + 0.03, 2.50, 2.64, 0.02, k == 1 ? LAMP : RED_LAMP);
    add_rear_lamps(s, rear - 0.005, 1.02, 1.10, 0.10, 0.16);
    for (int side = -1; side <= 1; side += 2) {
        part_box(s, vec3(rear - 0.006, side * 0.40, 2.0), vec3(0.008, 0.27, 0.26), 0.004, BLACK_PANEL);
        if (level != FAR) part_box(s, vec3(rear - 0.01, side * 1.0, 2.57), vec3(0.025, 0.12, 0.06), 0.015, RED_LAMP);
    }
    part_box(s, vec3(front + 0.01, 0, 2.56), vec3(0.02, 0.5, 0.06), 0.012, RED_LAMP);
    add_side_panel(s, 0.20, -0.45, half - 0.002, 1.80, 2.25, BLACK_PANEL);
    if (level == NEAR) {
        boxes(s, 0.42, 0.408, half, half + 0.004, 0.72, 2.42, 0.001, GAP);      /* doors */
        boxes(s, -0.62, -0.632, half, half + 0.004, 0.72, 2.42, 0.001, GAP);
        boxes(s, -2.30, -2.312, half, half + 0.004, 1.30, 2.42, 0.001, GAP);
        boxes(s, 0.42, -0.632, half, half + 0.004, 2.41, 2.42, 0.001, GAP);
        boxes(s, -2.30, -3.30, half, half + 0.004, 2.41, 2.42, 0.001, GAP);
        boxes(s, -0.50, -0.58, half, half + 0.03, 1.36, 1.44, 0.01, BRIGHT);
        box(s, rear - 0.002, rear - 0.006, 0.006, 0.62, 2.42, 0.001, GAP);
        for (int side = -1; side <= 1; side += 2) part_box(s, vec3(rear - 0.006, side * 0.80, 1.5), vec3(0.004, 0.005, 0.9), 0.001, GAP);
        box(s, rear - 0.004, rear - 0.012, 0.75, 1.04, 1.26, 0.002, ORANGE_PANEL);
        part_box(s, vec3(rear - 0.07, -0.35, 0.50), vec3(0.006, 0.152, 0.05), 0.002, PLATE_WHITE);
        for (int bar = 0; bar < 3; bar++)                                        /* a star of six arms */
            for (int side = -1; side <= 1; side += 2) {
                size_t first = s->points;
                struct vec3 at = vec3(-1.5, side * (half + 0.004), 1.88);
                part_box(s, at, vec3(0.07, 0.005, 0.27), 0.002, LIVERY);
                part_turn(s, first, at, 60 * bar, 0, 0);
            }
    } else if (level == MIDDLE)
        add_side_panel(s, -1.30, -1.70, half - 0.002, 1.68, 2.08, LIVERY);
    static const struct wheel_spec front_wheel = { 0.78, 0.225, 0.46, TRUCK_RIM, 10, RIM_COAT }, twin = { 0.78, 0.215, 0.46, TWIN_RIM, 10, RIM_COAT };
    add_axles(v, &front_wheel, &twin, ambulance_cab.axle_x[0], 0.98, -1.68, 1.10, 0, level);
}

/* --- fire truck --- */

static const struct car_spec fire_cab = {
    .coach = { .side = { { 4.66, 0.52, 0.08 }, { 4.74, 0.66, 0.06 }, { 4.75, 1.35, 0.10 }, { 4.68, 1.62, 0.12 }, { 4.50, 2.62, 0.18 }, { 4.25, 2.82, 0.20 }, { 3.4, 2.86, 0.3 },
                         { 1.85, 2.86, 0.06 }, { 1.80, 2.80, 0.04 }, { 1.80, 0.66, 0.05 }, { 2.0, 0.52, 0.1 }, END },
               .half_width = 1.24, .belt = { 1.55, 1.55 }, .tumble = 0.05, .bulge = 0.01, .shoulder = 0.015, .tuck = 0.02, .tuck_z = 0.80,
               .scallop = 0, .scallop_drop = 0.3, .taper = { 0.10, 0.0 }, .taper_from = { 4.0, 1.9 }, .sweep = { 0.10, 0.0 },
               .crown = 0.03, .crown_z = 2.0, .round = 0.10, .round_end = 0.16 },
    .axle_x = { 3.18, -9 }, .arch_gap = 0.09, .arch_inner_y = 0.78, .wheel = { 1.03, 0.29, 0.58, TRUCK_RIM, 10, RIM_COAT },
    .screen = { { CLEAR_WINDOW, { 4.67, 1.66 }, { 4.50, 2.56 }, 0.10, 0.10 } },
    .window = { { CLEAR_WINDOW, 4.44, -0.10, 3.66, 0 }, { TINTED_WINDOW, 3.40, 0, 2.98, 0 }, { TINTED_WINDOW, 2.86, 0, 1.98, 0 } },
    .window_sill = 0.03, .window_frame = 0.14, .window_round = 0.07, .window_top = 2.50,
    .door = { { 4.46, -0.08, 3.58, 0, 3.66 }, { 2.94, 0, 1.90, 0, 2.84 } }, .door_bottom = 0.66, .door_frame = 0.12, .handle_z = 1.40,
    .decal = { { FILL, MARK_FRONT, BRIGHT, 0, { { 0.72, 1.02, 0.03 }, { 1.10, 1.02, 0.05 }, { 1.16, 1.30, 0.03 }, { 0.72, 1.30, 0.03 }, END }, true },
               { FILL, MARK_FRONT, LAMP, 0, { { 0.76, 1.06, 0.03 }, { 1.06, 1.06, 0.03 }, { 1.08, 1.26, 0.03 }, { 0.76, 1.26, 0.03 }, END }, true },
               ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.03, 0.92, 0.58, 1.44, 0.58, 0.05),
               { FILL, MARK_SIDE, WHITE_PANEL, 0, { { 9, 1.36, 0.01 }, { 1.7, 1.36, 0.01 }, { 1.7, 1.52, 0.01 }, { 9, 1.52, 0.01 }, END }, true } },
    .skirt_z = 0.60, .seat_x = { 3.75, 2.35 }, .seat_z = 1.28, .cabin = { 4.9, 1.82, 1.30 },
    .mirror = { 4.50, 1.42, 2.05 }, .mirror_coat = TRIM_COAT, .mirror_half = { 0.07, 0.10, 0.24 }, .plate_z = { 0, 0 }, .wiper_x = 4.70, .wiper_z = 1.66 };

static void add_ladder(struct shell *s, double y, double z, double x0, double x1, enum level level)
{
    for (int side = 0; side < 2; side++) part_box(s, vec3((x0 + x1) / 2, y, z + 0.42 * side), vec3(fabs(x1 - x0) / 2, 0.025, 0.03), 0.01, SILVER_PANEL);
    for (int k = 1; k < 12 && level == NEAR; k++) {
        double x = x0 + (x1 - x0) * k / 12;
        part_rod(s, vec3(x, y, z), vec3(x, y, z + 0.42), 0.014, 6, SILVER_PANEL);
    }
}

static void make_fire_truck(struct vehicle *v, const struct vehicle_spec *spec, enum level level)
{
    (void)spec;
    struct shell *s = &v->body;
    car_body(s, &fire_cab, level);
    vehicle_add_driver(v, &fire_cab, level);
    const double half = 1.24, rear = -4.72, top = 2.52;
    add_frame(s, 2.2, -4.6, 0.90, -1.85, 0.515);
    box(s, 4.70, 4.98, 1.20, 0.50, 0.80, 0.05, BRIGHT);              /* bumper */
    box(s, 1.72, 0.92, half - 0.03, 0.75, 2.40, 0.03, SILVER_PANEL);  /* pump */
    box(s, 1.80, 0.90, 0.9, 2.3, 2.62, 0.05, PAINT_COAT);
    box(s, 0.90, -1.22, half, 0.62, top, 0.03, PAINT_COAT);
    box(s, -2.48, rear, half, 0.62, top, 0.03, PAINT_COAT);
    box(s, -1.20, -2.50, half, 1.20, top, 0.03, PAINT_COAT);
    box(s, -1.20, -2.50, 0.85, 0.80, 1.25, 0.03, GAP);
    box(s, rear + 0.02, rear - 0.26, 1.20, 0.55, 0.63, 0.02, SILVER_PANEL);
    boxes(s, 0.80, rear + 0.02, half - 0.30, half - 0.04, top, top + 0.26, 0.02, PAINT_COAT);
    box(s, 0.70, rear + 0.1, half - 0.30, top - 0.05, top + 0.10, 0.03, LIVERY);                /* hose bed's cover */
    add_side_panel(s, 0.88, rear + 0.02, half - 0.002, 1.36, 1.52, WHITE_PANEL);
    static const double shutter[][3] = { { 0.80, -1.10, 0.74 }, { -1.28, -2.42, 1.62 }, { -2.58, -4.62, 0.74 } };
    for (int k = 0; k < 3 && level != FAR; k++) {
        double x0 = shutter[k][0], x1 = shutter[k][1], low = fmax(shutter[k][2], level == NEAR ? 0 : 1.58);
        add_side_panel(s, x0, x1, half + 0.008, low, 2.36, SILVER_PANEL);
        for (double z = low + 0.09; z < 2.30 && level == NEAR; z += 0.09) boxes(s, x0 - 0.02, x1 + 0.02, half + 0.018, half + 0.0215, z, z + 0.012, 0.001, GAP);
    }
    add_lamp_bar(s, 4.05, 2.86, 0.95, level);
    for (int k = 0; k < 2 && level != FAR; k++) boxes(s, k ? 0.7 : rear + 0.35, k ? 0.45 : rear + 0.10, half - 0.22, half - 0.04, top + 0.25, top + 0.38, 0.03, RED_LAMP);
    add_ladder(s, -(half - 0.10), top + 0.20, 0.7, rear + 0.1, level);
    add_rear_lamps(s, rear - 0.01, 1.02, 1.02, 0.09, 0.22);
    box(s, rear - 0.004, rear - 0.012, 0.80, 0.75, 1.30, 0.004, YELLOW_SIGN);
    box(s, rear - 0.004, rear - 0.012, 0.62, 1.45, 2.36, 0.004, SILVER_PANEL);
    if (level == NEAR) {
        for (int k = 0; k < 4; k++)
            for (int side = -1; side <= 1; side += 2) {
                size_t first = s->points;
                struct vec3 at = vec3(rear - 0.012, side * (0.14 + 0.18 * k), 1.025);
                part_box(s, at, vec3(0.004, 0.045, 0.30), 0.001, RED_PANEL);
                part_turn(s, first, at, 0, 0, side * 35);
            }
        for (int side = -1; side <= 1; side += 2)
            for (int k = 0; k < 6; k++) {   /* gauges and outlets of the pump */
                double x = 1.62 - 0.12 * k;
                part_rod(s, vec3(x, side * (half - 0.04), 1.95), vec3(x, side * (half - 0.015), 1.95), 0.045, 12, PLATE_WHITE);
                if (k % 2) part_rod(s, vec3(x, side * (half - 0.04), 1.10 + 0.12 * (k % 3)), vec3(x, side * (half + 0.06), 1.08 + 0.12 * (k % 3)), 0.06, 10, BRIGHT);
            }
    }
    add_axles(v, &wheel_large, &twin_large, fire_cab.axle_x[0], 1.22, -1.85, 1.20, 0, level);
}

/* --- dump truck --- */

static const struct car_spec dump_cab = {
    .coach = { .side = { { 4.00, 0.62, 0.06 }, { 4.08, 0.72, 0.05 }, { 4.09, 1.30, 0.1 }, { 4.02, 1.62, 0.10 }, { 3.86, 1.74, 0.12 }, { 3.2, 1.84, 0.3 }, { 2.58, 1.92, 0.10 }, { 2.24, 2.66, 0.16 },
                         { 2.00, 2.80, 0.2 }, { 1.25, 2.82, 0.12 }, { 1.15, 2.70, 0.08 }, { 1.12, 0.95, 0.05 }, { 1.3, 0.80, 0.08 }, { 2.4, 0.72, 0.1 }, { 3.6, 0.62, 0.1 }, END },
               .half_width = 1.10, .belt = { 1.72, 1.80 }, .tumble = 0.08, .bulge = 0.02, .shoulder = 0.03, .tuck = 0.03, .tuck_z = 0.85,
               .scallop = 0.02, .scallop_drop = 0.25, .taper = { 0.16, 0.0 }, .taper_from = { 2.2, 1.2 }, .sweep = { 0.12, 0.0 },
               .crown = 0.09, .crown_z = 1.7, .round = 0.13, .round_end = 0.14 },
    .axle_x = { 3.08, -9 }, .arch_gap = 0.10, .arch_inner_y = 0.66, .wheel = { 1.03, 0.29, 0.58, TRUCK_RIM, 10, RIM_COAT },
    .screen = { { CLEAR_WINDOW, { 2.56, 1.97 }, { 2.26, 2.61 }, 0.10, 0.08 } },
    .window = { { CLEAR_WINDOW, 2.46, -0.40, 1.34, 0 } }, .window_sill = 0.06, .window_frame = 0.18, .window_round = 0.06,
    .door = { { 2.42, -0.1, 1.24, 0, 1.36 } }, .door_bottom = 0.95, .door_frame = 0.10, .handle_z = 1.62,
    .decal = { { FILL, MARK_FRONT, LAMP, 0, { { 0.66, 1.10, 0.03 }, { 0.96, 1.12, 0.05 }, { 1.10, 1.16, 0.03 }, { 1.08, 1.34, 0.03 }, { 0.68, 1.32, 0.03 }, END }, true },
               ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.04, 0.98, 0.50, 1.60, 0.46, 0.08), ACROSS(FILL, MARK_FRONT, BRIGHT, 0, 0.64, 0.85, 0.86, 0.85, 0.03) },
    .skirt_z = 0.80, .seat_x = { 1.55 }, .seat_z = 1.45, .cabin = { 2.66, 1.13, 1.55 },
    .mirror = { 2.42, 1.26, 2.22 }, .mirror_coat = TRIM_COAT, .mirror_half = { 0.06, 0.10, 0.22 }, .plate_z = { 0.76, 0 }, .wiper_x = 2.52, .wiper_z = 2.0 };

static void make_dump_truck(struct vehicle *v, const struct vehicle_spec *spec, enum level level)
{
    (void)spec;
    struct shell *s = &v->body;
    car_body(s, &dump_cab, level);
    vehicle_add_driver(v, &dump_cab, level);
    const double half = 1.25, front = 0.88, rear = -4.02, low = 1.28, top = 2.72, sheet = 0.06;
    add_frame(s, 2.4, -3.9, 1.06, -1.55, 0.515);
    part_rod(s, vec3(-2.90, -0.9, 0.515), vec3(-2.90, 0.9, 0.515), 0.09, 10, FLOOR);
    boxes(s, 1.35, 0.0, 0.62, 1.12, 0.55, 1.02, 0.12, SILVER_PANEL);    /* tanks */
    box(s, front, rear, half - 0.02, low, low + 0.16, 0.02, PAINT_COAT);
    boxes(s, front, rear, half - sheet, half, low + 0.06, top, 0.02, PAINT_COAT);
    box(s, front, front - sheet, half - 0.01, low + 0.06, top + 0.18, 0.02, PAINT_COAT);
    box(s, rear, rear + sheet, half - 0.01, low + 0.02, top - 0.06, 0.02, PAINT_COAT);
    box(s, front + 0.9, front - 0.02, half - 0.10, top + 0.14, top + 0.20, 0.02, PAINT_COAT);  /* over the cab */
    box(s, front - 0.05, rear + 0.05, half - 0.05, low + 0.15, low + 0.19, 0.01, BED);
    boxes(s, front, rear - 0.02, half - 0.08, half + 0.045, top - 0.04, top + 0.08, 0.02, PAINT_COAT);
    for (int k = 0; k < 8 && level != FAR; k++) boxes(s, front - 0.12 - 0.66 * k, front - 0.24 - 0.66 * k, half - 0.01, half + 0.05, low + 0.04, top - 0.02, 0.015, PAINT_COAT);
    for (int k = 0; k < 3 && level != FAR; k++) {
        double y = (k - 1) * 0.85;
        part_box(s, vec3(rear - 0.02, y, (low + top) / 2), vec3(0.035, 0.05, 0.6), 0.015, PAINT_COAT);
    }
    boxes(s, -0.85, -0.87, 0.62, 1.2, 0.3, 1.0, 0.005, GAP);
    boxes(s, -3.62, -3.64, 0.62, 1.2, 0.3, 1.1, 0.005, GAP);
    box(s, -3.85, -3.95, 1.1, 0.72, 0.90, 0.02, FLOOR);
    add_rear_lamps(s, -3.96, 0.85, 0.82, 0.14, 0.06);
    for (int side = -1; side <= 1; side += 2)
        part_rod(s, vec3(1.0, side * 1.02, 0.9), vec3(1.0, side * 1.02, 3.0), 0.065, level == NEAR ? 14 : 6, BRIGHT);   /* exhaust stacks */
    if (level != FAR) {
        boxes(s, 2.25, 1.3, 1.0, 1.16, 0.66, 0.72, 0.01, SILVER_PANEL);
        for (int k = 0; k < 5; k++) part_box(s, vec3(1.95, (k - 2) * 0.32, 2.84), vec3(0.03, 0.04, 0.025), 0.01, TURN_LAMP);
        if (level == NEAR) part_box(s, vec3(-3.97, 0, 0.80), vec3(0.01, 0.152, 0.076), 0.004, PLATE_WHITE);
    }
    add_axles(v, &wheel_large, &twin_large, dump_cab.axle_x[0], 1.17, -1.55, 1.21, -2.90, level);
}

/* --- city bus --- */

static const struct car_spec bus_body = {
    .coach = { .side = { { 6.14, 0.34, 0.10 }, { 6.24, 0.46, 0.10 }, { 6.25, 0.95, 0.2 }, { 6.21, 1.25, 0.2 }, { 6.00, 2.80, 0.25 }, { 5.76, 3.02, 0.25 }, { 4.0, 3.06, 0.5 },
                         { -5.84, 3.06, 0.3 }, { -6.18, 2.92, 0.25 }, { -6.25, 1.6, 0.3 }, { -6.25, 0.7, 0.15 }, { -6.10, 0.40, 0.15 }, { -3.0, 0.30, 0.2 }, { 3.0, 0.30, 0.2 }, END },
               .half_width = 1.295, .belt = { 1.15, 1.15 }, .tumble = 0.035, .bulge = 0.004, .shoulder = 0.008, .tuck = 0.01, .tuck_z = 0.60,
               .taper = { 0.13, 0.05 }, .taper_from = { 5.3, -5.5 }, .sweep = { 0.14, 0.04 }, .crown = 0.045, .crown_z = 2.2, .round = 0.16, .round_end = 0.17 },
    .axle_x = { 3.95, -3.257 }, .arch_gap = 0.07, .arch_inner_y = 0.85, .wheel = { 0.97, 0.28, 0.57, TRUCK_RIM, 10, RIM_COAT },
    .rear_wheel = { 0.97, 0.26, 0.57, TWIN_RIM, 10, RIM_COAT }, .wheel_out = 0.03,
    .screen = { { CLEAR_WINDOW, { 6.22, 1.18 }, { 6.04, 2.52 }, 0.10, 0.12 }, { TINTED_WINDOW, { -6.225, 1.95 }, { -6.19, 2.62 }, 0.20, 0.10 } },
    .window = { { CLEAR_WINDOW, 5.86, -0.10, 4.62, 0 }, { TINTED_WINDOW, 4.54, 0, 3.12, 0 }, { TINTED_WINDOW, 3.04, 0, 1.62, 0 }, { TINTED_WINDOW, 1.54, 0, 0.12, 0 },
                { TINTED_WINDOW, 0.04, 0, -1.38, 0 }, { TINTED_WINDOW, -1.46, 0, -2.88, 0 }, { TINTED_WINDOW, -2.96, 0, -4.38, 0 }, { TINTED_WINDOW, -4.46, 0, -5.60, 0 } },
    .window_sill = 0.06, .window_frame = 0.14, .window_round = 0.06, .window_top = 2.44,
    .decal = { { FILL, MARK_FRONT, LAMP, 0, { { 0.84, 0.72, 0.04 }, { 1.20, 0.74, 0.05 }, { 1.40, 0.80, 0.03 }, { 1.38, 0.94, 0.03 }, { 0.86, 0.92, 0.03 }, END }, true },
               ACROSS(FILL, MARK_FRONT, BLACK_PANEL, 0, 2.54, 1.0, 2.90, 0.98, 0.06), ACROSS(FILL, MARK_FRONT, DISPLAY, 0, 2.60, 0.70, 2.82, 0.70, 0.02),
               { FILL, MARK_SIDE, WHITE_PANEL, 0, { { 9, 2.52, 0.01 }, { -9, 2.52, 0.01 }, { -9, 4, 0.01 }, { 9, 4, 0.01 }, END }, true },
               { FILL, MARK_REAR, REAR_LAMP, 0, { { 0.98, 0.86, 0.03 }, { 1.16, 0.86, 0.03 }, { 1.16, 1.52, 0.03 }, { 0.98, 1.52, 0.03 }, END }, true },
               ACROSS(SINK, MARK_REAR, TRIM_COAT, 0.02, 0.95, 0.75, 1.60, 0.75, 0.05), ACROSS(FILL, MARK_FRONT, TRIM_COAT, 0, 0.2, 1.7, 0.56, 1.7, 0.05) },
    .skirt_z = 0.40, .cabin = { 6.5, -6.5, 1.0 }, .mirror = { 6.16, 1.38, 2.05 }, .mirror_coat = TRIM_COAT, .mirror_half = { 0.07, 0.10, 0.20 }, .plate_z = { 0.50, 0.78 }, .wiper_x = 6.23, .wiper_z = 1.24 };

static void make_bus(struct vehicle *v, const struct vehicle_spec *spec, enum level level)
{
    make_car(v, spec, level);
    struct shell *s = &v->body;
    box(s, 2.2, -0.4, 0.95, 3.02, 3.26, 0.08, WHITE_PANEL);      /* air conditioning, and what is on the roof behind it */
    box(s, -3.4, -5.3, 0.98, 3.02, 3.24, 0.08, WHITE_PANEL);
    static const double door[][2] = { { 5.74, 4.62 }, { 0.12, -1.10 } };
    for (int k = 0; k < 2; k++) {                                 /* doors on the kerb's side */
        double middle = (door[k][0] + door[k][1]) / 2, half = (door[k][0] - door[k][1]) / 2;
        struct coach coach;
        car_coach(&coach, &bus_body);
        double y = -coach_half_width(&coach, k ? middle : middle + 0.3, 1.2);
        part_box(s, vec3(middle, y, 1.42), vec3(half, 0.018, 1.0), 0.008, BLACK_PANEL);
        for (int leaf = -1; leaf <= 1 && level != FAR; leaf += 2)
            part_box(s, vec3(middle + leaf * half / 2, y - 0.016, 1.42), vec3(half / 2 - 0.06, 0.008, 0.92), 0.003, BLACK_PANEL);
    }
    for (int row = 0; row < 11 && level == NEAR; row++)           /* seats */
        for (int side = -1; side <= 1; side += 2) {
            double x = 4.0 - 0.82 * row;
            if (side < 0 && row > 3 && row < 6) continue;
            part_box(s, vec3(x, side * 0.80, 1.10), vec3(0.22, 0.40, 0.05), 0.03, SEAT);
            size_t first = s->points;
            part_box(s, vec3(x - 0.22, side * 0.80, 1.42), vec3(0.035, 0.40, 0.36), 0.03, SEAT);
            part_turn(s, first, vec3(x - 0.22, 0, 1.1), -10, 0, 0);
        }
    if (level == NEAR)
        for (int k = 0; k < 4; k++) boxes(s, 4.5 - 3.0 * k, 4.4 - 3.0 * k, 1.282, 1.30, 0.86, 0.90, 0.004, k == 3 ? REAR_LAMP : TURN_LAMP);
}

#define TRUCK(id, name, class, make, form, source, color, ...) \
    static const struct vehicle_spec spec_##id = { name, class, { __VA_ARGS__ }, source, make, form, color, 1 }
TRUCK(box_truck, "box-truck", CLASS_TRUCK, make_box_truck, NULL, "published dimensions of a best-selling light truck with a 16 ft box (Isuzu NPR, 150 in wheelbase)", NULL,
      7.0, 2.52, 3.25, 2.44, 3.81, 1.67, 0.20, 0.81);
TRUCK(ambulance, "ambulance", CLASS_AMBULANCE, make_ambulance, NULL, "published dimensions of type III ambulances (KKK-A-1822 F; Ford E-450 cutaway, 158 in wheelbase)", "#f0f0ee",
      6.84, 2.58, 2.75, 2.40, 4.01, 1.74, 0.20, 0.78);
TRUCK(fire_truck, "fire-truck", CLASS_FIRE_TRUCK, make_fire_truck, NULL, "published dimensions of custom-cab pumpers (32 ft long, 98 in wide; NFPA 1901)", "#a01418",
      9.96, 3.04, 3.17, 2.48, 5.03, 2.15, 0.30, 1.03);
TRUCK(dump_truck, "dump-truck", CLASS_CONSTRUCTION, make_dump_truck, NULL, "published dimensions of three-axle dump trucks with a 16 ft bed (Mack Granite, Kenworth T880)", "#c07818",
      8.15, 2.72, 3.0, 2.59, 5.3, 2.05, 0.30, 1.03);
TRUCK(bus, "city-bus", CLASS_BUS, make_bus, &bus_body, "published dimensions of 40 ft low-floor city buses (New Flyer Xcelsior XD40)", "#b02024",
      12.5, 2.96, 3.26, 2.59, 7.21, 2.25, 0.30, 0.97);

const struct vehicle_spec *const trucks[] = { &spec_box_truck, &spec_bus, &spec_ambulance, &spec_fire_truck, &spec_dump_truck };
const int truck_count = sizeof trucks / sizeof *trucks;

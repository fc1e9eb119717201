/* The cars of the cast: measures and curves. x runs forward from the middle, z up, in metres. */
#include "cast/car.h"

#define END { 0, 0, -1 }
/* The gaps of a bonnet from its front edge to the windscreen; of a lid or tailgate between two heights; and
 * between bumper and wing, from the wheel's arch (x, z) up to the lamp. */
#define BONNET(nose, cowl, half) \
    { LINE, MARK_TOP, GAP, 0.008, { { (nose), 0.0, 0.01 }, { (nose) - 0.06, 0.52, 0.2 }, { (nose) - 0.28, (half) - 0.05, 0.15 }, { (cowl), (half), 0.03 }, \
                                    { (cowl), -(half), 0.03 }, { (nose) - 0.28, 0.05 - (half), 0.15 }, { (nose) - 0.06, -0.52, 0.2 }, END }, false }
#define LID(low, high, half) \
    { LINE, MARK_REAR, GAP, 0.008, { { -(half), (low), 0.05 }, { (half), (low), 0.05 }, { (half) + 0.02, (high), 0.05 }, { -(half) - 0.02, (high), 0.05 }, END }, false }
#define BUMPER(x, z, out_x, top) \
    { LINE, MARK_SIDE, GAP, 0.007, { { (x), (z), 0.01 }, { (out_x), (top), 0.02 }, { 2 * (out_x), (top), 0.01 }, { 2 * (out_x), -0.2, 0.01 }, { (x), -0.2, 0.01 }, END }, false }
#define ACROSS(trace, kind, coat, depth, low, low_half, high, high_half, round) \
    { trace, kind, coat, depth, { { -(low_half), low, round }, { low_half, low, round }, { high_half, high, round }, { -(high_half), high, round }, END }, true }

#define SEDAN_COACH \
    .coach = { .side = { { 2.26, 0.165, 0.10 }, { 2.40, 0.23, 0.08 }, { 2.443, 0.47, 0.16 }, { 2.38, 0.69, 0.10 }, { 2.25, 0.775, 0.14 }, \
                         { 1.72, 0.905, 0.50 }, { 1.13, 0.985, 0.16 }, { 0.20, 1.380, 0.34 }, { -0.20, 1.450, 0.5 }, { -0.88, 1.400, 0.34 }, \
                         { -1.74, 1.105, 0.26 }, { -2.16, 1.075, 0.2 }, { -2.37, 1.045, 0.05 }, { -2.395, 0.80, 0.12 }, { -2.443, 0.60, 0.12 }, \
                         { -2.41, 0.32, 0.10 }, { -2.15, 0.20, 0.15 }, { -1.0, 0.155, 0.3 }, { 1.6, 0.155, 0.3 }, END }, \
               .half_width = 0.92, .belt = { 0.89, 1.01 }, .tumble = 0.36, .bulge = 0.22, .shoulder = 0.035, .tuck = 0.075, .tuck_z = 0.42, \
               .scallop = 0.014, .scallop_drop = 0.20, .taper = { 0.17, 0.13 }, .taper_from = { 1.0, -1.0 }, .house = { 0.10, 0.22 }, \
               .sweep = { 0.26, 0.20 }, .crown = 0.075, .crown_z = 0.75, .round = 0.07, .round_end = 0.16, .flare = 0.012 }, \
    .axle_x = { 1.46, -1.365 }, .arch_gap = 0.03, .arch_inner_y = 0.60, .wheel_out = 0.02, \
    .screen = { { CLEAR_WINDOW, { 1.13, 0.985 }, { 0.16, 1.395 }, 0.075, 0.08 }, { CLEAR_WINDOW, { -1.70, 1.115 }, { -0.98, 1.365 }, 0.10, 0.09 } }, \
    .window = { { CLEAR_WINDOW, 1.15, -1.0, -0.155, -0.10 }, { CLEAR_WINDOW, -0.235, -0.10, -1.12, 0.30 }, { TINTED_WINDOW, -1.16, 0.30, -1.46, 0.70 } }, \
    .window_sill = 0.018, .window_frame = 0.075, .window_round = 0.035, \
    .door = { { 1.00, -0.05, -0.19, -0.10, -0.02 }, { -0.196, -0.10, -1.13, 0.30, -1.00 } }, .door_bottom = 0.27, .door_frame = 0.045, .handle_z = 0.84, \
    .skirt_z = 0.20, .seat_x = { 0.0, -0.86 }, .seat_z = 0.44, .cabin = { 1.22, -1.80, 0.60 }, \
    .mirror = { 0.66, 0.985, 0.99 }, .mirror_half = { 0.075, 0.105, 0.072 }, .badge_z = { 0.72, 0 }, .plate_z = { 0.50, 0.62 }, .wiper_x = 1.08, .wiper_z = 1.015
#define SEDAN_LAMPS \
    { LAMP_HOUSE, MARK_FRONT, REFLECTOR, 0.05, { { 0.47, 0.615, 0.04 }, { 0.80, 0.635, 0.05 }, { 1.08, 0.73, 0.03 }, { 0.98, 0.775, 0.04 }, { 0.66, 0.735, 0.06 }, { 0.47, 0.69, 0.03 }, END }, true }, \
    { FILL, MARK_REAR, REAR_LAMP, 0, { { 0.40, 0.80, 0.03 }, { 0.80, 0.79, 0.05 }, { 1.10, 0.87, 0.03 }, { 1.00, 0.935, 0.05 }, { 0.42, 0.92, 0.03 }, END }, true }, \
    ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.03, 0.615, 0.44, 0.670, 0.45, 0.02), ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.05, 0.245, 0.62, 0.43, 0.50, 0.05), \
    ACROSS(FILL, MARK_REAR, TRIM_COAT, 0, 0.1, 0.75, 0.36, 0.62, 0.06), BONNET(2.19, 1.10, 0.79), LID(0.72, 1.2, 0.62), BUMPER(1.87, 0.4, 1.98, 0.63), \
    BUMPER(-1.78, 0.4, -1.95, 0.77)

static const struct car_spec sedan = { SEDAN_COACH, .decal = { SEDAN_LAMPS }, .wheel = { 0.672, 0.215, 0.45, ALLOY_RIM, 5, RIM_COAT }, .fin = true };

static const struct car_spec taxi = { SEDAN_COACH,
    .decal = { SEDAN_LAMPS, { FILL, MARK_SIDE, BLACK_PANEL, 0, { { 0.98, 0.72, 0.01 }, { -1.02, 0.72, 0.01 }, { -1.10, 0.80, 0.01 }, { 0.98, 0.80, 0.01 }, END }, false } },
    .wheel = { 0.672, 0.215, 0.42, STEEL_RIM, 10, RIM_COAT }, .roof_sign = { 0.10, 0.09, 0.30, 0.075 } };

static const struct car_spec hatchback = {
    .coach = { .side = { { 1.98, 0.165, 0.10 }, { 2.10, 0.24, 0.08 }, { 2.142, 0.48, 0.14 }, { 2.10, 0.69, 0.08 }, { 1.99, 0.78, 0.12 },
                         { 1.54, 0.915, 0.42 }, { 0.99, 1.00, 0.14 }, { 0.10, 1.380, 0.32 }, { -0.30, 1.457, 0.5 }, { -1.10, 1.445, 0.4 }, { -1.74, 1.380, 0.10 },
                         { -1.98, 1.06, 0.10 }, { -2.08, 0.95, 0.06 }, { -2.09, 0.74, 0.08 }, { -2.142, 0.58, 0.12 }, { -2.11, 0.32, 0.10 },
                         { -1.90, 0.20, 0.12 }, { -1.0, 0.15, 0.3 }, { 1.4, 0.15, 0.3 }, END },
               .half_width = 0.895, .belt = { 0.90, 1.02 }, .tumble = 0.34, .bulge = 0.20, .shoulder = 0.035, .tuck = 0.07, .tuck_z = 0.42,
               .scallop = 0.013, .scallop_drop = 0.20, .taper = { 0.16, 0.10 }, .taper_from = { 0.9, -0.9 }, .house = { 0.10, 0.16 },
               .sweep = { 0.26, 0.16 }, .crown = 0.075, .crown_z = 0.75, .round = 0.07, .round_end = 0.15, .flare = 0.012 },
    .axle_x = { 1.275, -1.361 }, .arch_gap = 0.03, .arch_inner_y = 0.58, .wheel = { 0.632, 0.205, 0.42, ALLOY_RIM, 5, RIM_COAT }, .wheel_out = 0.018,
    .screen = { { CLEAR_WINDOW, { 0.98, 1.005 }, { 0.05, 1.400 }, 0.075, 0.08 }, { TINTED_WINDOW, { -1.955, 1.095 }, { -1.765, 1.347 }, 0.14, 0.06 } },
    .window = { { CLEAR_WINDOW, 1.05, -1.0, -0.22, -0.09 }, { CLEAR_WINDOW, -0.30, -0.09, -1.12, 0.20 }, { TINTED_WINDOW, -1.16, 0.20, -1.40, 0.45 } },
    .window_sill = 0.018, .window_frame = 0.08, .window_round = 0.035,
    .door = { { 0.88, -0.05, -0.255, -0.09, -0.08 }, { -0.261, -0.09, -1.12, 0.20, -1.00 } }, .door_bottom = 0.26, .door_frame = 0.05, .handle_z = 0.85,
    .decal = { { LAMP_HOUSE, MARK_FRONT, REFLECTOR, 0.05, { { 0.46, 0.625, 0.04 }, { 0.78, 0.635, 0.05 }, { 1.02, 0.73, 0.03 }, { 0.93, 0.79, 0.04 }, { 0.62, 0.755, 0.06 }, { 0.46, 0.70, 0.03 }, END }, true },
               { FILL, MARK_REAR, REAR_LAMP, 0, { { 0.46, 0.80, 0.03 }, { 0.86, 0.80, 0.05 }, { 1.05, 0.90, 0.03 }, { 0.95, 0.985, 0.05 }, { 0.48, 0.955, 0.03 }, END }, true },
               ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.03, 0.63, 0.43, 0.685, 0.44, 0.02), ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.05, 0.25, 0.62, 0.44, 0.50, 0.05),
               ACROSS(FILL, MARK_REAR, TRIM_COAT, 0, 0.1, 0.75, 0.37, 0.60, 0.06), BONNET(1.93, 0.95, 0.77), LID(0.66, 1.46, 0.66), BUMPER(1.67, 0.38, 1.76, 0.64),
               BUMPER(-1.76, 0.38, -1.86, 0.78) },
    .skirt_z = 0.20, .driver = WOMAN_DRIVER, .seat_x = { -0.08, -0.92 }, .seat_z = 0.44, .cabin = { 1.08, -2.4, 0.62 },
    .mirror = { 0.56, 0.955, 1.00 }, .mirror_half = { 0.075, 0.105, 0.072 }, .badge_z = { 0.735, 0.88 }, .plate_z = { 0.50, 0.60 }, .wiper_x = 0.95, .wiper_z = 1.03, .fin = false };

static const struct car_spec estate = {
    .coach = { .side = { { 2.20, 0.165, 0.10 }, { 2.34, 0.23, 0.08 }, { 2.385, 0.47, 0.15 }, { 2.33, 0.69, 0.10 }, { 2.21, 0.775, 0.14 },
                         { 1.70, 0.905, 0.50 }, { 1.10, 0.985, 0.16 }, { 0.18, 1.395, 0.34 }, { -0.22, 1.475, 0.5 }, { -1.30, 1.462, 0.5 }, { -1.98, 1.39, 0.08 },
                         { -2.22, 1.07, 0.10 }, { -2.33, 0.96, 0.06 }, { -2.335, 0.76, 0.08 }, { -2.385, 0.60, 0.12 }, { -2.35, 0.32, 0.10 }, { -2.1, 0.20, 0.15 },
                         { -1.0, 0.15, 0.3 }, { 1.6, 0.15, 0.3 }, END },
               .half_width = 0.916, .belt = { 0.89, 1.01 }, .tumble = 0.36, .bulge = 0.20, .shoulder = 0.035, .tuck = 0.075, .tuck_z = 0.42,
               .scallop = 0.014, .scallop_drop = 0.20, .taper = { 0.17, 0.10 }, .taper_from = { 1.0, -1.1 }, .house = { 0.10, 0.16 },
               .sweep = { 0.26, 0.15 }, .crown = 0.075, .crown_z = 0.75, .round = 0.07, .round_end = 0.15, .flare = 0.012 },
    .axle_x = { 1.44, -1.351 }, .arch_gap = 0.03, .arch_inner_y = 0.60, .wheel = { 0.651, 0.215, 0.44, ALLOY_RIM, 7, RIM_COAT }, .wheel_out = 0.02,
    .screen = { { CLEAR_WINDOW, { 1.10, 0.985 }, { 0.14, 1.41 }, 0.075, 0.08 }, { TINTED_WINDOW, { -2.19, 1.105 }, { -2.005, 1.355 }, 0.13, 0.06 } },
    .window = { { CLEAR_WINDOW, 1.13, -1.0, -0.175, -0.10 }, { CLEAR_WINDOW, -0.255, -0.10, -1.12, 0.12 }, { TINTED_WINDOW, -1.18, 0.12, -1.98, 0.62 } },
    .window_sill = 0.018, .window_frame = 0.08, .window_round = 0.035,
    .door = { { 0.97, -0.05, -0.21, -0.10, -0.04 }, { -0.216, -0.10, -1.14, 0.12, -1.02 } }, .door_bottom = 0.26, .door_frame = 0.05, .handle_z = 0.84,
    .decal = { { LAMP_HOUSE, MARK_FRONT, REFLECTOR, 0.05, { { 0.44, 0.62, 0.04 }, { 0.78, 0.63, 0.05 }, { 1.05, 0.715, 0.03 }, { 0.97, 0.775, 0.04 }, { 0.64, 0.745, 0.06 }, { 0.44, 0.71, 0.03 }, END }, true },
               { FILL, MARK_REAR, REAR_LAMP, 0, { { 0.36, 0.82, 0.03 }, { 0.80, 0.80, 0.05 }, { 1.12, 0.88, 0.03 }, { 1.02, 0.965, 0.05 }, { 0.38, 0.93, 0.03 }, END }, true },
               ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.03, 0.60, 0.41, 0.715, 0.42, 0.03), ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.05, 0.245, 0.64, 0.42, 0.52, 0.05),
               ACROSS(FILL, MARK_REAR, TRIM_COAT, 0, 0.1, 0.75, 0.37, 0.62, 0.06), BONNET(2.15, 1.07, 0.79), LID(0.66, 1.45, 0.68), BUMPER(1.84, 0.38, 1.96, 0.63),
               BUMPER(-1.75, 0.38, -2.02, 0.78) },
    .skirt_z = 0.20, .seat_x = { -0.02, -0.88 }, .seat_z = 0.46, .cabin = { 1.20, -2.6, 0.60 }, .rails = { 0.0, -1.75, 0.60 },
    .mirror = { 0.64, 0.98, 0.985 }, .mirror_half = { 0.075, 0.105, 0.072 }, .badge_z = { 0.665, 0.88 }, .plate_z = { 0.47, 0.62 }, .wiper_x = 1.06, .wiper_z = 1.01, .fin = true };

static const struct car_spec suv = {
    .coach = { .side = { { 2.10, 0.22, 0.10 }, { 2.25, 0.30, 0.08 }, { 2.30, 0.58, 0.14 }, { 2.27, 0.86, 0.10 }, { 2.16, 0.965, 0.12 },
                         { 1.66, 1.07, 0.45 }, { 1.08, 1.13, 0.14 }, { 0.30, 1.56, 0.32 }, { -0.10, 1.672, 0.5 }, { -1.25, 1.665, 0.5 }, { -1.90, 1.585, 0.08 },
                         { -2.13, 1.21, 0.10 }, { -2.22, 1.10, 0.08 }, { -2.23, 0.86, 0.08 }, { -2.30, 0.68, 0.12 }, { -2.26, 0.40, 0.10 }, { -2.05, 0.28, 0.15 },
                         { -1.0, 0.20, 0.3 }, { 1.5, 0.20, 0.3 }, END },
               .half_width = 0.927, .belt = { 1.05, 1.17 }, .tumble = 0.28, .bulge = 0.18, .shoulder = 0.04, .tuck = 0.06, .tuck_z = 0.50,
               .scallop = 0.018, .scallop_drop = 0.24, .taper = { 0.15, 0.10 }, .taper_from = { 0.9, -1.0 }, .house = { 0.10, 0.14 },
               .sweep = { 0.22, 0.14 }, .crown = 0.07, .crown_z = 0.95, .round = 0.075, .round_end = 0.14, .flare = 0.022 },
    .axle_x = { 1.345, -1.345 }, .arch_gap = 0.045, .arch_inner_y = 0.59, .wheel = { 0.716, 0.225, 0.46, ALLOY_RIM, 5, RIM_COAT }, .wheel_out = 0.01,
    .screen = { { CLEAR_WINDOW, { 1.06, 1.14 }, { 0.26, 1.58 }, 0.075, 0.08 }, { TINTED_WINDOW, { -2.105, 1.245 }, { -1.925, 1.54 }, 0.14, 0.06 } },
    .window = { { CLEAR_WINDOW, 1.10, -0.85, -0.10, -0.07 }, { TINTED_WINDOW, -0.18, -0.07, -1.06, 0.15 }, { TINTED_WINDOW, -1.12, 0.15, -1.66, 0.40 } },
    .window_sill = 0.018, .window_frame = 0.09, .window_round = 0.04,
    .door = { { 0.90, -0.05, -0.135, -0.07, 0.02 }, { -0.141, -0.07, -1.08, 0.15, -0.94 } }, .door_bottom = 0.36, .door_frame = 0.055, .handle_z = 0.98,
    .decal = { { LAMP_HOUSE, MARK_FRONT, REFLECTOR, 0.05, { { 0.46, 0.80, 0.03 }, { 0.80, 0.80, 0.05 }, { 1.06, 0.88, 0.03 }, { 0.98, 0.945, 0.04 }, { 0.62, 0.915, 0.05 }, { 0.46, 0.885, 0.03 }, END }, true },
               { FILL, MARK_REAR, REAR_LAMP, 0, { { 0.42, 1.00, 0.03 }, { 0.80, 0.97, 0.05 }, { 1.10, 1.03, 0.03 }, { 1.02, 1.12, 0.05 }, { 0.44, 1.09, 0.03 }, END }, true },
               ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.035, 0.66, 0.40, 0.87, 0.43, 0.05), ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.04, 0.33, 0.66, 0.52, 0.56, 0.05),
               ACROSS(FILL, MARK_REAR, TRIM_COAT, 0, 0.1, 0.95, 0.50, 0.80, 0.06), BONNET(2.12, 1.04, 0.81), LID(0.64, 1.65, 0.70), BUMPER(1.75, 0.46, 1.86, 0.80),
               BUMPER(-1.75, 0.46, -1.97, 0.95) },
    .skirt_z = 0.36, .cladding = 0.055, .driver = WOMAN_DRIVER, .seat_x = { 0.05, -0.80 }, .seat_z = 0.66, .cabin = { 1.16, -2.6, 0.78 }, .rails = { 0.05, -1.70, 0.62 },
    .mirror = { 0.66, 0.99, 1.15 }, .mirror_half = { 0.08, 0.11, 0.09 }, .badge_z = { 0.775, 1.04 }, .plate_z = { 0.58, 0.77 }, .wiper_x = 1.03, .wiper_z = 1.165, .fin = true };

static const struct car_spec minivan = {
    .coach = { .side = { { 2.40, 0.175, 0.10 }, { 2.53, 0.24, 0.08 }, { 2.58, 0.50, 0.15 }, { 2.53, 0.76, 0.10 }, { 2.40, 0.865, 0.14 },
                         { 1.98, 1.00, 0.42 }, { 1.55, 1.085, 0.16 }, { 0.66, 1.58, 0.34 }, { 0.20, 1.715, 0.5 }, { -1.40, 1.725, 0.6 }, { -2.18, 1.645, 0.10 },
                         { -2.42, 1.17, 0.12 }, { -2.50, 1.02, 0.08 }, { -2.51, 0.78, 0.08 }, { -2.58, 0.62, 0.12 }, { -2.54, 0.32, 0.10 }, { -2.3, 0.21, 0.15 },
                         { -1.0, 0.16, 0.3 }, { 1.7, 0.16, 0.3 }, END },
               .half_width = 0.997, .belt = { 0.97, 1.09 }, .tumble = 0.24, .bulge = 0.14, .shoulder = 0.04, .tuck = 0.06, .tuck_z = 0.45,
               .scallop = 0.015, .scallop_drop = 0.22, .taper = { 0.18, 0.10 }, .taper_from = { 1.2, -1.3 }, .house = { 0.10, 0.10 },
               .sweep = { 0.26, 0.12 }, .crown = 0.06, .crown_z = 0.90, .round = 0.08, .round_end = 0.15, .flare = 0.010 },
    .axle_x = { 1.57, -1.43 }, .arch_gap = 0.035, .arch_inner_y = 0.66, .wheel = { 0.69, 0.235, 0.46, ALLOY_RIM, 5, RIM_COAT }, .wheel_out = 0.02,
    .screen = { { CLEAR_WINDOW, { 1.55, 1.085 }, { 0.62, 1.60 }, 0.08, 0.09 }, { TINTED_WINDOW, { -2.40, 1.21 }, { -2.205, 1.595 }, 0.14, 0.07 } },
    .window = { { CLEAR_WINDOW, 1.60, -0.85, 1.02, -0.25 }, { CLEAR_WINDOW, 0.96, -0.25, 0.13, -0.05 }, { TINTED_WINDOW, 0.05, -0.05, -1.14, 0.05 }, { TINTED_WINDOW, -1.22, 0.05, -2.08, 0.30 } },
    .window_sill = 0.018, .window_frame = 0.09, .window_round = 0.04,
    .door = { { 1.22, -0.05, 0.09, -0.05, 0.26 }, { 0.084, -0.05, -1.18, 0.05, -0.08 } }, .door_bottom = 0.27, .door_frame = 0.055, .handle_z = 0.92,
    .decal = { { LAMP_HOUSE, MARK_FRONT, REFLECTOR, 0.05, { { 0.50, 0.69, 0.04 }, { 0.86, 0.71, 0.05 }, { 1.15, 0.80, 0.03 }, { 1.06, 0.86, 0.04 }, { 0.70, 0.82, 0.06 }, { 0.50, 0.77, 0.03 }, END }, true },
               { FILL, MARK_REAR, REAR_LAMP, 0, { { 0.50, 0.92, 0.03 }, { 0.88, 0.89, 0.05 }, { 1.20, 0.96, 0.03 }, { 1.12, 1.09, 0.05 }, { 0.52, 1.04, 0.03 }, END }, true },
               ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.03, 0.67, 0.46, 0.76, 0.47, 0.03), ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.05, 0.26, 0.70, 0.48, 0.58, 0.05),
               { FILL, MARK_SIDE, TRIM_COAT, 0, { { -1.25, 0.965, 0.004 }, { -2.20, 0.985, 0.004 }, { -2.20, 1.010, 0.004 }, { -1.25, 0.990, 0.004 }, END }, false },
               ACROSS(FILL, MARK_REAR, TRIM_COAT, 0, 0.1, 0.85, 0.37, 0.70, 0.06), BONNET(2.34, 1.52, 0.82), LID(0.62, 1.70, 0.74), BUMPER(1.98, 0.4, 2.10, 0.70),
               BUMPER(-1.84, 0.4, -2.12, 0.88) },
    .skirt_z = 0.21, .driver = WOMAN_DRIVER, .seat_x = { 0.32, -0.60, -1.50 }, .seat_z = 0.58, .cabin = { 1.62, -2.9, 0.70 }, .rails = { 0.2, -1.9, 0.70 },
    .mirror = { 1.02, 1.07, 1.07 }, .mirror_half = { 0.08, 0.115, 0.08 }, .badge_z = { 0.715, 1.0 }, .plate_z = { 0.54, 0.70 }, .wiper_x = 1.50, .wiper_z = 1.115, .fin = true };

static const struct car_spec van = {
    .coach = { .side = { { 2.80, 0.22, 0.10 }, { 2.93, 0.30, 0.08 }, { 2.99, 0.58, 0.12 }, { 2.96, 0.90, 0.10 }, { 2.87, 1.06, 0.12 },
                         { 2.50, 1.26, 0.30 }, { 2.16, 1.36, 0.14 }, { 1.42, 2.08, 0.22 }, { 1.15, 2.40, 0.35 }, { 0.55, 2.535, 0.6 }, { -2.0, 2.55, 0.5 }, { -2.93, 2.52, 0.10 },
                         { -2.955, 1.5, 0.1 }, { -2.965, 0.72, 0.05 }, { -2.99, 0.60, 0.06 }, { -2.98, 0.42, 0.06 }, { -2.8, 0.34, 0.10 },
                         { -1.0, 0.24, 0.3 }, { 2.0, 0.20, 0.3 }, END },
               .half_width = 1.03, .belt = { 1.28, 1.30 }, .tumble = 0.085, .bulge = 0.035, .shoulder = 0.02, .tuck = 0.04, .tuck_z = 0.50,
               .scallop = 0.020, .scallop_drop = 0.42, .taper = { 0.16, 0.02 }, .taper_from = { 1.7, -2.4 }, .house = { 0.16, 0.0 },
               .sweep = { 0.20, 0.01 }, .crown = 0.05, .crown_z = 1.4, .round = 0.10, .round_end = 0.12, .flare = 0.012 },
    .axle_x = { 1.96, -1.79 }, .arch_gap = 0.06, .arch_inner_y = 0.70, .wheel = { 0.69, 0.225, 0.42, STEEL_RIM, 10, STEEL }, .wheel_out = 0.04,
    .screen = { { CLEAR_WINDOW, { 2.16, 1.36 }, { 1.40, 2.105 }, 0.09, 0.10 }, { NO_WINDOW, { 0, 0 }, { 0, 0 }, 0, 0 } },
    .window = { { CLEAR_WINDOW, 2.05, -0.80, 0.86, -0.03 } },
    .window_sill = 0.02, .window_frame = 0.10, .window_round = 0.06, .window_top = 2.02,
    .door = { { 1.60, -0.02, 0.80, -0.03, 0.92 }, { 0.70, 0, -0.58, 0, 0.60 } }, .door_bottom = 0.36, .door_frame = 0.20, .handle_z = 1.12,
    .decal = { { LAMP_HOUSE, MARK_FRONT, REFLECTOR, 0.05, { { 0.56, 0.86, 0.04 }, { 0.82, 0.86, 0.05 }, { 1.12, 0.98, 0.04 }, { 1.10, 1.16, 0.05 }, { 0.80, 1.08, 0.06 }, { 0.56, 0.98, 0.03 }, END }, true },
               { FILL, MARK_REAR, REAR_LAMP, 0, { { 0.91, 0.92, 0.02 }, { 1.01, 0.92, 0.02 }, { 1.01, 1.40, 0.02 }, { 0.91, 1.40, 0.02 }, END }, true },
               { FILL, MARK_REAR, BLACK_PANEL, 0, { { 0.12, 1.38, 0.05 }, { 0.76, 1.38, 0.05 }, { 0.74, 1.98, 0.05 }, { 0.12, 1.98, 0.05 }, END }, true },
               ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.035, 0.70, 0.46, 0.96, 0.50, 0.06), ACROSS(FILL, MARK_FRONT, TRIM_COAT, 0, 0.05, 1.6, 0.60, 1.35, 0.05),
               ACROSS(FILL, MARK_REAR, TRIM_COAT, 0, 0.1, 1.05, 0.66, 1.02, 0.03), { LINE, MARK_REAR, GAP, 0.008, { { 0.0, 0.68, 0.01 }, { 0.88, 0.68, 0.05 }, { 0.86, 2.42, 0.05 }, { 0.0, 2.42, 0.01 }, END }, false },
               { FILL, MARK_SIDE, TRIM_COAT, 0, { { 1.38, 0.66, 0.03 }, { -1.18, 0.66, 0.03 }, { -1.18, 0.78, 0.03 }, { 1.38, 0.78, 0.03 }, END }, false },
               { FILL, MARK_SIDE, TRIM_COAT, 0, { { -0.62, 1.22, 0.004 }, { -2.60, 1.22, 0.004 }, { -2.60, 1.25, 0.004 }, { -0.62, 1.25, 0.004 }, END }, false },
               BONNET(2.88, 2.10, 0.80), BUMPER(2.41, 0.5, 2.50, 0.86) },
    .skirt_z = 0.33, .seat_x = { 0.95 }, .seat_z = 0.86, .cabin = { 2.22, 0.55, 0.95 },
    .mirror = { 1.66, 1.16, 1.42 }, .mirror_coat = TRIM_COAT, .mirror_half = { 0.09, 0.09, 0.19 }, .badge_z = { 1.02, 0 }, .plate_z = { 0.50, 0.80 }, .wiper_x = 2.10, .wiper_z = 1.40, .fin = false };

static const struct car_spec pickup = {
    .coach = { .side = { { 2.72, 0.34, 0.10 }, { 2.88, 0.42, 0.06 }, { 2.94, 0.58, 0.08 }, { 2.92, 0.82, 0.08 }, { 2.89, 1.12, 0.08 }, { 2.81, 1.20, 0.10 },
                         { 2.10, 1.29, 0.40 }, { 1.30, 1.335, 0.14 }, { 0.62, 1.80, 0.28 }, { 0.25, 1.945, 0.4 }, { -0.55, 1.94, 0.4 }, { -0.90, 1.85, 0.16 },
                         { -1.02, 1.41, 0.03 }, { -2.86, 1.43, 0.02 }, { -2.90, 1.40, 0.04 }, { -2.87, 0.74, 0.04 }, { -2.94, 0.70, 0.05 }, { -2.94, 0.54, 0.06 }, { -2.80, 0.46, 0.10 },
                         { -1.0, 0.34, 0.3 }, { 2.0, 0.30, 0.3 }, END },
               .half_width = 1.015, .belt = { 1.22, 1.47 }, .tumble = 0.26, .bulge = 0.14, .shoulder = 0.03, .tuck = 0.05, .tuck_z = 0.62,
               .scallop = 0.016, .scallop_drop = 0.26, .taper = { 0.09, 0.02 }, .taper_from = { 1.8, -2.2 }, .house = { 0.10, 0.05 },
               .sweep = { 0.13, 0.03 }, .crown = 0.05, .crown_z = 1.25, .round = 0.07, .round_end = 0.08, .flare = 0.028 },
    .axle_x = { 1.98, -1.71 }, .arch_gap = 0.085, .arch_inner_y = 0.66, .wheel = { 0.80, 0.265, 0.50, ALLOY_RIM, 6, RIM_COAT }, .wheel_out = 0.035,
    .screen = { { CLEAR_WINDOW, { 1.27, 1.35 }, { 0.60, 1.815 }, 0.085, 0.09 }, { TINTED_WINDOW, { -1.005, 1.47 }, { -0.92, 1.79 }, 0.20, 0.07 } },
    .window = { { CLEAR_WINDOW, 1.28, -0.75, 0.20, -0.05 }, { TINTED_WINDOW, 0.11, -0.05, -0.82, -0.12 } },
    .window_sill = 0.0, .window_frame = 0.11, .window_round = 0.045,
    .door = { { 1.10, -0.04, 0.155, -0.05, 0.30 }, { 0.149, -0.05, -0.90, -0.06, -0.74 } }, .door_bottom = 0.50, .door_frame = 0.07, .handle_z = 1.18,
    .decal = { { LAMP_HOUSE, MARK_FRONT, REFLECTOR, 0.05, { { 0.60, 0.86, 0.03 }, { 0.98, 0.86, 0.04 }, { 1.12, 0.90, 0.03 }, { 1.12, 1.12, 0.03 }, { 0.62, 1.12, 0.03 }, END }, true },
               { FILL, MARK_REAR, REAR_LAMP, 0, { { 0.80, 0.98, 0.02 }, { 1.12, 0.98, 0.02 }, { 1.12, 1.36, 0.02 }, { 0.80, 1.36, 0.02 }, END }, true },
               ACROSS(SINK, MARK_FRONT, TRIM_COAT, 0.05, 0.80, 0.56, 1.12, 0.57, 0.05), ACROSS(FILL, MARK_FRONT, BRIGHT, 0, 0.54, 0.95, 0.72, 0.95, 0.03),
               ACROSS(FILL, MARK_FRONT, BRIGHT, 0, 0.945, 0.55, 0.985, 0.55, 0.01), ACROSS(FILL, MARK_FRONT, TRIM_COAT, 0, 0.28, 0.80, 0.50, 0.72, 0.04),
               ACROSS(FILL, MARK_REAR, BRIGHT, 0, 0.50, 1.00, 0.70, 1.00, 0.02), { LINE, MARK_REAR, GAP, 0.008, { { -0.77, 0.74, 0.02 }, { 0.77, 0.74, 0.02 }, { 0.77, 1.6, 0.02 }, { -0.77, 1.6, 0.02 }, END }, false },
               { LINE, MARK_SIDE, GAP, 0.016, { { -1.055, 0.2, 0.01 }, { -1.055, 1.6, 0.01 }, { -4, 1.6, 0.01 }, { -4, 0.2, 0.01 }, END }, false },
               BONNET(2.83, 1.26, 0.88), BUMPER(2.46, 0.60, 2.56, 0.78) },
    .skirt_z = 0.44, .bed = { -1.12, -2.82, 0.78, 0.92 }, .seat_x = { 0.35, -0.50 }, .seat_z = 0.85, .cabin = { 1.40, -1.11, 0.98 },
    .mirror = { 0.92, 1.13, 1.36 }, .mirror_half = { 0.09, 0.11, 0.13 }, .plate_z = { 0.62, 0.62 }, .wiper_x = 1.24, .wiper_z = 1.38, .fin = true };

#define CAR(name, class, measures, source, color, weight) \
    static const struct vehicle_spec spec_##name = { #name, class, measures, source, make_car, &name, color, weight }
#define SIZES(...) { __VA_ARGS__ }
CAR(sedan, CLASS_CAR, SIZES(4.885, 2.18, 1.445, 1.84, 2.825, 1.58, 0.155, 0.672), "published dimensions of a best-selling mid-size sedan (Toyota Camry, 2018)", NULL, 4);
CAR(taxi, CLASS_CAR, SIZES(4.885, 2.18, 1.545, 1.84, 2.825, 1.58, 0.155, 0.672), "the sedan, with a roof sign", "#e8b010", 0.3);
CAR(hatchback, CLASS_CAR, SIZES(4.284, 2.12, 1.456, 1.789, 2.636, 1.54, 0.15, 0.632), "published dimensions of a best-selling compact hatchback (Volkswagen Golf, 2020)", NULL, 2);
CAR(estate, CLASS_CAR, SIZES(4.77, 2.17, 1.50, 1.832, 2.791, 1.57, 0.15, 0.651), "published dimensions of a best-selling estate (Volkswagen Passat Variant, 2015)", NULL, 1);
CAR(suv, CLASS_CAR, SIZES(4.60, 2.20, 1.685, 1.855, 2.69, 1.60, 0.20, 0.716), "published dimensions of a best-selling compact SUV (Toyota RAV4, 2019)", NULL, 5);
CAR(minivan, CLASS_CAR, SIZES(5.16, 2.37, 1.74, 1.994, 3.00, 1.71, 0.16, 0.69), "published dimensions of a best-selling mini-van (Honda Odyssey, 2018)", NULL, 1);
CAR(van, CLASS_VAN, SIZES(5.98, 2.50, 2.55, 2.06, 3.75, 1.74, 0.20, 0.69), "published dimensions of a best-selling van (Ford Transit 350, 148 in, medium roof, 2015)", NULL, 1);
CAR(pickup, CLASS_CAR, SIZES(5.885, 2.48, 1.96, 2.03, 3.69, 1.69, 0.30, 0.80), "published dimensions of a best-selling pickup (Ford F-150 SuperCrew, 145 in, 2021)", NULL, 2);

const struct vehicle_spec *const cars[] = { &spec_sedan, &spec_hatchback, &spec_estate, &spec_suv, &spec_minivan, &spec_van, &spec_pickup, &spec_taxi };
const int car_count = sizeof cars / sizeof *cars;

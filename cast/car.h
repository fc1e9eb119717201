/* Cars, vans and cabs: a coachwork with windows, doors, lamps, wheels and seats. */
#ifndef STAFFAGE_CAST_CAR_H
#define STAFFAGE_CAST_CAR_H

#include "cast/coach.h"
#include "cast/coat.h"
#include "cast/vehicle.h"
#include "cast/wheel.h"

enum window_kind { NO_WINDOW, CLEAR_WINDOW, TINTED_WINDOW, BLIND_WINDOW /* black, nothing behind it */ };
struct window_spec { enum window_kind kind; double front_x, front_lean, rear_x, rear_lean; };
struct door_spec { double front_x, front_lean, rear_x, rear_lean, handle_x; };
struct screen_spec { enum window_kind kind; struct vec2 low, high; double pillar, round; };

enum trace { NO_TRACE, FILL, LINE, SINK, LAMP_HOUSE };
/* What is drawn on the coachwork: filled, as a dark line, sunk by `depth`, or a lamp under glass. */
struct decal { enum trace trace; enum mark_kind kind; int coat; double depth; struct corner corner[9]; bool coarse; /* in all levels */ };

enum { WINDOWS = 10, DOORS = 3, DECALS = 20, SEATS = 4 };
struct car_spec {
    struct coach_spec coach;
    double axle_x[2], arch_gap, arch_inner_y;
    struct wheel_spec wheel, rear_wheel; /* the rear one's diameter is 0 where it is the same */
    double wheel_out;                   /* how far tyres stay within the half width */
    struct screen_spec screen[2];       /* front, rear */
    struct window_spec window[WINDOWS];
    double window_sill, window_frame, window_round, window_top; /* top: 0 where the roof's line is it */
    struct door_spec door[DOORS];
    double door_bottom, door_frame, handle_z;
    struct decal decal[DECALS];
    double skirt_z, cladding;           /* below: plastic; around the wheels, that wide */
    double bed[4];                      /* a load bed: front and rear end, half width, height of its floor */
    double seat_x[SEATS], seat_z;       /* of rows of seats, front to rear */
    enum occupant driver;
    double cabin[3];                    /* front and rear end, floor */
    struct vec3 mirror;                 /* middle of the left one */
    struct vec3 mirror_half;
    int mirror_coat;
    struct vec2 plate_z, badge_z;       /* front, rear */
    double wiper_x, wiper_z;
    bool fin;                           /* an aerial */
    double roof_sign[4];                /* x, half length, half width, half height */
    double rails[3];                    /* front and rear end, distance from the middle */
};
/* Everything but wheels: cabs of trucks add their own. The shell is the left half of the closed body until `finish`. */
void car_coach(struct coach *coach, const struct car_spec *spec);
void make_car(struct vehicle *vehicle, const struct vehicle_spec *spec, enum level level);
void car_body(struct shell *body, const struct car_spec *spec, enum level level);
/* Behind the wheel of the first seat. */
void vehicle_add_driver(struct vehicle *vehicle, const struct car_spec *spec, enum level level);

#endif

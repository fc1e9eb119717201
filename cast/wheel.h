/* Wheels: a tyre on a rim, about y, the outer face to the left. */
#ifndef STAFFAGE_CAST_WHEEL_H
#define STAFFAGE_CAST_WHEEL_H

#include "cast/vehicle.h"

enum rim { ALLOY_RIM, STEEL_RIM, TRUCK_RIM, TWIN_RIM /* a truck's two wheels side by side */, CAST_RIM /* a motorcycle's */, WIRE_RIM };
struct wheel_spec {
    double diameter_m, width_m, rim_diameter_m;
    enum rim rim;
    int spokes;
    int coat;   /* of the rim */
};
void wheel_make(struct shell *shell, const struct wheel_spec *spec, enum level level);

/* One in the middle. */
void vehicle_add_wheel(struct vehicle *vehicle, const struct wheel_spec *spec, const char *name, double x, enum level level);
/* Two wheels on an axle: the left one's outer face is `outer_y` from the middle. Named wheel_AXLE_left and _right. */
void vehicle_add_axle(struct vehicle *vehicle, const struct wheel_spec *spec, const char *left, const char *right, double x,
                      double outer_y, enum level level);

#endif

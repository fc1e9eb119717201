/* A vehicle of the cast: what is known of it, and its surfaces in one level of detail. */
#ifndef STAFFAGE_CAST_VEHICLE_H
#define STAFFAGE_CAST_VEHICLE_H

#include "cast/occupant.h"
#include "cast/shell.h"
#include "lib/class.h"
#include "lib/error.h"

#include <stdbool.h>

enum level { NEAR, MIDDLE, FAR, LEVELS };

enum { WHEELS = 6 };
struct wheel { const char *name; struct vec3 hub; int shell; double radius; }; /* shell: which of the vehicle's */
struct vehicle {
    struct crew *crew;
    struct shell body, driver;
    struct shell wheel_shell[WHEELS];
    struct wheel wheel[WHEELS];
    int wheels;
};
void vehicle_release(struct vehicle *vehicle);

struct measures_of_vehicle {
    double length_m, width_m, height_m;  /* of all there is, mirrors too */
    double body_width_m;                 /* as makers state it: without mirrors */
    double wheelbase_m, track_m, clearance_m, wheel_diameter_m;
};
struct vehicle_spec {
    const char *name;
    enum entity_class entity_class;
    struct measures_of_vehicle size;
    const char *source;                  /* where the measures come from */
    void (*make)(struct vehicle *vehicle, const struct vehicle_spec *spec, enum level level);
    const void *form;                    /* a car_spec, where make() wants one */
    const char *color;                   /* the only one, "#rrggbb", or NULL for the statistics of car colours */
    double weight;                       /* how common among those of its class; 0 stands for 1 */
};
extern const struct vehicle_spec *const cars[], *const trucks[], *const cycles[];
extern const int car_count, truck_count, cycle_count;

/* Write FOLDER/NAME.glb, NAME-middle.glb and NAME-far.glb. Out: how many triangles each shows */
bool write_vehicle(size_t triangles[LEVELS], const struct vehicle_spec *spec, struct crew *crew, const char *folder, struct error *err);

#endif

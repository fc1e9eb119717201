#include "cast/fleet.h"

#include "cast/vehicle.h"

#include <stdio.h>

#define COUNT(a) (sizeof(a) / sizeof *(a))

/* Of a hundred new cars of the world in 2022, with a paint or two to each name.
 * Src: Axalta, Global Automotive Color Popularity Report 2022: white 34 (20 solid, 14 pearl), black 21, gray 19, silver 8, blue 8,
 * red 5, green 1; the rest are browns and beiges, mostly. */
static const struct paint_share car_colors[] = {
    { "#dcdddc", 20 }, { "#d4d3cd", 14 }, { "#121314", 14 }, { "#1a1c20", 7 }, { "#5a5d61", 11 }, { "#787c80", 8 }, { "#a9adb0", 8 },
    { "#1f3a6b", 4 }, { "#2f5a86", 2 }, { "#16233f", 2 }, { "#7d1518", 3 }, { "#a11c1d", 2 }, { "#2e4437", 1 }, { "#6b5744", 2 }, { "#b3a68f", 2 } };

bool write_listed_vehicle(struct listing *listing, const struct vehicle_spec *v, const char *folder, struct error *err)
{
    static const char *const roll[] = { "roll", NULL };
    struct listed listed = { .name = v->name, .class_ = class_info(v->entity_class)->name, .kind = "vehicle", .weight = v->weight, .animations = roll,
                             .colors = car_colors, .color_count = COUNT(car_colors), .source = v->source,
                             .length_m = v->size.length_m, .width_m = v->size.width_m, .height_m = v->size.height_m, .wheelbase_m = v->size.wheelbase_m,
                             .track_m = v->size.track_m, .clearance_m = v->size.clearance_m, .wheel_diameter_m = v->size.wheel_diameter_m };
    struct paint_share own = { v->color, 1 };
    if (v->color) listed.colors = &own, listed.color_count = 1;
    char file[LEVELS][64];
    static const char *const suffix[LEVELS] = { "", "-middle", "-far" };
    for (int level = 0; level < LEVELS; level++) snprintf(file[level], sizeof file[level], "%s%s.glb", v->name, suffix[level]);
    listed.file = file[NEAR], listed.middle = file[MIDDLE], listed.far = file[FAR];
    struct crew *crew = crew_create();
    bool good = write_vehicle(listed.triangles, v, crew, folder, err) && listing_add(listing, &listed, err);
    crew_destroy(crew);
    return good;
}

int fleet_count(void) { return car_count + truck_count + cycle_count; }

const struct vehicle_spec *fleet_vehicle(int i)
{
    if (i < car_count) return cars[i];
    i -= car_count;
    return i < truck_count ? trucks[i] : cycles[i - truck_count];
}

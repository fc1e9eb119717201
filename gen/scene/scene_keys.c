#include "gen/scene/scene_keys.h"

#include "gen/scene/scene.h"
#include "lib/class.h"

#include <math.h>

#define NAMES(function, ...)                                                              \
    const char *function(int i)                                                           \
    {                                                                                     \
        static const char *const names[] = { __VA_ARGS__ };                               \
        return (size_t)i < sizeof names / sizeof *names ? names[i] : NULL;                \
    }

NAMES(camera_axes_name, [CAMERA_AXES_OPENCV] = "opencv", [CAMERA_AXES_OPENGL] = "opengl",
      [CAMERA_AXES_X_LEFT_Y_UP] = "x-left-y-up")
NAMES(world_direction_name, [WORLD_EAST] = "east", [WORLD_WEST] = "west", [WORLD_NORTH] = "north",
      [WORLD_SOUTH] = "south", [WORLD_UP] = "up", [WORLD_DOWN] = "down")
NAMES(model_axis_name, [AXIS_POS_X] = "+x", [AXIS_NEG_X] = "-x", [AXIS_POS_Y] = "+y", [AXIS_NEG_Y] = "-y",
      [AXIS_POS_Z] = "+z", [AXIS_NEG_Z] = "-z", "x", "y", "z")
NAMES(sky_name, [SKY_CLEAR] = "clear", [SKY_OVERCAST] = "overcast", [SKY_CIE] = "cie", [SKY_MAP] = "map",
      [SKY_AUTO] = "auto")
NAMES(auto_name, "auto")
NAMES(sun_name, "auto", "none")
NAMES(trait_name, "auto", "none")
NAMES(shade_name, [SHADE_AUTO] = "auto", [SHADE_NONE] = "none")
NAMES(transfer_name, [TRANSFER_LAYERS] = "layers", [TRANSFER_RATIO] = "ratio", [TRANSFER_THRESHOLD] = "threshold",
      [TRANSFER_ALPHA] = "alpha")
NAMES(overwrite_name, [OVERWRITE_ABOVE] = "above", [OVERWRITE_BELOW] = "below")
NAMES(mask_name, [MASK_TRACED] = "traced", [MASK_DILATED] = "dilated")
NAMES(driving_side_name, [DRIVE_RIGHT] = "right", [DRIVE_LEFT] = "left")
NAMES(road_use_name, [ROAD_VEHICLES] = "vehicles", [ROAD_PEOPLE] = "people")
NAMES(quality_name, [QUALITY_DRAFT] = "draft", [QUALITY_STANDARD] = "standard", [QUALITY_HIGH] = "high")

const char *lens_name(int i)
{
    return i < CAMERA_MODEL_COUNT ? camera_model_name((enum camera_model)i) : NULL;
}

const char *class_choice_name(int i)
{
    return i < CLASS_COUNT ? class_info((enum entity_class)i)->name : NULL;
}

#define LIMITS(from, to) .min = (from), .max = (to)
#define ABOVE(from, to) .min = (from), .max = (to), .above_min = true
#define COUNT(n) .count_min = (n), .count_max = (n)
#define PIXELS_MAX 65535
#define SECTION .preset = "{}"

/* A lens and a pose are written alike wherever they stand. */
#define LENS(at)                                                                                      \
    { at "model", TYPE_CHOICE, .presence = REQUIRED, .choice = lens_name },                           \
    { at "size_px", TYPE_INTEGERS, "px", .presence = REQUIRED, COUNT(2), LIMITS(1, PIXELS_MAX) },     \
    { at "params", TYPE_NUMBERS, "px", .presence = ONE_OF, .count_min = 3, .count_max = CAMERA_PARAMS_MAX }, \
    { at "horizontal_fov_deg", TYPE_NUMBER, "deg", .presence = ONE_OF, LIMITS(1, 170) }

#define POSE(at)                                                                                      \
    { at, TYPE_MAPPING, .presence = REQUIRED },                                                       \
    { at ".axes", TYPE_CHOICE, .preset = "opencv", .choice = camera_axes_name },                      \
    { at ".world_axes", TYPE_CHOICES, .preset = "[east, north, up]", COUNT(3), .choice = world_direction_name }, \
    { at ".matrix", TYPE_ROWS, "m", .presence = ONE_OF, .count_min = 3, .count_max = 4, .columns = 4 }, \
    { at ".camera_from_world", TYPE_MAPPING, .presence = ONE_OF },                                    \
    { at ".camera_from_world.quaternion_wxyz", TYPE_NUMBERS, .presence = ONE_OF, COUNT(4) },          \
    { at ".camera_from_world.rotation", TYPE_ROWS, .presence = ONE_OF, COUNT(3), .columns = 3 },      \
    { at ".camera_from_world.translation_m", TYPE_NUMBERS, "m", .presence = REQUIRED, COUNT(3) },     \
    { at ".position_m", TYPE_NUMBERS, "m", .presence = ONE_OF, COUNT(3) },                            \
    { at ".quaternion_wxyz", TYPE_NUMBERS, COUNT(4) },                                                \
    { at ".rotation", TYPE_ROWS, COUNT(3), .columns = 3 },                                            \
    { at ".look_at", TYPE_MAPPING, .presence = ONE_OF },                                              \
    { at ".look_at.position_m", TYPE_NUMBERS, "m", .presence = REQUIRED, COUNT(3) },                  \
    { at ".look_at.target_m", TYPE_NUMBERS, "m", .presence = REQUIRED, COUNT(3) },                    \
    { at ".look_at.up", TYPE_NUMBERS, COUNT(3) },                                                     \
    { at ".look_at.roll_deg", TYPE_NUMBER, "deg", .preset = "0", LIMITS(-180, 180) }

/* Vehicles or people of the traffic. */
#define MOVERS(at, speed)                                                                             \
    { at, TYPE_MAPPING, .presence = OPTIONAL },                                                       \
    { at ".count", TYPE_INTEGER, .presence = REQUIRED, LIMITS(1, 5000) },                             \
    { at ".models", TYPE_TEXT | TYPE_TEXTS | TYPE_WEIGHTS | TYPE_NAMED, .presence = REQUIRED },         \
    { at ".models.NAME.weight", TYPE_NUMBER, .preset = "1", ABOVE(0, INFINITY) },                     \
    { at ".speed_m_s", TYPE_NUMBER, "m/s", .preset = speed, ABOVE(0, 100) }

static const struct schema_key keys[] = {
    { "staffage", TYPE_INTEGER, .presence = REQUIRED, LIMITS(1, INFINITY) },
    { "photographs", TYPE_MAPPING, .presence = ONE_OF },
    { "photographs.files", TYPE_FILES, .presence = ONE_OF, .count_min = 1 },
    { "photographs.video", TYPE_FILE, .presence = ONE_OF },
    { "photographs.frames", TYPE_RANGE | TYPE_INTEGERS, .count_min = 1, LIMITS(0, FRAME_MAX) },
    { "photographs.rate_hz", TYPE_NUMBER, "1/s", ABOVE(0, 100000) },
    { "photographs.scale", TYPE_NUMBER, .preset = "1", ABOVE(0, 1) },

    { "camera", TYPE_MAPPING, .presence = OPTIONAL },
    LENS("camera."),
    POSE("camera.pose"),

    { "shots", TYPE_ITEMS, .presence = ONE_OF, .count_min = 1 },
    { "shots[].photograph", TYPE_FILE, .presence = OPTIONAL },
    { "shots[].camera", TYPE_TEXT, .presence = REQUIRED },
    { "shots[].time", TYPE_TIME, .presence = OPTIONAL },
    POSE("shots[].pose"),
    { "shots[].semantic", TYPE_FILE, .presence = OPTIONAL },
    { "shots[].depth", TYPE_FILE, .presence = OPTIONAL },
    { "cameras", TYPE_NAMED, .preset = "{}" },
    LENS("cameras.NAME."),

    { "place", TYPE_MAPPING, .presence = OPTIONAL },
    { "place.latitude_deg", TYPE_NUMBER, "deg", .presence = REQUIRED, LIMITS(-90, 90) },
    { "place.longitude_deg", TYPE_NUMBER, "deg", .presence = REQUIRED, LIMITS(-180, 180) },
    { "place.height_m", TYPE_NUMBER, "m", .preset = "0", LIMITS(-1000, 100000) },
    { "north_deg", TYPE_NUMBER, "deg", .preset = "0", LIMITS(-360, 360) },
    { "north", TYPE_MAPPING, .presence = OPTIONAL },
    { "north.foot_px", TYPE_NUMBERS, "px", .presence = REQUIRED, COUNT(2), LIMITS(0, PIXELS_MAX) },
    { "north.tip_px", TYPE_NUMBERS, "px", .presence = REQUIRED, COUNT(2), LIMITS(0, PIXELS_MAX) },
    { "north.shot", TYPE_INTEGER, .preset = "0", LIMITS(0, FRAME_MAX) },
    { "time", TYPE_TIME, .presence = OPTIONAL },

    { "light", TYPE_MAPPING | TYPE_CHOICE, .presence = REQUIRED, .choice = auto_name },
    { "light.sky", TYPE_CHOICE, .presence = REQUIRED, .choice = sky_name },
    { "light.turbidity", TYPE_NUMBER, .preset = "2.5", LIMITS(1.7, 10) },
    { "light.cie_type", TYPE_INTEGER, LIMITS(1, 15) },
    { "light.map", TYPE_MAPPING, .presence = OPTIONAL },
    { "light.map.file", TYPE_FILE, .presence = REQUIRED },
    { "light.map.north_px", TYPE_NUMBER, "px", .presence = ONE_OF, LIMITS(0, PIXELS_MAX) },
    { "light.map.middle_deg", TYPE_NUMBER, "deg", .presence = ONE_OF, LIMITS(-360, 360) },
    { "light.sun", TYPE_CHOICE | TYPE_MAPPING, .preset = "auto", .choice = sun_name },
    { "light.sun.azimuth_deg", TYPE_NUMBER, "deg", .presence = REQUIRED, LIMITS(-360, 360) },
    { "light.sun.elevation_deg", TYPE_NUMBER, "deg", .presence = REQUIRED, ABOVE(0, 90) },
    { "light.sun_scale", TYPE_NUMBER, .preset = "1", LIMITS(0, INFINITY) },
    { "light.sky_share", TYPE_NUMBERS, COUNT(3), ABOVE(0, 0.99) },
    { "light.shadows", TYPE_ITEMS, .preset = "[]" },
    { "light.shadows[].lit_px", TYPE_NUMBERS, "px", .presence = REQUIRED, COUNT(2), LIMITS(0, PIXELS_MAX) },
    { "light.shadows[].shade_px", TYPE_NUMBERS, "px", .presence = REQUIRED, COUNT(2), LIMITS(0, PIXELS_MAX) },
    { "light.shadows[].shot", TYPE_INTEGER, .preset = "0", LIMITS(0, FRAME_MAX) },
    { "light.shade", TYPE_CHOICE, .preset = "auto", .choice = shade_name },
    { "light.fill", TYPE_NUMBER, .preset = "0", LIMITS(0, 1) },

    { "ground", TYPE_MAPPING, SECTION },
    { "ground.height_m", TYPE_NUMBER, "m", .presence = AT_MOST_ONE_OF },
    { "ground.plane", TYPE_NUMBERS, "m", .presence = AT_MOST_ONE_OF, COUNT(4) },
    { "ground.points_m", TYPE_ROWS, "m", .presence = AT_MOST_ONE_OF, .count_min = 3, .columns = 3 },
    { "ground.albedo", TYPE_NUMBER | TYPE_NUMBERS | TYPE_COLOR, .preset = "0.2", COUNT(3), LIMITS(0, 1) },
    { "ground.reflection", TYPE_NUMBER, .preset = "0", LIMITS(0, 1) },
    { "ground.roughness", TYPE_NUMBER, .preset = "0.4", LIMITS(0, 1) },

    { "surroundings", TYPE_MAPPING, SECTION },
    { "surroundings.skyline_deg", TYPE_NUMBER | TYPE_ROWS, "deg", .preset = "10", .count_min = 1, .columns = 2 },
    { "surroundings.albedo", TYPE_NUMBER | TYPE_NUMBERS | TYPE_COLOR, .preset = "[0.24, 0.23, 0.19]", COUNT(3), LIMITS(0, 1) },

    { "static", TYPE_MAPPING, .presence = OPTIONAL },
    { "static.mesh", TYPE_FILE, .presence = REQUIRED },
    { "static.world_from_mesh", TYPE_MAPPING, SECTION },
    { "static.world_from_mesh.scale", TYPE_NUMBER, .preset = "1", ABOVE(0, INFINITY) },
    { "static.world_from_mesh.quaternion_wxyz", TYPE_NUMBERS, .preset = "[1, 0, 0, 0]", COUNT(4) },
    { "static.world_from_mesh.translation_m", TYPE_NUMBERS, "m", .preset = "[0, 0, 0]", COUNT(3) },
    { "static.detail_m", TYPE_NUMBER, "m", .preset = "0.2", ABOVE(0, 100) },

    { "roads", TYPE_MAPPING, .presence = OPTIONAL },
    { "roads.osm", TYPE_FILE, .presence = REQUIRED },
    { "roads.driving_side", TYPE_CHOICE, .preset = "right", .choice = driving_side_name },
    { "roads.sidewalk_m", TYPE_NUMBER, "m", .preset = "1.8", LIMITS(0, 20) },
    { "paths", TYPE_ITEMS, .preset = "[]" },
    { "paths[].name", TYPE_TEXT, .presence = REQUIRED, .count_max = 120 },
    { "paths[].use", TYPE_CHOICE, .presence = REQUIRED, .choice = road_use_name },
    { "paths[].width_m", TYPE_NUMBER, "m", .presence = REQUIRED, ABOVE(0, 100) },
    { "paths[].oneway", TYPE_BOOLEAN, .preset = "false" },
    { "paths[].points_m", TYPE_ROWS, "m", .presence = ONE_OF, .count_min = 2, .columns = 2 },
    { "paths[].lat_lon_deg", TYPE_ROWS, "deg", .presence = ONE_OF, .count_min = 2, .columns = 2 },
    { "paths[].points_px", TYPE_ROWS, "px", .presence = ONE_OF, .count_min = 2, .columns = 2 },
    { "paths[].shot", TYPE_INTEGER, .preset = "0", LIMITS(0, FRAME_MAX) },

    { "exposure", TYPE_MAPPING | TYPE_CHOICE, .presence = OPTIONAL, .choice = auto_name },
    { "exposure.roads", TYPE_BOOLEAN, .presence = ONE_OF },
    { "exposure.patch_px", TYPE_INTEGERS, "px", .presence = ONE_OF, COUNT(4), LIMITS(0, PIXELS_MAX) },
    { "exposure.value", TYPE_NUMBER | TYPE_NUMBERS, .presence = ONE_OF, COUNT(3), ABOVE(0, INFINITY) },
    { "exposure.white_balance", TYPE_BOOLEAN, .preset = "true" },

    { "models", TYPE_NAMED, .preset = "{}" },
    { "models.NAME.file", TYPE_FILE, .presence = REQUIRED },
    { "models.NAME.unit_m", TYPE_NUMBER, "m", .presence = AT_MOST_ONE_OF, ABOVE(0, 1000) },
    { "models.NAME.length_m", TYPE_NUMBER, "m", .presence = AT_MOST_ONE_OF, ABOVE(0, 1000) },
    { "models.NAME.height_m", TYPE_NUMBER, "m", .presence = AT_MOST_ONE_OF, ABOVE(0, 1000) },
    { "models.NAME.up", TYPE_CHOICE, .choice = model_axis_name },
    { "models.NAME.front", TYPE_CHOICE, .choice = model_axis_name },
    { "models.NAME.class", TYPE_CHOICE, .choice = class_choice_name },
    { "materials", TYPE_MAPPING, SECTION },
    { "materials.rules", TYPE_FILE, .presence = OPTIONAL },

    { "entities", TYPE_ITEMS, .preset = "[]" },
    { "entities[].name", TYPE_TEXT, .presence = REQUIRED, .count_max = 120 },
    { "entities[].model", TYPE_TEXT | TYPE_TEXTS | TYPE_WEIGHTS, .presence = REQUIRED },
    { "entities[].class", TYPE_CHOICE, .choice = class_choice_name },
    { "entities[].at", TYPE_MAPPING, .presence = ONE_OF },
    { "entities[].at.world_m", TYPE_NUMBERS, "m", .presence = ONE_OF, COUNT(2) },
    { "entities[].at.pixel", TYPE_NUMBERS, "px", .presence = ONE_OF, COUNT(2), LIMITS(0, PIXELS_MAX) },
    { "entities[].at.latitude_deg", TYPE_NUMBER, "deg", .presence = ONE_OF, LIMITS(-90, 90) },
    { "entities[].at.longitude_deg", TYPE_NUMBER, "deg", LIMITS(-180, 180) },
    { "entities[].at.shot", TYPE_INTEGER, .preset = "0", LIMITS(0, FRAME_MAX) },
    { "entities[].heading_deg", TYPE_NUMBER, "deg", LIMITS(-360, 360) },
    { "entities[].path", TYPE_TEXT, .presence = ONE_OF },
    { "entities[].start_m", TYPE_NUMBER, "m", .presence = OPTIONAL },
    { "entities[].offset_m", TYPE_NUMBER, "m", LIMITS(-100, 100) },
    { "entities[].speed_m_s", TYPE_NUMBER, "m/s", LIMITS(-100, 100) },
    { "entities[].parked", TYPE_BOOLEAN, .preset = "false" },
    { "entities[].color", TYPE_COLOR | TYPE_NUMBERS, COUNT(3), LIMITS(0, 1) },

    { "occluders", TYPE_ITEMS, .preset = "[]" },
    { "occluders[].name", TYPE_TEXT, .presence = REQUIRED, .count_max = 120 },
    { "occluders[].polygon_px", TYPE_ROWS, "px", .presence = REQUIRED, .count_min = 3, .columns = 2 },
    { "occluders[].ground_px", TYPE_NUMBERS, "px", .presence = REQUIRED, COUNT(2) },
    { "occluders[].shot", TYPE_INTEGER, .presence = OPTIONAL, LIMITS(0, FRAME_MAX) },

    { "traffic", TYPE_MAPPING, SECTION },
    MOVERS("traffic.vehicles", "8"),
    { "traffic.vehicles.colors", TYPE_COLORS, .preset = "[]" },
    MOVERS("traffic.people", "1.4"),

    { "weather", TYPE_MAPPING, .presence = OPTIONAL },
    { "weather.visibility_m", TYPE_NUMBER, "m", .presence = REQUIRED, ABOVE(0, INFINITY) },
    { "weather.haze", TYPE_COLOR | TYPE_NUMBERS, .presence = REQUIRED, COUNT(3), LIMITS(0, 1) },
    { "lens", TYPE_MAPPING, SECTION },
    { "lens.exposure_s", TYPE_NUMBER, "s", .preset = "0", LIMITS(0, 10) },
    { "lens.defocus_px", TYPE_NUMBER, "px", .preset = "0", LIMITS(0, 500) },
    { "lens.focus_m", TYPE_NUMBER, "m", ABOVE(0, INFINITY) },
    { "lens.softness_px", TYPE_NUMBER | TYPE_CHOICE, "px", .preset = "auto", LIMITS(0, 100), .choice = trait_name },
    { "lens.sharpening", TYPE_NUMBER | TYPE_CHOICE, .preset = "auto", LIMITS(0, 3), .choice = trait_name },
    { "lens.grain", TYPE_NUMBER | TYPE_CHOICE, .preset = "auto", LIMITS(0, 100), .choice = trait_name, .merging = true },
    { "lens.compression", TYPE_CHOICE, .preset = "auto", .choice = trait_name, .merging = true },
    { "lens.vignetting", TYPE_NUMBER | TYPE_CHOICE, .preset = "none", LIMITS(0, 0.95), .choice = trait_name, .merging = true },
    { "lens.blacks", TYPE_NUMBER | TYPE_CHOICE, .preset = "none", LIMITS(1, 100), .choice = trait_name, .merging = true },
    { "lens.highlights", TYPE_NUMBER | TYPE_CHOICE, .preset = "none", LIMITS(0.01, 1), .choice = trait_name, .merging = true },

    { "transfer", TYPE_MAPPING, SECTION, .merging = true },
    { "transfer.method", TYPE_CHOICE, .preset = "layers", .choice = transfer_name },
    { "transfer.t1", TYPE_NUMBER, .preset = "30", LIMITS(0, 255) },
    { "transfer.t2", TYPE_NUMBER, .preset = "200", LIMITS(0, 255) },
    { "transfer.t3", TYPE_NUMBER, .preset = "96", LIMITS(0, 255) },
    { "transfer.overwrite", TYPE_CHOICE, .preset = "above", .choice = overwrite_name },
    { "labels", TYPE_MAPPING, SECTION, .merging = true },
    { "labels.mask", TYPE_CHOICE, .preset = "traced", .choice = mask_name },
    { "labels.palette", TYPE_CHOICE, .preset = "cityscapes", .choice = palette_name },
    { "quality", TYPE_CHOICE, .preset = "standard", .choice = quality_name },
    { "seed", TYPE_INTEGER, .preset = "0", LIMITS(0, 2147483647) },
};

const struct schema scene_schema = { keys, sizeof keys / sizeof *keys };

#include "cases.h"

#include <string.h>

static const struct proving_entity fixed_cast[] = {
    { "red car", "sedan", "car", { 0.5, -1.75, 0 }, 90, "#8a1c1c" },
    { "white car", "sedan", "car", { 12, 1.75, 0 }, 270, "#dcdcd8" },
    { "man", "man-jacket", "person", { -3.2, 1.6, 0 }, 195, NULL },
    { "woman", "woman-coat", "person", { 6.2, -3.0, 0 }, 240, NULL },
    { NULL, NULL, NULL, { 0, 0, 0 }, 0, NULL },
};
static const struct proving_entity flight_cast[] = {
    { "blue car", "sedan", "car", { -6, 1.75, 0 }, 270, "#1d3560" },
    { "grey car", "sedan", "car", { 3.5, -1.75, 0 }, 90, "#8d9296" },
    { "man", "man-jacket", "person", { 8, 0.4, 0 }, 185, NULL },
    { "woman", "woman-skirt", "person", { 1.5, -7, 0.12 }, 95, NULL },
    { "waiting man", "man-sweater", "person", { -1, 4.6, 0.12 }, 150, NULL },
    { NULL, NULL, NULL, { 0, 0, 0 }, 0, NULL },
};

static const struct proving_shot fixed_shot[] = { { { -16, -7, 6.5 }, { 3.5, -0.6, 0 }, { 0, 0, 1 } } };
static const struct proving_shot flight_shots[] = {
    { { 1, -1, 24 }, { 1.001, -1, 0 }, { 0, 1, 0 } },
    { { -9, -15, 17 }, { 1, 0, 0 }, { 0, 0, 1 } },
    { { 14, 13, 18 }, { 1, -1.5, 0 }, { 0, 0, 1 } },
};

#define STANDING .shots = fixed_shot, .shot_count = 1, .entities = fixed_cast, \
    .camera = { CAMERA_OPENCV, 960, 540, { 800, 801, 483.5, 268.2, -0.14, 0.03, 0.0006, -0.0004 } }
#define FIXED STANDING, .has_mesh = true
#define PLANE STANDING, .patch_px = { 330, 320, 440, 370 }
#define FLIGHT .shots = flight_shots, .shot_count = 3, .entities = flight_cast, .has_mesh = true, .flies = true, \
    .camera = { CAMERA_RADIAL, 960, 540, { 690, 478.2, 272.6, -0.06, 0.01 } }
#define NOON .time = "2022-06-21T12:40:00+02:00", .light = "{sky: clear, turbidity: 3}", .k = { 0.90, 0.95, 1.02 }
#define LOW .time = "2022-06-21T18:40:00+02:00", .light = "{sky: clear, turbidity: 3.5, sun_scale: 0.9}", .k = { 0.84, 0.95, 1.08 }
#define OVERCAST .time = "2022-06-21T12:40:00+02:00", .light = "{sky: overcast}", .k = { 0.98, 0.95, 0.90 }
#define HAZE .time = "2022-06-21T10:10:00+02:00", .light = "{sky: clear, turbidity: 6, sun_scale: 0.8}", .k = { 0.86, 0.88, 0.90 }, \
    .visibility_m = 250, .haze = { 0.46, 0.49, 0.52 }

const struct proving_case proving_cases[] = {
    { .name = "fixed-noon", FIXED, NOON },   { .name = "fixed-low", FIXED, LOW },
    { .name = "fixed-overcast", FIXED, OVERCAST }, { .name = "fixed-haze", FIXED, HAZE },
    { .name = "flight-noon", FLIGHT, NOON }, { .name = "flight-low", FLIGHT, LOW },
    { .name = "flight-overcast", FLIGHT, OVERCAST }, { .name = "flight-haze", FLIGHT, HAZE },
    { .name = "plane-noon", .photographed_as = "fixed-noon", PLANE, NOON },
    { .name = "plane-low", .photographed_as = "fixed-low", PLANE, LOW },
    { .name = "plane-overcast", .photographed_as = "fixed-overcast", PLANE, OVERCAST },
    { .name = "plane-haze", .photographed_as = "fixed-haze", PLANE, HAZE },
};
const size_t proving_case_count = sizeof proving_cases / sizeof *proving_cases;

const struct vec3 proving_post_m = { -6.5, -3.9, 0.12 };
const struct vec3 proving_parked_m[] = { { -1.7, -4.6, 0 }, { 9.4, -4.6, 0 }, { 20.6, -4.65, 0 }, { -14, -4.6, 0 } };
const size_t proving_parked_count = sizeof proving_parked_m / sizeof *proving_parked_m;

const struct proving_case *proving_case(const char *name)
{
    for (size_t i = 0; i < proving_case_count; i++)
        if (!strcmp(proving_cases[i].name, name)) return &proving_cases[i];
    return NULL;
}

size_t proving_entity_count(const struct proving_case *c)
{
    size_t n = 0;
    while (c->entities[n].name) n++;
    return n;
}

struct pose proving_entity_pose(const struct proving_entity *e)
{
    double a = e->heading_deg * M_PI / 180;
    return (struct pose){ mat3_from_columns(vec3(sin(a), cos(a), 0), vec3(-cos(a), sin(a), 0), vec3(0, 0, 1)), e->position_m };
}

struct pose proving_shot_pose(const struct proving_shot *s)
{
    struct vec3 forward = vec3_unit(vec3_sub(s->target_m, s->eye_m)), right = vec3_unit(vec3_cross(forward, s->up));
    return (struct pose){ mat3_from_columns(right, vec3_cross(forward, right), forward), s->eye_m };
}

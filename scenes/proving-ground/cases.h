/* The cases of the proving ground: what stands in the street, who photographs it, in which light.
 * World: x east, y north, z up; see street.inc. */
#ifndef STAFFAGE_PROVING_CASES_H
#define STAFFAGE_PROVING_CASES_H

#include "lib/camera.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

struct proving_entity {
    const char *name, *model, *class_;  /* model: a key of models/, without its ending; NULL name ends a list */
    struct vec3 position_m;             /* on the true street */
    double heading_deg;                 /* clockwise from north */
    const char *color;                  /* "#rrggbb", or NULL */
};

struct proving_shot { struct vec3 eye_m, target_m, up; };

struct proving_case {
    const char *name;
    const char *light;          /* what a user would write who knows the light */
    const char *time;
    double k[3];                /* linear photograph value of a level white surface's radiance 1, the camera's secret */
    double visibility_m;        /* 0: clear */
    double haze[3];             /* linear photograph values */
    const struct proving_shot *shots;
    size_t shot_count;
    const char *photographed_as; /* the case whose photographs and truths these are, too; NULL: its own */
    bool has_mesh;              /* the tool is given the reconstruction; else a plane */
    bool flies;                 /* its photographs color the reconstruction */
    struct camera camera;       /* at full size */
    const struct proving_entity *entities;
    int patch_px[4];            /* sunlit asphalt at full size, without a mesh */
};

#define PROVING_ALBEDO 0.11     /* of the asphalt, as a user would know it */

extern const struct proving_case proving_cases[];
extern const size_t proving_case_count;
/* NULL when there is none of this name. */
const struct proving_case *proving_case(const char *name);

size_t proving_entity_count(const struct proving_case *c);
/* World from entity, from position and heading alone: x forward, y left, z up. */
struct pose proving_entity_pose(const struct proving_entity *e);
/* World from camera: x right, y down, z forward. */
struct pose proving_shot_pose(const struct proving_shot *s);
/* The foot of the lamp post that stands between the fixed camera and the street; its arm reaches towards +y. */
extern const struct vec3 proving_post_m;
#define PROVING_POST_RADIUS_M 0.07
#define PROVING_POST_HEIGHT_M 6.0
#define PROVING_POST_REACH_M 0.9
/* The ground below the middles of the parked cars, which face +x. */
extern const struct vec3 proving_parked_m[];
extern const size_t proving_parked_count;

/* What the camera does to the light, the same in every case. */
#define PROVING_SOFTNESS_PX 0.55    /* standard deviation at any size, besides the area of a pixel */
#define PROVING_VIGNETTING 0.10     /* of the light, lost in the corners, with the square of the distance */
#define PROVING_SHOT_NOISE 6e-5     /* variance = this * value + that^2, linear values of 0 to 1 */
#define PROVING_READ_NOISE 6e-4

#endif

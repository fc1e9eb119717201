/* What of the sky's light reaches the ground: past the place, and past entities, which send light back (exitance.h). */
#ifndef STAFFAGE_GEN_SKY_SIGHT_H
#define STAFFAGE_GEN_SKY_SIGHT_H

#include "gen/estimate/sun_share.h"
#include "gen/light/light.h"
#include "gen/light/wet.h"
#include "gen/trace/sky_rays.h"
#include "gen/trace/trace.h"
#include "gen/world/entity.h"
#include "gen/world/receiver.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

struct sky_sight;

/* Irradiance / pi of a point of the ground, but for the sun's own, without and with the entities. */
struct sky_seen { double without[3], with[3]; };

struct sky_sight_input {
    const struct light *light;         /* borrowed, as all but near is */
    size_t directions;                 /* the sky is so many rays (sky_rays.h) */
    const struct static_cut *near;     /* what of the place each point's rays may meet; NULL: nothing */
    struct sky_round round;            /* what stands farther off, and lights the entities; without it they send nothing back, and what is near is black */
    const struct sun_share *sun_share; /* what besides the place keeps the sun away; NULL: nothing */
};
/* Err: ERR_MEMORY */
bool sky_sight_create(struct sky_sight **sight, const struct sky_sight_input *in, struct error *err);
/* An entity takes light from its receiver, less towards the receiver's edge (receiver_share), and none beyond.
 * tracer, entity and receiver are borrowed. */
bool sky_sight_add(struct sky_sight *sight, const struct tracer *tracer, const struct entity *entity,
                   const struct receiver *receiver, struct error *err);
void sky_sight_destroy(struct sky_sight *sight);

/* How far from a point, seen from above, the nearest entity's receiver begins, at least. */
double sky_sight_distance(const struct sky_sight *sight, struct vec3 p_m);

/* Does an entity hide a point of its receiver from an eye? */
bool sky_sight_hidden(const struct sky_sight *sight, struct vec3 p_m, struct vec3 eye_m);

/* What entities leave of light from a point, wherever their receivers are. In/out: share (n) along world directions (n) */
void sky_sight_shade(const struct sky_sight *sight, float *share, struct vec3 p_m, const struct vec3 *directions, size_t n);
/* What of the sun reaches a point: past entities, the place near by, and what the sun share tells. 0 without a sun. */
double sky_sight_sun(const struct sky_sight *sight, struct vec3 p_m);

/* Not for several threads at once. */
struct sky_seen sky_sight_at(const struct sky_sight *sight, struct vec3 p_m, struct vec3 normal);
/* Radiance that wet ground mirrors to an eye, likewise, but for the sun; of a plane, for nothing near by of a place is looked for.
 * In: with  what the point receives, of sky_sight_at */
struct sky_seen sky_sight_mirrored(const struct sky_sight *sight, const struct wet *wet, struct vec3 p_m, struct vec3 normal, struct vec3 eye_m,
                                   const double with[3]);

#endif

/* What of the sky's light reaches the ground: past the place, and past entities. The sky is some hundred directions,
 * the same for every point and every frame, so that what does not move keeps its shade to the last bit. */
#ifndef STAFFAGE_GEN_SKY_SIGHT_H
#define STAFFAGE_GEN_SKY_SIGHT_H

#include "gen/light/light.h"
#include "gen/trace/trace.h"
#include "gen/world/entity.h"
#include "gen/world/receiver.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

struct sky_sight;

/* The sky's irradiance / pi of a point of the ground. */
struct sky_seen { double without[3], with[3]; /* entities */ };

/* In:  directions  what light_sample_sky makes of the sky: so many
 *      place       what of the static mesh can be in the way, copied; NULL: nothing
 * Err: ERR_MEMORY */
bool sky_sight_create(struct sky_sight **sight, const struct light *light, size_t directions, const struct static_cut *place,
                      struct error *err);
/* An entity takes light from its receiver, less towards the receiver's edge (receiver_share), and none beyond.
 * tracer, entity's model and receiver are borrowed. */
bool sky_sight_add(struct sky_sight *sight, const struct tracer *tracer, const struct entity *entity,
                   const struct receiver *receiver, struct error *err);
void sky_sight_destroy(struct sky_sight *sight);

/* How far from a point, seen from above, the nearest entity's receiver begins, at least. */
double sky_sight_distance(const struct sky_sight *sight, struct vec3 p_m);

/* Does an entity hide a point of its receiver from an eye? */
bool sky_sight_hidden(const struct sky_sight *sight, struct vec3 p_m, struct vec3 eye_m);

struct sky_seen sky_sight_at(const struct sky_sight *sight, struct vec3 p_m, struct vec3 normal);

#endif

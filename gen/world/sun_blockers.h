/* What can keep the sun from the ground: how far up the sun's rays things stand, on a grid across these. Of ground that nothing
 * on the grid stands above POV-Ray need not ask. */
#ifndef STAFFAGE_GEN_SUN_BLOCKERS_H
#define STAFFAGE_GEN_SUN_BLOCKERS_H

#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct sun_blockers;

/* Out: *blockers, the caller's; free with sun_blockers_destroy
 * In:  towards_sun unit; point_m (n), at least one: the corners of all ground that will be asked about
 * Err: ERR_MEMORY */
bool sun_blockers_create(struct sun_blockers **blockers, struct vec3 towards_sun, const struct vec3 *point_m, size_t n, struct error *err);
void sun_blockers_destroy(struct sun_blockers *blockers);

/* What stands somewhere. In: position_m (vertices,3), triangle (triangles,3). Err: ERR_MEMORY */
bool sun_blockers_add(struct sun_blockers *blockers, struct pose world_from_mesh, const float (*position_m)[3], size_t vertices,
                      const uint32_t (*triangle)[3], size_t triangles, struct error *err);
/* A triangle that hangs above all the ground, so far up the sun's rays from where it is given. */
void sun_blockers_add_above(struct sun_blockers *blockers, const struct vec3 corner_m[3], double up_m);

/* May one of them keep part of the sun's disc from a point of this triangle of the ground? False only where none does. */
bool sun_blockers_reach(const struct sun_blockers *blockers, const struct vec3 corner_m[3]);

#endif

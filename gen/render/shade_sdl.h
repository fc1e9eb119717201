/* Shade that lies in the photograph, for POV-Ray: a sheet in the way of the sun. */
#ifndef STAFFAGE_GEN_SHADE_SDL_H
#define STAFFAGE_GEN_SHADE_SDL_H

#include "gen/estimate/sun_share.h"
#include "gen/render/sdl.h"
#include "gen/world/entity.h"
#include "lib/vec.h"

#include <stddef.h>

/* Whatever shades the ground from above the entities shades what is between alike: at a point in the air there is as much
 * sun as where its ray meets the ground. So the ground's shade is moved up the sun's rays, above all entities.
 * In:  map, through: share's, in files: paths relative to the output folder; through "" without; sun: unit, towards it */
void shade_sdl(struct sdl *sdl, const struct sun_share *share, const char *map, const char *through, struct vec3 sun,
               const struct entity *entities, size_t n);

#endif

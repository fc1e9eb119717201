/* Does the sun that a measured sky shows stand where place and time put it? */
#ifndef STAFFAGE_GEN_MAP_SUN_H
#define STAFFAGE_GEN_MAP_SUN_H

#include "gen/light/light.h"
#include "gen/scene/scene.h"
#include "lib/error.h"

#include <stdbool.h>

/* Out: text  to warn with, to be freed; NULL when they agree within 15 deg, or one of them is not known
 * Err: ERR_MEMORY */
bool map_sun_doubt(char **text, const struct light *light, const struct scene *scene, struct error *err);

#endif

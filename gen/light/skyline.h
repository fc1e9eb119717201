/* What stands around where the ground is a plane, and nothing else tells what does: houses and trees, upright and matte, up to a skyline.
 * They keep the sky away that is behind them, and send back of the sun's, the sky's and the ground's light what falls on
 * them. They stand so far away that they look the same from all entities. */
#ifndef STAFFAGE_GEN_SKYLINE_H
#define STAFFAGE_GEN_SKYLINE_H

#include "gen/light/light.h"
#include "gen/scene/scene.h"
#include "lib/error.h"

#include <stdbool.h>

/* The elevation up to which the sky is hidden. In: azimuth_rad clockwise from the world's y axis */
double skyline_elevation(const struct scene_skyline *skyline, double azimuth_rad);

/* Out: *text  a warning that it was told to hide the sun, which shines all the same; NULL: there is none; the caller frees
 * Err: ERR_MEMORY */
bool skyline_doubt(char **text, const struct light *light, const struct scene *scene, struct error *err);

/* Of the light in the open, what reaches the entities.
 * In:  light->open_sky and the sun
 * Out: light->sky, of the same size, its lower half the ground; light->irradiance */
void skyline_raise(struct light *light, const struct scene_skyline *skyline, const double ground_albedo[3]);

#endif

/* A sky that somebody measured: an equirectangular picture with high dynamic range. */
#ifndef STAFFAGE_GEN_MEASURED_SKY_H
#define STAFFAGE_GEN_MEASURED_SKY_H

#include "gen/scene/scene.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdbool.h>

struct measured_sky {
    struct image sky;          /* as sky_image.h says, with the file's radiances, the sun taken out */
    bool has_sun;
    struct vec3 sun_direction; /* unit, world */
    double sun_color[3];       /* normal irradiance / pi */
};

/* The map of a scene. Its sun is sought in all of it, round the direction `towards`, or not at all, as the scene
 * says; what is there and brighter than the sky by orders is taken out, and the sky round it put in its place.
 * Err: ERR_INPUT at the map or in the scene: no such picture, not equirectangular, not linear, its north
 *      outside, no light, no sun where one is given, a sun that was clipped */
bool measured_sky_read(struct measured_sky *measured, const struct scene *scene, struct vec3 towards, struct error *err);
void measured_sky_release(struct measured_sky *measured);

#endif

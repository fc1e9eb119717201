/* The light of a scene: a sun, and a sky that lights, shades and is reflected.
 *
 * One unit for all of it: radiance is relative, scaled so that a level white surface in the open, where nothing
 * stands around, has luminance 1, and an irradiance E is kept as E / pi, the radiance of a white matte surface
 * that receives it. It is what POV-Ray's light colours mean. Colours are linear Rec.709. */
#ifndef STAFFAGE_GEN_LIGHT_H
#define STAFFAGE_GEN_LIGHT_H

#include "gen/scene/scene.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

#define SUN_RADIUS_RAD (0.5 * 0.53 * 3.14159265358979323846 / 180)

struct light {
    bool has_sun;
    struct vec3 sun_direction;  /* unit, world, towards the sun */
    double sun_color[3];        /* normal irradiance / pi */
    struct image sky;           /* F32 3: radiance, laid out as sky_image.h says, with what stands around (skyline.h) and the ground */
    struct image open_sky;      /* the same without what stands around; its lower half is empty */
    double irradiance[3];       /* on level ground, sun and sky, / pi */
};

/* A direction that stands for a share of the sky: what the ground sees of it (gen/trace/sky_sight.h). */
struct sky_light {
    struct vec3 direction;      /* unit, towards the light, above the horizon */
    double color[3];            /* normal irradiance / pi */
    double solid_angle;         /* / pi */
};

/* Sun and sky of a scene. The sky below the horizon has the colour of the ground.
 * Err: ERR_INPUT at the scene's sun: it stands below the horizon; at its skyline: what stands around would be brighter than
 *      sky_share leaves; what sun_position and measured_sky_read say
 * Src: clear, and standard skies that show the sun: daylight.h (how much light, and its colour), sky_form.h (where
 *      in the sky); overcast: Moon and Spencer 1942 */
bool light_create(struct light *light, const struct scene *scene, struct error *err);
void light_release(struct light *light);

/* Where the scene's sun stands, by time or given.
 * Err: ERR_INPUT at the scene's sun: it stands below the horizon; what sun_position says */
bool light_sun_direction(struct vec3 *direction, const struct scene *scene, struct error *err);

/* The sky's radiance in a direction. */
void light_sky_radiance(double color[3], const struct light *light, struct vec3 direction);

/* What a surface of any unit normal receives, sun and sky, / pi; the map's lower half, lit level
 * ground, counts where the surface faces it. Of the normal (0, 0, 1) it is light->irradiance. */
void light_irradiance(double rgb[3], const struct light *light, struct vec3 normal);
/* The same without the sun. */
void light_sky_irradiance(double rgb[3], const struct light *light, struct vec3 normal);

/* n lights that share the level surface's irradiance equally: importance-sampled by radiance and
 * cosine, stratified; their sum on a level surface is the sky's irradiance exactly.
 * Out: lights (n) */
void light_sample_sky(struct sky_light *lights, size_t n, const struct light *light);

#endif

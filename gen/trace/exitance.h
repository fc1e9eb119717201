/* The light that an entity sends back: what its triangles receive, found as they are asked for, times what they reflect. All are taken
 * as matte; what they shine with themselves, and light that comes from other entities, is left out. */
#ifndef STAFFAGE_GEN_EXITANCE_H
#define STAFFAGE_GEN_EXITANCE_H

#include "gen/light/light.h"
#include "gen/trace/shape.h"
#include "gen/world/entity.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

struct exitance;
struct sky_sight;

/* What lights an entity. All borrowed. */
struct entity_light {
    const struct light *light;     /* its sun */
    const struct image *around;    /* radiance from all directions, laid out as sky_image.h says; the lower half is level ground in the open */
    const struct sky_sight *sight; /* what is in the way of both (sky_sight_shade, sky_sight_sun) */
};

/* entity is borrowed, in is copied. Err: ERR_MEMORY */
bool exitance_create(struct exitance **exitance, const struct entity *entity, const struct entity_light *in, struct error *err);
void exitance_destroy(struct exitance *exitance);

/* Radiance of a point of the entity, towards whoever sees it along a direction (entity coordinates).
 * In:  ground_left  the light on the ground near by, of that in the open */
void exitance_radiance(double rgb[3], struct exitance *exitance, const struct shape_point *point, struct vec3 direction, double ground_left);

#endif

/* The light that an entity sends back: what its triangles receive, found as they are asked for, times what they reflect. */
#ifndef STAFFAGE_GEN_EXITANCE_H
#define STAFFAGE_GEN_EXITANCE_H

#include "gen/estimate/sun_share.h"
#include "gen/light/light.h"
#include "gen/trace/shape.h"
#include "gen/world/cut_rays.h"
#include "gen/world/entity.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

/* What lights entities. All borrowed. */
struct entity_light {
    const struct light *light;         /* its sun */
    const struct image *around;        /* radiance from all directions, laid out as sky_image.h says; the lower half is level ground in the open */
    const struct cut_rays *place;      /* what keeps the sun away; NULL: nothing */
    const struct sun_share *sun_share; /* what else does; NULL: nothing */
};

struct exitance;

/* shape is the entity's; both are borrowed, in is copied. Err: ERR_MEMORY */
bool exitance_create(struct exitance **exitance, const struct entity *entity, const struct shape *shape, const struct entity_light *in,
                     struct error *err);
void exitance_destroy(struct exitance *exitance);

/* Radiance at a point of the entity, towards whoever sees it along a direction (entity coordinates).
 * In:  ground_left  what entities leave of the light on the ground near by, of that in the open */
void exitance_at(double rgb[3], struct exitance *exitance, const struct shape_point *point, struct vec3 direction, double ground_left);

#endif

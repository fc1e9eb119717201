/* The sky as some hundred directions, the same for every point and every frame; and what light comes along them where something
 * stands before it. Below the bare sky what does not move keeps its shade to the last bit; what stands round is found anew for each frame. */
#ifndef STAFFAGE_GEN_SKY_RAYS_H
#define STAFFAGE_GEN_SKY_RAYS_H

#include "gen/light/light.h"
#include "gen/world/receiver.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stddef.h>

struct sky_rays {
    struct vec3 *direction; /* (n) unit, above the horizon */
    double *solid_angle;    /* (n) / pi */
    double (*color)[3];     /* (n) normal irradiance / pi, of the sky */
    size_t n;
};

/* n of light_sample_sky. Err: ERR_MEMORY. sky_rays_release may be called after a failure, too. */
bool sky_rays_init(struct sky_rays *rays, const struct light *light, size_t n, struct error *err);
void sky_rays_release(struct sky_rays *rays);

/* The i-th of n directions round +z that share a matte surface's irradiance equally: by the cosine, turned by the golden ratio. */
struct vec3 cosine_direction(size_t i, size_t n);

/* What comes along a ray from an image of radiances, laid out as sky_image.h says. */
void sky_ray_color(double color[3], const struct sky_rays *rays, size_t ray, const struct image *radiance);

/* What stands round. All borrowed. */
struct sky_round {
    const struct image *radiance;    /* of all directions, laid out as sky_image.h says; NULL: there is the sky alone */
    const struct static_mesh *place; /* NULL: all that stands round is in the radiance, and level ground receives as much as of the sky */
};

/* By so much the radiance round is brought to what level ground receives of the sky, on a plane. */
void sky_round_gain(double gain[3], const struct sky_rays *rays, const struct sky_round *round);

/* Light beyond a receiver: from a point in it, what the place has farther off shines with the radiance round in its direction.
 * Out: color (n) as struct sky_rays */
void sky_rays_round(double (*color)[3], const struct sky_rays *rays, const struct sky_round *round, const struct receiver *receiver,
                    struct vec3 from_m);

#endif

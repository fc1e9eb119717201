/* The light that the ground sends back, less what entities keep from it: below a car there is little sky. */
#ifndef STAFFAGE_GEN_BOUNCED_H
#define STAFFAGE_GEN_BOUNCED_H

#include "gen/estimate/sun_share.h"
#include "gen/light/light.h"
#include "gen/trace/sky_sight.h"
#include "gen/world/ground.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stddef.h>

/* An entity, seen from above, and the ground right below it. */
struct bounced_ground { struct vec2 at_m; struct plane plane; };

struct bounced_input {
    const struct sky_sight *sight;
    const struct light *light;
    const struct sun_share *sun;              /* NULL: the sun reaches all ground but where entities shade */
    struct vec2 low_m, high_m;                /* world x, y of the image's corners */
    const struct bounced_ground *ground;      /* (n) */
    size_t n;
};

/* In the renderer the whole sky lights the ground that bounces, and the sun what it sees: an albedo that is so much
 * lower sends back the rest.
 * In/out: albedo  U8, 3 channels, sRGB; row 0 is the northmost, as orthophoto.bouncing
 * Err:    ERR_MEMORY */
bool bounced_shade(struct image *albedo, const struct bounced_input *in, struct error *err);

#endif

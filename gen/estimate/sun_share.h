/* What of the sun reaches the ground round the entities, past what stands in the photograph or beside it: a map. */
#ifndef STAFFAGE_GEN_SUN_SHARE_H
#define STAFFAGE_GEN_SUN_SHARE_H

#include "gen/estimate/ground_shade.h"
#include "gen/light/seen.h"
#include "gen/world/ground.h"
#include "gen/world/receiver.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

struct sun_share {
    struct image map;          /* U8, 1 channel: 255 in the sun, as it is at the edges and beyond; row 0 is the northmost; empty: all in the sun */
    struct vec2 low_m, high_m; /* world x, y of the corners that the map fills */
};

struct sun_share_input {
    const struct ground_shade *shade;
    const struct seen *seen;
    const struct plane *ground;
    const struct receiver *receivers;  /* (n) the map reaches over these: where entities and their shadows are */
    size_t n;
};

/* Ground that something hides is as what it is beside, as is what is neither of the ground's surfaces: markings, drain
 * covers, cars. Beyond the picture shade fades: far out the ground is lit.
 * Out: *share, initialized here; free with sun_share_release
 * Err: ERR_MEMORY */
bool sun_share_create(struct sun_share *share, const struct sun_share_input *in, struct error *err);
void sun_share_release(struct sun_share *share);

/* At world x, y: 0 to 1. */
double sun_share_at(const struct sun_share *share, struct vec2 at_m);

#endif

/* What stands on the ground of a picture, upright, as mirrors and bouncing light meet it: its outline and its radiance
 * on the plane through its foot that faces the camera. Its other sides are not known: they are as this one. What a place has
 * itself stands there already. */
#ifndef STAFFAGE_GEN_STANDING_H
#define STAFFAGE_GEN_STANDING_H

#include "gen/light/seen.h"
#include "gen/trace/trace.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stddef.h>

struct standing {
    struct image radiance;       /* F32, 3 channels: of the rectangle round the outline; beyond the outline as beside it */
    struct vec2 *outline;        /* (count) shares of the rectangle's sides, from its lower left */
    size_t count;                /* 0: nothing stands; what is seen from above 45 degrees shows its top, no side */
    struct vec2 size_m;          /* of the rectangle */
    struct pose world_from_rectangle; /* metres: x as the picture's right, y up, z towards the camera; from the lower left */
};

/* In:  place_depth F32, z in the picture, not finite where a place has nothing; NULL: the ground is a plane
 * Out: *standing, initialized here; free with standing_release
 * Err: ERR_MEMORY */
bool standing_create(struct standing *standing, const struct seen *seen, const struct occluder *occluder, const struct image *place_depth,
                     struct error *err);
void standing_release(struct standing *standing);

#endif

/* Ground that nothing can keep the sun from: POV-Ray need not ask there. */
#ifndef STAFFAGE_GEN_SUNLIT_GROUND_H
#define STAFFAGE_GEN_SUNLIT_GROUND_H

#include "gen/estimate/sun_share.h"
#include "gen/trace/shaded_ground.h"
#include "gen/world/entity.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

struct sunlit_input {
    struct vec3 towards_sun;
    const struct entity *entities; /* (entity_count) */
    size_t entity_count;
    const struct static_cut *shades; /* of the place; NULL: none */
    const struct sun_share *share;   /* that the photograph tells of; NULL: none */
};

/* Out: ground->sunlit. Err: ERR_MEMORY */
bool sunlit_ground_find(struct shaded_ground *ground, const struct sunlit_input *in, struct error *err);

#endif

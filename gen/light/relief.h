/* The place round the entities as light and mirrors meet it: a coarse surface of what is seen from among them, as far away as it is.
 * The panorama is its picture. What is not seen from there is not on it, but for level ground that has its orthophoto: that is
 * all there, also behind a parked car, and lies in sun and sky, so that entities shade it. */
#ifndef STAFFAGE_GEN_RELIEF_H
#define STAFFAGE_GEN_RELIEF_H

#include "gen/world/entity.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stddef.h>
#include <stdint.h>

/* Of a normal's z, above: ground, and no side of what stands on it. */
#define RELIEF_LEVEL 0.8
/* So far below the horizon the place is on the relief, and in the panorama. */
#define RELIEF_LOWEST_RAD (30 * M_PI / 180)

struct relief {
    struct relief_part { struct vec3 *point_m; size_t points; uint32_t (*triangle)[3]; size_t triangles; } /* world */
        seen, ground;            /* ground: with an orthophoto */
};

struct relief_input {
    const struct static_mesh *place;
    struct vec3 from_m;          /* as the panorama's */
    const struct entity *entities; /* (n) level ground round these has its orthophoto */
    size_t n;
    const struct prism *known;   /* (n) level ground within an entity's own is left out, for it is there already; NULL: none is */
};

/* Out: *relief, initialized here; free with relief_release
 * Err: ERR_MEMORY */
bool relief_create(struct relief *relief, const struct relief_input *in, struct error *err);
void relief_release(struct relief *relief);

#endif

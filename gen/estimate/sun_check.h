/* Does the sun stand where the shadows say? */
#ifndef STAFFAGE_GEN_SUN_CHECK_H
#define STAFFAGE_GEN_SUN_CHECK_H

#include "gen/world/static_mesh.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

/* Two points on either side of the edge of a real shadow. */
struct shadow_sides { struct vec3 lit_m, shade_m; };

/* By how much the sun had to stand elsewhere for the place's shadows to fall as the photographs show them. */
struct sun_check {
    double azimuth_off_deg, elevation_off_deg; /* of the shadows' sun from the scene's */
    double azimuth_sigma_deg, elevation_sigma_deg;
    double agree, agree_there; /* share of edges on whose two sides light is told right, where the sun stands and where the shadows put it */
    size_t edges;
    bool at_limit;             /* farther off than is looked for */
};

#define SUN_CHECK_EDGES_MIN 200

/* Edges that no shadow of the place lies near are left out: their trees are not in it.
 * Out: *done: false where too few are left to tell
 * Err: ERR_MEMORY */
bool sun_check(struct sun_check *check, bool *done, const struct static_mesh *mesh, struct vec3 sun, const struct shadow_sides *sides,
               size_t n, struct error *err);

#endif

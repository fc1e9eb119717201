/* The light on sunlit ground between buildings and trees: they keep part of the sky away and send back light of their own. */
#ifndef STAFFAGE_GEN_ENCLOSED_H
#define STAFFAGE_GEN_ENCLOSED_H

#include "gen/light/light.h"
#include "gen/world/static_mesh.h"
#include "lib/vec.h"

#include <stddef.h>

/* Of what stands round: plaster and brick 0.2 to 0.5, trees 0.1. It tells a tenth of the light at most. */
#define ENCLOSING_ALBEDO 0.25

/* Out: rgb  irradiance / pi of level ground, mean over at most ENCLOSED_POINTS of the points (n, at least 1) */
#define ENCLOSED_POINTS 64
void enclosed_irradiance(double rgb[3], const struct light *light, const struct static_mesh *place, const struct vec3 *points_m, size_t n);

#endif

/* What of the place shades the place: of a street most does not, and no shadow ray has to look at it. */
#ifndef STAFFAGE_GEN_SHADING_H
#define STAFFAGE_GEN_SHADING_H

#include "gen/world/static_mesh.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

#define SHADING_SAMPLE_M 1.0

/* Part a cut's triangles: those that stand between a light and something of receivers, with their neighbours,
 * and the rest. A triangle is judged by its corners; a large one, with an edge over SHADING_SAMPLE_M, is always taken
 * to shade: its middle could.
 * Out: shading, rest   without colours; free with static_cut_release
 * In:  towards (n)     unit, towards the lights */
bool shading_part(struct static_cut *shading, struct static_cut *rest, const struct static_cut *cut,
                  const struct static_cut *receivers, const struct vec3 *towards, size_t n, struct error *err);

#endif

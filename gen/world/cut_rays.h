/* A cut of the static mesh as rays of light meet it. */
#ifndef STAFFAGE_GEN_CUT_RAYS_H
#define STAFFAGE_GEN_CUT_RAYS_H

#include "gen/world/static_mesh.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>

struct cut_rays;

/* The cut is copied. Err: ERR_MEMORY */
bool cut_rays_create(struct cut_rays **rays, const struct static_cut *cut, struct error *err);
void cut_rays_destroy(struct cut_rays *rays);
/* Does anything lie that way, more than 1 mm and less than reach_m away? */
bool cut_rays_blocked(const struct cut_rays *rays, struct vec3 from_m, struct vec3 direction, double reach_m);

#endif

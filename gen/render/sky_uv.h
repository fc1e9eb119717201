/* The sky's light on a mesh, told to POV-Ray as uv: how much of it there is, and how far its colour is from the open sky's. A sky
 * between two colours, as white and blue, is told exactly; of other colours, that things send back, what lies between these and the luminance. */
#ifndef STAFFAGE_GEN_SKY_UV_H
#define STAFFAGE_GEN_SKY_UV_H

#include "gen/light/light.h"
#include "gen/trace/shaded_ground.h"
#include "lib/vec.h"

/* Light = u most + (v - 0.5) tint, 0 <= u < 1, 0 <= v < 1. */
struct sky_scale { double most[3], tint[3]; };
struct sky_scale sky_scale(const struct shaded_ground *ground, const struct light *light);
struct vec2 sky_uv(const struct sky_scale *scale, const double irradiance[3]);

#endif

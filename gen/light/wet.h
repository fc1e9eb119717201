/* What wet ground mirrors: a film of water with the roughness of what it lies on.
 * Src: T. S. Trowbridge, K. P. Reitz 1975 (GGX); its visible normals after E. Heitz, Sampling the GGX Distribution of Visible
 * Normals, JCGT 7(4) 2018; Fresnel after C. Schlick 1994 */
#ifndef STAFFAGE_GEN_WET_H
#define STAFFAGE_GEN_WET_H

#include "lib/vec.h"

#include <stddef.h>

struct light;

struct wet {
    double reflection; /* mirror share at normal incidence; 0: dry */
    double roughness;  /* root of GGX's alpha; 0: a mirror */
};

/* Where what comes to an eye was mirrored from: the eye sees the sum of weight times radiance. */
#define WET_RAYS_MAX 64
struct wet_rays { struct vec3 direction[WET_RAYS_MAX]; double weight[WET_RAYS_MAX]; size_t n; };
/* In: normal, to_eye  unit, dot > 0; n  at most WET_RAYS_MAX; of a mirror there is one */
void wet_rays(struct wet_rays *rays, const struct wet *wet, struct vec3 normal, struct vec3 to_eye, size_t n);

/* Of the sky in the open. */
void wet_sky(double rgb[3], const struct wet *wet, const struct light *light, struct vec3 normal, struct vec3 to_eye, size_t n);

#endif

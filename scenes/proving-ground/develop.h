/* The camera of the proving ground: radiance through a pinhole becomes a photograph through a lens.
 * In order: air (after Koschmieder), the lens's distortion, its softness, vignetting; then the sensor's noise, sRGB, JPEG. */
#ifndef STAFFAGE_PROVING_DEVELOP_H
#define STAFFAGE_PROVING_DEVELOP_H

#include "cases.h"
#include "lib/image.h"
#include "pinhole.h"

/* Radiance (F32, 3 or 4 channels) and distance (U16, PROVING_RANGE_M) of the pinhole's pixels to the light that falls on
 * the sensor. Out: linear (F32 3, initialized here), values of 0 to 1 as the photograph has them but without noise */
bool develop_light(struct image *linear, const struct image *radiance, const struct image *range, const struct pinhole *pinhole,
                   const struct camera *camera, const struct proving_case *c, struct error *err);
/* With noise, 8-bit sRGB. A pixel's noise is drawn by its place and `key` alone and scaled by its brightness: two pictures
 * of one key differ in nothing but what the light does.
 * Out: photograph (U8 3, initialized here) */
bool develop_sensor(struct image *photograph, const struct image *linear, uint64_t key, struct error *err);

#endif

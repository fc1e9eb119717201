#include "gen/light/enclosed.h"

#include "lib/luminance.h"

#include <math.h>

enum { DIRECTIONS = 64, SIDES = 8 };
#define OFF_GROUND_M 0.5 /* a reconstruction's ground is rough */
#define FAR_M 1000

/* What upright sides of all directions shine with, in the mean. */
static void of_sides(double radiance[3], const struct light *light)
{
    for (int c = 0; c < 3; c++) radiance[c] = 0;
    for (int i = 0; i < SIDES; i++) {
        double side[3], azimuth = 2 * M_PI * i / SIDES;
        light_irradiance(side, light, vec3(cos(azimuth), sin(azimuth), 0));
        for (int c = 0; c < 3; c++) radiance[c] += ENCLOSING_ALBEDO * side[c] / SIDES;
    }
}

void enclosed_irradiance(double rgb[3], const struct light *light, const struct static_mesh *place, const struct vec3 *points_m, size_t n)
{
    struct sky_light sky[DIRECTIONS];
    double sides[3], level[3], lost[3] = { 0, 0, 0 };
    size_t stride = (n + ENCLOSED_POINTS - 1) / ENCLOSED_POINTS, points = 0;
    light_sample_sky(sky, DIRECTIONS, light);
    of_sides(sides, light);
    light_irradiance(level, light, vec3(0, 0, 1));
    for (size_t i = 0; i < n; i += stride, points++)
        for (size_t k = 0; k < DIRECTIONS; k++) {
            double of_sky[3];
            if (!static_mesh_blocks(place, points_m[i], sky[k].direction, OFF_GROUND_M, FAR_M)) continue;
            light_sky_radiance(of_sky, light, sky[k].direction);
            double part = luminance_of(sky[k].color) / fmax(luminance_of(of_sky), 1e-9); /* of the hemisphere */
            for (int c = 0; c < 3; c++) lost[c] += sky[k].direction.z * (sky[k].color[c] - part * sides[c]);
        }
    for (int c = 0; c < 3; c++) rgb[c] = level[c] - lost[c] / (double)points;
}

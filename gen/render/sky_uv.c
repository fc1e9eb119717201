#include "gen/render/sky_uv.h"

#include "gen/light/sky_image.h"

#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* How a light differs from the open sky's of its luminance. */
static void rest_of(double rest[3], const double irradiance[3], const double open[3])
{
    double luminance = luminance_of(irradiance);
    for (int c = 0; c < 3; c++) rest[c] = irradiance[c] - luminance * open[c];
}

/* In which colours parts of the sky differ most: the first principal axis, the same in every frame. */
static void tint_of(double axis[3], const struct light *light, const double open[3])
{
    enum { PARTS = 64 };
    struct sky_light part[PARTS];
    double spread[3][3] = { { 0 } }, next[3], rest[3];
    light_sample_sky(part, PARTS, light);
    for (int i = 0; i < PARTS; i++) {
        rest_of(rest, part[i].color, open);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) spread[a][b] += part[i].direction.z * part[i].direction.z * rest[a] * rest[b];
    }
    axis[0] = 1, axis[1] = axis[2] = -0.2126 / (1 - 0.2126); /* of a white sky from cyan to red, at no luminance: what it meets may have a colour */
    for (int k = 0; k < 30; k++) {
        for (int a = 0; a < 3; a++) next[a] = dot(spread[a], axis);
        double norm = sqrt(dot(next, next));
        if (!(norm > 1e-30)) return;
        for (int a = 0; a < 3; a++) axis[a] = next[a] / norm;
    }
}

struct sky_scale sky_scale(const struct shaded_ground *g, const struct light *light)
{
    struct sky_scale scale;
    double open[3], axis[3], most = 0, most_tint = 0;
    light_sky_irradiance(open, light, vec3(0, 0, 1));
    double luminance = luminance_of(open);
    for (int c = 0; c < 3; c++) open[c] = luminance > 0 ? open[c] / luminance : 1;
    tint_of(axis, light, open);
    for (size_t i = 0; i < 2 * g->vertices; i++) {
        const double *irradiance = i % 2 ? g->sky[i / 2].with : g->sky[i / 2].without;
        double rest[3];
        rest_of(rest, irradiance, open);
        most = fmax(most, luminance_of(irradiance));
        most_tint = fmax(most_tint, fabs(dot(rest, axis)) / dot(axis, axis));
    }
    /* Twice as much as there is: POV-Ray's gradient begins anew at 1. */
    for (int c = 0; c < 3; c++) {
        scale.most[c] = 2 * fmax(most, 1e-9) * open[c];
        scale.tint[c] = 4 * fmax(most_tint, 1e-9) * axis[c];
    }
    return scale;
}

struct vec2 sky_uv(const struct sky_scale *scale, const double irradiance[3])
{
    double open[3], rest[3], most = luminance_of(scale->most);
    for (int c = 0; c < 3; c++) open[c] = scale->most[c] / most;
    rest_of(rest, irradiance, open);
    return (struct vec2){ luminance_of(irradiance) / most, 0.5 + dot(rest, scale->tint) / dot(scale->tint, scale->tint) };
}

#include "gen/trace/sky_rays.h"

#include "gen/light/sky_image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FAR_M 1e5

bool sky_rays_init(struct sky_rays *rays, const struct light *light, size_t n, struct error *err)
{
    struct sky_light *sampled = calloc(n + 1, sizeof *sampled);
    *rays = (struct sky_rays){ calloc(n + 1, sizeof *rays->direction), calloc(n + 1, sizeof *rays->solid_angle),
                               calloc(n + 1, sizeof *rays->color), n };
    bool ok = sampled && rays->direction && rays->solid_angle && rays->color;
    if (ok) light_sample_sky(sampled, n, light);
    for (size_t i = 0; ok && i < n; i++) {
        rays->direction[i] = sampled[i].direction;
        rays->solid_angle[i] = sampled[i].solid_angle;
        memcpy(rays->color[i], sampled[i].color, sizeof rays->color[i]);
    }
    free(sampled);
    return ok || error_set(err, ERR_MEMORY, "no memory for the sky's directions");
}

void sky_rays_release(struct sky_rays *rays)
{
    free(rays->direction);
    free(rays->solid_angle);
    free(rays->color);
    *rays = (struct sky_rays){ 0 };
}

struct vec3 cosine_direction(size_t i, size_t n)
{
    double r = sqrt(((double)i + 0.5) / (double)n), turn = 2 * M_PI * fmod(((double)i + 0.5) * 0.61803398874989485, 1);
    return vec3(r * cos(turn), r * sin(turn), sqrt(1 - r * r));
}

void sky_ray_color(double color[3], const struct sky_rays *rays, size_t ray, const struct image *radiance)
{
    const float *rgb = sky_radiance(radiance, rays->direction[ray]);
    for (int c = 0; c < 3; c++) color[c] = rays->solid_angle[ray] * (double)rgb[c];
}

void sky_round_gain(double gain[3], const struct sky_rays *rays, const struct sky_round *round)
{
    double sky[3] = { 0, 0, 0 }, there[3] = { 0, 0, 0 }, color[3];
    gain[0] = gain[1] = gain[2] = 1;
    if (!round->radiance || round->place) return;
    for (size_t i = 0; i < rays->n; i++) {
        sky_ray_color(color, rays, i, round->radiance);
        for (int c = 0; c < 3; c++) {
            sky[c] += rays->direction[i].z * rays->color[i][c];
            there[c] += rays->direction[i].z * color[c];
        }
    }
    for (int c = 0; c < 3; c++) gain[c] = sky[c] / fmax(there[c], 1e-9);
}

void sky_rays_round(double (*color)[3], const struct sky_rays *rays, const struct sky_round *round, const struct receiver *receiver,
                    struct vec3 from)
{
    double gain[3];
    memcpy(color, rays->color, rays->n * sizeof *color);
    if (!round->radiance) return;
    sky_round_gain(gain, rays, round);
    for (size_t i = 0; i < rays->n; i++) {
        struct vec3 d = rays->direction[i];
        double level = fmax(hypot(d.x, d.y), 1e-9);
        double beyond = receiver_reach(receiver, from, (struct vec2){ d.x / level, d.y / level }) / level;
        if (round->place && !static_mesh_blocks(round->place, from, d, beyond, beyond + FAR_M)) continue;
        sky_ray_color(color[i], rays, i, round->radiance);
        for (int c = 0; c < 3; c++) color[i][c] *= gain[c];
    }
}

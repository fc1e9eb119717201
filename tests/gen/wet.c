/* Wet ground against a sum over the hemisphere of what Cook and Torrance write: F D G / (4 cos cos'), with GGX's D and Smith's G. */
#include "gen/light/wet.h"

#include "gen/light/light.h"
#include "tests/tap.h"

#include <math.h>

#define REFLECTION 0.05

static double fresnel(double cosine) { return REFLECTION + (1 - REFLECTION) * pow(1 - cosine, 5); }

static double lambda(double cosine, double alpha)
{
    double square = cosine * cosine;
    return (sqrt(1 + alpha * alpha * (1 - square) / square) - 1) / 2;
}

/* Brighter towards one side, as a street between houses is. */
static double sky_at(struct vec3 d) { return (1 + 2 * d.z) / 3 + 0.8 * d.x; }

/* What an eye sees of sky_at, and of a sky of 1. */
static void integrate(double *seen, double *share, struct vec3 v, double alpha)
{
    enum { STEPS = 1500 };
    *seen = *share = 0;
    for (int i = 0; i < STEPS; i++)
        for (int j = 0; j < STEPS; j++) {
            double z = (i + 0.5) / STEPS, turn = 2 * M_PI * (j + 0.5) / STEPS, across = sqrt(1 - z * z);
            struct vec3 l = vec3(across * cos(turn), across * sin(turn), z), h = vec3_unit(vec3_add(l, v));
            double spread = alpha * alpha, bell = h.z * h.z * (spread - 1) + 1;
            double d = spread / (M_PI * bell * bell), g = 1 / (1 + lambda(v.z, alpha) + lambda(l.z, alpha));
            double mirrored = fresnel(vec3_dot(v, h)) * d * g / (4 * v.z) * 2 * M_PI / STEPS / STEPS;
            *seen += mirrored * sky_at(l);
            *share += mirrored;
        }
}

static void check(double roughness, double deg)
{
    struct wet wet = { REFLECTION, roughness };
    struct wet_rays rays;
    double angle = deg * M_PI / 180, want, want_share, seen = 0, share = 0, above = 1;
    struct vec3 v = vec3(sin(angle), 0, cos(angle));
    integrate(&want, &want_share, v, roughness * roughness);
    wet_rays(&rays, &wet, vec3(0, 0, 1), v, WET_RAYS_MAX);
    for (size_t i = 0; i < rays.n; i++) {
        seen += rays.weight[i] * sky_at(rays.direction[i]);
        share += rays.weight[i];
        above = fmin(above, rays.direction[i].z);
        if (fabs(vec3_norm(rays.direction[i]) - 1) > 1e-9) OK(false, "ray %zu is not unit", i);
    }
    NEAR(share, want_share, 0.04 * want_share, "roughness %.1f, %.0f deg: as much is mirrored", roughness, deg);
    NEAR(seen, want, 0.04 * want_share, "and from there");
    OK(above > 0, "and nothing from below");
}

int main(void)
{
    static const double deg[] = { 5, 40, 65, 80 };
    struct wet_rays rays;
    for (size_t i = 0; i < sizeof deg / sizeof *deg; i++) {
        check(0.3, deg[i]);
        check(0.4, deg[i]);
        check(0.6, deg[i]);
    }
    struct vec3 v = vec3_unit(vec3(3, 4, 5)), normal = vec3_unit(vec3(0.1, -0.2, 1));
    wet_rays(&rays, &(struct wet){ REFLECTION, 0 }, normal, v, WET_RAYS_MAX);
    OK(rays.n == 1, "of a mirror there is one ray");
    NEAR(rays.weight[0], fresnel(vec3_dot(v, normal)), 1e-12, "of Fresnel's share");
    struct vec3 half = vec3_unit(vec3_add(v, rays.direction[0]));
    NEAR(vec3_dot(half, normal), 1, 1e-12, "mirrored at the normal");
    wet_rays(&rays, &(struct wet){ 0, 0.4 }, normal, v, WET_RAYS_MAX);
    OK(rays.n == 0, "dry ground mirrors nothing");
    wet_rays(&rays, &(struct wet){ REFLECTION, 0.4 }, normal, vec3_scale(v, -1), WET_RAYS_MAX);
    OK(rays.n == 0, "nor does what is seen from below");
    return tap_done();
}

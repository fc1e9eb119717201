#include "gen/light/wet.h"

#include "gen/light/light.h"

#include <math.h>

static double fresnel(const struct wet *wet, double cosine)
{
    return wet->reflection + (1 - wet->reflection) * pow(1 - fmin(fmax(cosine, 0), 1), 5);
}

/* Smith's, of the part of the surface that a direction cannot see. In: v  z along the normal */
static double lambda(struct vec3 v, double alpha)
{
    double tangent = hypot(v.x, v.y) / fmax(v.z, 1e-9);
    return (sqrt(1 + alpha * alpha * tangent * tangent) - 1) / 2;
}

/* A normal of the rough surface that v sees, by two numbers of 0 to 1. */
static struct vec3 visible_normal(struct vec3 v, double alpha, double a, double b)
{
    struct vec3 stretched = vec3_unit(vec3(alpha * v.x, alpha * v.y, v.z));
    double aside = hypot(stretched.x, stretched.y), r = sqrt(a), s = (1 + stretched.z) / 2;
    struct vec3 one = aside > 1e-9 ? vec3(-stretched.y / aside, stretched.x / aside, 0) : vec3(1, 0, 0), two = vec3_cross(stretched, one);
    double x = r * cos(2 * M_PI * b), y = (1 - s) * sqrt(fmax(0, 1 - x * x)) + s * r * sin(2 * M_PI * b);
    struct vec3 h = vec3_add(vec3_add(vec3_scale(one, x), vec3_scale(two, y)), vec3_scale(stretched, sqrt(fmax(0, 1 - x * x - y * y))));
    return vec3_unit(vec3(alpha * h.x, alpha * h.y, fmax(1e-9, h.z)));
}

static struct vec3 mirrored(struct vec3 v, struct vec3 normal)
{
    return vec3_sub(vec3_scale(normal, 2 * vec3_dot(v, normal)), v);
}

void wet_rays(struct wet_rays *rays, const struct wet *wet, struct vec3 normal, struct vec3 to_eye, size_t n)
{
    const double golden = 0.6180339887498949, alpha = wet->roughness * wet->roughness;
    double cosine = vec3_dot(to_eye, normal);
    rays->n = 0;
    if (wet->reflection <= 0 || cosine <= 0) return;
    if (wet->roughness <= 0) {
        rays->direction[rays->n] = mirrored(to_eye, normal);
        rays->weight[rays->n++] = fresnel(wet, cosine);
        return;
    }
    /* x towards the eye, so that neighbours' rays are alike. */
    struct vec3 level = vec3_sub(to_eye, vec3_scale(normal, cosine));
    struct vec3 x = vec3_norm(level) > 1e-9 ? vec3_unit(level) : vec3_unit(vec3_cross(normal, vec3(0.36, 0.48, 0.8))), y = vec3_cross(normal, x);
    struct vec3 v = vec3(vec3_dot(to_eye, x), vec3_dot(to_eye, y), cosine);
    for (size_t i = 0; i < n; i++) {
        double turn = golden * (double)i;
        struct vec3 h = visible_normal(v, alpha, ((double)i + 0.5) / (double)n, turn - floor(turn)), l = mirrored(v, h);
        if (l.z <= 0) continue;
        double seen = (1 + lambda(v, alpha)) / (1 + lambda(v, alpha) + lambda(l, alpha));
        rays->direction[rays->n] = vec3_add(vec3_add(vec3_scale(x, l.x), vec3_scale(y, l.y)), vec3_scale(normal, l.z));
        rays->weight[rays->n++] = fresnel(wet, vec3_dot(v, h)) * seen / (double)n;
    }
}

void wet_sky(double rgb[3], const struct wet *wet, const struct light *light, struct vec3 normal, struct vec3 to_eye, size_t n)
{
    struct wet_rays rays;
    wet_rays(&rays, wet, normal, to_eye, n);
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (size_t i = 0; i < rays.n; i++) {
        double sky[3];
        light_sky_radiance(sky, light, rays.direction[i]);
        for (int c = 0; c < 3; c++) rgb[c] += rays.weight[i] * sky[c];
    }
}

#include "gen/light/sky_form.h"

#include <math.h>

static double cos_between(struct vec3 a, struct vec3 b)
{
    return fmin(1, fmax(-1, vec3_dot(a, b)));
}

/* --- clear --- */

static double perez(const struct perez *p, double cos_zenith, double cos_sun)
{
    return (1 + p->a * exp(p->b / fmax(cos_zenith, 0.01))) * (1 + p->c * exp(p->d * acos(cos_sun)) + p->e * cos_sun * cos_sun);
}

/* In units of the zenith. */
static double perez_ratio(const struct perez *p, struct vec3 sun, struct vec3 direction)
{
    return perez(p, direction.z, cos_between(direction, sun)) / perez(p, 1, fmin(1, sun.z));
}

struct clear_form clear_form(struct vec3 sun, double turbidity)
{
    double t = fmin(CLEAR_TURBIDITY_MAX, fmax(CLEAR_TURBIDITY_MIN, turbidity));
    double s = acos(fmin(1, sun.z)), s2 = s * s, s3 = s2 * s;
    return (struct clear_form){
        .sun = sun,
        .luminance = { 0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                       -0.0670 * t + 0.3703 },
        .x = { -0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
               -0.0033 * t + 0.0452 },
        .y = { -0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
               -0.0109 * t + 0.0529 },
        .zenith_x = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                    t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                    (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886),
        .zenith_y = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
                    t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                    (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688),
    };
}

double clear_form_luminance(const struct clear_form *form, struct vec3 direction)
{
    return perez_ratio(&form->luminance, form->sun, direction);
}

void clear_form_color(double rgb[3], const struct clear_form *form, struct vec3 direction)
{
    double x = form->zenith_x * perez_ratio(&form->x, form->sun, direction);
    double y = form->zenith_y * perez_ratio(&form->y, form->sun, direction);
    double xyz[3] = { x / y, 1, (1 - x - y) / y };
    rgb[0] = fmax(0, 3.2404542 * xyz[0] - 1.5371385 * xyz[1] - 0.4985314 * xyz[2]);
    rgb[1] = fmax(0, -0.9692660 * xyz[0] + 1.8760108 * xyz[1] + 0.0415560 * xyz[2]);
    rgb[2] = fmax(0, 0.0556434 * xyz[0] - 0.2040259 * xyz[1] + 1.0572252 * xyz[2]);
}

/* --- standard skies --- */

static const struct cie_sky skies[CIE_SKY_TYPES] = {
    { 4, -0.7, 0, -1, 0, .diffuse = 0.10 },
    { 4, -0.7, 2, -1.5, 0.15, true, .diffuse = 0.18 },
    { 1.1, -0.8, 0, -1, 0, .diffuse = 0.15 },
    { 1.1, -0.8, 2, -1.5, 0.15, true, .diffuse = 0.22 },
    { 0, -1, 0, -1, 0, .diffuse = 0.20 },
    { 0, -1, 2, -1.5, 0.15, true, .diffuse = 0.38 },
    { 0, -1, 5, -2.5, 0.3, true, true, true, 12, 0.42 },
    { 0, -1, 10, -3, 0.45, true, true, true, 10, 0.41 },
    { -1, -0.55, 2, -1.5, 0.15, true, true, true, 12, 0.40 },
    { -1, -0.55, 5, -2.5, 0.3, true, true, true, 10, 0.36 },
    { -1, -0.55, 10, -3, 0.45, true, true, false, 4, 0.23 },
    { -1, -0.32, 10, -3, 0.45, true, true, false, 2.5, 0.10 },
    { -1, -0.32, 16, -3, 0.3, true, true, false, 4.5, 0.28 },
    { -1, -0.15, 16, -3, 0.3, true, true, false, 5, 0.28 },
    { -1, -0.15, 24, -2.8, 0.15, true, true, false, 4, 0.30 },
};

const struct cie_sky *cie_sky(int type)
{
    return &skies[type - 1];
}

static double gradation(const struct cie_sky *s, double cos_zenith)
{
    return 1 + s->a * (cos_zenith > 0 ? exp(s->b / cos_zenith) : 0);
}

static double indicatrix(const struct cie_sky *s, double cos_sun)
{
    return 1 + s->c * (exp(s->d * acos(cos_sun)) - exp(s->d * M_PI / 2)) + s->e * cos_sun * cos_sun;
}

double cie_sky_luminance(const struct cie_sky *sky, struct vec3 sun, struct vec3 direction)
{
    double around = sky->turns ? indicatrix(sky, cos_between(direction, sun)) / indicatrix(sky, fmin(1, sun.z)) : 1;
    return gradation(sky, direction.z) / gradation(sky, 1) * around;
}

double overcast_luminance(struct vec3 direction)
{
    return (1 + 2 * direction.z) / 3;
}

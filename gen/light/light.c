#include "gen/light/light.h"

#include <stdlib.h>

enum { SKY_WIDTH = 256, SKY_HEIGHT = 128 };

static double luminance(const double c[3])
{
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

static void rgb_from_xyz(double rgb[3], const double xyz[3])
{
    rgb[0] = fmax(0, 3.2404542 * xyz[0] - 1.5371385 * xyz[1] - 0.4985314 * xyz[2]);
    rgb[1] = fmax(0, -0.9692660 * xyz[0] + 1.8760108 * xyz[1] + 0.0415560 * xyz[2]);
    rgb[2] = fmax(0, 0.0556434 * xyz[0] - 0.2040259 * xyz[1] + 1.0572252 * xyz[2]);
}

/* --- clear sky: Preetham et al. 1999, appendix A --- */

struct perez { double a, b, c, d, e; };

static double perez(const struct perez *p, double cos_zenith, double angle, double cos_angle)
{
    return (1 + p->a * exp(p->b / cos_zenith)) * (1 + p->c * exp(p->d * angle) + p->e * cos_angle * cos_angle);
}

struct clear_sky {
    struct vec3 sun;
    double sun_zenith;
    struct perez luminance, x, y;
    double zenith_luminance, zenith_x, zenith_y; /* cd/m2 */
};

static void clear_sky_create(struct clear_sky *sky, struct vec3 sun, double turbidity)
{
    double t = turbidity, s = acos(fmin(1, sun.z)), s2 = s * s, s3 = s2 * s;
    double chi = (4.0 / 9 - t / 120) * (M_PI - 2 * s);
    *sky = (struct clear_sky){
        .sun = sun,
        .sun_zenith = s,
        .luminance = { 0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                       -0.0670 * t + 0.3703 },
        .x = { -0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
               -0.0033 * t + 0.0452 },
        .y = { -0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
               -0.0109 * t + 0.0529 },
        .zenith_luminance = 1000 * ((4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192),
        .zenith_x = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                    t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                    (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886),
        .zenith_y = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
                    t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                    (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688),
    };
}

static void clear_sky_radiance(double rgb[3], const struct clear_sky *sky, struct vec3 d)
{
    double cos_zenith = fmax(d.z, 0.01), cos_angle = fmin(1, fmax(-1, vec3_dot(d, sky->sun)));
    double angle = acos(cos_angle), s = sky->sun_zenith, cos_s = cos(s);
    double luma = sky->zenith_luminance * perez(&sky->luminance, cos_zenith, angle, cos_angle) /
                  perez(&sky->luminance, 1, s, cos_s);
    double x = sky->zenith_x * perez(&sky->x, cos_zenith, angle, cos_angle) / perez(&sky->x, 1, s, cos_s);
    double y = sky->zenith_y * perez(&sky->y, cos_zenith, angle, cos_angle) / perez(&sky->y, 1, s, cos_s);
    double xyz[3] = { luma * x / y, luma, luma * (1 - x - y) / y };
    rgb_from_xyz(rgb, xyz);
}

/* Normal irradiance / pi of the sun's disc below the atmosphere, lx/sr as the sky's cd/m2. */
static void sun_irradiance(double rgb[3], double zenith, double turbidity)
{
    /* One wavelength stands for each primary. Ozone: absorption of 0.35 cm at that wavelength. */
    static const double wavelength_um[3] = { 0.610, 0.550, 0.465 }, ozone[3] = { 0.120, 0.085, 0.0075 };
    static const double extraterrestrial[3] = { 1.09, 0.98, 0.94 }; /* a 5900 K black body, luminance 1 */
    const double illuminance_lx = 133800, ozone_cm = 0.35;
    double zenith_deg = zenith * 180 / M_PI;
    double air_mass = 1 / (cos(zenith) + 0.15 * pow(93.885 - zenith_deg, -1.253));
    double aerosol = 0.04608 * turbidity - 0.04586;
    for (int c = 0; c < 3; c++) {
        double rayleigh = 0.008735 * pow(wavelength_um[c], -4.08);
        double mie = aerosol * pow(wavelength_um[c], -1.3);
        rgb[c] = extraterrestrial[c] * illuminance_lx / M_PI *
                 exp(-air_mass * (rayleigh + mie + ozone[c] * ozone_cm));
    }
}

/* --- the map --- */

static struct vec3 sky_direction(int column, int row)
{
    double elevation = M_PI / 2 - (row + 0.5) / SKY_HEIGHT * M_PI, turn = (column + 0.5) / SKY_WIDTH * 2 * M_PI;
    return vec3(cos(elevation) * cos(turn), cos(elevation) * sin(turn), sin(elevation));
}

/* Cosine-weighted solid angle / pi of a pixel for a level surface: over the upper half it sums to 1. */
static double level_weight(int row)
{
    double top = M_PI / 2 - (double)row / SKY_HEIGHT * M_PI, bottom = top - M_PI / SKY_HEIGHT;
    return (sin(top) * sin(top) - sin(bottom) * sin(bottom)) / SKY_WIDTH;
}

void light_sky_radiance(double color[3], const struct light *light, struct vec3 d)
{
    double turn = atan2(d.y, d.x) / (2 * M_PI);
    int column = (int)((turn - floor(turn)) * SKY_WIDTH) % SKY_WIDTH;
    int row = (int)((0.5 - asin(fmin(1, fmax(-1, d.z))) / M_PI) * SKY_HEIGHT);
    const float *pixel = image_f32(&light->sky, column, row < SKY_HEIGHT ? row : SKY_HEIGHT - 1);
    for (int c = 0; c < 3; c++) color[c] = (double)pixel[c];
}

static void sky_irradiance(double rgb[3], const struct image *sky)
{
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int row = 0; row < SKY_HEIGHT / 2; row++)
        for (int column = 0; column < SKY_WIDTH; column++)
            for (int c = 0; c < 3; c++) rgb[c] += level_weight(row) * (double)image_f32(sky, column, row)[c];
}

/* Directions of a pixel, summed over its solid angle, / pi: exact, so that a surface above whose plane
 * the pixel lies wholly gets exactly its light. */
static struct vec3 pixel_share(int column, int row)
{
    double top = M_PI / 2 - (double)row / SKY_HEIGHT * M_PI, bottom = top - M_PI / SKY_HEIGHT;
    double from = (double)column / SKY_WIDTH * 2 * M_PI, to = from + 2 * M_PI / SKY_WIDTH;
    double level = ((top - bottom) / 2 + (sin(2 * top) - sin(2 * bottom)) / 4) / M_PI;
    return vec3(level * (sin(to) - sin(from)), level * (cos(from) - cos(to)), level_weight(row));
}

void light_sky_irradiance(double rgb[3], const struct light *light, struct vec3 normal)
{
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int row = 0; row < SKY_HEIGHT; row++)
        for (int column = 0; column < SKY_WIDTH; column++) {
            double share = fmax(0, vec3_dot(pixel_share(column, row), normal));
            for (int c = 0; c < 3; c++) rgb[c] += share * (double)image_f32(&light->sky, column, row)[c];
        }
}

void light_irradiance(double rgb[3], const struct light *light, struct vec3 normal)
{
    light_sky_irradiance(rgb, light, normal);
    double cosine = light->has_sun ? fmax(0, vec3_dot(light->sun_direction, normal)) : 0;
    for (int c = 0; c < 3; c++) rgb[c] += cosine * light->sun_color[c];
}

static bool sun_of_scene(struct vec3 *direction, const struct scene *scene, struct error *err)
{
    double azimuth = scene->sun_azimuth_rad, elevation = scene->sun_elevation_rad;
    if (scene->sun == SUN_BY_TIME) {
        struct sun_position sun;
        /* UT1 - UTC stays below 0.9 s, 0.004 deg of the sun's way; refraction as at sea level,
         * for the shadow follows the light that arrives. */
        struct atmosphere air = { 1013.25 * exp(-scene->place.height_m / 8434.0), 15 };
        if (!sun_position(&sun, scene->time_utc, 0, scene->place, air, err)) return false;
        azimuth = sun.azimuth_rad;
        elevation = sun.elevation_rad;
    }
    if (elevation <= 0)
        return error_at(err, ERR_INPUT, scene->path, scene->sun_source.line, scene->sun_source.column,
                        "the sun stands %.1f deg below the horizon (azimuth %.1f deg): a clear sky needs a time "
                        "of day, or use `sky: overcast`", -elevation * 180 / M_PI, azimuth * 180 / M_PI);
    double turn = azimuth - scene->north_rad;
    *direction = vec3(cos(elevation) * sin(turn), cos(elevation) * cos(turn), sin(elevation));
    return true;
}

/* Row by row over the upper half of the map. */
static void fill_clear(struct image *sky, struct vec3 sun, double turbidity)
{
    struct clear_sky clear;
    clear_sky_create(&clear, sun, turbidity);
    for (int row = 0; row < SKY_HEIGHT / 2; row++)
        for (int column = 0; column < SKY_WIDTH; column++) {
            double rgb[3];
            clear_sky_radiance(rgb, &clear, sky_direction(column, row));
            for (int c = 0; c < 3; c++) image_f32(sky, column, row)[c] = (float)rgb[c];
        }
}

static void fill_overcast(struct image *sky)
{
    for (int row = 0; row < SKY_HEIGHT / 2; row++)
        for (int column = 0; column < SKY_WIDTH; column++)
            for (int c = 0; c < 3; c++)
                image_f32(sky, column, row)[c] = (float)(1 + 2 * sky_direction(column, row).z);
}

static void scale_sky(struct image *sky, double factor)
{
    size_t values = (size_t)SKY_WIDTH * (SKY_HEIGHT / 2) * 3;
    for (size_t i = 0; i < values; i++) ((float *)sky->data)[i] *= (float)factor;
}

/* The clear sky's level illuminance / pi. Preetham's zenith is twice too bright beside its own
 * sun; form and colour are taken from there, and the amount at a turbidity of 3 from the daylight
 * that was measured (IES RP-21: 0.8 + 15.5 sqrt(sin h) klx under a clear sky). */
static double measured_clear_sky(double sin_elevation)
{
    return (800 + 15500 * sqrt(sin_elevation)) / M_PI;
}

bool light_create(struct light *light, const struct scene *scene, struct error *err)
{
    struct light made = { .has_sun = scene->sun != SUN_NONE };
    if (made.has_sun && !sun_of_scene(&made.sun_direction, scene, err)) return false;
    if (!image_init(&made.sky, SKY_WIDTH, SKY_HEIGHT, 3, PIXEL_F32, err)) return false;

    if (scene->sky == SKY_CLEAR) {
        double at_turbidity_3[3];
        fill_clear(&made.sky, made.sun_direction, 3);
        sky_irradiance(at_turbidity_3, &made.sky);
        fill_clear(&made.sky, made.sun_direction, scene->turbidity);
        scale_sky(&made.sky, measured_clear_sky(made.sun_direction.z) / luminance(at_turbidity_3));
        sun_irradiance(made.sun_color, acos(made.sun_direction.z), scene->turbidity);
        for (int c = 0; c < 3; c++) made.sun_color[c] *= scene->sun_scale;
    } else
        fill_overcast(&made.sky);
    sky_irradiance(made.irradiance, &made.sky);
    for (int c = 0; c < 3; c++) made.irradiance[c] += made.sun_color[c] * made.sun_direction.z;

    double scale = 1 / luminance(made.irradiance);
    for (int c = 0; c < 3; c++) {
        made.irradiance[c] *= scale;
        made.sun_color[c] *= scale;
    }
    scale_sky(&made.sky, scale);
    for (int row = SKY_HEIGHT / 2; row < SKY_HEIGHT; row++)
        for (int column = 0; column < SKY_WIDTH; column++)
            for (int c = 0; c < 3; c++)
                image_f32(&made.sky, column, row)[c] = (float)(scene->ground_albedo[c] * made.irradiance[c]);
    *light = made;
    return true;
}

void light_release(struct light *light)
{
    image_release(&light->sky);
}

void light_sample_sky(struct sky_light *lights, size_t n, const struct light *light)
{
    double rows[SKY_HEIGHT / 2 + 1] = { 0 }, want[3], got[3] = { 0 };
    for (int row = 0; row < SKY_HEIGHT / 2; row++) {
        double sum = 0;
        for (int column = 0; column < SKY_WIDTH; column++) {
            const float *p = image_f32(&light->sky, column, row);
            sum += luminance((double[3]){ (double)p[0], (double)p[1], (double)p[2] });
        }
        rows[row + 1] = rows[row] + sum * level_weight(row);
    }
    double total = rows[SKY_HEIGHT / 2];
    for (size_t i = 0; i < n; i++) {
        /* Strata by elevation; around the horizon by the golden ratio, which fills evenly. */
        double u = ((double)i + 0.5) / (double)n * total, v = fmod(((double)i + 0.5) * 0.61803398874989485, 1);
        int row = 0, column = 0;
        while (row < SKY_HEIGHT / 2 - 1 && rows[row + 1] < u) row++;
        double in_row = (u - rows[row]) / (rows[row + 1] - rows[row]);
        double sum = v * (rows[row + 1] - rows[row]) / level_weight(row), step = 0;
        for (;; column++) {
            const float *p = image_f32(&light->sky, column, row);
            step = luminance((double[3]){ (double)p[0], (double)p[1], (double)p[2] });
            if (sum < step || column == SKY_WIDTH - 1) break;
            sum -= step;
        }
        double elevation = M_PI / 2 - (row + in_row) / SKY_HEIGHT * M_PI;
        double turn = (column + fmin(1, sum / step)) / SKY_WIDTH * 2 * M_PI;
        lights[i].direction = vec3(cos(elevation) * cos(turn), cos(elevation) * sin(turn), sin(elevation));
        const float *p = image_f32(&light->sky, column, row);
        for (int c = 0; c < 3; c++) {
            lights[i].color[c] = (double)p[c] / step * total / ((double)n * lights[i].direction.z);
            got[c] += lights[i].color[c] * lights[i].direction.z;
        }
    }
    sky_irradiance(want, &light->sky);
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) lights[i].color[c] *= want[c] / got[c];
}

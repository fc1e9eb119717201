#include "gen/light/light.h"

#include "gen/light/daylight.h"
#include "gen/light/measured_sky.h"
#include "gen/light/sky_form.h"
#include "gen/light/sky_image.h"
#include "gen/light/skyline.h"

#include <stdlib.h>
#include <string.h>

/* Of a sky that a formula gives; a measured one has its own, up to SKY_HEIGHT_MAX. */
enum { SKY_WIDTH = 256, SKY_HEIGHT = 128, SKY_HEIGHT_MAX = 512 };

void light_sky_radiance(double color[3], const struct light *light, struct vec3 d)
{
    const float *pixel = sky_radiance(&light->sky, d);
    for (int c = 0; c < 3; c++) color[c] = (double)pixel[c];
}

static void level_irradiance(double rgb[3], const struct image *sky)
{
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int row = 0; row < sky->height_px / 2; row++)
        for (int column = 0; column < sky->width_px; column++)
            for (int c = 0; c < 3; c++) rgb[c] += sky_level_weight(sky, row) * (double)image_f32(sky, column, row)[c];
}

/* Directions of a pixel, summed over its solid angle, / pi: exact, so that a surface above whose plane
 * the pixel lies wholly gets exactly its light. Level, they are a row's share of a column's. */
void light_sky_irradiance(double rgb[3], const struct light *light, struct vec3 normal)
{
    const struct image *sky = &light->sky;
    double towards[2 * SKY_HEIGHT_MAX];
    for (int column = 0; column < sky->width_px; column++) {
        double from = (double)column / sky->width_px * 2 * M_PI, to = from + 2 * M_PI / sky->width_px;
        towards[column] = (sin(to) - sin(from)) * normal.x + (cos(from) - cos(to)) * normal.y;
    }
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int row = 0; row < sky->height_px; row++) {
        double top = sky_row_top(sky, row), bottom = sky_row_top(sky, row + 1);
        double level = ((top - bottom) / 2 + (sin(2 * top) - sin(2 * bottom)) / 4) / M_PI, up = sky_level_weight(sky, row) * normal.z;
        for (int column = 0; column < sky->width_px; column++) {
            double share = fmax(0, level * towards[column] + up);
            for (int c = 0; c < 3; c++) rgb[c] += share * (double)image_f32(sky, column, row)[c];
        }
    }
}

void light_irradiance(double rgb[3], const struct light *light, struct vec3 normal)
{
    light_sky_irradiance(rgb, light, normal);
    double cosine = light->has_sun ? fmax(0, vec3_dot(light->sun_direction, normal)) : 0;
    for (int c = 0; c < 3; c++) rgb[c] += cosine * light->sun_color[c];
}

bool light_sun_direction(struct vec3 *direction, const struct scene *scene, struct error *err)
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
                        "the sun stands %.1f deg below the horizon (azimuth %.1f deg): this sky needs a time "
                        "of day, or use `sky: overcast`", -elevation * 180 / M_PI, azimuth * 180 / M_PI);
    double turn = azimuth - scene->north_rad;
    *direction = vec3(cos(elevation) * sin(turn), cos(elevation) * cos(turn), sin(elevation));
    return true;
}

static struct daylight daylight_of(const struct light *light, const struct scene *scene, double turbidity)
{
    struct atmosphere_light air = { turbidity, scene->has_place ? exp(-scene->place.height_m / 8434.0) : 1 };
    struct daylight daylight;
    daylight_of_clear_sky(&daylight, asin(fmin(1, light->sun_direction.z)), air);
    return daylight;
}

/* Each channel of the upper half by a factor, so that it gives a level surface what is wanted. */
static void scale_sky(struct image *sky, const double wanted_lx[3])
{
    double is[3];
    level_irradiance(is, sky);
    for (int row = 0; row < sky->height_px / 2; row++)
        for (int column = 0; column < sky->width_px; column++)
            for (int c = 0; c < 3; c++) image_f32(sky, column, row)[c] *= (float)(wanted_lx[c] / M_PI / is[c]);
}

/* Between broken clouds the air is clear; they take their part of the sun from all of its colours alike, and with
 * the blue between them they are as white as this haze. */
#define CLOUDED_TURBIDITY 6

static void take_amount(double rgb[3], double luminance)
{
    double is = luminance_of(rgb);
    for (int c = 0; c < 3; c++) rgb[c] *= luminance / is;
}

/* The form and the places of the colours by Preetham, the amount and the colour in all by the atmosphere that
 * lets the sun through. In: cie: the brightness of a standard sky in place of his, or NULL */
static void fill_sunny(struct light *light, const struct scene *scene, const struct cie_sky *cie)
{
    double turbidity = cie ? cie->turbidity : scene->turbidity;
    struct daylight daylight = daylight_of(light, scene, turbidity);
    if (cie && cie->clouded) {
        double sun = luminance_of(daylight.sun);
        daylight = daylight_of(light, scene, CLOUDED_TURBIDITY);
        memcpy(daylight.sun, daylight_of(light, scene, CLEAR_TURBIDITY_MIN).sun, sizeof daylight.sun);
        take_amount(daylight.sun, sun);
    }
    if (cie) take_amount(daylight.sky, cie->diffuse * daylight_extraterrestrial_lx() * light->sun_direction.z);
    struct clear_form form = clear_form(light->sun_direction, cie && cie->clouded ? CLOUDED_TURBIDITY : turbidity);
    for (int row = 0; row < light->open_sky.height_px / 2; row++)
        for (int column = 0; column < light->open_sky.width_px; column++) {
            struct vec3 d = sky_direction(&light->open_sky, column, row);
            double rgb[3], luminance = cie ? cie_sky_luminance(cie, form.sun, d) : clear_form_luminance(&form, d);
            clear_form_color(rgb, &form, d);
            for (int c = 0; c < 3; c++) image_f32(&light->open_sky, column, row)[c] = (float)(luminance * rgb[c]);
        }
    scale_sky(&light->open_sky, daylight.sky);
    for (int c = 0; c < 3; c++) light->sun_color[c] = daylight.sun[c] / M_PI;
}

/* Clouds are white. In: cie: or NULL for the traditional overcast sky */
static void fill_clouds(struct light *light, const struct cie_sky *cie)
{
    for (int row = 0; row < light->open_sky.height_px / 2; row++)
        for (int column = 0; column < light->open_sky.width_px; column++) {
            struct vec3 d = sky_direction(&light->open_sky, column, row);
            double luminance = cie ? cie_sky_luminance(cie, light->sun_direction, d) : overcast_luminance(d);
            for (int c = 0; c < 3; c++) image_f32(&light->open_sky, column, row)[c] = (float)luminance;
        }
}

static bool fill_measured(struct light *light, const struct scene *scene, struct error *err)
{
    struct measured_sky measured;
    if (!measured_sky_read(&measured, scene, light->sun_direction, err)) return false;
    light->open_sky = measured.sky;
    light->has_sun = measured.has_sun;
    light->sun_direction = measured.sun_direction;
    for (int c = 0; c < 3; c++) light->sun_color[c] = measured.sun_color[c];
    return true;
}

static bool fill(struct light *light, const struct scene *scene, struct error *err)
{
    if (scene->sky == SKY_MAP) return fill_measured(light, scene, err);
    const struct cie_sky *cie = scene->sky == SKY_CIE ? cie_sky(scene->cie_type) : NULL;
    if (!image_init(&light->open_sky, SKY_WIDTH, SKY_HEIGHT, 3, PIXEL_F32, err)) return false;
    light->has_sun = scene->sky == SKY_CLEAR || (cie && cie->shows_sun);
    if (light->has_sun) fill_sunny(light, scene, cie);
    else fill_clouds(light, cie);
    return true;
}

static void in_the_open(double rgb[3], const struct light *light)
{
    level_irradiance(rgb, &light->open_sky);
    for (int c = 0; c < 3; c++) rgb[c] += light->has_sun ? light->sun_color[c] * light->sun_direction.z : 0;
}

/* On the ground, with what stands around, in the sun or without one. */
static void on_the_ground(double rgb[3], const struct light *light, const struct scene *scene, bool sun)
{
    struct light lit = *light;
    lit.has_sun = sun;
    skyline_raise(&lit, &scene->skyline, scene->ground_albedo);
    memcpy(rgb, lit.irradiance, sizeof lit.irradiance);
}

/* The light in the open stays as it is. On the ground so much is not the sun's own: the sky's, and what stands around gives. */
static bool share_out(struct light *light, const struct scene *scene, struct error *err)
{
    double open[3], sky_open[3], by_sky[3], by_both[3];
    in_the_open(open, light);
    level_irradiance(sky_open, &light->open_sky);
    on_the_ground(by_sky, light, scene, false);
    on_the_ground(by_both, light, scene, true);
    for (int c = 0; c < 3; c++) {
        double share = scene->sky_share[c], direct = light->sun_color[c] * light->sun_direction.z, sent_back = by_both[c] - by_sky[c] - direct;
        /* share = (sky by_sky + sun sent_back) / (sky by_sky + sun sent_back + sun direct) */
        double sky_of_sun = (share / (1 - share) * direct - sent_back) / by_sky[c];
        if (!(sky_of_sun > 0))
            return error_at(err, ERR_INPUT, scene->path, scene->skyline.source.line, scene->skyline.source.column,
                            "surroundings: what stands around sends more light back than the shade has: lower skyline_deg or albedo");
        double sun = open[c] / (sky_of_sun * sky_open[c] + direct);
        light->sun_color[c] *= sun;
        sky_open[c] *= sun * sky_of_sun * M_PI;
    }
    scale_sky(&light->open_sky, sky_open);
    return true;
}

bool light_create(struct light *light, const struct scene *scene, struct error *err)
{
    struct light made = { 0 };
    bool directed = scene->sun == SUN_BY_TIME || scene->sun == SUN_GIVEN;
    if (directed && !light_sun_direction(&made.sun_direction, scene, err)) return false;
    bool ok = fill(&made, scene, err) &&
              image_init(&made.sky, made.open_sky.width_px, made.open_sky.height_px, 3, PIXEL_F32, err);
    if (ok && made.has_sun && scene->has_sky_share) ok = share_out(&made, scene, err);
    else for (int c = 0; c < 3; c++) made.sun_color[c] *= scene->sun_scale;
    if (!ok) {
        light_release(&made);
        return false;
    }
    double open[3];
    in_the_open(open, &made);
    double scale = 1 / luminance_of(open);
    for (int c = 0; c < 3; c++) made.sun_color[c] *= scale;
    for (int row = 0; row < made.sky.height_px / 2; row++)
        for (int column = 0; column < made.sky.width_px; column++)
            for (int c = 0; c < 3; c++) image_f32(&made.open_sky, column, row)[c] *= (float)scale;
    skyline_raise(&made, &scene->skyline, scene->ground_albedo);
    *light = made;
    return true;
}

void light_release(struct light *light)
{
    image_release(&light->sky);
    image_release(&light->open_sky);
}

void light_sample_sky(struct sky_light *lights, size_t n, const struct light *light)
{
    const struct image *sky = &light->sky;
    const int width = sky->width_px, height = sky->height_px;
    double rows[SKY_HEIGHT_MAX / 2 + 1] = { 0 }, want[3], got[3] = { 0 };
    for (int row = 0; row < height / 2; row++) {
        double sum = 0;
        for (int column = 0; column < width; column++) sum += sky_pixel_luminance(sky, column, row);
        rows[row + 1] = rows[row] + sum * sky_level_weight(sky, row);
    }
    double total = rows[height / 2];
    for (size_t i = 0; i < n; i++) {
        /* Strata by elevation; around the horizon by the golden ratio, which fills evenly. */
        double u = ((double)i + 0.5) / (double)n * total, v = fmod(((double)i + 0.5) * 0.61803398874989485, 1);
        int row = 0, column = 0;
        while (row < height / 2 - 1 && rows[row + 1] < u) row++;
        double in_row = (u - rows[row]) / (rows[row + 1] - rows[row]);
        double sum = v * (rows[row + 1] - rows[row]) / sky_level_weight(sky, row), step = 0;
        for (;; column++) {
            step = sky_pixel_luminance(sky, column, row);
            if (sum < step || column == width - 1) break;
            sum -= step;
        }
        double elevation = M_PI / 2 - (row + in_row) / height * M_PI;
        double turn = (column + fmin(1, sum / step)) / width * 2 * M_PI;
        lights[i].direction = vec3(cos(elevation) * cos(turn), cos(elevation) * sin(turn), sin(elevation));
        const float *p = image_f32(sky, column, row);
        for (int c = 0; c < 3; c++) {
            lights[i].color[c] = (double)p[c] / step * total / ((double)n * lights[i].direction.z);
            got[c] += lights[i].color[c] * lights[i].direction.z;
        }
        lights[i].solid_angle = total / ((double)n * lights[i].direction.z * step);
    }
    level_irradiance(want, sky);
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) lights[i].color[c] *= want[c] / got[c];
}

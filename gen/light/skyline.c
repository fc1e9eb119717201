#include "gen/light/skyline.h"

#include "gen/light/sky_image.h"
#include "lib/file.h"

#include <math.h>
#include <string.h>

enum { SIDES = 32, BOUNCES = 4 }; /* SIDES: azimuths at which what stands around is lit, evenly between */

double skyline_elevation(const struct scene_skyline *skyline, double azimuth_rad)
{
    size_t n = skyline->count, next = 0;
    if (!n) return 0;
    double at = fmod(fmod(azimuth_rad, 2 * M_PI) + 2 * M_PI, 2 * M_PI);
    while (next < n && skyline->point_rad[next][0] <= at) next++;
    const double *from = skyline->point_rad[(next + n - 1) % n], *to = skyline->point_rad[next % n];
    double span = to[0] - from[0], way = at - from[0];
    if (span <= 0) span += 2 * M_PI;
    if (way < 0) way += 2 * M_PI;
    return from[1] + way / span * (to[1] - from[1]);
}

/* How much of a pixel's light on level ground is hidden. */
static double hidden_share(const struct image *sky, int row, double skyline_rad)
{
    double top = sin(sky_row_top(sky, row)), bottom = sin(sky_row_top(sky, row + 1)), line = sin(skyline_rad);
    return fmin(1, fmax(0, (line * line - bottom * bottom) / (top * top - bottom * bottom)));
}

static void put_ground(struct light *light, const double albedo[3])
{
    struct image *sky = &light->sky;
    for (int row = sky->height_px / 2; row < sky->height_px; row++)
        for (int column = 0; column < sky->width_px; column++)
            for (int c = 0; c < 3; c++) image_f32(sky, column, row)[c] = (float)(albedo[c] * light->irradiance[c]);
}

/* In: side (SIDES) radiance of what stands at the azimuths from +x towards +y */
static void put_sides(struct light *light, const struct scene_skyline *skyline, double side[SIDES][3])
{
    struct image *sky = &light->sky;
    for (int column = 0; column < sky->width_px; column++) {
        double at = (column + 0.5) / sky->width_px * SIDES, radiance[3];
        int i = (int)at;
        for (int c = 0; c < 3; c++) radiance[c] = side[i][c] + (at - i) * (side[(i + 1) % SIDES][c] - side[i][c]);
        double line = skyline_elevation(skyline, M_PI / 2 - (column + 0.5) / sky->width_px * 2 * M_PI);
        for (int row = 0; row < sky->height_px / 2; row++) {
            double hidden = hidden_share(sky, row, line);
            const float *open = image_f32(&light->open_sky, column, row);
            for (int c = 0; c < 3; c++) image_f32(sky, column, row)[c] = (float)((1 - hidden) * (double)open[c] + hidden * radiance[c]);
        }
    }
}

/* How much of a side the sun reaches past what stands across, as far from the middle as the side itself: its shade is as
 * high as it is, less what the sun comes down on the way. */
static double sunlit_share(const struct light *light, const struct scene_skyline *skyline, double azimuth_rad)
{
    struct vec3 sun = light->sun_direction;
    double own = tan(skyline_elevation(skyline, azimuth_rad)), across = tan(skyline_elevation(skyline, atan2(sun.x, sun.y)));
    double down = 2 * sun.z / fmax(1e-9, hypot(sun.x, sun.y)), shade = across - down;
    return !(shade > 0) ? 1 : own > shade ? 1 - shade / own : 0;
}

void skyline_raise(struct light *light, const struct scene_skyline *skyline, const double ground_albedo[3])
{
    double side[SIDES][3] = { { 0 } };
    put_sides(light, skyline, side);
    for (int bounce = 0;; bounce++) {
        light_irradiance(light->irradiance, light, vec3(0, 0, 1));
        put_ground(light, ground_albedo);
        if (bounce == BOUNCES || !skyline->count) return;
        for (int i = 0; i < SIDES; i++) {
            double turn = 2 * M_PI * i / SIDES, sky[3], sunlit = light->has_sun ? sunlit_share(light, skyline, M_PI / 2 - turn) : 0;
            struct vec3 facing = vec3(-cos(turn), -sin(turn), 0);
            light_irradiance(side[i], light, facing);
            light_sky_irradiance(sky, light, facing);
            for (int c = 0; c < 3; c++) side[i][c] = skyline->albedo[c] * (sky[c] + sunlit * (side[i][c] - sky[c]));
        }
        put_sides(light, skyline, side);
    }
}

bool skyline_doubt(char **text, const struct light *light, const struct scene *scene, struct error *err)
{
    const struct scene_skyline *skyline = &scene->skyline;
    double line = skyline_elevation(skyline, atan2(light->sun_direction.x, light->sun_direction.y)), sun = asin(fmin(1, light->sun_direction.z));
    *text = NULL;
    if (skyline->assumed || !light->has_sun || sun > line) return true;
    *text = string_format("%s:%d:%d: surroundings.skyline_deg: is %.0f deg towards the sun, which stands %.0f deg high: it is taken to shine "
                          "through a gap", scene->path, skyline->source.line, skyline->source.column, line * 180 / M_PI, sun * 180 / M_PI);
    return *text || error_set(err, ERR_MEMORY, "no memory for a warning");
}

#include "gen/light/measured_sky.h"

#include "gen/light/sky_image.h"

#include <stdlib.h>

/* Wide enough for reflections; more only costs. */
enum { WIDTH_MAX = 1024, WIDTH_MIN = 16 };

/* The sun's disc is ten thousand times brighter than a clear sky, the sky round it ten times, clouds five. What
 * lies between was a sun before the camera clipped it. */
#define SUN_BESIDE_MEDIAN 100
#define CLIPPED_BESIDE_MEDIAN 20
/* Round the brightest pixel: as far as its glare is part of it, and as far as the sky is taken that it hides. */
#define GLARE_COS 0.99619469809174555   /* 5 deg */
#define RING_COS 0.99026806874157036    /* 8 deg */
#define GLARE_BESIDE_RING 10
#define NEAR_COS 0.98480775301220802    /* 10 deg: a sun that is given may be off by that */

struct map {
    struct image *picture;     /* columns turn clockwise, seen from above */
    double north_px;           /* the column of true north, from the left edge */
    double world_north_rad;    /* azimuth of the world's +y */
};

static struct vec3 map_direction(const struct map *map, int column, int row)
{
    double elevation = sky_row_top(map->picture, row) - M_PI / map->picture->height_px / 2;
    double azimuth = (column + 0.5 - map->north_px) / map->picture->width_px * 2 * M_PI - map->world_north_rad;
    return vec3(cos(elevation) * sin(azimuth), cos(elevation) * cos(azimuth), sin(elevation));
}

static int ascending(const void *a, const void *b)
{
    double d = *(const double *)a - *(const double *)b;
    return (d > 0) - (d < 0);
}

/* Of the sky's luminance above the horizon, by solid angle. */
static double median_luminance(const struct image *picture)
{
    enum { RINGS = 50, STEPS = 100 };
    double sample[RINGS * STEPS];
    for (int ring = 0; ring < RINGS; ring++)
        for (int step = 0; step < STEPS; step++) {
            double elevation = asin((ring + 0.5) / RINGS);
            int row = (int)((0.5 - elevation / M_PI) * picture->height_px);
            int column = (int)((step + 0.5) / STEPS * picture->width_px);
            sample[ring * STEPS + step] = sky_pixel_luminance(picture, column, row);
        }
    qsort(sample, RINGS * STEPS, sizeof *sample, ascending);
    return sample[RINGS * STEPS / 2];
}

/* In: towards, or NULL for all of the sky */
static double brightest(struct vec3 *direction, const struct map *map, const struct vec3 *towards)
{
    double most = -1;
    for (int row = 0; row < map->picture->height_px / 2; row++)
        for (int column = 0; column < map->picture->width_px; column++) {
            double luminance = sky_pixel_luminance(map->picture, column, row);
            if (luminance <= most) continue;
            struct vec3 d = map_direction(map, column, row);
            if (towards && vec3_dot(d, *towards) < NEAR_COS) continue;
            most = luminance;
            *direction = d;
        }
    return most;
}

/* Mean of the sky between glare and ring. */
static void sky_round(double rgb[3], const struct map *map, struct vec3 peak)
{
    double sum[3] = { 0 }, weight = 0;
    for (int row = 0; row < map->picture->height_px / 2; row++)
        for (int column = 0; column < map->picture->width_px; column++) {
            double cosine = vec3_dot(map_direction(map, column, row), peak);
            if (cosine > GLARE_COS || cosine < RING_COS) continue;
            double solid = sky_solid_angle(map->picture, row);
            weight += solid;
            for (int c = 0; c < 3; c++) sum[c] += solid * (double)image_f32(map->picture, column, row)[c];
        }
    for (int c = 0; c < 3; c++) rgb[c] = weight > 0 ? sum[c] / weight : 0;
}

static void take_out_sun(struct measured_sky *measured, const struct map *map, struct vec3 peak)
{
    double round[3];
    struct vec3 sum = { 0, 0, 0 };
    sky_round(round, map, peak);
    double least = GLARE_BESIDE_RING * luminance_of(round);
    for (int row = 0; row < map->picture->height_px / 2; row++)
        for (int column = 0; column < map->picture->width_px; column++) {
            struct vec3 d = map_direction(map, column, row);
            if (vec3_dot(d, peak) < GLARE_COS || sky_pixel_luminance(map->picture, column, row) < least) continue;
            float *pixel = image_f32(map->picture, column, row);
            double solid = sky_solid_angle(map->picture, row), more[3];
            for (int c = 0; c < 3; c++) {
                more[c] = solid * fmax(0, (double)pixel[c] - round[c]) / M_PI;
                measured->sun_color[c] += more[c];
                pixel[c] = (float)round[c];
            }
            sum = vec3_add(sum, vec3_scale(d, luminance_of(more)));
        }
    measured->has_sun = true;
    measured->sun_direction = vec3_unit(sum);
}

static bool find_sun(struct measured_sky *measured, const struct map *map, const struct scene *scene,
                     struct vec3 towards, struct error *err)
{
    const struct scene_map *m = &scene->map;
    bool given = scene->sun == SUN_GIVEN;
    struct vec3 peak = { 0, 0, 1 };
    double median = median_luminance(map->picture), most = brightest(&peak, map, given ? &towards : NULL);
    if (most >= SUN_BESIDE_MEDIAN * median) {
        take_out_sun(measured, map, peak);
        if (given) measured->sun_direction = towards;
        return true;
    }
    if (given)
        return error_at(err, ERR_INPUT, scene->path, scene->sun_source.line, scene->sun_source.column,
                        "%s shows no sun within 10 deg of there: its brightest spot is %.3g times the sky's median, and "
                        "the sun is more than %d times: check the map's north and the sun, or say \"sun: none\"",
                        m->file, most / median, SUN_BESIDE_MEDIAN);
    if (most >= CLIPPED_BESIDE_MEDIAN * median)
        return error_at(err, ERR_INPUT, scene->path, m->source.line, m->source.column,
                        "%s: its brightest spot is %.3g times the sky's median, more than a cloud and less than the sun "
                        "(%d times): a clipped sun gives no shadows; take a map with the sun in full, or \"sun: none\" "
                        "to light with it as it is", m->file, most / median, SUN_BESIDE_MEDIAN);
    return true;
}

/* A picture of the map's own direction to one as the world's. */
static bool turn_map(struct image *sky, const struct map *map, struct error *err)
{
    int height = map->picture->height_px, width = map->picture->width_px;
    if (!image_init(sky, width, height, 3, PIXEL_F32, err)) return false;
    for (int column = 0; column < width; column++) {
        double azimuth = map->world_north_rad + M_PI / 2 - (column + 0.5) / width * 2 * M_PI;
        double at = map->north_px + azimuth / (2 * M_PI) * width - 0.5, left = floor(at), share = at - left;
        int from = (int)fmod(fmod(left, width) + width, width), to = (from + 1) % width;
        for (int row = 0; row < height; row++)
            for (int c = 0; c < 3; c++)
                image_f32(sky, column, row)[c] = (float)((1 - share) * (double)image_f32(map->picture, from, row)[c] +
                                                         share * (double)image_f32(map->picture, to, row)[c]);
    }
    return true;
}

/* A colour of which nothing comes from above cannot be brought to the scene's unit. */
static bool has_all_colors(const struct image *picture)
{
    bool has[3] = { false };
    for (int row = 0; row < picture->height_px / 2; row++)
        for (int column = 0; column < picture->width_px; column++)
            for (int c = 0; c < 3; c++) has[c] |= image_f32(picture, column, row)[c] > 0;
    return has[0] && has[1] && has[2];
}

/* The scene names the map: there it is to be mended, or another to be named. */
static bool map_fault(struct error *err, const struct scene *scene, const struct error *of_map)
{
    if (!of_map->file[0]) return error_set(err, of_map->code, "%s", of_map->text);
    return error_at(err, of_map->code, scene->path, scene->map.source.line, scene->map.source.column, "light.map.file: %.400s: %s", of_map->file,
                    of_map->text);
}

/* Three channels, nothing negative, nothing that is no number. */
static bool check_picture(struct image *clean, const struct image *picture, const char *file, struct error *err)
{
    int width = picture->width_px, height = picture->height_px;
    if (picture->type != PIXEL_F32)
        return error_at(err, ERR_INPUT, file, 0, 0, "has integer pixels: a sky is measured in linear float (.hdr or .exr)");
    if (picture->channels < 3) return error_at(err, ERR_INPUT, file, 0, 0, "has one channel: a sky has three, red, green and blue");
    if (width != 2 * height || width < WIDTH_MIN)
        return error_at(err, ERR_INPUT, file, 0, 0,
                        "is %dx%d px: an equirectangular map is twice as wide as high, and at least %d px wide", width,
                        height, WIDTH_MIN);
    if (!image_init(clean, width, height, 3, PIXEL_F32, err)) return false;
    for (int row = 0; row < height; row++)
        for (int column = 0; column < width; column++)
            for (int c = 0; c < 3; c++) {
                float value = image_f32(picture, column, row)[c];
                if (!isfinite(value)) {
                    image_release(clean);
                    return error_at(err, ERR_INPUT, file, 0, 0, "has a pixel that is no number, at (%d, %d) from the top left",
                                    column, row);
                }
                image_f32(clean, column, row)[c] = fmaxf(0, value); /* what resampling of others leaves below 0 */
            }
    return true;
}

bool measured_sky_read(struct measured_sky *measured, const struct scene *scene, struct vec3 towards, struct error *err)
{
    const struct scene_map *m = &scene->map;
    struct image file = { 0 }, picture = { 0 }, reduced = { 0 };
    struct measured_sky made = { 0 };
    struct error of_map = ERROR_NONE;
    bool ok = image_read(&file, m->file, &of_map) && check_picture(&picture, &file, m->file, &of_map);
    image_release(&file);
    if (!ok) return map_fault(err, scene, &of_map);
    int width = picture.width_px;
    struct map map = { &picture, m->by_column ? m->north_px : (0.5 - m->middle_rad / (2 * M_PI)) * width, scene->north_rad };
    if (m->by_column && m->north_px > width) {
        ok = error_at(err, ERR_INPUT, scene->path, m->north_source.line, m->north_source.column,
                      "light.map.north_px: the map is %d px wide", width);
    } else if (!(median_luminance(&picture) > 0)) {
        error_at(&of_map, ERR_INPUT, m->file, 0, 0, "has no light above the horizon");
    } else if (!has_all_colors(&picture)) {
        error_at(&of_map, ERR_INPUT, m->file, 0, 0, "has no red, no green or no blue above the horizon: light for photographs has all three");
    }
    if (of_map.code != ERR_OK) ok = map_fault(err, scene, &of_map);
    ok = ok && (scene->sun == SUN_NONE || find_sun(&made, &map, scene, towards, err));
    if (ok) { /* rows in fours: the horizon stays an edge */
        int to = width > WIDTH_MAX ? WIDTH_MAX : width / 4 * 4;
        ok = image_resize(&reduced, &picture, to, to / 2, err);
        map.north_px *= (double)to / width;
        map.picture = &reduced;
        ok = ok && turn_map(&made.sky, &map, err);
    }
    image_release(&picture);
    image_release(&reduced);
    if (ok) *measured = made;
    return ok;
}

void measured_sky_release(struct measured_sky *measured)
{
    image_release(&measured->sky);
}

/* Measured skies: maps made here, whose light is known by hand. */
#include "gen/light/light.h"

#include "gen/light/map_sun.h"
#include "gen/light/sky_image.h"
#include "lib/file.h"
#include "tests/tap.h"

#include <unistd.h>

enum { WIDTH = 512, HEIGHT = 256 };
#define SKY 0.5
#define SUN_LUX 3.0 /* normal irradiance / pi, in the map's units */

/* A uniform sky whose sun stands at an azimuth and elevation; the middle column looks to the azimuth middle_deg. */
static struct image map_of(double sun_azimuth_deg, double sun_elevation_deg, double sun, double middle_deg)
{
    struct image map;
    struct error err = ERROR_NONE;
    if (!image_init(&map, WIDTH, HEIGHT, 3, PIXEL_F32, &err)) exit(1);
    for (int row = 0; row < HEIGHT; row++)
        for (int column = 0; column < WIDTH; column++)
            for (int c = 0; c < 3; c++) image_f32(&map, column, row)[c] = (float)(SKY * (c + 1));
    double at = fmod((sun_azimuth_deg - middle_deg) / 360 + 0.5 + 2, 1) * WIDTH;
    int column = (int)at, row = (int)((90 - sun_elevation_deg) / 180 * HEIGHT);
    for (int c = 0; c < 3; c++) image_f32(&map, column, row)[c] += (float)(sun * M_PI / sky_solid_angle(&map, row));
    return map;
}

/* RGBE without compression, as any program reads it. */
static bool write_hdr(const char *path, const struct image *map)
{
    FILE *f = fopen(path, "wb");
    if (!f) return false;
    fprintf(f, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", map->height_px, map->width_px);
    for (int row = 0; row < map->height_px; row++)
        for (int column = 0; column < map->width_px; column++) {
            const float *p = image_f32(map, column, row);
            int exponent;
            double most = (double)fmaxf(p[0], fmaxf(p[1], p[2])), scale = frexp(most, &exponent) * 256 / most;
            for (int c = 0; c < 3; c++) fputc((int)((double)p[c] * scale), f);
            fputc(exponent + 128, f);
        }
    return fclose(f) == 0;
}

static struct scene scene_of(char *file, double middle_deg)
{
    return (struct scene){ .path = "scene.yaml", .sky = SKY_MAP, .sun = SUN_IN_MAP, .sun_scale = 1, .sun_source = { 7, 9 },
                           .ground_albedo = { 0.2, 0.2, 0.2 },
                           .map = { .file = file, .middle_rad = middle_deg * M_PI / 180, .source = { 8, 3 }, .north_source = { 8, 30 } } };
}

static double angle_deg(struct vec3 a, double azimuth_deg, double elevation_deg)
{
    double azimuth = azimuth_deg * M_PI / 180, elevation = elevation_deg * M_PI / 180;
    struct vec3 b = { cos(elevation) * sin(azimuth), cos(elevation) * cos(azimuth), sin(elevation) };
    return acos(fmin(1, vec3_dot(a, b))) * 180 / M_PI;
}

static void check_sun(const struct scene *scene, const char *name, double azimuth_deg, double elevation_deg)
{
    struct error err = ERROR_NONE;
    struct light light;
    if (!OK(light_create(&light, scene, &err), "%s: read", name)) {
        printf("# %s: %s\n", err.file, err.text);
        return;
    }
    OK(light.has_sun && angle_deg(light.sun_direction, azimuth_deg, elevation_deg) < 0.6, "%s: the sun stands where it was put (%.2f deg)",
       name, angle_deg(light.sun_direction, azimuth_deg, elevation_deg));
    /* By hand: the uniform sky gives level ground its own radiance, the sun its share by the sine. */
    double sine = light.sun_direction.z, sum = 0;
    for (int c = 0; c < 3; c++) sum += (double[]){ 0.2126, 0.7152, 0.0722 }[c] * (SKY * (c + 1) + SUN_LUX * sine);
    for (int c = 0; c < 3; c++) {
        NEAR(light.sun_color[c], SUN_LUX / sum, 0.01 * SUN_LUX / sum, "%s: the sun's irradiance, channel %d", name, c);
        NEAR(light.irradiance[c], (SKY * (c + 1) + SUN_LUX * sine) / sum, 0.01, "%s: the level irradiance, channel %d", name, c);
    }
    double rgb[3];
    light_sky_radiance(rgb, &light, light.sun_direction);
    NEAR(rgb[1], 2 * SKY / sum, 0.02 * rgb[1], "%s: where the sun was, sky is left", name);
    light_release(&light);
}

/* Which way the map lies: a bright quarter of the sky. */
static void check_quarter(char *file)
{
    struct image map = map_of(0, 45, 0, 0);
    for (int row = 0; row < HEIGHT / 2; row++)
        for (int column = WIDTH * 5 / 8; column < WIDTH * 7 / 8; column++) /* to the right of the middle, seen from inside */
            for (int c = 0; c < 3; c++) image_f32(&map, column, row)[c] *= 4;
    struct error err = ERROR_NONE;
    struct light light;
    struct scene scene = scene_of(file, 0);
    if (OK(image_write(file, &map, &err) && light_create(&light, &scene, &err), "a map with a bright quarter")) {
        double east[3], west[3], north[3];
        light_sky_radiance(east, &light, vec3_unit(vec3(1, 0, 0.3)));
        light_sky_radiance(west, &light, vec3_unit(vec3(-1, 0, 0.3)));
        light_sky_radiance(north, &light, vec3_unit(vec3(0, 1, 0.3)));
        OK(!light.has_sun, "bright clouds are no sun");
        NEAR(east[1] / north[1], 4, 1e-3, "what is right of north in the map is east");
        NEAR(west[1] / north[1], 1, 1e-3, "what is left is not");
        light_release(&light);
    }
    image_release(&map);
}

/* Greenwich at noon in midsummer: the sun is in the south but for the equation of time, 23.4 deg higher than at an equinox. */
static void check_doubt(char *file)
{
    static const struct { double azimuth_deg, elevation_deg; bool doubted; } suns[] = {
        { 180, 62, false }, { 170, 55, false }, { 180, 42, true }, { 230, 62, true }, { 0, 62, true } };
    for (size_t i = 0; i < sizeof suns / sizeof *suns; i++) {
        struct image map = map_of(suns[i].azimuth_deg, suns[i].elevation_deg, SUN_LUX, 0);
        struct error err = ERROR_NONE;
        struct scene scene = scene_of(file, 0);
        struct light light;
        char *text = NULL;
        scene.north_rad = 1; /* of the world: the map has its own */
        scene.place = (struct geodetic){ 51.4779 * M_PI / 180, 0, 0 };
        scene.time_utc = (struct utc_time){ 2021, 6, 21, 12, 0, 0 };
        scene.has_time = true;
        if (!OK(image_write(file, &map, &err) && light_create(&light, &scene, &err), "a map is read")) return;
        OK(map_sun_doubt(&text, &light, &scene, &err) && !text, "without a place no sun is doubted");
        scene.has_place = true;
        OK(map_sun_doubt(&text, &light, &scene, &err) && (text != NULL) == suns[i].doubted, "a sun at %g, %g is %sdoubted",
           suns[i].azimuth_deg, suns[i].elevation_deg, suns[i].doubted ? "" : "not ");
        if (text) {
            double shown[2] = { NAN, NAN }, computed[2] = { NAN, NAN };
            OK(sscanf(text, "scene.yaml:8:30: light.map: its sun stands at azimuth %lf deg, elevation %lf deg; by place and time it is at azimuth "
                            "%lf deg, elevation %lf", &shown[0], &shown[1], &computed[0], &computed[1]) == 4, "%s", text);
            NEAR(remainder(shown[0] - suns[i].azimuth_deg, 360), 0, 1, "the sun of the map");
            NEAR(shown[1], suns[i].elevation_deg, 1, "its elevation");
            NEAR(computed[0], 180, 2, "the sun by the time");
            NEAR(computed[1], 90 - 51.48 + 23.44, 0.1, "its elevation");
        }
        free(text);
        scene.time_utc.year = 9000;
        OK(map_sun_doubt(&text, &light, &scene, &err) && !text && err.code == ERR_OK, "nor in a year whose sun is not known");
        light_release(&light);
        image_release(&map);
    }
}

static void check_refusal(struct scene *scene, const char *name, const char *file, int line, const char *text)
{
    struct error err = ERROR_NONE;
    struct light light;
    bool ok = light_create(&light, scene, &err);
    OK(!ok && err.code == ERR_INPUT && err.line == line && strstr(err.text, text) && !strcmp(err.file, file), "%s: \"%s\"", name, text);
    if (!ok && !strstr(err.text, text)) printf("# %s:%d: %s\n", err.file, err.line, err.text);
    if (ok) light_release(&light);
}

int main(void)
{
    struct error err = ERROR_NONE;
    char folder[] = "measured.XXXXXX";
    if (!OK(mkdtemp(folder) != NULL, "a folder for maps")) return tap_done();
    char *exr = string_format("%s/map.exr", folder), *hdr = string_format("%s/map.hdr", folder);

    struct image map = map_of(120, 40, SUN_LUX, 0);
    OK(image_write(exr, &map, &err) && write_hdr(hdr, &map), "maps are written");
    struct scene scene = scene_of(exr, 0);
    check_sun(&scene, "an EXR, north in the middle", 120, 40);
    scene.map.file = hdr;
    check_sun(&scene, "a Radiance picture", 120, 40);
    scene.north_rad = 0.5;
    check_sun(&scene, "a world that is turned", 120 - 0.5 * 180 / M_PI, 40);
    scene.north_rad = 0;
    scene.map.by_column = true;
    scene.map.north_px = 0;
    check_sun(&scene, "north at the left edge", 120 + 180, 40);
    scene.map.north_px = WIDTH + 1;
    check_refusal(&scene, "a north outside", "scene.yaml", 8, "the map is 512 px wide");

    scene = scene_of(exr, 0);
    scene.sun = SUN_GIVEN;
    scene.sun_azimuth_rad = 118 * M_PI / 180;
    scene.sun_elevation_rad = 43 * M_PI / 180;
    struct light light;
    if (OK(light_create(&light, &scene, &err), "a sun that is given, some degrees off")) {
        OK(angle_deg(light.sun_direction, 118, 43) < 1e-3, "stands where it is given");
        OK(luminance_of(light.sun_color) > 0.5, "with the light of the map's");
        light_release(&light);
    }
    scene.sun_azimuth_rad = 2.8;
    check_refusal(&scene, "a sun given where there is none", "scene.yaml", 7, "no sun within 10 deg");
    scene.sun = SUN_NONE;
    if (OK(light_create(&light, &scene, &err), "a map that is taken as it is")) {
        OK(!light.has_sun, "has no sun");
        NEAR(luminance_of(light.irradiance), 1, 1e-6, "and all of its light");
        struct sky_light lights[8];
        light_sample_sky(lights, 8, &light);
        double most = 0;
        for (int i = 0; i < 8; i++) most = fmax(most, -angle_deg(lights[i].direction, 120, 40));
        OK(most > -1, "some lights of the sky stand in the bright spot");
        light_release(&light);
    }
    image_release(&map);

    scene = scene_of(exr, 0);
    map = map_of(120, 40, 0, 0);
    float *spot = image_f32(&map, 100, 60);
    for (int c = 0; c < 3; c++) spot[c] = SKY * 80;
    OK(image_write(exr, &map, &err), "a map is written");
    check_refusal(&scene, "a sun that was clipped", "scene.yaml", 8, "a clipped sun gives no shadows");
    spot[1] = NAN;
    OK(image_write(exr, &map, &err), "a map is written");
    check_refusal(&scene, "no number", "scene.yaml", 8, "has a pixel that is no number, at (100, 60)");
    memset(map.data, 0, image_size(&map));
    OK(image_write(exr, &map, &err), "a map is written");
    check_refusal(&scene, "a black map", "scene.yaml", 8, "no light above the horizon");
    for (int i = 0; i < WIDTH * HEIGHT; i++) ((float *)map.data)[3 * i] = ((float *)map.data)[3 * i + 1] = SKY;
    OK(image_write(exr, &map, &err), "a map is written");
    check_refusal(&scene, "a map without blue", "scene.yaml", 8, "has no red, no green or no blue above the horizon");
    image_release(&map);
    if (image_init(&map, 300, 200, 3, PIXEL_F32, &err) && image_write(exr, &map, &err))
        check_refusal(&scene, "a picture that is no map", "scene.yaml", 8, "is 300x200 px: an equirectangular map is twice as wide as high");
    image_release(&map);
    char *png = string_format("%s/map.png", folder);
    scene.map.file = png;
    if (image_init(&map, 64, 32, 3, PIXEL_U8, &err) && image_write(png, &map, &err))
        check_refusal(&scene, "a picture of 8 bits", "scene.yaml", 8, "has integer pixels");
    image_release(&map);
    check_quarter(exr);
    check_doubt(exr);

    unlink(exr);
    unlink(hdr);
    unlink(png);
    rmdir(folder);
    free(exr);
    free(hdr);
    free(png);
    return tap_done();
}

/* What stands around: what it keeps away and sends back, against integrals worked out by hand. */
#include "gen/light/skyline.h"

#include "gen/light/sky_image.h"
#include "tests/tap.h"

static double rad(double deg) { return deg * M_PI / 180; }

static double elevation_deg(double (*point_deg)[2], size_t n, double azimuth_deg)
{
    double point[8][2];
    for (size_t i = 0; i < n; i++) point[i][0] = rad(point_deg[i][0]), point[i][1] = rad(point_deg[i][1]);
    return skyline_elevation(&(struct scene_skyline){ .point_rad = point, .count = n }, rad(azimuth_deg)) * 180 / M_PI;
}

static void check_elevations(void)
{
    double one[1][2] = { { 0, 20 } }, street[3][2] = { { 20, 30 }, { 110, 10 }, { 200, 20 } };
    NEAR(elevation_deg(one, 1, 250), 20, 1e-9, "one elevation is that of all sides");
    NEAR(elevation_deg(street, 3, 110), 10, 1e-9, "where it was told, it is as told");
    NEAR(elevation_deg(street, 3, 65), 20, 1e-9, "between, it is between");
    NEAR(elevation_deg(street, 3, 290), 25, 1e-9, "also past north");
    NEAR(elevation_deg(street, 3, -70), 25, 1e-9, "and turned the other way");
    NEAR(elevation_deg(NULL, 0, 7), 0, 1e-9, "where nothing stands it is the horizon");
}

static bool uniform(struct light *light, struct error *err)
{
    *light = (struct light){ 0 };
    if (!image_init(&light->open_sky, 256, 128, 3, PIXEL_F32, err) || !image_init(&light->sky, 256, 128, 3, PIXEL_F32, err)) return false;
    for (int i = 0; i < 256 * 64 * 3; i++) ((float *)light->open_sky.data)[i] = 1;
    return true;
}

/* Under a sky of radiance 1 and walls up to the elevation a all round, of radiance w: level ground receives cos^2 a + w sin^2 a.
 * A wall that faces the middle sees, above its own horizon, the share V of walls and 1/2 - V of sky, V = (a + sin a cos a) / pi, and below it half ground.
 * So w = r (1/2 - V + w V + g (cos^2 a + w sin^2 a) / 2), which is linear in w. */
static void check_uniform_sky(double a_deg, double r, double g)
{
    struct error err = ERROR_NONE;
    struct light light;
    double point[1][2] = { { 0, rad(a_deg) } }, a = rad(a_deg), v = (a + sin(a) * cos(a)) / M_PI, open = cos(a) * cos(a), ground[3] = { g, g, g };
    double w = r * (0.5 - v + g * open / 2) / (1 - r * (v + g * (1 - open) / 2)), want = open + w * (1 - open), rgb[3];
    struct scene_skyline skyline = { .point_rad = point, .count = 1, .albedo = { r, r, r } };
    if (!OK(uniform(&light, &err), "an even sky")) return;
    skyline_raise(&light, &skyline, ground);
    NEAR(light.irradiance[1], want, 2e-3 * want, "walls of %.0f deg and albedo %.2f leave level ground %.3f of the light", a_deg, r, want);
    light_sky_radiance(rgb, &light, vec3(cos(a / 2), 0, sin(a / 2)));
    if (a > 0) NEAR(rgb[1], w, 5e-3 * w + 1e-9, "and shine with what they receive");
    light_sky_radiance(rgb, &light, vec3(0, cos(a + 0.03), sin(a + 0.03)));
    NEAR(rgb[1], 1, 1e-6, "above them is the sky");
    light_sky_radiance(rgb, &light, vec3(0, 0.6, -0.8));
    NEAR(rgb[1], g * want, 2e-3 * want, "below them the ground, lit by both");
    struct sky_light lights[64];
    double level = 0;
    light_sample_sky(lights, 64, &light);
    for (int i = 0; i < 64; i++) level += lights[i].color[1] * lights[i].direction.z;
    NEAR(level, want, 2e-3 * want, "which is what the directions send in which shade is measured");
    light_release(&light);
}

static struct scene clear_scene(double (*point)[2], size_t n)
{
    return (struct scene){ .path = "scene.yaml", .sky = SKY_CLEAR, .sun = SUN_GIVEN, .sun_azimuth_rad = M_PI, .sun_elevation_rad = rad(40),
                           .turbidity = 3, .sun_scale = 1, .ground_albedo = { 0.1, 0.1, 0.1 },
                           .skyline = { .point_rad = point, .count = n, .albedo = { 0.25, 0.25, 0.2 }, .source = { 8, 3 } } };
}

/* The sun in the south, houses to the north. */
static void check_sun(void)
{
    struct error err = ERROR_NONE;
    struct light light, bare;
    double point[4][2] = { { 0, rad(30) }, { rad(90), 0 }, { rad(180), 0 }, { rad(270), 0 } }, north[3], upright[3], sky[3];
    struct scene scene = clear_scene(point, 4);
    if (!OK(light_create(&light, &scene, &err), "a sunny street")) return;
    light_sky_radiance(north, &light, vec3(0, cos(0.2), sin(0.2)));
    light_irradiance(upright, &light, vec3(0, -1, 0));
    for (int c = 0; c < 3; c++)
        NEAR(north[c], scene.skyline.albedo[c] * upright[c], 0.01 * upright[c], "a house shines with the sun on it and all else that it receives, channel %d", c);
    light_sky_irradiance(sky, &light, vec3(0, -1, 0));
    OK(upright[1] - sky[1] > sky[1], "most of which is the sun's");
    scene.skyline.count = 0;
    if (OK(light_create(&bare, &scene, &err), "the same in the open")) {
        for (int c = 0; c < 3; c++) NEAR(light.sun_color[c], bare.sun_color[c], 1e-6 * bare.sun_color[c], "the unit stays that of the open, channel %d", c);
        NEAR(luminance_of(bare.irradiance), 1, 1e-6, "where level ground receives 1");
        light_release(&bare);
    }
    light_release(&light);
}

/* Between walls of 35 deg all round a sun of 3 deg reaches the top of the wall across: as high as it comes down on the way. */
static void check_low_sun(void)
{
    struct error err = ERROR_NONE;
    struct light light;
    double point[1][2] = { { 0, rad(35) } }, north[3], upright[3], sky[3], lit = 2 * tan(rad(3)) / tan(rad(35));
    struct scene scene = clear_scene(point, 1);
    scene.sun_elevation_rad = rad(3);
    if (!OK(light_create(&light, &scene, &err), "a narrow street in the evening")) return;
    light_sky_radiance(north, &light, vec3(0, cos(0.2), sin(0.2)));
    light_irradiance(upright, &light, vec3(0, -1, 0));
    light_sky_irradiance(sky, &light, vec3(0, -1, 0));
    for (int c = 0; c < 3; c++) {
        double want = scene.skyline.albedo[c] * (sky[c] + lit * (upright[c] - sky[c]));
        NEAR(north[c], want, 0.02 * want, "a house has the sun on its top alone, channel %d", c);
    }
    light_release(&light);
}

/* What of the light in the sun is not the sun's was measured on the ground: what stands around is part of it. */
static void check_share(void)
{
    struct error err = ERROR_NONE;
    struct light light;
    double point[1][2] = { { 0, rad(25) } }, sky[3];
    struct scene scene = clear_scene(point, 1);
    scene.has_sky_share = true;
    memcpy(scene.sky_share, (double[]){ 0.15, 0.2, 0.3 }, sizeof scene.sky_share);
    if (OK(light_create(&light, &scene, &err), "a sky's share that was measured in a street")) {
        light_sky_irradiance(sky, &light, vec3(0, 0, 1));
        for (int c = 0; c < 3; c++)
            NEAR(sky[c] / light.irradiance[c], scene.sky_share[c], 1e-5, "is what level ground there gets without the sun, channel %d", c);
        light_release(&light);
    }
    memcpy(scene.sky_share, (double[]){ 0.01, 0.01, 0.01 }, sizeof scene.sky_share);
    point[0][1] = rad(60);
    scene.skyline.albedo[0] = 0.8;
    OK(!light_create(&light, &scene, &err) && err.line == 8 && strstr(err.text, "sends more light back"),
       "a share less than what sunlit houses send is refused at its place: %s", err.text);
}

static void check_doubt(void)
{
    struct error err = ERROR_NONE;
    struct light light = { .has_sun = true, .sun_direction = { 0, -cos(rad(15)), sin(rad(15)) } };
    double point[2][2] = { { 0, rad(5) }, { rad(180), rad(22) } };
    struct scene scene = clear_scene(point, 2);
    char *text;
    if (OK(skyline_doubt(&text, &light, &scene, &err) && text && !strncmp(text, "scene.yaml:8:3: ", 16) && strstr(text, "is 22 deg towards the sun, which stands 15 deg"),
           "a sun behind what stands around is warned of"))
        free(text);
    scene.skyline.assumed = true;
    OK(skyline_doubt(&text, &light, &scene, &err) && !text, "unless nobody told that it stands there");
    scene.skyline.assumed = false;
    light.sun_direction.y *= -1;
    OK(skyline_doubt(&text, &light, &scene, &err) && !text, "nor where the sun stands above it");
}

int main(void)
{
    check_elevations();
    check_uniform_sky(0, 0.2, 0.1);
    check_uniform_sky(20, 0, 0.1);
    check_uniform_sky(20, 0.25, 0.1);
    check_uniform_sky(50, 0.5, 0.3);
    check_sun();
    check_low_sun();
    check_share();
    check_doubt();
    return tap_done();
}

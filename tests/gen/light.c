#include "gen/light/light.h"

#include "tests/tap.h"

static struct scene scene_with(enum sky_kind sky, double elevation_deg, double turbidity)
{
    return (struct scene){ .path = "scene.yaml", .sky = sky, .sun = sky == SKY_CLEAR ? SUN_GIVEN : SUN_NONE,
                           .sun_azimuth_rad = 2, .sun_elevation_rad = elevation_deg * M_PI / 180,
                           .turbidity = turbidity, .sun_scale = 1, .ground_albedo = { 0.2, 0.2, 0.2 } };
}

static double luminance(const double c[3])
{
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

/* The same integral over rings about the normal, through the function that looks directions up. */
static double by_rings(const struct light *light, struct vec3 normal)
{
    enum { RINGS = 300, STEPS = 1200 };
    struct vec3 across = vec3_unit(vec3_cross(normal, vec3(0.3, -0.8, 0.1))), other = vec3_cross(normal, across);
    double sum = 0;
    for (int i = 0; i < RINGS; i++) {
        double sine = sqrt((i + 0.5) / RINGS); /* rings of equal cosine-weighted solid angle */
        for (int k = 0; k < STEPS; k++) {
            double turn = (k + 0.5) / STEPS * 2 * M_PI, rgb[3];
            struct vec3 d = vec3_add(vec3_scale(across, sine * cos(turn)), vec3_scale(other, sine * sin(turn)));
            light_sky_radiance(rgb, light, vec3_add(d, vec3_scale(normal, sqrt(1 - sine * sine))));
            sum += luminance(rgb) / RINGS / STEPS;
        }
    }
    return sum;
}

static void check_irradiance(void)
{
    struct error err = ERROR_NONE;
    struct light light;
    double rgb[3];
    struct scene scene = scene_with(SKY_OVERCAST, 0, 3);
    if (!OK(light_create(&light, &scene, &err), "a light to lie in")) return;
    light_irradiance(rgb, &light, vec3(0, 0, 1));
    NEAR(rgb[1], light.irradiance[1], 1e-6, "a level surface gets the level irradiance");
    light_irradiance(rgb, &light, vec3(0, 0, -1));
    NEAR(rgb[1], 0.2, 1e-6, "what faces down gets the ground's");
    /* Moon and Spencer 1942: the overcast sky gives a wall 39.6 % of what it gives the ground; half of what
     * the wall sees is ground. */
    light_irradiance(rgb, &light, vec3(0.6, -0.8, 0));
    NEAR(rgb[1], 0.396 + 0.2 / 2, 1e-3, "an overcast wall gets 39.6 %% and the ground's half");
    light_release(&light);

    scene = scene_with(SKY_CLEAR, 35, 3);
    if (!OK(light_create(&light, &scene, &err), "a clear one")) return;
    for (int c = 0; c < 3; c++) {
        light_irradiance(rgb, &light, vec3(0, 0, 1));
        NEAR(rgb[c], light.irradiance[c], 1e-6, "channel %d: sun and sky on a level surface", c);
    }
    light_irradiance(rgb, &light, light.sun_direction);
    double sky[3];
    light_sky_irradiance(sky, &light, light.sun_direction);
    NEAR(rgb[0] - sky[0], light.sun_color[0], 1e-12, "what faces the sun gets all of it");
    light_irradiance(rgb, &light, vec3_scale(light.sun_direction, -1));
    light_sky_irradiance(sky, &light, vec3_scale(light.sun_direction, -1));
    NEAR(rgb[0], sky[0], 1e-12, "what turns its back gets none");
    for (int i = 0; i < 4; i++) {
        double tilt = (i + 0.5) * 25 * M_PI / 180, turn = 1 + 2.2 * i;
        struct vec3 normal = { sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt) };
        light_sky_irradiance(sky, &light, normal);
        double want = by_rings(&light, normal);
        NEAR(luminance(sky), want, 3e-3 * want, "the sky on a surface %.0f deg steep, summed in another way", tilt * 180 / M_PI);
    }
    light_release(&light);
}

/* Standard skies: as much sun beside the sky as is typical of the type (Kittler, Perez, Darula 1997: luminous turbidity T
 * and diffuse share D of 12 and 0.42, ...): exp(-m T / (9.9 + 0.043 m)) / D on level ground, by hand at 40 deg, m = 1.553. */
static void check_standard_skies(void)
{
    static const struct { int type; double sun_to_sky; } typical[] = { { 7, 0.367 }, { 8, 0.514 }, { 10, 0.585 }, { 11, 2.331 },
                                                                       { 12, 6.773 }, { 13, 1.771 }, { 14, 1.638 }, { 15, 1.787 } };
    struct error err = ERROR_NONE;
    struct light light;
    for (size_t i = 0; i < sizeof typical / sizeof *typical; i++) {
        struct scene scene = scene_with(SKY_CIE, 40, 3);
        scene.sun = SUN_GIVEN;
        scene.cie_type = typical[i].type;
        if (!OK(light_create(&light, &scene, &err), "standard sky %d", scene.cie_type)) continue;
        double sun = luminance(light.sun_color) * light.sun_direction.z, want = typical[i].sun_to_sky;
        NEAR(sun / (1 - sun), want, 0.08 * want, "standard sky %d: sun to sky on level ground", scene.cie_type);
        OK(light.has_sun && light.sun_color[0] < 2.2 * light.sun_color[2], "standard sky %d: its sun is not red", scene.cie_type);
        light_release(&light);
    }
    for (int type = 1; type <= 6; type++) {
        struct scene scene = scene_with(SKY_CIE, 40, 3);
        scene.sun = type % 2 ? SUN_NONE : SUN_GIVEN;
        scene.cie_type = type;
        if (!OK(light_create(&light, &scene, &err), "standard sky %d", type)) continue;
        double towards[3], away[3], level[3] = { sin(2), cos(2), 0.5 };
        light_sky_radiance(towards, &light, vec3_unit(vec3(level[0], level[1], level[2])));
        light_sky_radiance(away, &light, vec3_unit(vec3(-level[0], -level[1], level[2])));
        OK(!light.has_sun && fabs(light.irradiance[0] - light.irradiance[2]) < 1e-6, "standard sky %d: clouds are white and hide the sun", type);
        OK((towards[1] > 1.2 * away[1]) == (type % 2 == 0), "standard sky %d: is %s towards the sun", type, type % 2 ? "as bright" : "brighter");
        light_release(&light);
    }
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct light light;
    struct scene scene = scene_with(SKY_OVERCAST, 0, 3);
    OK(light_create(&light, &scene, &err), "an overcast sky needs no sun");
    NEAR(luminance(light.irradiance), 1, 1e-6, "a level white surface has luminance 1");
    double zenith[3], horizon[3];
    light_sky_radiance(zenith, &light, vec3(0, 0, 1));
    light_sky_radiance(horizon, &light, vec3(cos(0.012), 0, sin(0.012)));
    NEAR(zenith[1] / horizon[1], 3, 0.08, "the overcast zenith is three times as bright as the horizon (CIE)");
    NEAR(zenith[1], 9.0 / 7, 0.01, "and 9/7 of the level irradiance / pi (integral worked out by hand)");
    double below[3];
    light_sky_radiance(below, &light, vec3(0.6, 0, -0.8));
    NEAR(below[1], 0.2, 1e-6, "below the horizon is lit ground");

    struct sky_light lights[48];
    light_sample_sky(lights, 48, &light);
    double level = 0, east = 0, west = 0;
    bool up = true;
    for (int i = 0; i < 48; i++) {
        level += lights[i].color[1] * lights[i].direction.z;
        east += lights[i].color[1] * fmax(0, lights[i].direction.x);
        west += lights[i].color[1] * fmax(0, -lights[i].direction.x);
        up &= lights[i].direction.z > 0;
    }
    OK(up, "every sky light stands above the horizon");
    NEAR(level, light.irradiance[1], 1e-6, "sky lights sum to the level irradiance");
    NEAR(east / west, 1, 0.25, "and light all sides of an overcast scene alike");
    light_release(&light);

    double previous = 0;
    for (int elevation = 10; elevation <= 80; elevation += 10) {
        scene = scene_with(SKY_CLEAR, elevation, 3);
        err = ERROR_NONE;
        OK(light_create(&light, &scene, &err), "a clear sky with the sun at %d deg", elevation);
        double sun = luminance(light.sun_color) * light.sun_direction.z, sky = 1 - sun;
        OK(sun / sky > previous, "the sun's share of the light grows with its elevation (%.2f)", sun / sky);
        previous = sun / sky;
        double blue[3], opposite = fmod(2 + M_PI, 2 * M_PI);
        light_sky_radiance(blue, &light, vec3(0.6 * sin(opposite), 0.6 * cos(opposite), 0.8));
        OK(blue[2] > blue[0], "the clear sky away from the sun is blue");
        OK(light.sun_color[0] > light.sun_color[2], "and its sun is yellow");
        NEAR(light.sun_direction.x, sin(2) * cos(elevation * M_PI / 180), 1e-12, "the sun stands at its azimuth");
        light_release(&light);
    }
    scene = scene_with(SKY_CLEAR, 40, 3);
    scene.north_rad = 2;
    err = ERROR_NONE;
    OK(light_create(&light, &scene, &err) && fabs(light.sun_direction.x) < 1e-12,
       "a sun in the direction of the world's +y axis stands over +y");
    light_release(&light);

    scene = scene_with(SKY_CLEAR, -3, 3);
    scene.sun_source = (struct source){ 7, 3 };
    err = ERROR_NONE;
    OK(!light_create(&light, &scene, &err) && err.line == 7 && strstr(err.text, "3.0 deg below the horizon"),
       "a sun below the horizon is told with its place in the scene");
    check_irradiance();
    check_standard_skies();
    return tap_done();
}

/* The light at the foot of walls, against a sum over the hemisphere. */
#include "gen/light/enclosed.h"

#include "tests/gen/place.h"
#include "tests/tap.h"

#define FROM_WALL_M 6.0

/* Walls 100 m long at both sides, symmetric about the point. In: height_m  of the walls. Out: irradiance / pi */
static void by_sum(double rgb[3], const struct light *light, double height_m)
{
    enum { TURNS = 720, RISES = 180 };
    double side[3], sides[3] = { 0, 0, 0 }, sun = fmax(0, light->sun_direction.z) * light->has_sun;
    for (int i = 0; i < TURNS; i++) {
        light_irradiance(side, light, vec3(cos(2 * M_PI * i / TURNS), sin(2 * M_PI * i / TURNS), 0));
        for (int c = 0; c < 3; c++) sides[c] += ENCLOSING_ALBEDO * side[c] / TURNS;
    }
    for (int c = 0; c < 3; c++) rgb[c] = sun * light->sun_color[c];
    for (int j = 0; j < RISES; j++)
        for (int i = 0; i < TURNS; i++) {
            double rise = (j + 0.5) / RISES * M_PI / 2, turn = (i + 0.5) / TURNS * 2 * M_PI, of[3];
            struct vec3 d = vec3(cos(rise) * cos(turn), cos(rise) * sin(turn), sin(rise));
            double share = d.z * cos(rise) * (M_PI / 2 / RISES) * (2 * M_PI / TURNS) / M_PI;
            bool at_wall = fabs(d.x) * FROM_WALL_M < 50 * fabs(d.y) && d.z * FROM_WALL_M < height_m * fabs(d.y);
            light_sky_radiance(of, light, d);
            for (int c = 0; c < 3; c++) rgb[c] += share * (at_wall ? sides[c] : of[c]);
        }
}

static void between_walls(const struct light *light, double height_m, const char *what)
{
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct vec3 at = vec3(0, 90, 0);
    double rgb[3], sum[3], open[3];
    place_ground(&place, 0, 0);
    place_wall(&place, -50, 50, 90 - FROM_WALL_M, 0, height_m, 0);
    place_wall(&place, -50, 50, 90 + FROM_WALL_M, 0, height_m, 0);
    if (!OK(place_mesh(&mesh, &place, false, &err), "walls of %g m", height_m)) return;
    enclosed_irradiance(rgb, light, mesh, &at, 1);
    by_sum(sum, light, height_m);
    light_irradiance(open, light, vec3(0, 0, 1));
    for (int c = 0; c < 3; c++) NEAR(rgb[c], sum[c], 0.03 * sum[c], "%s, between walls of %g m, channel %d", what, height_m, c);
    OK(rgb[2] < 0.97 * open[2], "less than in the open (%.3f of %.3f)", rgb[2], open[2]);
    static_mesh_destroy(mesh);
    place_free(&place);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct scene scene = { .path = "scene.yaml", .sky = SKY_CLEAR, .sun = SUN_GIVEN, .sun_azimuth_rad = 4, .sun_elevation_rad = M_PI / 4, .turbidity = 3,
                           .sun_scale = 1, .ground = { { 0, 0, 1 }, 0 }, .ground_albedo = { 0.3, 0.3, 0.3 } };
    struct light light;
    if (OK(light_create(&light, &scene, &err), "a clear sky")) {
        between_walls(&light, 8, "under a clear sky");
        light_release(&light);
    }
    scene.sky = SKY_OVERCAST;
    if (OK(light_create(&light, &scene, &err), "clouds")) {
        between_walls(&light, 4, "under clouds");
        between_walls(&light, 8, "under clouds");
        light_release(&light);
    }
    return tap_done();
}

/* What the ground beside a long wall sends back, against the share of the sky that the wall hides. */
#include "gen/trace/bounced.h"

#include "gen/trace/trace.h"
#include "tests/gen/solid.h"
#include "tests/tap.h"

enum { SIDE = 16 };
#define HALF_M 4.0
#define HEIGHT_M 2.0
#define ALBEDO 0.5

static const struct plane flat = { { 0, 0, 1 }, 0 };

/* An even sky: of a point beside the wall, in closed form. */
static double left_beside(double away_m)
{
    double d = fabs(away_m);
    return 1 - (1 - d / hypot(d, HEIGHT_M)) / 2;
}

/* The mean over a texel's two samples across the wall. */
static double left_in(int column)
{
    double x = -HALF_M + (column + 0.5) * 2 * HALF_M / SIDE, aside = HALF_M / SIDE / 2;
    return (left_beside(x - aside) + left_beside(x + aside)) / 2;
}

static double albedo_at(const struct image *image, int column)
{
    return (double)linear_from_srgb((float)image_u8(image, column, SIDE / 2)[1] / 255);
}

/* The wall along y, through the middle; the sun, if there is one, towards +x, 30 degrees high.
 * Out: left (SIDE) of the sky's light, mean of a column's two samples across the wall */
static bool shade(struct image *image, struct light *light, double *left, bool sunny, struct error *err)
{
    static const struct vec2 far[] = { { -500, -500 }, { 500, -500 }, { 500, 500 }, { -500, 500 } };
    struct scene scene = { .path = "scene.yaml", .sky = sunny ? SKY_CLEAR : SKY_CIE, .sun = sunny ? SUN_GIVEN : SUN_NONE, .sun_azimuth_rad = M_PI / 2,
                           .sun_elevation_rad = M_PI / 6, .cie_type = 5, .turbidity = 3, .sun_scale = 1, .ground = flat, .ground_albedo = { 0.1, 0.1, 0.1 } };
    struct vec3 corner[4];
    for (int i = 0; i < 4; i++) corner[i] = vec3(far[i].x, far[i].y, 0);
    const struct receiver everywhere = { corner, 4, 1 };
    struct solid wall;
    struct tracer *tracer = NULL;
    struct sky_sight *sight = NULL;
    solid_box(&wall, 0.01, 600, HEIGHT_M);
    const struct model *models[] = { &wall.model };
    struct entity entity = { .id = 1, .name = "wall", .model = &wall.model, .world_from_entity = pose_identity() };
    const struct bounced_ground ground = { { 0, 0 }, flat };
    bool ok = tracer_create(&tracer, models, 1, err) && light_create(light, &scene, err) && sky_sight_create(&sight, &(struct sky_sight_input){ .light = light, .directions = 256 }, err) &&
              sky_sight_add(sight, tracer, &entity, &everywhere, err) && image_init(image, SIDE, SIDE, 3, PIXEL_U8, err);
    if (ok) {
        memset(image->data, (int)(srgb_from_linear((float)ALBEDO) * 255 + 0.5f), image_size(image));
        struct bounced_input in = { .sight = sight, .light = light, .low_m = { -HALF_M, -HALF_M }, .high_m = { HALF_M, HALF_M }, .ground = &ground, .n = 1 };
        ok = bounced_shade(image, &in, err);
        for (int i = 0; i < 2 * SIDE; i++) {
            struct sky_seen seen = sky_sight_at(sight, vec3(-HALF_M + (i + 0.5) * HALF_M / SIDE, 0.1, 0), flat.normal);
            left[i / 2] = (i % 2 ? left[i / 2] : 0) + seen.with[1] / seen.without[1] / 2;
        }
    }
    sky_sight_destroy(sight);
    tracer_destroy(tracer);
    solid_free(&wall);
    return ok;
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct light light;
    struct image image;
    double left[SIDE];
    if (OK(shade(&image, &light, left, false, &err), "ground below an even sky: %s", err.text)) {
        for (int column = 9; column < SIDE; column += 2)
            NEAR(albedo_at(&image, column), ALBEDO * left_in(column), 0.015, "column %d sends back what is left of the sky", column);
        NEAR(albedo_at(&image, 4), albedo_at(&image, SIDE - 1 - 4), 0.015, "and so it is behind the wall");
        image_release(&image);
        light_release(&light);
    }
    if (OK(shade(&image, &light, left, true, &err), "with a sun: %s", err.text)) {
        double sky[3], open[3];
        light_sky_irradiance(sky, &light, flat.normal);
        light_irradiance(open, &light, flat.normal);
        OK(open[1] > 1.3 * sky[1], "that matters (%.2f of %.2f)", sky[1], open[1]);
        double lit = (left[10] * sky[1] + open[1] - sky[1]) / open[1];
        NEAR(albedo_at(&image, 10), ALBEDO * lit, 0.015, "where the sun shines all of the sun is sent back");
        NEAR(albedo_at(&image, 5), ALBEDO * left[5], 0.015, "in the wall's shadow, the sky alone");
        image_release(&image);
        light_release(&light);
    }
    return tap_done();
}

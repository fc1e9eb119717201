/* What stands round the entities, from pictures that were drawn by hand. */
#include "gen/light/panorama.h"

#include "gen/light/sky_image.h"
#include "gen/light/unhidden.h"
#include "tests/gen/place.h"
#include "tests/gen/view_above.h"
#include "tests/tap.h"

enum { WIDTH = 400, HEIGHT = 300 };

static const struct camera camera = { .model = CAMERA_PINHOLE, .width_px = WIDTH, .height_px = HEIGHT, .params = { 200, 200, 200, 150 } };
/* 6 m above the ground, level, along +y: ground is ground for sqrt(0.5 m * 6 m * 200) = 24.495 m. */
static const struct pose level = { { { { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } } }, { 0, 0, 6 } };
static struct image picture;

static void radiance_at(double rgb[3], const struct image *image, double azimuth_deg, double elevation_deg)
{
    int x = (int)(azimuth_deg / 360 * image->width_px), y = (int)((90 - elevation_deg) / 180 * image->height_px);
    for (int c = 0; c < 3; c++) rgb[c] = (double)image_f32(image, x, y)[c];
}

static void near_radiance(const struct image *image, double azimuth_deg, double elevation_deg, double r, double g, double b, const char *what)
{
    double rgb[3], want[3] = { r, g, b };
    radiance_at(rgb, image, azimuth_deg, elevation_deg);
    for (int c = 0; c < 3; c++) NEAR(rgb[c], want[c], 0.01 * want[c] + 0.002, "%s, channel %d", what, c);
}

static void paint_red_above(uint8_t srgb[3], const float p[3])
{
    memcpy(srgb, p[2] > 0.5f && p[2] < 0.9f ? (uint8_t[]){ 220, 10, 10 } : (uint8_t[]){ 128, 128, 128 }, 3);
}

static double degrees(double radians) { return radians * 180 / M_PI; }

static struct panorama_input input(const struct seen *seen, const struct light *light)
{
    return (struct panorama_input){ .seen = seen, .light = light, .from_m = { 0, 10, 1 }, .height_m = 6, .color_gain = { 2, 2, 2 } };
}

static void over_a_plane(const struct light *light)
{
    struct error err = ERROR_NONE;
    struct panorama p;
    struct image lighting;
    struct seen seen = { .picture = &picture, .camera = &camera, .world_from_camera = level, .k = { 0.5, 0.5, 0.5 } };
    seen_init(&seen);
    struct panorama_input in = input(&seen, light);
    /* Grey; a sign at 24.495 m, from 8 to 10 m high and 2 m wide: 16.33 to 32.66 px above the middle, 8.2 px to each side. */
    fill_px(&picture, 0, 0, WIDTH, HEIGHT, 0.1, 0.1, 0.1);
    fill_px(&picture, 192, 117, 208, 134, 0.1, 0.2, 0.4);
    if (!OK(panorama_create(&p, &in, &err), "over a plane")) return;
    NEAR(p.radius_m, 24.4949, 1e-3, "the circle begins where the ground ends");
    if (!OK(panorama_lighting(&lighting, &p, light, &err), "and at the size of the sky")) return;
    OK(p.radiance.width_px == 1024 && lighting.width_px == light->sky.width_px, "which is coarser");
    double up = degrees(atan2(8, 14.495));
    near_radiance(&p.radiance, 90, up, 0.2, 0.4, 0.8, "the sign is where it stands: 14.5 m from here, 8 m higher");
    near_radiance(&p.radiance, 90, degrees(atan2(6.3, 14.495)), 0.2, 0.2, 0.2, "below it is what the picture shows below it");
    near_radiance(&p.radiance, 90 + degrees(atan2(1.6, 14.495)), up, 0.2, 0.2, 0.2, "and beside it what it shows there");
    /* A grey wall that shows its shaded side ahead is sunlit behind the camera, or the other way round. */
    double ahead[3], behind[3];
    light_irradiance(ahead, light, vec3(0, -1, 0));
    light_irradiance(behind, light, vec3(0, 1, 0));
    near_radiance(&p.radiance, 270, 3, 0.2 * behind[0] / ahead[0], 0.2 * behind[1] / ahead[1], 0.2 * behind[2] / ahead[2],
                  "behind the camera it goes on, lit as the side that is seen there");
    OK(fabs(behind[0] / ahead[0] - 1) > 0.3, "which is lit otherwise (%.2f)", behind[0] / ahead[0]);
    /* A picture dark to one side and bright to the other: no neighbours round the circle differ as much. */
    double step = 0;
    for (int x = 0; x < WIDTH; x++) fill_px(&picture, x, 0, x + 1, HEIGHT, 0.1 + 0.8 * x / WIDTH, 0.2, 0.2);
    struct panorama slope;
    if (OK(panorama_create(&slope, &in, &err), "a picture that brightens to one side")) {
        int row = slope.radiance.height_px / 2 - 3;
        for (int x = 0; x < slope.radiance.width_px; x++)
            step = fmax(step, fabs((double)(image_f32(&slope.radiance, x, row)[0] - image_f32(&slope.radiance, (x + 1) % slope.radiance.width_px, row)[0])));
        OK(step < 0.06, "goes round without a seam (%.3f)", step);
        panorama_release(&slope);
    }
    /* A post in the middle of the picture, as far up as it goes. */
    struct image unhidden = { 0 };
    struct panorama post;
    fill_px(&picture, 0, 0, WIDTH, HEIGHT, 0.1, 0.1, 0.1);
    fill_px(&picture, 195, 0, 205, HEIGHT, 0.8, 0.1, 0.1);
    struct occluder outline = { .polygon_px = (struct vec2[]){ { 195, 0 }, { 205, 0 }, { 205, HEIGHT }, { 195, HEIGHT } }, .polygon_count = 4 };
    seen.unhidden = &unhidden;
    if (OK(unhidden_create(&unhidden, &outline, 1, WIDTH, HEIGHT, &err) && panorama_create(&post, &in, &err), "with a post in the middle")) {
        near_radiance(&post.radiance, 90 + degrees(atan2(1.6, 14.495)), up, 0.2, 0.2, 0.2, "what is beside it is there");
        near_radiance(&post.radiance, 90, degrees(atan2(2, 14.495)), 0.2, 0.2, 0.2, "and so it is instead of the post");
        panorama_release(&post);
        image_release(&unhidden);
    }
    seen.unhidden = NULL;
    double sky[3], model[3];
    radiance_at(sky, &p.radiance, 30, 75);
    light_sky_radiance(model, light, vec3(cos(M_PI / 6) * cos(75 * M_PI / 180), sin(M_PI / 6) * cos(75 * M_PI / 180), sin(75 * M_PI / 180)));
    for (int c = 0; c < 3; c++) NEAR(sky[c], model[c], 0.03 * model[c], "above is the sky, channel %d", c);
    double sum[2][3] = { { 0 } };
    for (int k = 0; k < 2; k++) {
        const struct image *image = k ? &lighting : &p.radiance;
        for (int y = 0; y < image->height_px / 2; y++)
            for (int x = 0; x < image->width_px; x++)
                for (int c = 0; c < 3; c++) sum[k][c] += sky_level_weight(image, y) * (double)image_f32(image, x, y)[c];
    }
    for (int c = 0; c < 3; c++) NEAR(sum[1][c], sum[0][c], 0.005 * sum[0][c], "both send as much light down, channel %d", c);
    image_release(&lighting);
    panorama_release(&p);

    /* A sky that the sensor could not hold. */
    fill_px(&picture, 0, 0, WIDTH, 140, 1, 1, 1);
    for (int c = 0; c < 3; c++) seen.k[c] = 10;
    if (OK(panorama_create(&p, &in, &err), "a white sky")) {
        radiance_at(sky, &p.radiance, 90, 30);
        light_sky_radiance(model, light, vec3(0, cos(M_PI / 6), sin(M_PI / 6)));
        OK(sky[0] >= 0.95 * model[0], "is as bright as the sky's model, or more (%.3f, %.3f)", sky[0], model[0]);
        panorama_release(&p);
    }

    /* A camera that looks down shows nothing that stands. */
    seen.world_from_camera = looking(vec3(0, 0, 30), vec3(0, 1, 0));
    seen_init(&seen);
    in.height_m = 30;
    if (OK(panorama_create(&p, &in, &err) && panorama_lighting(&lighting, &p, light, &err), "from above")) {
        int other = 0;
        for (int y = 0; y < lighting.height_px / 2; y++)
            for (int x = 0; x < lighting.width_px; x++)
                other += fabsf(image_f32(&lighting, x, y)[1] / image_f32(&light->sky, x, y)[1] - 1) > 0.1f;
        OK(other == 0 && !(p.radius_m > 0), "there is the sky alone");
        image_release(&lighting);
        panorama_release(&p);
    }
}

/* The picture's upper half, above the horizon: something grey on the left, the sky on the right. What stands around is told or assumed, 70 degrees
 * high, higher than the picture goes. */
static void with_a_skyline(const struct scene *open_scene)
{
    struct error err = ERROR_NONE;
    struct panorama p;
    struct light light;
    double point[1][2] = { { 0, 70 * M_PI / 180 } }, rgb[3], stands[3];
    struct scene scene = *open_scene;
    scene.skyline = (struct scene_skyline){ .point_rad = point, .count = 1, .albedo = { 0.05, 0.05, 0.05 } };
    if (!OK(light_create(&light, &scene, &err), "a light between houses")) return;
    struct seen seen = { .picture = &picture, .camera = &camera, .world_from_camera = level, .k = { 0.5, 0.5, 0.5 } };
    seen_init(&seen);
    struct panorama_input in = input(&seen, &light);
    fill_px(&picture, 0, 0, WIDTH, HEIGHT, 0.1, 0.1, 0.1);
    fill_px(&picture, WIDTH / 2, 0, WIDTH, 145, 0.4, 0.7, 1);
    for (int told = 0; told < 2; told++) {
        in.told = told;
        if (!OK(panorama_create(&p, &in, &err), "what stands around is %s", told ? "told" : "assumed")) continue;
        near_radiance(&p.radiance, 105, 30, 0.2, 0.2, 0.2, "what the picture shows counts before it");
        radiance_at(rgb, &p.radiance, 75, 30);
        OK(rgb[2] > 1.9, "also the sky that it shows (%.2f)", rgb[2]);
        struct vec3 above_sky = vec3(cos(1.1) * cos(1.3), cos(1.1) * sin(1.3), sin(1.1)), above_grey = vec3(cos(1.1) * cos(1.8), cos(1.1) * sin(1.8), sin(1.1));
        radiance_at(rgb, &p.radiance, degrees(1.3), degrees(1.1));
        light_sky_radiance(stands, &light, above_sky);
        OK(rgb[2] > 3 * stands[2], "above a sky that is seen nothing stands (%.3f, %.3f)", rgb[2], stands[2]);
        radiance_at(rgb, &p.radiance, degrees(1.8), degrees(1.1));
        light_sky_radiance(stands, &light, above_grey);
        NEAR(rgb[2], stands[2], 0.05 * stands[2], "above what stands it goes on");
        int bright = 0, n = 0;
        for (int azimuth = 200; azimuth < 340; azimuth++, n++) {
            radiance_at(rgb, &p.radiance, azimuth, 30);
            bright += rgb[2] > 1;
        }
        OK(told ? bright == 0 : bright > n / 4, "behind the camera the sky of the picture is %s mirrored (%d of %d)", told ? "not" : "also", bright, n);
        panorama_release(&p);
    }
    light_release(&light);
}

/* A wall 5 m ahead of the body and 3 m high, and one behind the camera; the mesh is grey of 128, 0.21586 linear. */
static void over_a_place(const struct light *light)
{
    struct error err = ERROR_NONE;
    struct panorama p;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct image depth = { 0 };
    struct seen seen = { .picture = &picture, .camera = &camera, .world_from_camera = level, .k = { 0.5, 0.5, 0.5 } };
    seen_init(&seen);
    struct panorama_input in = input(&seen, light);
    place_ground(&place, 0, 0);
    place_wall(&place, -20, 20, 15, 0, 3, 0);
    place_wall(&place, -20, 20, -9, 0, 3, 0);
    fill_px(&picture, 0, 0, WIDTH, HEIGHT, 0.1, 0.1, 0.1);
    /* 1.88 m up on the wall, 10 degrees above the body: 4.12 / 15 * 200 = 54.9 px below the middle. */
    fill_px(&picture, 190, 200, 210, 210, 0.4, 0.1, 0.1);
    if (!OK(place_mesh(&mesh, &place, false, &err) && image_init(&depth, WIDTH, HEIGHT, 1, PIXEL_F32, &err), "a place")) return;
    for (int i = 0; i < WIDTH * HEIGHT; i++) ((float *)depth.data)[i] = i < WIDTH * 150 ? NAN : 15;
    in.place = mesh;
    in.place_depth = &depth;
    if (OK(panorama_create(&p, &in, &err), "over a place")) {
        near_radiance(&p.radiance, 90, 10, 0.8, 0.2, 0.2, "what the picture shows on a wall is there");
        near_radiance(&p.radiance, 90, 3, 0.2, 0.2, 0.2, "and not lower");
        near_radiance(&p.radiance, 90, -20, 0.2, 0.2, 0.2, "below the horizon the ground is as the picture shows it");
        near_radiance(&p.radiance, 270, 3, 0.43172, 0.43172, 0.43172, "a wall that the picture does not show has the mesh's colour");
        double sky[3], model[3];
        radiance_at(sky, &p.radiance, 270, 30);
        light_sky_radiance(model, light, vec3(0, -cos(M_PI / 6), sin(M_PI / 6)));
        NEAR(sky[2], model[2], 0.03 * model[2], "above it is the sky");
        panorama_release(&p);
    }
    /* Something 8 m away that the mesh has 3 px beside what is looked at on the red patch: the picture may show it there. */
    for (int y = 195; y < 215; y++)
        for (int x = 205; x < 240; x++) *image_f32(&depth, x, y) = 8;
    if (OK(panorama_create(&p, &in, &err), "with something before it")) {
        near_radiance(&p.radiance, 88, 10, 0.43172, 0.43172, 0.43172, "beside an outline of the mesh its own colour counts");
        panorama_release(&p);
    }
    static_mesh_destroy(mesh);
    place_free(&place);
    image_release(&depth);
}

/* A board 3 m ahead of the body, red in the picture, and a wall 30 m ahead. */
static void beyond(const struct light *light)
{
    struct error err = ERROR_NONE;
    struct panorama p;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct image depth = { 0 };
    struct seen seen = { .picture = &picture, .camera = &camera, .world_from_camera = level, .k = { 0.5, 0.5, 0.5 } };
    seen_init(&seen);
    struct panorama_input in = input(&seen, light);
    place_ground(&place, 0, 0);
    place_wall(&place, -1, 1, 13, 0, 6, 0);
    place_wall(&place, -30, 30, 40, 0, 12, 0);
    fill_px(&picture, 0, 0, WIDTH, HEIGHT, 0.1, 0.1, 0.1);
    fill_px(&picture, 184, 150, 216, 243, 0.4, 0.1, 0.1);
    if (!OK(place_mesh(&mesh, &place, false, &err) && image_init(&depth, WIDTH, HEIGHT, 1, PIXEL_F32, &err), "a board before a wall")) return;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            bool board = x >= 184 && x < 216 && y >= 150 && y < 243;
            *image_f32(&depth, x, y) = board ? 13 : y < 180 ? 40 : 1200.0f / ((float)y - 149.5f);
        }
    in.place = mesh;
    in.place_depth = &depth;
    if (OK(panorama_create(&p, &in, &err), "all of it")) {
        near_radiance(&p.radiance, 90, 5, 0.8, 0.2, 0.2, "the board is there");
        panorama_release(&p);
    }
    in.beyond_m = 20;
    if (OK(panorama_create(&p, &in, &err), "what is 20 m away and more")) {
        near_radiance(&p.radiance, 90, 5, 0.43172, 0.43172, 0.43172, "in place of the board is the wall behind it, in the mesh's colour");
        near_radiance(&p.radiance, 90, -2.5, 0.43172, 0.43172, 0.43172, "and the ground behind it");
        near_radiance(&p.radiance, 120, 5, 0.2, 0.2, 0.2, "beside it the wall is as the picture shows it");
        near_radiance(&p.radiance, 60, -20, 0.2, 0.2, 0.2, "ground stays, though it is nearer");
        panorama_release(&p);
    }
    static_mesh_destroy(mesh);
    place_free(&place);
    image_release(&depth);
}

/* The place ends 30 m before the camera, 40 px below the horizon: what the picture shows past it stands far off, or 50 m from the body. */
static void past_a_place(const struct light *light)
{
    struct error err = ERROR_NONE;
    struct panorama p;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct image depth = { 0 };
    struct seen seen = { .picture = &picture, .camera = &camera, .world_from_camera = level, .k = { 0.5, 0.5, 0.5 } };
    seen_init(&seen);
    struct panorama_input in = input(&seen, light);
    place_quad(&place, (const double[4][3]){ { -50, -10, 0 }, { 50, -10, 0 }, { 50, 30, 0 }, { -50, 30, 0 } }, 0);
    /* A board 5 m before the camera, behind the body, that hides what is past it on the left; and a red table there. */
    place_wall(&place, -3, -1.5, 5, 0, 8, 0);
    place.paint = paint_red_above;
    place_quad(&place, (const double[4][3]){ { -10, 14, 0.6 }, { -6, 14, 0.6 }, { -6, 20, 0.6 }, { -10, 20, 0.6 } }, 0);
    if (!OK(place_mesh(&mesh, &place, false, &err) && image_init(&depth, WIDTH, HEIGHT, 1, PIXEL_F32, &err), "a place that ends")) return;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) *image_f32(&depth, x, y) = x >= 80 && x < 140 && y >= 70 ? 5 : y >= 190 ? 1200.0f / ((float)y - 149.5f) : NAN;
    fill_px(&picture, 0, 0, WIDTH, HEIGHT, 0.1, 0.1, 0.1);
    fill_px(&picture, 80, 70, 140, HEIGHT, 0.1, 0.4, 0.1);
    /* Above the horizon, 90 px aside and 25 px up. */
    fill_px(&picture, 280, 117, 300, 133, 0.4, 0.1, 0.1);
    /* On the ground, 8 to 12 m aside 40 m before the camera: 6 / 40 * 200 = 30 px below the horizon. */
    fill_px(&picture, 238, 174, 262, 186, 0.1, 0.1, 0.4);
    in.place = mesh;
    in.place_depth = &depth;
    in.past_m = 1e6;
    if (OK(panorama_create(&p, &in, &err), "past its end")) {
        double aside = degrees(atan2(90, 200)), up = degrees(atan2(25, hypot(90, 200))), sky[3], model[3];
        OK(!(p.radius_m > 0), "nothing stands on a circle");
        near_radiance(&p.radiance, 90 - aside, up, 0.8, 0.2, 0.2, "what is above the horizon is in the direction in which the camera sees it");
        near_radiance(&p.radiance, 90 - aside - 5, up, 0.2, 0.2, 0.2, "and not further aside, as if it were near");
        near_radiance(&p.radiance, 90 - aside, up + 4, 0.2, 0.2, 0.2, "nor higher");
        near_radiance(&p.radiance, 90 - degrees(atan2(10, 30)), -degrees(atan2(1, hypot(10, 30))), 0.2, 0.2, 0.8, "ground is where it lies: 30 m from here, 10 m aside");
        near_radiance(&p.radiance, 90, -degrees(atan2(1, 30)), 0.2, 0.2, 0.2, "beside it is what the picture shows beside it");
        near_radiance(&p.radiance, 90 - degrees(atan2(50, 200)), -degrees(atan2(30, hypot(50, 200))), 0.2, 0.2, 0.2, "the place is nearer than it");
        near_radiance(&p.radiance, 90 - degrees(atan2(50, 200)), -0.9, 0.2, 0.2, 0.2, "and farther off it ends");
        /* Through the middle of the board, 10 degrees up; and to (-18, 40), which it hides. */
        radiance_at(sky, &p.radiance, 90 + degrees(atan2(90, 200)), 10);
        light_sky_radiance(model, light, vec3(-sin(atan2(90, 200)) * cos(M_PI / 18), cos(atan2(90, 200)) * cos(M_PI / 18), sin(M_PI / 18)));
        for (int c = 0; c < 3; c++) NEAR(sky[c], model[c], 0.03 * model[c], "where the picture shows the place there is the sky past it, channel %d", c);
        near_radiance(&p.radiance, 90 + degrees(atan2(18, 30)), -degrees(atan2(1, hypot(18, 30))), 0.43172, 0.43172, 0.43172,
                      "or ground that goes on as where the place ends");
        double turn = 90 + degrees(atan2(7.3, 7)), there[3], on[3];
        radiance_at(there, &p.radiance, turn, -degrees(atan2(0.4, hypot(7.3, 7))));
        radiance_at(on, &p.radiance, turn, -0.2);
        OK(there[0] > 20 * there[1], "the table is there (%.3f, %.3f)", there[0], there[1]);
        OK(on[0] < 1.05 * on[1] && on[0] > 0.15, "but ground does not go on as a table (%.3f, %.3f)", on[0], on[1]);
        panorama_release(&p);
    }
    in.past_m = 50;
    if (OK(panorama_create(&p, &in, &err), "past its end, 50 m from the body")) {
        /* The camera sees (0.45 y, y), as far from the body: y = 53.76 m. */
        struct vec3 way = vec3(0.45 * 53.76, 53.76 - 10, 6 + 25.0 / 200 * 53.76 - 1);
        double aside = degrees(atan2(way.x, way.y)), up = degrees(atan2(way.z, 50));
        near_radiance(&p.radiance, 90 - aside, up, 0.8, 0.2, 0.2, "what is above the horizon stands there");
        near_radiance(&p.radiance, 90 - degrees(atan2(90, 200)), up, 0.2, 0.2, 0.2, "and not in the direction in which the camera sees it");
        panorama_release(&p);
    }
    /* White from the horizon to 20 px above it: 5 m up, 50 m away, is lower than the camera, and no sky. */
    fill_px(&picture, 190, 130, 210, 190, 1, 1, 1);
    if (OK(panorama_create(&p, &in, &err), "with something white there")) {
        near_radiance(&p.radiance, 90, degrees(atan2(3, 50)), 2, 2, 2, "below the camera's height it is as bright as it is shown");
        panorama_release(&p);
    }
    static_mesh_destroy(mesh);
    place_free(&place);
    image_release(&depth);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct light light;
    struct scene scene = { .path = "scene.yaml", .sky = SKY_CLEAR, .sun = SUN_GIVEN, .sun_azimuth_rad = 4, .sun_elevation_rad = M_PI / 4, .turbidity = 3,
                           .sun_scale = 1, .ground = { { 0, 0, 1 }, 0 }, .ground_albedo = { 0.3, 0.3, 0.3 } };
    if (!OK(light_create(&light, &scene, &err) && image_init(&picture, WIDTH, HEIGHT, 3, PIXEL_U8, &err), "light and a picture")) return tap_done();
    over_a_plane(&light);
    over_a_place(&light);
    past_a_place(&light);
    beyond(&light);
    with_a_skyline(&scene);
    image_release(&picture);
    light_release(&light);
    return tap_done();
}

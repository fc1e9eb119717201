/* Ground rectified from pictures that were drawn by hand: where things lie follows from similar triangles. */
#include "gen/light/orthophoto.h"

#include "tests/gen/place.h"
#include "tests/gen/solid.h"
#include "tests/gen/view_above.h"
#include "tests/tap.h"

enum { WIDTH = 400, HEIGHT = 300 };

static const struct camera camera = { .model = CAMERA_PINHOLE, .width_px = WIDTH, .height_px = HEIGHT, .params = { 200, 200, 200, 150 } };
/* 20 m above (3, 4), north at the top: 10 px a metre. */
static const struct pose above = { { { { 1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } } }, { 3, 4, 20 } };
static struct image picture;

/* Albedo of a texel, or of a coarse one. */
static void albedo_at(double rgb[3], const struct orthophoto *o, const struct image *image, double x, double y)
{
    int column = (int)((x - o->low_m.x) / (o->high_m.x - o->low_m.x) * image->width_px);
    int row = (int)((o->high_m.y - y) / (o->high_m.y - o->low_m.y) * image->height_px);
    for (int c = 0; c < 3; c++) rgb[c] = (double)linear_from_srgb((float)image_u8(image, column, row)[c] / 255);
}

static void near_albedo(const struct orthophoto *o, const struct image *image, double x, double y, double r, double g, double b,
                        const char *what)
{
    double rgb[3], want[3] = { r, g, b };
    albedo_at(rgb, o, image, x, y);
    for (int c = 0; c < 3; c++) NEAR(rgb[c], want[c], 0.012 * want[c] + 0.002, "%s, channel %d", what, c);
}

static struct scene sunny(void)
{
    return (struct scene){ .path = "scene.yaml", .sky = SKY_CLEAR, .sun = SUN_GIVEN, .sun_azimuth_rad = M_PI / 2, .sun_elevation_rad = M_PI / 4,
                           .turbidity = 3, .sun_scale = 1, .ground = { { 0, 0, 1 }, 0 }, .ground_albedo = { 0.3, 0.3, 0.3 } };
}

static void over_a_plane(const struct light *light, const struct entity *entities, size_t n)
{
    const double *e = light->irradiance, k[3] = { 0.9, 1.1, 0.7 };
    struct plane ground = { { 0, 0, 1 }, 0 };
    struct error err = ERROR_NONE;
    struct orthophoto o;
    struct seen seen = { .picture = &picture, .camera = &camera, .world_from_camera = above, .k = { k[0], k[1], k[2] } };
    seen_init(&seen);
    struct orthophoto_input in = { .seen = &seen, .light = light, .ground = &ground, .entities = entities, .n = n, .ground_albedo = { 0.3, 0.3, 0.3 } };
    /* Ground of albedo 0.2, 0.25, 0.3; a block of 0.6, 0.1, 0.1 from (5, 6) to (6, 8): right 20 to 30 px, up 20 to 40. */
    fill_px(&picture, 0, 0, WIDTH, HEIGHT, 0.2 * e[0] * k[0], 0.25 * e[1] * k[1], 0.3 * e[2] * k[2]);
    fill_px(&picture, 220, 110, 230, 130, 0.6 * e[0] * k[0], 0.1 * e[1] * k[1], 0.1 * e[2] * k[2]);
    if (!OK(orthophoto_create(&o, &in, &err), "a plane")) return;
    near_albedo(&o, &o.mirrored, 2, 3, 0.2, 0.25, 0.3, "radiance over the light in the open is the ground's albedo");
    near_albedo(&o, &o.mirrored, 5.2, 6.3, 0.6, 0.1, 0.1, "a block is where it lies");
    near_albedo(&o, &o.mirrored, 5.8, 7.8, 0.6, 0.1, 0.1, "to its corners");
    near_albedo(&o, &o.mirrored, 6.2, 6.3, 0.2, 0.25, 0.3, "and not beyond");
    near_albedo(&o, &o.mirrored, 5.2, 8.2, 0.2, 0.25, 0.3, "to no side");
    near_albedo(&o, &o.mirrored, -25, 3, 0.2, 0.25, 0.3, "ground that the picture does not show is as what it shows");
    near_albedo(&o, &o.mirrored, o.low_m.x + 0.1, o.low_m.y + 0.1, 0.2, 0.25, 0.3, "and so is all the rest");
    NEAR(o.elsewhere[1], 0.25, 0.003, "which goes on beyond");
    double low = 1, high = 0, coarse[3];
    for (double x = 4; x < 7; x += 0.1) {
        albedo_at(coarse, &o, &o.bouncing, x, 7);
        low = fmin(low, coarse[0]), high = fmax(high, coarse[0]);
    }
    OK(low < 0.21 && high > 0.3 && high < 0.601, "where light bounces it is blurred (%.3f to %.3f)", low, high);
    OK(image_u8(&o.mirrored, 0, 0)[0] == image_u8(&o.mirrored, o.mirrored.width_px - 1, 40)[0], "its edges are the rest");
    orthophoto_release(&o);

    /* From frame to frame: somebody moves on, and there is other noise. */
    struct entity moved[2] = { entities[0], entities[1] };
    struct orthophoto next;
    int other = 0;
    double before[3], after[3];
    moved[0].world_from_entity.translation.x += 0.37;
    in.entities = moved;
    if (OK(orthophoto_create(&o, &in, &err), "the next frame")) {
        for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) ((uint8_t *)picture.data)[i] += (uint8_t)((uint32_t)i * 2654435761u >> 30);
        in.entities = entities;
        if (OK(orthophoto_create(&next, &in, &err), "with other noise")) {
            for (double x = -4; x < 8; x += 0.5) {
                albedo_at(before, &o, &o.bouncing, x, 3);
                albedo_at(after, &next, &next.bouncing, x, 3);
                other += fabs(before[1] / after[1] - 0.975) > 0.015;
            }
            OK(other == 0, "bounces the same but for the noise's mean (%d)", other);
            orthophoto_release(&next);
        }
        for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) ((uint8_t *)picture.data)[i] -= (uint8_t)((uint32_t)i * 2654435761u >> 30);
        if (OK(orthophoto_create(&next, &in, &err), "with the same")) {
            other = 0;
            for (double y = -2; y < 9; y += 0.11)
                for (double x = -2; x < 8; x += 0.11) {
                    albedo_at(before, &o, &o.mirrored, x, y);
                    albedo_at(after, &next, &next.mirrored, x, y);
                    other += memcmp(before, after, sizeof before) != 0;
                }
            OK(other == 0, "texels stay where they are, to the bit (%d)", other);
            orthophoto_release(&next);
        }
        orthophoto_release(&o);
    }
    in.entities = entities;

    /* A tall thing hides ground: what it shows is not taken for ground. */
    struct image unhidden = { 0 };
    if (!image_init(&unhidden, WIDTH, HEIGHT, 1, PIXEL_U8, &err)) return;
    memset(unhidden.data, 255, image_size(&unhidden));
    for (int y = 110; y < 130; y++) memset(image_u8(&unhidden, 220, y), 0, 10);
    seen.unhidden = &unhidden;
    if (OK(orthophoto_create(&o, &in, &err), "with an occluder")) {
        near_albedo(&o, &o.mirrored, 5.5, 7, 0.2, 0.25, 0.3, "what it hides is filled with what is round it");
        orthophoto_release(&o);
    }
    image_release(&unhidden);
    seen.unhidden = NULL;

    /* Behind 20 m of air that keeps half of the light back, with haze of 0.4 before it. */
    double haze = 0.4, t = 0.5;
    fill_px(&picture, 0, 0, WIDTH, HEIGHT, 0.2 * e[0] * k[0] * t + haze * (1 - t), 0.25 * e[1] * k[1] * t + haze * (1 - t),
            0.3 * e[2] * k[2] * t + haze * (1 - t));
    seen.visibility_m = 20 * log(0.05) / log(0.5);
    for (int c = 0; c < 3; c++) seen.haze[c] = haze;
    if (OK(orthophoto_create(&o, &in, &err), "in mist")) {
        double rgb[3];
        albedo_at(rgb, &o, &o.mirrored, 3, 4);
        NEAR(rgb[1], 0.25, 0.01, "the air is taken away");
        orthophoto_release(&o);
    }
}

/* Level ground at 0 with a wall 2 m high at x = 8, and the sun in the east; the mesh is grey of 128, 0.21586 linear. */
static void over_a_place(const struct light *light, const struct entity *entities, size_t n)
{
    const double *e = light->irradiance;
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct orthophoto o;
    struct image depth = { 0 };
    place_quad(&place, (const double[4][3]){ { -50, -50, 0 }, { 50, -50, 0 }, { 50, 50, 0 }, { -50, 50, 0 } }, 0);
    place_quad(&place, (const double[4][3]){ { 8, -50, 0 }, { 8, 50, 0 }, { 8, 50, 2 }, { 8, -50, 2 } }, 0);
    /* The wall's shade under a sun at 45 degrees reaches 2 m, from x = 6 to 8: 30 to 50 px right of the middle. */
    double sky[3];
    light_sky_irradiance(sky, light, vec3(0, 0, 1));
    fill_px(&picture, 0, 0, WIDTH, HEIGHT, 0.3 * e[0], 0.3 * e[1], 0.3 * e[2]);
    fill_px(&picture, 230, 0, 250, HEIGHT, 0.3 * sky[0], 0.3 * sky[1], 0.3 * sky[2]);
    struct seen seen = { .picture = &picture, .camera = &camera, .world_from_camera = above, .k = { 1, 1, 1 } };
    seen_init(&seen);
    struct orthophoto_input in = { .seen = &seen, .light = light, .place = NULL, .place_depth = &depth, .entities = entities, .n = n, .ground_albedo = { 0.3, 0.3, 0.3 } };
    if (!OK(place_mesh(&mesh, &place, false, &err) && image_init(&depth, WIDTH, HEIGHT, 1, PIXEL_F32, &err), "a place")) return;
    for (int i = 0; i < WIDTH * HEIGHT; i++) ((float *)depth.data)[i] = 20;
    in.place = mesh;
    if (OK(orthophoto_create(&o, &in, &err), "its ground")) {
        near_albedo(&o, &o.mirrored, 2, 3, 0.3, 0.3, 0.3, "in the sun, over the light of the open");
        near_albedo(&o, &o.mirrored, 7, 3, 0.3, 0.3, 0.3, "in the shade of the place, over the sky's: it is the same ground");
        for (int c = 0; c < 3; c++) NEAR(o.color_gain[c], 0.3 * e[c] / 0.21586, 0.02 * e[c], "how the mesh's own colours become light");
        near_albedo(&o, &o.mirrored, -21, 3, 0.3, 0.3, 0.3, "which is what they are where the picture shows nothing");
        orthophoto_release(&o);
    }
    static_mesh_destroy(mesh);
    place_free(&place);
    image_release(&depth);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct light light;
    struct scene scene = sunny();
    struct solid box;
    solid_box(&box, 4, 2, 1.5);
    struct entity entities[2] = {
        { .id = 1, .name = "a", .model_name = "a", .class_ = CLASS_CAR, .model = &box.model, .world_from_entity = pose_identity() },
        { .id = 2, .name = "b", .model_name = "b", .class_ = CLASS_CAR, .model = &box.model, .world_from_entity = { mat3_identity(), { -20, 0, 0 } } },
    };
    if (!OK(light_create(&light, &scene, &err) && image_init(&picture, WIDTH, HEIGHT, 3, PIXEL_U8, &err), "light and a picture")) return tap_done();
    over_a_plane(&light, entities, 2);
    over_a_place(&light, entities, 2);
    image_release(&picture);
    light_release(&light);
    solid_free(&box);
    return tap_done();
}

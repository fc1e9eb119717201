/* What mirror balls show of surroundings taken from a picture, as POV-Ray renders them. */
#include "gen/light/sky_image.h"
#include "tests/gen/ball.h"
#include "tests/gen/place.h"

/* Where in the picture a mirror ball shows a point: light takes the shortest way by its surface (Fermat). */
static struct vec2 mirrored_at(struct vec3 point)
{
    double low_a = 0, high_a = M_PI, low_b = -M_PI, high_b = M_PI, best_a = 0, best_b = 0;
    for (int round = 0; round < 12; round++) {
        double least = INFINITY, wa = high_a - low_a, wb = high_b - low_b;
        for (int i = 0; i <= 40; i++)
            for (int k = 0; k <= 40; k++) {
                double a = low_a + wa * i / 40, b = low_b + wb * k / 40;
                struct vec3 n = vec3(sin(a) * cos(b), sin(a) * sin(b), cos(a)), p = vec3_add(middle, n);
                if (vec3_dot(n, vec3_sub(eye, p)) <= 0 || vec3_dot(n, vec3_sub(point, p)) <= 0) continue;
                double way = vec3_norm(vec3_sub(eye, p)) + vec3_norm(vec3_sub(point, p));
                if (way < least) least = way, best_a = a, best_b = b;
            }
        low_a = best_a - wa / 10, high_a = best_a + wa / 10, low_b = best_b - wb / 10, high_b = best_b + wb / 10;
    }
    struct vec3 p = vec3_add(middle, vec3(sin(best_a) * cos(best_b), sin(best_a) * sin(best_b), cos(best_a)));
    struct vec3 ahead = vec3_unit(vec3_sub(middle, eye)), right = vec3_unit(vec3_cross(ahead, vec3(0, 0, 1))), way = vec3_sub(p, eye);
    double z = vec3_dot(way, ahead);
    return (struct vec2){ 80 + 180 * vec3_dot(way, right) / z, 60 - 180 * vec3_dot(way, vec3_cross(right, ahead)) / z };
}

static double red_at(const struct image *pass, int x, int y)
{
    const float *p = image_f32(pass, x, y);
    return p[3] >= 1 && p[0] > 2 * p[1] ? (double)(p[0] - p[1]) : 0;
}

/* The middle of what is red. Returns how red it is, in all. */
static double red_middle(struct vec2 *middle_px, const struct image *pass)
{
    double sum = 0, sx = 0, sy = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double redness = red_at(pass, x, y);
            sum += redness, sx += redness * (x + 0.5), sy += redness * (y + 0.5);
        }
    *middle_px = (struct vec2){ sx / sum, sy / sum };
    return sum;
}

static void test_mirror(const struct light *light, struct entity *entity, struct image *picture, struct vec3 marker)
{
    struct image pass = { 0 };
    const double *e = light->irradiance;
    fill_px(picture, 0, 0, WIDTH, HEIGHT, 0.2 * e[0], 0.2 * e[1], 0.2 * e[2]);
    struct pose camera_from_world = pose_inverse(looking(eye, middle));
    for (int y = 0; y < HEIGHT; y++) /* a square of 0.6 m round the marker, by its corner's rays */
        for (int x = 0; x < WIDTH; x++) {
            struct vec3 ray = mat3_apply(mat3_transpose(camera_from_world.rotation), vec3((x + 0.5 - 80) / 180, (y + 0.5 - 60) / 180, 1)), p;
            if (plane_intersect(&scene.ground, &p, eye, ray) && fabs(p.x - marker.x) < 0.3 && fabs(p.y - marker.y) < 0.3)
                fill_px(picture, x, y, x + 1, y + 1, 0.7 * e[0], 0.05 * e[1], 0.05 * e[2]);
        }
    if (!OK(render(&pass, light, entity, picture, NULL), "a mirror ball over a marker at (%g, %g)", marker.x, marker.y)) return;
    struct vec2 want = mirrored_at(marker), got;
    OK(red_middle(&got, &pass) > 0, "the ball shows it");
    NEAR(got.x, want.x, 1, "where its mirror image is, across");
    NEAR(got.y, want.y, 1, "and down");
    image_release(&pass);
}

/* A red board, 1 m wide and 1.6 m high, upright before the ball, facing the camera: the ball sees its back. */
static void test_upright(const struct light *light, struct entity *entity, struct image *picture)
{
    const double width = 1, height = 1.6, *e = light->irradiance;
    const struct vec3 foot = vec3(2, -1.8, 0), away = vec3_unit(vec3(foot.x - eye.x, foot.y - eye.y, 0)), right = vec3(away.y, -away.x, 0);
    const struct pose camera_from_world = pose_inverse(looking(eye, middle));
    struct vec2 polygon[4];
    struct image pass = { 0 };
    struct error err = ERROR_NONE;
    fill_px(picture, 0, 0, WIDTH, HEIGHT, 0.2 * e[0], 0.2 * e[1], 0.2 * e[2]);
    for (int i = 0; i < 4; i++) {
        struct vec3 p = vec3_add(foot, vec3_scale(right, (i == 0 || i == 3 ? -0.5 : 0.5) * width));
        p.z = i < 2 ? 0 : height;
        if (!OK(camera_project(&camera, &polygon[i], pose_apply(camera_from_world, p), &err), "corner %d is in the picture", i)) return;
    }
    struct occluder board = { .name = "board", .polygon_px = polygon, .polygon_count = 4, .foot_m = foot };
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            if (inside(&board, x, y)) fill_px(picture, x, y, x + 1, y + 1, 0.5 * e[0], 0.02 * e[1], 0.02 * e[2]);
    /* The ground that its upper part hides, beside it as the ball sees it. */
    struct vec3 beyond = vec3_add(vec3(eye.x, eye.y, 0), vec3_scale(vec3(foot.x - eye.x, foot.y - eye.y, 0), eye.z / (eye.z - 0.9 * height)));
    struct vec2 flat = mirrored_at(beyond);
    if (!OK(render(&pass, light, entity, picture, NULL), "a mirror ball beside something red")) return;
    OK(red_at(&pass, (int)flat.x, (int)flat.y) > 0, "untold, it lies on the ground");
    image_release(&pass);
    if (!OK(render(&pass, light, entity, picture, &board), "a mirror ball beside an upright board")) return;
    static const double across[] = { -0.3, 0, 0.3 }, up[] = { 0.3, 0.8, 1.3 };
    for (int i = 0; i < 9; i++) {
        struct vec3 p = vec3_add(foot, vec3(right.x * across[i % 3] * width, right.y * across[i % 3] * width, up[i / 3]));
        struct vec2 q = mirrored_at(p);
        OK(red_at(&pass, (int)q.x, (int)q.y) > 0.2 * e[0], "it is mirrored where it stands, %g m to the right, %g m up", across[i % 3], up[i / 3]);
    }
    struct vec2 over = mirrored_at(vec3_add(foot, vec3(0, 0, height + 0.6)));
    OK(!(red_at(&pass, (int)over.x, (int)over.y) > 0), "not above its height");
    OK(!(red_at(&pass, (int)flat.x, (int)flat.y) > 0), "and not on the ground");
    image_release(&pass);
}

/* A red disc of 6 degrees, 20 m from the camera, on a circle round it, past a place or without one, or on a wall of a place before the
 * circle, as it is seen from beside the ball: the ball mirrors it from where the ball is. */
static void test_circle(const struct light *light, struct entity *entity, struct image *picture, double radius_m,
                        const struct static_mesh *place)
{
    struct error err = ERROR_NONE;
    struct image pass = { 0 };
    struct vec3 disc = vec3(0.5 * 20, eye.y - sqrt(0.75) * 20, 6);
    circle.from_m = vec3(5, 3, 1);
    circle.centre_m = vec3(eye.x, eye.y, 0);
    circle.radius_m = radius_m;
    struct relief relief = { 0 };
    struct relief_input in = { .place = place, .from_m = circle.from_m };
    if (place && !OK(relief_create(&relief, &in, &err), "a relief of a wall")) return;
    circle.relief = place ? &relief : NULL;
    if (!OK(image_init(&circle.map, 512, 256, 3, PIXEL_F32, &err), "a picture of what stands around")) return;
    for (int y = 0; y < 256; y++)
        for (int x = 0; x < 512; x++) {
            bool red = vec3_dot(sky_direction(&circle.map, x, y), vec3_unit(vec3_sub(disc, circle.from_m))) > cos(6 * M_PI / 180);
            for (int c = 0; c < 3; c++) image_f32(&circle.map, x, y)[c] = c && red ? 0.01f : 0.5f;
        }
    fill_px(picture, 0, 0, WIDTH, HEIGHT, 0.2, 0.2, 0.2);
    struct vec2 got = { 0, 0 };
    double sum = 0;
    if (OK(render(&pass, light, entity, picture, NULL), "a mirror ball %s", place ? "before a wall" : radius_m > 0 ? "on a circle" : "below a far sky"))
        sum = red_middle(&got, &pass);
    struct vec2 want = mirrored_at(radius_m > 0 || place ? disc : vec3_add(middle, vec3_scale(vec3_sub(disc, circle.from_m), 1000)));
    OK(sum > 0, "the ball shows the disc");
    NEAR(got.x, want.x, 0.7, "%s, across", radius_m > 0 || place ? "where it stands" : "as far away as the sky it is in its direction");
    NEAR(got.y, want.y, 0.7, "and down");
    image_release(&pass);
    image_release(&circle.map);
    relief_release(&relief);
}

static void test_relief(const struct light *light, struct entity *entity, struct image *picture)
{
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    place_wall(&place, -40, 60, eye.y - sqrt(0.75) * 20, 0, 20, 0);
    if (OK(place_mesh(&mesh, &place, false, &err), "a wall")) {
        test_circle(light, entity, picture, 0, mesh);
        test_circle(light, entity, picture, 60, mesh);
    }
    static_mesh_destroy(mesh);
    place_free(&place);
    /* A wall that is before the circle, and beside the disc. */
    mesh = NULL;
    place = (struct place){ 0 };
    place_wall(&place, -12, -6, eye.y - 10, 0, 20, 0);
    if (OK(place_mesh(&mesh, &place, false, &err), "a short wall")) test_circle(light, entity, picture, 20, mesh);
    static_mesh_destroy(mesh);
    place_free(&place);
}

/* Past a place the map is red below the horizon, 60 m away; nearer, the ground is the orthophoto's. Without a map of the relief the
 * ground is level, and hides it. */
static void test_past_ground(const struct light *light, struct entity *entity, struct image *picture)
{
    struct error err = ERROR_NONE;
    struct image pass = { 0 };
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct relief relief = { 0 };
    struct relief_input in = { .from_m = { 5, 3, 1 } };
    place_wall(&place, -12, -6, eye.y - 10, 0, 2, 0);
    bool ok = place_mesh(&mesh, &place, false, &err) && image_init(&circle.map, 512, 256, 3, PIXEL_F32, &err);
    in.place = mesh;
    if (!OK(ok && relief_create(&relief, &in, &err), "a short wall")) return;
    circle.from_m = in.from_m;
    circle.centre_m = vec3(5, 3, 0);
    circle.radius_m = 60;
    circle.relief = &relief;
    for (int y = 0; y < 256; y++)
        for (int x = 0; x < 512; x++)
            for (int c = 0; c < 3; c++) image_f32(&circle.map, x, y)[c] = c && y >= 128 ? 0.01f : 0.5f;
    fill_px(picture, 0, 0, WIDTH, HEIGHT, 0.2, 0.2, 0.2);
    /* The ball's edge is a pixel to 6 degrees: from the horizon to where the orthophoto begins. */
    double red[2] = { 0, 0 };
    for (int told = 0; told < 2; told++) {
        struct vec2 got, near_by = mirrored_at(vec3(2, -4, 0));
        circle.no_relief_map = !told;
        if (!OK(render(&pass, light, entity, picture, NULL), "a mirror ball, the relief %s", told ? "with its map" : "without")) continue;
        red[told] = red_middle(&got, &pass);
        OK(!(red_at(&pass, (int)near_by.x, (int)near_by.y) > 0.1), "ground near by is the orthophoto's");
        image_release(&pass);
    }
    OK(red[1] > 2 * red[0] && red[1] > 1, "far off it is the map's, or else level (%.2f, %.2f)", red[1], red[0]);
    circle.relief = NULL, circle.no_relief_map = false;
    image_release(&circle.map);
    relief_release(&relief);
    static_mesh_destroy(mesh);
    place_free(&place);
}

/* Red from (-1, 1) to (2, 4), across and up. */
static void paint_red(uint8_t srgb[3], const float p[3])
{
    bool red = p[0] >= -1 && p[0] <= 2 && p[2] >= 1 && p[2] <= 4;
    memcpy(srgb, red ? (uint8_t[]){ 220, 10, 10 } : (uint8_t[]){ 128, 128, 128 }, 3);
}

/* A board hides a red part of a wall from the look round the place, and not from the ball. */
static void test_hidden(const struct light *light, struct entity *entity, struct image *picture)
{
    const double wall_y = -4, gain[3] = { 1, 1, 1 };
    struct error err = ERROR_NONE;
    struct place place = { .paint = paint_red };
    struct static_mesh *mesh = NULL;
    struct relief relief = { 0 };
    struct hidden_place hidden = { 0 };
    struct image pass = { 0 };
    struct vec2 got;
    place_grid(&place, vec3(-5, wall_y, 0), vec3(0.25, 0, 0), vec3(0, 0, 0.25), 60, 28);
    place_wall(&place, 3.2, 4.3, 1, 0, 2.2, 0);
    struct relief_input in = { .from_m = { 5, 3, 1 }, .entities = entity, .n = 1 };
    bool ok = place_mesh(&mesh, &place, false, &err) && image_init(&circle.map, 512, 256, 3, PIXEL_F32, &err);
    in.place = mesh;
    if (!OK(ok && relief_create(&relief, &in, &err) && hidden_place_create(&hidden, &in, gain, &err), "a wall behind a board")) return;
    for (size_t i = 0; i < 3 * 512 * 256; i++) ((float *)circle.map.data)[i] = 0.5f;
    circle.from_m = in.from_m;
    circle.radius_m = 0;
    circle.relief = &relief;
    fill_px(picture, 0, 0, WIDTH, HEIGHT, 0.2, 0.2, 0.2);
    OK(render(&pass, light, entity, picture, NULL) && !(red_middle(&got, &pass) > 0), "what the look does not meet is on no relief");
    image_release(&pass);
    circle.hidden = &hidden;
    OK(render(&pass, light, entity, picture, NULL) && red_middle(&got, &pass) > 0, "told, it is mirrored");
    for (int i = 0; i < 9; i++) {
        double across = i % 3 - 1, up = i / 3 - 1;
        struct vec2 q = mirrored_at(vec3(0.5 + 1.2 * across, wall_y, 2.5 + 1.2 * up));
        struct vec2 beside = mirrored_at(vec3(0.5 + 2.1 * across, wall_y, 2.5 + 2.1 * up));
        OK(red_at(&pass, (int)q.x, (int)q.y) > 0, "where it stands, %g m to the right, %g m up", 1.2 * across, 1.2 * up);
        if (i != 4) OK(!(red_at(&pass, (int)beside.x, (int)beside.y) > 0), "and not beside it");
    }
    circle.relief = NULL, circle.hidden = NULL;
    image_release(&pass);
    image_release(&circle.map);
    hidden_place_release(&hidden);
    relief_release(&relief);
    static_mesh_destroy(mesh);
    place_free(&place);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct light light;
    struct image picture;
    struct solid mirror;
    ball(&mirror);
    mirror.material.metallic = 1;
    mirror.material.roughness = 0;
    struct entity entity = { .id = 1, .name = "ball", .model_name = "ball", .class_ = CLASS_OTHER, .model = &mirror.model, .world_from_entity = pose_identity() };
    if (!OK(mkdtemp(out) != NULL && light_create(&light, &scene, &err) && image_init(&picture, WIDTH, HEIGHT, 3, PIXEL_U8, &err), "light and a picture"))
        return tap_done();
    test_mirror(&light, &entity, &picture, vec3(1.2, -1.9, 0));
    test_mirror(&light, &entity, &picture, vec3(-2, -1.4, 0));
    test_upright(&light, &entity, &picture);
    test_circle(&light, &entity, &picture, 20, NULL);
    test_circle(&light, &entity, &picture, 0, NULL);
    test_relief(&light, &entity, &picture);
    test_past_ground(&light, &entity, &picture);
    test_hidden(&light, &entity, &picture);
    image_release(&picture);
    light_release(&light);
    solid_free(&mirror);
    povray_remove(out);
    return tap_done();
}

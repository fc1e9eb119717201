/* What light reaches a ball from surroundings taken from a picture, as POV-Ray renders it. */
#include "gen/light/sky_image.h"
#include "tests/gen/ball.h"
#include "tests/gen/place.h"

#define SHINES 2.0

/* The mean over the part of a ball that looks down: below its middle in the picture. */
static void underside(double rgb[3], const struct image *pass)
{
    double n = 0;
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int y = 70; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const float *p = image_f32(pass, x, y);
            if (p[3] < 1) continue;
            for (int c = 0; c < 3; c++) rgb[c] += (double)p[c];
            n++;
        }
    for (int c = 0; c < 3; c++) rgb[c] /= n;
}

static void test_bounce(const struct light *light, struct entity *entity, struct image *picture)
{
    struct image pass[3] = { { 0 } };
    double bare[3], shown[3], red[3];
    const double *e = light->irradiance;
    if (!OK(render(&pass[0], light, entity, NULL, NULL), "a white ball over bare ground")) return;
    fill_px(picture, 0, 0, WIDTH, HEIGHT, 0.3 * e[0], 0.3 * e[1], 0.3 * e[2]);
    if (!OK(render(&pass[1], light, entity, picture, NULL), "over a picture of the same ground")) return;
    fill_px(picture, 0, 0, WIDTH, HEIGHT, 0.3 * e[0], 0.05 * e[1], 0.05 * e[2]);
    if (!OK(render(&pass[2], light, entity, picture, NULL), "over a picture of red ground")) return;
    underside(bare, &pass[0]);
    underside(shown, &pass[1]);
    underside(red, &pass[2]);
    for (int c = 0; c < 3; c++) NEAR(shown[c] / bare[c], 1, 0.02, "a picture of even ground sends as much light up as the ground itself, channel %d", c);
    NEAR(red[0] / shown[0], 1, 0.02, "red ground sends up the red");
    OK(red[1] < 0.8 * shown[1] && red[2] < 0.8 * shown[2], "and little else (%.3f, %.3f)", red[1] / shown[1], red[2] / shown[2]);
    for (int i = 0; i < 3; i++) image_release(&pass[i]);
}

/* How bright the ball is in front, at (0, -1, 1), with nothing else to light it than circle.map. */
static double front_light(const struct light *light, struct entity *entity, struct image *picture)
{
    struct error err = ERROR_NONE;
    struct light sunless = *light;
    struct image pass = { 0 };
    struct vec2 q;
    double got = 0;
    sunless.has_sun = false;
    scene.quality = QUALITY_STANDARD;
    fill_px(picture, 0, 0, WIDTH, HEIGHT, 0, 0, 0);
    if (OK(camera_project(&camera, &q, pose_apply(pose_inverse(looking(eye, middle)), vec3(0, -1, 1)), &err) &&
           render(&pass, &sunless, entity, picture, NULL), "a white ball among what shines"))
        for (int i = 0; i < 25; i++) got += (double)image_f32(&pass, (int)q.x + i % 5 - 2, (int)q.y + i / 5 - 2)[1] / 25;
    scene.quality = QUALITY_DRAFT;
    image_release(&pass);
    return got;
}

/* A long wall shines: the ball is lit from where it stands itself, nearer to it than who looked round. */
static void test_relief(const struct light *light, struct entity *entity, struct image *picture)
{
    const double wall_y = -10, height = 7, far = -1 - wall_y;
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct relief relief = { 0 };
    struct relief_input in = { .from_m = { 0, 6, 1 } };
    place_wall(&place, -300, 300, wall_y, 0, height, 0);
    bool ok = place_mesh(&mesh, &place, false, &err) && image_init(&circle.map, 1024, 512, 3, PIXEL_F32, &err);
    in.place = mesh;
    if (OK(ok && relief_create(&relief, &in, &err), "a relief of a long wall %s", err.text)) {
        for (int y = 0; y < 512; y++)
            for (int x = 0; x < 1024; x++) {
                struct vec3 d = sky_direction(&circle.map, x, y);
                double z = in.from_m.z + (wall_y - in.from_m.y) / d.y * d.z;
                for (int c = 0; c < 3; c++) image_f32(&circle.map, x, y)[c] = d.y < 0 && z > 0 && z < height ? (float)SHINES : 0;
            }
        circle.from_m = in.from_m;
        circle.relief = &relief;
        double wanted = (sin(atan((height - 1) / far)) + sin(atan(1 / far))) / 2 * SHINES;
        /* The relief may end a step of 0.4 m below the top; as seen from there it would be 0.62 of it. */
        NEAR(front_light(light, entity, picture), wanted, 0.1 * wanted, "is as bright as the wall is large, seen from the ball");
    }
    circle.relief = NULL;
    image_release(&circle.map);
    relief_release(&relief);
    static_mesh_destroy(mesh);
    place_free(&place);
}

/* The share of what a surface facing south at (0, -1, 1) receives that comes from a band round the circle, up to a height. */
static double band_share(double height_m)
{
    enum { STEPS = 400 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++)
        for (int j = 0; j < STEPS; j++) {
            double r = sqrt((i + 0.5) / STEPS), turn = 2 * M_PI * (j + 0.5) / STEPS;
            struct vec3 d = { r * cos(turn), -sqrt(1 - r * r), r * sin(turn) };
            double x = -circle.centre_m.x, y = -1 - circle.centre_m.y, a = d.x * d.x + d.y * d.y, b = x * d.x + y * d.y;
            double z = 1 + d.z * (-b + sqrt(b * b - a * (x * x + y * y - circle.radius_m * circle.radius_m))) / a;
            sum += z > 0 && z < height_m;
        }
    return sum / STEPS / STEPS;
}

/* A band round a circle shines: the ball stands near to its southern side, who looked round in its middle. */
static void test_circle(const struct light *light, struct entity *entity, struct image *picture)
{
    const double height = 7;
    struct error err = ERROR_NONE;
    circle.centre_m = vec3(0, 14, 0);
    circle.from_m = vec3(0, 14, 1);
    circle.radius_m = 20;
    if (!OK(image_init(&circle.map, 1024, 512, 3, PIXEL_F32, &err), "a circle %s", err.text)) return;
    for (int y = 0; y < 512; y++)
        for (int x = 0; x < 1024; x++) {
            struct vec3 d = sky_direction(&circle.map, x, y);
            double z = circle.from_m.z + circle.radius_m * d.z / hypot(d.x, d.y);
            for (int c = 0; c < 3; c++) image_f32(&circle.map, x, y)[c] = z > 0 && z < height ? (float)SHINES : 0;
        }
    double wanted = band_share(height) * SHINES, from_middle = (sin(atan((height - 1) / 20)) + sin(atan(1.0 / 20))) / 2 * SHINES;
    OK(wanted > 1.8 * from_middle, "the band is larger from near by (%.2f, %.2f)", wanted, from_middle);
    NEAR(front_light(light, entity, picture), wanted, 0.08 * wanted, "and lights the ball as much more");
    circle.radius_m = 0;
    image_release(&circle.map);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct light light;
    struct image picture;
    struct solid white;
    ball(&white);
    struct entity entity = { .id = 1, .name = "ball", .model_name = "ball", .class_ = CLASS_OTHER, .model = &white.model, .world_from_entity = pose_identity() };
    if (OK(mkdtemp(out) != NULL && light_create(&light, &scene, &err) && image_init(&picture, WIDTH, HEIGHT, 3, PIXEL_U8, &err), "light and a picture")) {
        test_bounce(&light, &entity, &picture);
        test_relief(&light, &entity, &picture);
        test_circle(&light, &entity, &picture);
        image_release(&picture);
        light_release(&light);
    }
    solid_free(&white);
    povray_remove(out);
    return tap_done();
}

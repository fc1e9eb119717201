/* The ground beside a box under an even sky: what the box takes from it, and sends back, as POV-Ray's radiosity renders the same. */
#include "gen/trace/sky_sight.h"

#include "tests/gen/povray.h"
#include "tests/gen/solid.h"
#include "tests/tap.h"

#include <sys/stat.h>

enum { SIDE = 96, POINTS = 6 };
#define HALF_M 2.4     /* of the square of ground that is looked at, from above */
#define BEGINS_M 0.3   /* the square, east of the box's side */
#define GROUND_ALBEDO 0.3
#define LENGTH_M 4.0
#define WIDTH_M 2.0
#define HEIGHT_M 1.5

static const double red[3] = { 0.7, 0.2, 0.05 };
static char out[] = "sent_back_povray.XXXXXX";

/* Looked at straight down through a parallel camera: x of the picture is east, its left edge BEGINS_M from the box. */
static char *scene_text(bool box)
{
    double x = WIDTH_M / 2;
    char *solid = box ? string_format("box { <%g, %g, 0>, <%g, %g, %g> pigment { rgb <%g, %g, %g> } finish { diffuse 1 } }\n", -x, -LENGTH_M / 2, x,
                                      LENGTH_M / 2, HEIGHT_M, red[0], red[1], red[2]) : string_format(" ");
    char *text = string_format(
        "#version 3.7; global_settings { assumed_gamma 1 ambient_light 0 radiosity { count 1000 error_bound 0.1 nearest_count 8 recursion_limit 3\n"
        "  pretrace_start 0.08 pretrace_end 0.01 low_error_factor 0.3 gray_threshold 0 brightness 1 } }\n"
        "sky_sphere { pigment { rgb 1 } }\n"
        "camera { orthographic location <%g, 0, 10> direction <0, 0, -1> right x * %g up y * %g }\n"
        "plane { z, 0 pigment { rgb %g } finish { diffuse 1 } }\n%s",
        x + BEGINS_M + HALF_M, 2 * HALF_M, 2 * HALF_M, GROUND_ALBEDO, solid);
    free(solid);
    return text;
}

static bool render(struct image *image, bool box)
{
    struct error err = ERROR_NONE;
    const char *name = box ? "box" : "bare";
    char *path = string_format("%s/frames/%s.pov", out, name), *result = string_format("%s/frames/%s.exr", out, name), *text = scene_text(box);
    bool ok = file_write(path, text, strlen(text), &err) && povray(out, name, SIDE, SIDE, "-A") && image_read(image, result, &err);
    free(path);
    free(result);
    free(text);
    return OK(ok, "POV-Ray renders the ground %s a box %s", box ? "beside" : "without", err.text);
}

/* Mean of a square of 12 pixels, as a share of the bare ground's. */
static void share_at(double rgb[3], const struct image *box, const struct image *bare, double away_m)
{
    double with[3] = { 0 }, without[3] = { 0 };
    int x = (int)((away_m - BEGINS_M) / (2 * HALF_M) * SIDE);
    for (int j = -6; j < 6; j++)
        for (int i = -2; i < 3; i++)
            for (int c = 0; c < 3; c++) {
                with[c] += (double)image_f32(box, x + i, SIDE / 2 + j)[c];
                without[c] += (double)image_f32(bare, x + i, SIDE / 2 + j)[c];
            }
    for (int c = 0; c < 3; c++) rgb[c] = with[c] / without[c];
}

static void paint(struct solid *box)
{
    box->material.ior = 1;
    memcpy(box->material.base_color, red, sizeof red);
}

static void compare(struct sky_sight *lit, struct sky_sight *black, const struct image *beside, const struct image *bare)
{
    double worst = 0, worst_black = 0;
    for (int i = 0; i < POINTS; i++) {
        double away = BEGINS_M + 0.3 + i * 0.6, truth[3];
        struct vec3 p = vec3(WIDTH_M / 2 + away, 0, 0), up = vec3(0, 0, 1);
        struct sky_seen seen = sky_sight_at(lit, p, up), dark = sky_sight_at(black, p, up);
        share_at(truth, beside, bare, away);
        for (int c = 0; c < 3; c++) {
            double ours = seen.with[c] / seen.without[c];
            NEAR(ours, truth[c], 0.01, "%.1f m away, %s", away, (const char *[]){ "red", "green", "blue" }[c]);
            worst = fmax(worst, fabs(ours - truth[c]));
            worst_black = fmax(worst_black, fabs(dark.with[c] / dark.without[c] - truth[c]));
        }
    }
    OK(worst_black > 3 * worst, "it sends back what counts: %.3f off at most, %.3f were it black", worst, worst_black);
}

int main(void)
{
    static const struct vec2 far[] = { { -500, -500 }, { 500, -500 }, { 500, 500 }, { -500, 500 } };
    struct scene scene = { .path = "scene.yaml", .sky = SKY_CIE, .sun = SUN_NONE, .cie_type = 5, .ground = { { 0, 0, 1 }, 0 },
                           .ground_albedo = { GROUND_ALBEDO, GROUND_ALBEDO, GROUND_ALBEDO } };
    struct error err = ERROR_NONE;
    struct light light;
    struct solid box;
    struct tracer *tracer = NULL;
    struct sky_sight *lit = NULL, *black = NULL;
    struct image beside, bare;
    struct vec3 corner[4];
    const struct receiver everywhere = { corner, 4, 1 };
    for (int i = 0; i < 4; i++) corner[i] = vec3(far[i].x, far[i].y, 0);
    solid_box(&box, LENGTH_M, WIDTH_M, HEIGHT_M);
    paint(&box);
    const struct model *models[] = { &box.model };
    const struct entity entity = { .id = 1, .name = "box", .model = &box.model, .world_from_entity = entity_stand(&scene.ground, vec3(0, 0, 0), 0) };
    char *frames = mkdtemp(out) ? string_format("%s/frames", out) : NULL;
    if (OK(frames && mkdir(frames, 0777) == 0 && light_create(&light, &scene, &err) && tracer_create(&tracer, models, 1, &err), "a box %s", err.text)) {
        struct sky_sight_input in = { .light = &light, .directions = 512 };
        bool ok = sky_sight_create(&black, &in, &err) && sky_sight_add(black, tracer, &entity, &everywhere, &err);
        in.round.radiance = &light.sky;
        ok = ok && sky_sight_create(&lit, &in, &err) && sky_sight_add(lit, tracer, &entity, &everywhere, &err);
        if (OK(ok, "the sky past it %s", err.text) && render(&beside, true) && render(&bare, false)) {
            compare(lit, black, &beside, &bare);
            image_release(&beside);
            image_release(&bare);
        }
        light_release(&light);
    }
    sky_sight_destroy(lit);
    sky_sight_destroy(black);
    tracer_destroy(tracer);
    solid_free(&box);
    free(frames);
    povray_remove(out);
    return tap_done();
}

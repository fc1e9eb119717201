/* The ground beside a box: what the box takes of its light, and sends back, as POV-Ray's radiosity renders the same; below an even sky, in the sun, and
 * behind a wall. */
#include "gen/trace/sky_sight.h"

#include "tests/gen/povray.h"
#include "tests/gen/solid.h"
#include "tests/tap.h"

#include <sys/stat.h>

enum { SIDE = 96, POINTS = 6, THINGS = 2 };
#define HALF_M 2.4     /* of the square of ground that is looked at, from above */
#define BEGINS_M 0.3   /* the square, east of the box's side */
#define GROUND_ALBEDO 0.3
#define SUN 3.0        /* its normal irradiance / pi, of a sky of 1 */

static const struct vec3 box_m = { 4, 2, 1.5 }, wall_m = { 10, 0.3, 6 }; /* along y, along x, up */
static const double red[3] = { 0.7, 0.2, 0.05 }, grey[3] = { 0.5, 0.5, 0.5 };
#define WALL_X 7.0
#define TURN_DEG 20.0 /* of the box, where the sun shines: to the left */
static char out[] = "sent_back_povray.XXXXXX";

/* Light that wall and box send to each other first is left out. */
static const struct setting { const char *name; bool sun, wall; double tolerance; } settings[] = {
    { "below an even sky", false, false, 0.012 }, { "in the sun", true, false, 0.012 }, { "in the shadow of a wall", true, true, 0.025 },
};

static struct vec3 towards_sun(void) { return vec3_unit(vec3(1, 0.2, 0.8)); }
static double turn_deg(const struct setting *s) { return s->sun ? TURN_DEG : 0; }

static char *box_text(struct vec3 size_m, const double color[3], double turn, double x)
{
    return string_format("box { <%g, %g, 0>, <%g, %g, %g> pigment { rgb <%g, %g, %g> } finish { diffuse 1 } rotate z * %g translate x * %g }\n", -size_m.y / 2,
                         -size_m.x / 2, size_m.y / 2, size_m.x / 2, size_m.z, color[0], color[1], color[2], turn, x);
}

/* Looked at straight down through a parallel camera: x of the picture is east, its left edge BEGINS_M from the box as it stands unturned. */
static char *scene_text(const struct setting *s, bool things)
{
    struct vec3 d = towards_sun();
    char *box = box_text(box_m, red, turn_deg(s), 0), *wall = box_text(wall_m, grey, 0, WALL_X);
    char *sun = string_format("light_source { 1000 * <%g, %g, %g> rgb %g parallel point_at 0 }\n", d.x, d.y, d.z, SUN);
    char *text = string_format(
        "#version 3.7; global_settings { assumed_gamma 1 ambient_light 0 radiosity { count 1000 error_bound 0.1 nearest_count 8 recursion_limit 3\n"
        "  pretrace_start 0.08 pretrace_end 0.01 low_error_factor 0.3 gray_threshold 0 brightness 1 } }\n"
        "sky_sphere { pigment { rgb 1 } }\n"
        "camera { orthographic location <%g, 0, 10> direction <0, 0, -1> right x * %g up y * %g }\n"
        "plane { z, 0 pigment { rgb %g } finish { diffuse 1 } }\n%s%s%s",
        box_m.y / 2 + BEGINS_M + HALF_M, 2 * HALF_M, 2 * HALF_M, GROUND_ALBEDO, s->sun ? sun : "", things ? box : "", things && s->wall ? wall : "");
    free(box);
    free(wall);
    free(sun);
    return text;
}

static bool render(struct image *image, const struct setting *s, bool things)
{
    struct error err = ERROR_NONE;
    char *path = string_format("%s/frames/ground.pov", out), *result = string_format("%s/frames/ground.exr", out), *text = scene_text(s, things);
    bool ok = file_write(path, text, strlen(text), &err) && povray(out, "ground", SIDE, SIDE, "-A") && image_read(image, result, &err);
    free(path);
    free(result);
    free(text);
    return OK(ok, "%s: POV-Ray renders the ground %s", s->name, things ? "with what stands on it" : "bare");
}

/* Mean of 5 by 12 pixels, as a share of the bare ground's. */
static void share_at(double rgb[3], const struct image *beside, const struct image *bare, double away_m)
{
    double with[3] = { 0 }, without[3] = { 0 };
    int x = (int)((away_m - BEGINS_M) / (2 * HALF_M) * SIDE);
    for (int j = -6; j < 6; j++)
        for (int i = -2; i < 3; i++)
            for (int c = 0; c < 3; c++) {
                with[c] += (double)image_f32(beside, x + i, SIDE / 2 + j)[c];
                without[c] += (double)image_f32(bare, x + i, SIDE / 2 + j)[c];
            }
    for (int c = 0; c < 3; c++) rgb[c] = with[c] / without[c];
}

/* The same by rays: what is left of sun and sky. */
static void share_of(double rgb[3], const struct sky_sight *sight, const struct light *light, struct vec3 p)
{
    struct sky_seen seen = sky_sight_at(sight, p, vec3(0, 0, 1));
    double sun = light->has_sun ? light->sun_direction.z * light->sun_color[0] : 0, lit = sky_sight_sun(sight, p);
    for (int c = 0; c < 3; c++) rgb[c] = (seen.with[c] + lit * sun) / (seen.without[c] + sun);
}

static void compare(const struct setting *s, struct sky_sight *lit, struct sky_sight *black, const struct light *light, const struct image *beside,
                    const struct image *bare)
{
    double worst = 0, worst_black = 0;
    for (int i = 0; i < POINTS; i++) {
        double away = BEGINS_M + 0.3 + i * 0.6, truth[3], ours[3], dark[3];
        struct vec3 p = vec3(box_m.y / 2 + away, 0, 0);
        share_at(truth, beside, bare, away);
        share_of(ours, lit, light, p);
        share_of(dark, black, light, p);
        for (int c = 0; c < 3; c++) {
            NEAR(ours[c], truth[c], s->tolerance, "%s: %.1f m away, %s", s->name, away, (const char *[]){ "red", "green", "blue" }[c]);
            worst = fmax(worst, fabs(ours[c] - truth[c]));
            worst_black = fmax(worst_black, fabs(dark[c] - truth[c]));
        }
    }
    OK(worst_black > 2.5 * worst, "%s: what is sent back counts: %.3f off at most, %.3f were all black", s->name, worst, worst_black);
}

/* An even sky of radiance 1, and a sun. */
static bool make_light(struct light *light, bool sun, struct error *err)
{
    const struct scene scene = { .path = "scene.yaml", .sky = SKY_CIE, .sun = SUN_NONE, .cie_type = 5, .ground = { { 0, 0, 1 }, 0 },
                                 .ground_albedo = { GROUND_ALBEDO, GROUND_ALBEDO, GROUND_ALBEDO } };
    if (!light_create(light, &scene, err)) return false;
    light->has_sun = sun;
    light->sun_direction = towards_sun();
    for (int c = 0; c < 3; c++) {
        light->sun_color[c] = SUN;
        light->irradiance[c] += sun ? SUN * light->sun_direction.z : 0;
    }
    for (int y = light->sky.height_px / 2; y < light->sky.height_px; y++)
        for (int x = 0; x < light->sky.width_px; x++)
            for (int c = 0; c < 3; c++) image_f32(&light->sky, x, y)[c] = (float)(GROUND_ALBEDO * light->irradiance[c]);
    return true;
}

static bool open_sight(struct sky_sight **sight, const struct sky_sight_input *in, const struct tracer *tracer, const struct entity *things, size_t n,
                       const struct receiver *everywhere, struct error *err)
{
    bool ok = sky_sight_create(sight, in, err);
    for (size_t i = 0; ok && i < n; i++) ok = sky_sight_add(*sight, tracer, &things[i], everywhere, err);
    return ok;
}

static void test_setting(const struct setting *s, const struct tracer *tracer, const struct model *const *models)
{
    struct vec3 corner[4] = { { -500, -500, 0 }, { 500, -500, 0 }, { 500, 500, 0 }, { -500, 500, 0 } };
    const struct receiver everywhere = { corner, 4, 1 };
    const struct plane level = { vec3(0, 0, 1), 0 };
    const struct entity things[THINGS] = {
        { .id = 1, .name = "box", .model = models[0], .world_from_entity = entity_stand(&level, vec3(0, 0, 0), -turn_deg(s) * M_PI / 180) },
        { .id = 2, .name = "wall", .model = models[1], .world_from_entity = entity_stand(&level, vec3(WALL_X, 0, 0), 0) },
    };
    size_t n = s->wall ? 2 : 1;
    struct error err = ERROR_NONE;
    struct light light;
    struct sky_sight *lit = NULL, *black = NULL;
    struct image beside, bare;
    if (!OK(make_light(&light, s->sun, &err), "%s: light %s", s->name, err.text)) return;
    struct sky_sight_input in = { .light = &light, .directions = 512 };
    bool ok = open_sight(&black, &in, tracer, things, n, &everywhere, &err);
    in.round.radiance = &light.sky;
    ok = ok && open_sight(&lit, &in, tracer, things, n, &everywhere, &err);
    if (OK(ok, "%s: the sky past it %s", s->name, err.text) && render(&beside, s, true)) {
        if (render(&bare, s, false)) {
            compare(s, lit, black, &light, &beside, &bare);
            image_release(&bare);
        }
        image_release(&beside);
    }
    sky_sight_destroy(lit);
    sky_sight_destroy(black);
    light_release(&light);
}

static void make_thing(struct solid *thing, struct vec3 size_m, const double color[3])
{
    solid_box(thing, size_m.x, size_m.y, size_m.z);
    thing->material.ior = 1;
    memcpy(thing->material.base_color, color, sizeof thing->material.base_color);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct solid box, wall;
    struct tracer *tracer = NULL;
    make_thing(&box, box_m, red);
    make_thing(&wall, wall_m, grey);
    const struct model *models[THINGS] = { &box.model, &wall.model };
    char *frames = mkdtemp(out) ? string_format("%s/frames", out) : NULL;
    if (OK(frames && mkdir(frames, 0777) == 0 && tracer_create(&tracer, models, THINGS, &err), "a box and a wall %s", err.text))
        for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) test_setting(&settings[i], tracer, models);
    tracer_destroy(tracer);
    solid_free(&box);
    solid_free(&wall);
    free(frames);
    povray_remove(out);
    return tap_done();
}

/* Light estimated from photographs whose light is known: made here, pixel by pixel; and real ones, where pairs of
 * pixels across real shadows were picked by eye. */
#include "gen/estimate/estimate.h"

#include "gen/light/light.h"
#include "lib/image.h"
#include "tests/gen/craig.h"
#include "tests/gen/place.h"
#include "tests/gen/street.h"
#include "tests/tap.h"

static char file[] = "estimate-test.png";

static void make(const struct made *m)
{
    struct error err = ERROR_NONE;
    struct image srgb;
    make_image(&srgb, m);
    if (!image_write(file, &srgb, &err)) OK(false, "%s", err.text);
    image_release(&srgb);
}

static bool estimate_in(struct light_estimate *e, struct scene *scene, struct static_mesh *mesh, struct error *err)
{
    struct stage stage = { .scene = scene, .mesh = mesh, .surface = { .has_mesh = mesh != NULL, .mesh = mesh, .plane = { { 0, 0, 1 }, 0 } } };
    struct estimate_photograph photograph = { 0, file };
    return light_estimate(e, &stage, &photograph, 1, err);
}

static struct light_estimate estimate(struct scene *scene, struct static_mesh *mesh)
{
    struct error err = ERROR_NONE;
    struct light_estimate e = { 0 };
    if (!estimate_in(&e, scene, mesh, &err)) OK(false, "line %d: %s", err.line, err.text);
    return e;
}

static void is_near(const struct light_estimate *e, const double want[3], double within, const char *what)
{
    for (int c = 0; c < 3; c++) NEAR(e->shade.ratio[c], want[c], within * want[c], "%s: shade to lit, %c", what, "RGB"[c]);
}

/* In: albedo  that the ground is told to have, of a photograph of 0.3 to 0.35 */
static void check_albedo(const struct light_estimate *e, double albedo, bool doubted)
{
    const double radiance[3] = { albedo, albedo, albedo };
    char *text = light_estimate_doubt(e, radiance);
    OK(text && !strstr(text, "ground.albedo may be too low") == !doubted, "an albedo of %.2f is%s doubted", albedo, doubted ? "" : " not");
    free(text);
}

static void on_a_plane(void)
{
    struct scene_camera camera;
    struct scene_shot shot;
    struct scene scene = scene_of(&camera, &shot, file);
    struct made m = { .ratio = { 0.15, 0.2, 0.3 }, .balance = { 1.1, 1, 0.8 }, .shade = street_shade };
    make(&m);
    struct light_estimate e = estimate(&scene, NULL), again = estimate(&scene, NULL);
    is_near(&e, m.ratio, 0.03, "street");
    OK(e.clear && e.from == SHADE_FROM_EDGES && e.certainty > 0.8, "clear, sure to %.2f", e.certainty);
    for (int c = 0; c < 3; c++) NEAR(e.lit[c], 1.6 * 0.2 * m.balance[c], 0.02 * e.lit[c], "lit asphalt, %c", "RGB"[c]);
    OK(!memcmp(e.shade.ratio, again.shade.ratio, sizeof e.shade.ratio), "the same again");
    check_albedo(&e, 0.25, false);
    check_albedo(&e, 0.1, true);

    light_estimate_apply(&scene, &e);
    struct error err = ERROR_NONE;
    struct light light;
    double sky[3];
    if (OK(light_create(&light, &scene, &err), "the scene has light %s", err.text)) {
        light_sky_irradiance(sky, &light, vec3(0, 0, 1));
        for (int c = 0; c < 3; c++) NEAR(sky[c] / light.irradiance[c], e.sky_share[c], 1e-4, "of which the sky gives as much, %c", "RGB"[c]);
        light_release(&light);
    }

    scene = scene_of(&camera, &shot, file);
    scene.sun = SUN_NONE;
    OK(!estimate_in(&e, &scene, NULL, &err) && err.line == 8 && strstr(err.text, "give place and time"), "sun that nobody knows the place of: %s",
       err.text);

    m.haze = 0.5;
    m.visibility_m = 60;
    make(&m);
    scene = scene_of(&camera, &shot, file);
    scene.has_mist = true;
    scene.visibility_m = 60;
    for (int c = 0; c < 3; c++) scene.haze[c] = 0.5;
    e = estimate(&scene, NULL);
    is_near(&e, m.ratio, 0.05, "through haze");

    m = (struct made){ .ratio = { 1, 1, 1 }, .balance = { 1, 1, 1.1 }, .shade = no_shade };
    make(&m);
    scene = scene_of(&camera, &shot, file);
    e = estimate(&scene, NULL);
    OK(!e.clear && e.certainty > 0.8, "without a shadow it is overcast, sure to %.2f", e.certainty);
    light_estimate_apply(&scene, &e);
    OK(scene.sky == SKY_OVERCAST && scene.sun == SUN_NONE, "an overcast sky");
}

static void marks(void)
{
    struct error err = ERROR_NONE;
    struct scene_camera camera;
    struct scene_shot shot;
    struct scene scene = scene_of(&camera, &shot, file);
    struct made m = { .ratio = { 0.3, 0.35, 0.4 }, .balance = { 1, 1, 1 }, .shade = street_shade };
    struct scene_mark mark[2] = { { { 300, 240 }, { 360, 240 }, 0, { 12, 7 } }, { { 460, 80 }, { 570, 80 }, 0, { 13, 7 } } };
    make(&m);
    scene.marks = mark;
    scene.mark_count = 2;
    struct light_estimate e = estimate(&scene, NULL);
    is_near(&e, m.ratio, 0.08, "marked");
    OK(e.clear && e.from == SHADE_FROM_MARKS && e.shade.edges == 2 && fabs(e.beyond) < 0.04, "two pairs, and no doubt");
    struct made bright = { .ratio = { 0.93, 0.94, 0.95 }, .balance = { 1, 1, 1 }, .shade = street_shade };
    make(&bright);
    e = estimate(&scene, NULL);
    OK(e.beyond > 0.1, "shade that no clear sky makes is told: by %.2f of the light too bright", e.beyond);
    make(&m);
    mark[1].shade_px = mark[1].lit_px;
    mark[1].lit_px = (struct vec2){ 570, 80 };
    OK(!estimate_in(&e, &scene, NULL, &err) && err.line == 13 && strstr(err.text, "not darker"), "the wrong way round: %s", err.text);
}

/* A wall that casts a shadow on the ground, with the sun where the scene says, and elsewhere. */
static void over_a_mesh(void)
{
    struct scene_camera camera;
    struct scene_shot shot;
    struct scene scene = scene_of(&camera, &shot, file);
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct vec3 sun;
    place_ground(&place, 0, 0);
    place_wall(&place, -7, 7, 18, 0, 5, 0);
    for (int i = 0; i < 3; i++) place_wall(&place, -12 + 9 * i, -10 + 9 * i, 24, 0, 3 + i, 0);
    if (!OK(place_mesh(&mesh, &place, false, &err) && light_sun_direction(&sun, &scene, &err), "a place %s", err.text)) return;
    struct made m = { .ratio = { 0.15, 0.2, 0.3 }, .balance = { 1, 1, 1 }, .mesh = mesh, .sun = sun };
    make(&m);
    struct light_estimate e = estimate(&scene, mesh);
    OK(e.clear && e.certainty > 0.8, "clear, sure to %.2f", e.certainty);
    OK(e.has_check, "the sun is looked for (%zu edges)", e.check.edges);
    NEAR(e.check.azimuth_off_deg, 0, 0.5, "azimuth is right");
    NEAR(e.check.elevation_off_deg, 0, 0.5, "elevation is right");

    scene.sun_azimuth_rad -= 3 * DEG;
    scene.sun_elevation_rad += 2 * DEG;
    e = estimate(&scene, mesh);
    NEAR(e.check.azimuth_off_deg, 3, 0.6, "the sun stands 3 deg clockwise of where it was said to");
    NEAR(e.check.elevation_off_deg, -2, 0.6, "and 2 deg lower");
    OK(e.check.agree_there > e.check.agree, "where more edges agree");

    m.ratio[0] = m.ratio[1] = m.ratio[2] = 1;
    make(&m);
    e = estimate(&scene, mesh);
    OK(!e.clear, "shadows that the mesh would cast, and that are not there: overcast, sure to %.2f", e.certainty);
    static_mesh_destroy(mesh);
    place_free(&place);
}

/* Across real shadows on craig's asphalt, 13 pixels to a side, picked by eye: in the shade, in the sun beside it. */
static const int craig[][4] = {
    { 888, 1415, 975, 1415 },  { 1250, 1298, 1250, 1395 }, { 1408, 1344, 1462, 1344 }, { 653, 1325, 653, 1395 },
    { 459, 1321, 459, 1369 },  { 204, 1388, 255, 1415 },   { 850, 1440, 930, 1460 },   { 880, 1400, 960, 1440 },
    { 850, 280, 900, 340 },    { 1260, 1280, 1330, 1330 },
};
enum { CRAIG = sizeof craig / sizeof *craig, PATCH = 6 };

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median_about(const struct image *image, int x, int y, int c)
{
    double v[(2 * PATCH + 1) * (2 * PATCH + 1)];
    size_t n = 0;
    for (int j = y - PATCH; j <= y + PATCH; j++)
        for (int i = x - PATCH; i <= x + PATCH; i++) v[n++] = (double)linear_from_srgb(image_u8(image, i, j)[c] / 255.0f);
    qsort(v, n, sizeof *v, ascending);
    return v[n / 2];
}

static bool estimate_craig(struct light_estimate *e, struct image *image, const char *photograph)
{
    struct error err = ERROR_NONE;
    struct scene *scene = NULL;
    bool ok = craig_scene(&scene, photograph, "light: auto", &err);
    if (ok) {
        struct stage stage = { .scene = scene, .surface = { .plane = scene->ground } };
        struct estimate_photograph one = { 0, scene->shots[0].photograph };
        ok = light_estimate(e, &stage, &one, 1, &err) && image_read(image, one.path, &err);
    }
    OK(ok, "craig, %s %s", photograph, err.text);
    scene_destroy(scene);
    return ok;
}

static void craig_street(void)
{
    struct light_estimate e = { 0 };
    struct image image;
    if (!tap_shared()) {
        SKIP("the shade on craig's asphalt, and clouds on wet and median", "no ../shared");
        return;
    }
    if (estimate_craig(&e, &image, "sunny_2021-05-01T14-53-40.jpg")) {
        for (int c = 0; c < 3; c++) {
            double ratio[CRAIG];
            for (int i = 0; i < CRAIG; i++)
                ratio[i] = median_about(&image, craig[i][0], craig[i][1], c) / median_about(&image, craig[i][2], craig[i][3], c);
            qsort(ratio, CRAIG, sizeof *ratio, ascending);
            double measured = (ratio[CRAIG / 2 - 1] + ratio[CRAIG / 2]) / 2;
            NEAR(e.shade.ratio[c], measured, 0.1 * measured, "sunny: %c of the shade is %.3f of the light, by hand %.3f", "RGB"[c],
                 e.shade.ratio[c], measured);
        }
        OK(e.clear && e.certainty > 0.9, "sunny is clear, sure to %.2f", e.certainty);
        image_release(&image);
    }
    static const char *const clouds[] = { "wet_2021-05-07T16-20-36.jpg", "median.jpg" };
    for (int i = 0; i < 2; i++)
        if (estimate_craig(&e, &image, clouds[i])) {
            OK(!e.clear && e.certainty > 0.8, "%s is overcast, sure to %.2f", clouds[i], e.certainty);
            image_release(&image);
        }
}

int main(void)
{
    on_a_plane();
    marks();
    over_a_mesh();
    craig_street();
    unlink(file);
    return tap_done();
}

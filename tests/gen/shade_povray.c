/* A box half in the shade of a wall, as POV-Ray renders it: with a map of the wall's shade on the ground, against the wall itself; and with the
 * map in a place that has something above the wall where nothing is. */
#include "gen/render/passes.h"
#include "tests/gen/povray.h"
#include "gen/trace/sunlit_ground.h"
#include "tests/gen/shade.h"
#include "tests/gen/solid.h"
#include "tests/gen/view_above.h"
#include "tests/tap.h"

enum { WIDTH = 160, HEIGHT = 120, TEXELS = 400, PASSES = 3 };
static const char *const pass_names[PASSES] = { "object", "plane", "shadow" };
#define TEXEL_M 0.05
#define WALL_M 6.0     /* from the box, towards the sun */
#define SUN_SLOPE 0.9
#define LINE_M 1.0     /* so high on the middle of the box its shade reaches */

static const struct camera camera = { .model = CAMERA_PINHOLE, .width_px = WIDTH, .height_px = HEIGHT, .params = { 180, 180, 80, 60 } };
static char out[] = "shade_povray.XXXXXX";
static struct scene scene = {
    .path = "scene.yaml", .sky = SKY_CLEAR, .sun = SUN_GIVEN, .sun_azimuth_rad = M_PI / 2, .turbidity = 3, .sun_scale = 1,
    .ground = { { 0, 0, 1 }, 0 }, .ground_albedo = { 0.3, 0.3, 0.3 }, .quality = QUALITY_STANDARD,
};

/* The sun stands in the east: the ground is shaded up to so far west of the box. The map ends in the sun, 10 m away. */
static bool draw_map(struct sun_share *share)
{
    struct error err = ERROR_NONE;
    double end_x = -LINE_M / SUN_SLOPE;
    share->ground = scene.ground;
    if (!image_init(&share->map, TEXELS, TEXELS, 1, PIXEL_U8, &err)) return false;
    share->low_m = (struct vec2){ -TEXELS * TEXEL_M / 2, -TEXELS * TEXEL_M / 2 };
    share->high_m = (struct vec2){ TEXELS * TEXEL_M / 2, TEXELS * TEXEL_M / 2 };
    for (int y = 0; y < TEXELS; y++)
        for (int x = 0; x < TEXELS; x++) {
            double shaded = fmin(1, fmax(0, (share->low_m.x + (x + 1) * TEXEL_M - end_x) / TEXEL_M));
            *image_u8(&share->map, x, y) = x < 1 || y < 1 || x >= TEXELS - 1 || y >= TEXELS - 1 ? 255 : (uint8_t)(255 * (1 - shaded) + 0.5);
        }
    return true;
}

/* The same pass with something else in place of the sheet: "" for nothing. */
static bool render(struct image *image, const char *pass, const char *instead)
{
    static const char include[] = "#include \"shade.inc\"";
    struct error err = ERROR_NONE;
    char *path = string_format("%s/frames/%s.pov", out, pass), *other = string_format("%s/frames/other.pov", out);
    char *result = string_format("%s/frames/%s.exr", out, instead ? "other" : pass), *text = NULL;
    size_t size;
    bool ok = true;
    if (instead) {
        ok = file_read(&text, &size, path, &err);
        char *at = ok ? strstr(text, include) : NULL;
        if (at) *at = 0;
        char *changed = at ? string_format("%s%s%s", text, instead, at + strlen(include)) : NULL;
        ok = changed && file_write(other, changed, strlen(changed), &err);
        free(changed);
    }
    ok = ok && povray(out, instead ? "other" : pass, WIDTH, HEIGHT, "-A -J") && image_read(image, result, &err);
    free(path);
    free(other);
    free(result);
    free(text);
    return OK(ok, "%s pass%s %s", pass, !instead ? "" : instead[0] ? " with the wall" : " in the open", err.text);
}

/* Of pixels of full alpha in which the wall takes 3 % of the light or more: mean distance from it, in shares of the light in the open. */
static double distance(const struct image *a, const struct image *truth, const struct image *open, size_t *n)
{
    double sum = 0;
    *n = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const float *p = image_f32(a, x, y), *t = image_f32(truth, x, y), *o = image_f32(open, x, y);
            if (p[3] < 1 || !(o[1] > 0) || t[1] > 0.97f * o[1]) continue;
            sum += fabs((double)(p[1] - t[1]) / (double)o[1]);
            ++*n;
        }
    return sum / fmax(1, (double)*n);
}

static bool test_pass(struct image *truth, struct image *open, const char *pass, const char *wall)
{
    struct image with;
    size_t n;
    if (!render(&with, pass, NULL) || !render(truth, pass, wall) || !render(open, pass, "")) return false;
    double off = distance(&with, truth, open, &n), unshaded = distance(open, truth, open, &n);
    OK(n > 300 && unshaded > 0.2, "%s pass: the wall shades %zu pixels, by %.3f", pass, n, unshaded);
    OK(off < 0.02, "and the map does as it: %.4f off", off);
    image_release(&with);
    return true;
}

/* The shape of a wall. Returns the caller's text. */
static char *wall_of(double half_width_m, double foot_m, double top_m)
{
    double x = WALL_M, y = half_width_m;
    return string_format("polygon { 5, <%g, %g, %g>, <%g, %g, %g>, <%g, %g, %g>, <%g, %g, %g>, <%g, %g, %g> ", x, -y, foot_m, x, y, foot_m,
                         x, y, top_m, x, -y, top_m, x, -y, foot_m);
}

/* Passes in a place that casts too much, with a map that says so everywhere, or nowhere. */
static bool write_in_place(struct passes *p, struct pass_surroundings *around, const char *folder, const char *too_much, bool through)
{
    static const char place_text[] = "#declare Receivers = sphere { <0, 0, -1e6>, 1 } #declare Level = Receivers #declare Rest = Receivers";
    struct error err = ERROR_NONE;
    char *place = string_format("%s/place.inc", folder), *shades = string_format("%s/shades.inc", folder), *map = string_format("%s/sun-through.png", folder);
    char *text = string_format("#declare Shades = sphere { <0, 0, -1e6>, 1 } #declare Shades_Told = Shades #declare Shades_In_Part = %s }", too_much);
    image_release(&around->sun_share.through);
    bool ok = image_init(&around->sun_share.through, TEXELS, TEXELS, 1, PIXEL_U8, &err);
    for (int y = 1; ok && through && y < TEXELS - 1; y++) memset(image_u8(&around->sun_share.through, 1, y), 255, TEXELS - 2);
    strcpy(around->sun_through_map, "frames/sun-through.png");
    p->place_include = "frames/place.inc";
    p->shades_include = "frames/shades.inc";
    ok = ok && image_write(map, &around->sun_share.through, &err) && file_write(place, place_text, strlen(place_text), &err) &&
         file_write(shades, text, strlen(text), &err) && passes_write(folder, p, &err);
    free(place);
    free(shades);
    free(map);
    free(text);
    return OK(ok, "a place %s", err.text);
}

static void check_in_place(const char *pass, const struct image *truth, const struct image *open, const char *what)
{
    struct image with;
    size_t n;
    if (!render(&with, pass, NULL)) return;
    double off = distance(&with, truth, open, &n);
    OK(n > 300 && off < 0.02, "%s pass: %s: %.4f off", pass, what, off);
    image_release(&with);
}

/* The ground that nothing keeps the sun from is rendered without asking. */
static void check_sunlit(struct shaded_ground *ground, const struct passes *p, const char *folder)
{
    struct error err = ERROR_NONE;
    struct image asked[PASSES] = { 0 }, told = { 0 };
    size_t without = 0, with = 0;
    bool ok = true;
    for (int i = 1; i < PASSES; i++) ok = ok && render(&asked[i], pass_names[i], NULL);
    struct sunlit_input in = { p->light->sun_direction, p->entities, p->entity_count, NULL, &p->surroundings->sun_share };
    ok = OK(ok && sunlit_ground_find(ground, &in, &err) && passes_write(folder, p, &err), "sunlit ground %s", err.text);
    for (size_t i = 0; ok && i < ground->triangles; i++) {
        without += ground->sunlit[i].without;
        with += ground->sunlit[i].with;
    }
    OK(0 < with && with < without && without < ground->triangles, "of %zu triangles %zu, and past the box %zu, are sunlit", ground->triangles, without, with);
    for (int i = 1; ok && i < PASSES; i++) {
        double most = 0;
        if (!render(&told, pass_names[i], NULL)) break;
        for (size_t k = 0; k < image_size(&told) / sizeof(float); k++)
            most = fmax(most, fabs((double)(((float *)told.data)[k] - ((float *)asked[i].data)[k])));
        NEAR(most, 0, 1e-6, "%s pass: the same pixels", pass_names[i]);
        image_release(&told);
    }
    for (int i = 1; i < PASSES; i++) image_release(&asked[i]);
    free(ground->sunlit);
    ground->sunlit = NULL;
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct light light;
    struct receiver receiver = { 0 };
    struct shaded_ground ground = { 0 };
    struct solid box;
    struct pass_surroundings around = { .sun_share_map = "frames/sun-share.png", .orthophoto = "frames/ground.png",
                                        .orthophoto_coarse = "frames/ground.png", .low_m = { -15, -15 }, .high_m = { 15, 15 },
                                        .ground_albedo = { 0.3, 0.3, 0.3 } };
    struct image even;
    char sky_map[SKY_MAP_SIZE];
    scene.sun_elevation_rad = atan(SUN_SLOPE);
    solid_box(&box, 1, 1, 2);
    struct entity entity = { .id = 1, .name = "box", .model_name = "box", .class_ = CLASS_OTHER, .model = &box.model,
                             .world_from_entity = entity_stand(&scene.ground, vec3(0, 0, 0), 0) };
    const struct model_include include = model_include(0, &entity);
    struct passes p = { .scene = &scene, .sky_map = sky_map, .light = &light, .world_from_camera = looking(vec3(4, -9, 5), vec3(0, 0, 0.8)),
                        .entities = &entity, .includes = &include, .entity_count = 1, .ground = scene.ground, .receivers = &ground };
    if (!OK(mkdtemp(out) != NULL && draw_map(&around.sun_share), "a map")) return tap_done();
    char *folder = string_format("%s/frames", out), *map = string_format("%s/sun-share.png", folder), *orthophoto = string_format("%s/ground.png", folder);
    if (!OK(image_init(&even, 8, 8, 3, PIXEL_U8, &err), "even ground")) return tap_done();
    fill_px(&even, 0, 0, 8, 8, 0.3, 0.3, 0.3);
    bool ok = folder_make(folder, &err) && image_write(map, &around.sun_share.map, &err) && image_write(orthophoto, &even, &err) && light_create(&light, &scene, &err) &&
              sky_map_write(sky_map, out, &light, &err) && receiver_create(&receiver, &entity, &scene.ground, &light, false, NULL, &err) &&
              view_cover(&p.view, &camera, (struct rect){ 0, 0, WIDTH, HEIGHT }, 1, &err) &&
              shaded_ground_of_plane(&ground, &scene.ground, &receiver, 1, &err) && shade_ground(&ground, &p, &receiver, NULL, &err) &&
              model_include_write(&include, NULL, out, &entity, &err);
    p.surroundings = &around;
    double top = LINE_M + WALL_M * SUN_SLOPE;
    static const char unseen[] = "pigment { rgb 0 } no_image no_reflection no_radiosity }";
    char *shape = wall_of(50, 0, top), *above = wall_of(1.5, top - 1, top + 2);
    char *wall = string_format("%s%s", shape, unseen), *both = string_format("%s%s%s", wall, above, unseen);
    struct image truth[PASSES] = { 0 }, open[PASSES] = { 0 }, more = { 0 };
    ok = OK(ok && passes_write(folder, &p, &err), "passes %s", err.text);
    for (int i = 0; ok && i < PASSES; i++) ok = test_pass(&truth[i], &open[i], pass_names[i], wall);
    if (ok) check_sunlit(&ground, &p, folder);
    ok = ok && render(&more, "plane", both);
    if (ok && write_in_place(&p, &around, folder, above, true))
        for (int i = 0; i < PASSES; i++) check_in_place(pass_names[i], &truth[i], &open[i], "where the map tells, what the place has casts nothing");
    if (ok && write_in_place(&p, &around, folder, above, false))
        check_in_place("plane", &more, &open[1], "where it does not, it does");
    for (int i = 0; i < PASSES; i++) {
        image_release(&truth[i]);
        image_release(&open[i]);
    }
    image_release(&more);
    free(shape);
    free(above);
    free(wall);
    free(both);
    free(map);
    free(orthophoto);
    image_release(&even);
    free(folder);
    sun_share_release(&around.sun_share);
    shaded_ground_release(&ground);
    receiver_release(&receiver);
    light_release(&light);
    solid_free(&box);
    povray_remove(out);
    return tap_done();
}

/* What planes of five directions receive under a sky, rendered by POV-Ray, against the integral of that sky. */
#include "gen/render/passes.h"

#include "gen/light/sky_image.h"
#include "lib/image.h"
#include "tests/gen/povray.h"
#include "tests/tap.h"

enum { PLANES = 5, WIDTH = 1000, HEIGHT = 20 };
#define APART_M 20 /* they hide and light each other by a thousandth */
#define ABOVE_M 100

/* Level; and tilted 50 deg to four sides that are not the sun's. */
static struct vec3 normal_of(int plane)
{
    double tilt = plane ? 50 * M_PI / 180 : 0, turn = (plane - 1) * M_PI / 2 + 0.3;
    return vec3(sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt));
}

#define GLASS_M 120.0      /* a box round planes and camera, so that these are not seen through it */
#define GLASS_T 0.72
#define GLASS_SHARE 0.91   /* of an even hemisphere that glass of index 1.5 does not reflect at one surface; Walter and others 2007 */
enum { CELLS = 36, SIDE_VERTICES = (CELLS + 1) * (CELLS + 1), SIDE_TRIANGLES = 2 * CELLS * CELLS };

/* A closed box, in faces so small that what is kept of them is spread over all directions. */
static struct mesh glass_box(void)
{
    static float position[6 * SIDE_VERTICES][3], normal[6 * SIDE_VERTICES][3];
    static uint32_t triangle[6 * SIDE_TRIANGLES][3];
    size_t n = 0;
    for (int i = 0; i < 6 * SIDE_VERTICES; i++) {
        int axis = i / SIDE_VERTICES / 2, cell = i % SIDE_VERTICES;
        float sign = i / SIDE_VERTICES % 2 ? 1 : -1, half = (float)GLASS_M;
        position[i][axis] = sign * half;
        position[i][(axis + 1) % 3] = half * (float)(2 * (cell % (CELLS + 1)) - CELLS) / CELLS;
        position[i][(axis + 2) % 3] = half * (float)(2 * (cell / (CELLS + 1)) - CELLS) / CELLS;
        position[i][2] = position[i][2] / 2 + (float)(ABOVE_M + GLASS_M / 2 - 10);
        normal[i][axis] = sign;
    }
    for (int i = 0; i < 6 * CELLS * CELLS; i++) {
        int side = i / (CELLS * CELLS), row = i / CELLS % CELLS, column = i % CELLS;
        uint32_t a = (uint32_t)(side * SIDE_VERTICES + row * (CELLS + 1) + column), below = a + CELLS + 1;
        memcpy(triangle[n++], (uint32_t[3]){ a, a + 1, below + 1 }, sizeof *triangle);
        memcpy(triangle[n++], (uint32_t[3]){ a, below + 1, below }, sizeof *triangle);
    }
    return (struct mesh){ .position_m = position, .normal = normal, .triangle = triangle, .vertices = 6 * SIDE_VERTICES, .triangles = n,
                          .material = 1 };
}

/* White squares of 1.4 m far above the ground, so that they shade little of it. In: in_glass  the box, too. Out: materials, meshes (2) */
static struct model planes_model(struct material *materials, struct mesh *meshes, bool in_glass)
{
    static float position[4 * PLANES][3], normal[4 * PLANES][3];
    static uint32_t triangle[2 * PLANES][3];
    for (int i = 0; i < PLANES; i++) {
        struct vec3 n = normal_of(i), side = vec3_unit(vec3_cross(n, vec3(0.3, -0.8, 0.1))), up = vec3_cross(n, side);
        for (int k = 0; k < 4; k++) {
            struct vec3 p = vec3_add(vec3_scale(side, k == 1 || k == 2 ? 0.7 : -0.7), vec3_scale(up, k >= 2 ? 0.7 : -0.7));
            float *to = position[4 * i + k], *towards = normal[4 * i + k];
            to[0] = (float)(p.x + (i - PLANES / 2) * APART_M), to[1] = (float)p.y, to[2] = (float)(p.z + ABOVE_M);
            towards[0] = (float)n.x, towards[1] = (float)n.y, towards[2] = (float)n.z;
        }
        for (int k = 0; k < 2; k++)
            for (int corner = 0; corner < 3; corner++)
                triangle[2 * i + k][corner] = (uint32_t)(4 * i + (corner == 0 ? 0 : corner + k));
    }
    material_default(&materials[0]);
    material_default(&materials[1]);
    materials[1].kind = FINISH_GLASS;
    materials[1].transmission = GLASS_T;
    meshes[0] = (struct mesh){ .position_m = position, .normal = normal, .triangle = triangle, .vertices = 4 * PLANES, .triangles = 2 * PLANES };
    struct model model = { .meshes = meshes, .mesh_count = 1, .materials = materials, .material_count = 2,
                           .min_m = { -60, -3, ABOVE_M - 3 }, .max_m = { 60, 3, ABOVE_M + 3 } };
    if (!in_glass) return model;
    meshes[model.mesh_count++] = glass_box();
    model.min_m = vec3(-GLASS_M, -GLASS_M, ABOVE_M - 10);
    model.max_m = vec3(GLASS_M, GLASS_M, ABOVE_M + GLASS_M - 10);
    return model;
}

/* Mean of the pixels that a plane fills. */
static bool mean_of(double rgb[3], const struct image *object, int plane)
{
    int n = 0;
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int y = 0; y < object->height_px; y++)
        for (int x = plane * WIDTH / PLANES; x < (plane + 1) * WIDTH / PLANES; x++) {
            const float *p = image_f32(object, x, y);
            bool inside = true;
            for (int k = 0; k < 9 && inside; k++) {
                int nx = x + k % 3 - 1, ny = y + k / 3 - 1;
                inside = nx >= 0 && ny >= 0 && nx < object->width_px && ny < object->height_px && image_f32(object, nx, ny)[3] > 0.99f;
            }
            if (!inside) continue;
            n++;
            for (int c = 0; c < 3; c++) rgb[c] += (double)p[c];
        }
    for (int c = 0; c < 3 && n; c++) rgb[c] /= n;
    return n > 40;
}

static char out[] = "sky_povray.XXXXXX";

/* The object pass: the sky by radiosity, the sun, and the ground that bounces both. In: level  what level ground receives, NAN: not known;
 * in_glass  all of it comes through glass */
static void check_object_pass(const struct scene *scene, const struct light *light, const char *name, double level, bool in_glass)
{
    struct error err = ERROR_NONE;
    struct material materials[2];
    struct mesh meshes[2];
    struct model model = planes_model(materials, meshes, in_glass);
    double share = in_glass ? GLASS_SHARE * GLASS_T : 1, within = in_glass ? 0.1 : 0.02;
    struct entity entity = { .id = 1, .name = "planes", .model_name = "planes", .class_ = CLASS_OTHER, .model = &model,
                             .world_from_entity = entity_stand(&scene->ground, vec3(0, 0, 0), M_PI / 2) };
    /* North is up in the picture, the planes lie from west to east: an entity that heads east has its axes the world's. */
    const struct camera camera = { .model = CAMERA_PINHOLE, .width_px = WIDTH, .height_px = HEIGHT,
                                   .params = { 1000, 1000, WIDTH / 2.0, HEIGHT / 2.0 } };
    const struct pose world_from_camera = { mat3_from_columns(vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, -1)), { 0, 0, ABOVE_M + 100 } };
    const struct model_include include = model_include(0, &entity);
    const struct shaded_ground nothing = { 0 };
    char sky_map[SKY_MAP_SIZE];
    struct image object = { 0 };
    struct passes p = { .scene = scene, .light = light, .world_from_camera = world_from_camera, .entities = &entity, .sky_map = sky_map,
                        .includes = &include, .entity_count = 1, .ground = scene->ground, .receivers = &nothing };
    char *folder = string_format("%s/frames", out), *path = string_format("%s/object.exr", folder);
    bool ok = sky_map_write(sky_map, out, light, &err) && view_cover(&p.view, &camera, (struct rect){ 0, 0, WIDTH, HEIGHT }, 1, &err) &&
              model_include_write(&include, NULL, out, &entity, &err) && passes_write(folder, &p, &err) &&
              povray(out, "object", p.view.width_px, p.view.height_px, "-A -J") && image_read(&object, path, &err);
    if (OK(ok, "%s: POV-Ray renders the planes", name))
        for (int i = 0; i < PLANES; i++) {
            double got[3], want[3];
            light_irradiance(want, light, normal_of(i));
            if (!OK(mean_of(got, &object, i), "%s: plane %d is in the picture", name, i)) continue;
            if (i == 0 && isfinite(level))
                NEAR(got[1], level, 0.02 * level, "%s: level ground receives what an integral by hand says (%+.2f %%)", name, 100 * (got[1] / level - 1));
            for (int c = 0; c < 3; c++)
                NEAR(got[c], share * want[c], within * share * want[c], "%s: plane %d receives what the integral says, channel %d (%+.2f %%)",
                     name, i, c, 100 * (got[c] / (share * want[c]) - 1));
        }
    else
        printf("# %s %s; %s/povray.log\n", err.file, err.text, out);
    image_release(&object);
    free(folder);
    free(path);
}

/* Level ground under the overcast sky of (3/7) (1 + 2 sin e), of level light 1, between walls up to an elevation all round: the
 * integral by hand. A wall receives of the sky (2/pi) times its integral over cos^2 e, of the walls opposite V = (a + sin a cos a) / pi, and half the
 * ground's, of which all is linear in what it sends. */
static double between_walls(double a, double wall_albedo, double ground_albedo)
{
    double s = sin(a), c = cos(a), sky = 3.0 / 7 * (1 - s * s + 4.0 / 3 * (1 - s * s * s));
    double on_wall = 6 / (7 * M_PI) * (M_PI / 4 - (a + s * c) / 2 + 2 * c * c * c / 3), v = (a + s * c) / M_PI;
    double wall = wall_albedo * (on_wall + ground_albedo * sky / 2) / (1 - wall_albedo * (v + ground_albedo * s * s / 2));
    return sky + wall * s * s;
}

/* The lights that stand for the sky where shade is measured. */
static void check_lights(const struct light *light, size_t n, const char *name)
{
    struct sky_light lights[512];
    light_sample_sky(lights, n, light);
    for (int i = 0; i < PLANES; i++) {
        double got = 0, want[3];
        struct light above = *light;
        struct error err = ERROR_NONE;
        if (!image_init(&above.sky, light->sky.width_px, light->sky.height_px, 3, PIXEL_F32, &err)) exit(1);
        memcpy(above.sky.data, light->sky.data, image_size(&light->sky) / 2); /* the ground gives them no light */
        light_sky_irradiance(want, &above, normal_of(i));
        image_release(&above.sky);
        for (size_t k = 0; k < n; k++) got += luminance_of(lights[k].color) * fmax(0, vec3_dot(lights[k].direction, normal_of(i)));
        double off = got / luminance_of(want) - 1;
        if (i == 0) OK(fabs(off) < 1e-4, "%s: %zu lights give level ground the sky's light", name, n);
        else OK(fabs(off) < 0.09, "%s: on plane %d they give it to %+.1f %%: where it is tilted the shade's share counts", name, i, 100 * off);
    }
}

/* Unlike all round, and bright in one place, yet no sun. */
static bool write_map(const char *path, struct error *err)
{
    struct image map;
    if (!image_init(&map, 256, 128, 3, PIXEL_F32, err)) return false;
    for (int row = 0; row < 128; row++)
        for (int column = 0; column < 256; column++) {
            struct vec3 d = sky_direction(&map, column, row);
            double cloud = exp(8 * (vec3_dot(d, vec3_unit(vec3(0.5, -0.6, 0.5))) - 1));
            for (int c = 0; c < 3; c++) image_f32(&map, column, row)[c] = (float)(1 + 0.3 * c + 6 * cloud);
        }
    bool ok = image_write(path, &map, err);
    image_release(&map);
    return ok;
}

int main(void)
{
    struct error err = ERROR_NONE;
    if (!OK(mkdtemp(out) != NULL, "a folder to render in")) return tap_done();
    char *map = string_format("%s/map.exr", out), *folder = string_format("%s/frames", out);
    if (!OK(folder_make(folder, &err) && write_map(map, &err), "a measured sky")) return tap_done();
    const struct scene base = {
        .path = "scene.yaml", .sun = SUN_GIVEN, .sun_azimuth_rad = 1, .sun_elevation_rad = 0.6, .turbidity = 2.5, .sun_scale = 1,
        .ground = { { 0, 0, 1 }, 0 }, .ground_albedo = { 0.22, 0.2, 0.18 }, .quality = QUALITY_HIGH, .map = { .file = map },
    };
    static const struct { const char *name; enum sky_kind sky; int cie_type; enum sun_kind sun; double skyline_rad; } skies[] = {
        { "clear", SKY_CLEAR, 0, SUN_GIVEN, 0 },       { "overcast", SKY_OVERCAST, 0, SUN_NONE, 0 }, { "standard sky 7", SKY_CIE, 7, SUN_GIVEN, 0 },
        { "standard sky 12", SKY_CIE, 12, SUN_GIVEN, 0 }, { "measured", SKY_MAP, 0, SUN_NONE, 0 }, { "between walls", SKY_OVERCAST, 0, SUN_NONE, 0.5 },
    };
    for (size_t i = 0; i < sizeof skies / sizeof *skies; i++) {
        struct scene scene = base;
        struct light light;
        scene.sky = skies[i].sky;
        scene.cie_type = skies[i].cie_type;
        scene.sun = skies[i].sun;
        double line[1][2] = { { 0, skies[i].skyline_rad } };
        scene.skyline = (struct scene_skyline){ .point_rad = line, .count = skies[i].skyline_rad > 0, .albedo = { 0.3, 0.3, 0.25 } };
        if (!OK(light_create(&light, &scene, &err), "%s: a light", skies[i].name)) continue;
        check_object_pass(&scene, &light, skies[i].name, skies[i].sky == SKY_OVERCAST ? between_walls(skies[i].skyline_rad, 0.3, 0.2) : NAN, false);
        if (i == 1) check_object_pass(&scene, &light, "overcast, in glass", NAN, true);
        scene.quality = QUALITY_STANDARD;
        check_lights(&light, pass_settings(scene.quality).sky_directions, skies[i].name);
        light_release(&light);
    }
    free(map);
    free(folder);
    povray_remove(out);
    return tap_done();
}

/* A place as POV-Ray renders it: its own shade in every pass, nothing where nobody is, and the fill. By the geometry of a
 * wall: it stands along y at x = 0, 3 m high, with the sun low in the east-west plane behind it, so that the ground from
 * x = 0 to 3 lies in its shade. */
#include "gen/render/passes.h"

#include "gen/render/place_sdl.h"
#include "gen/world/shading.h"
#include "gen/world/surroundings.h"
#include "lib/file.h"
#include "tests/gen/place.h"
#include "tests/gen/povray.h"
#include "tests/gen/shade.h"
#include "tests/gen/solid.h"
#include "tests/tap.h"

enum { WIDTH = 160, HEIGHT = 120 };
enum { OBJECT, PLANE, SHADOW };
static char out[] = "place-sdl.XXXXXX";

/* Straight down from 40 m: 5 px a metre on the ground. */
static const struct camera camera = { .model = CAMERA_PINHOLE, .width_px = WIDTH, .height_px = HEIGHT, .params = { 200, 200, 80, 60 } };
static const struct pose above = { { { { 1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } } }, { 3, 0, 40 } };

/* The passes of a box at (x, 0), without anti-aliasing. */
static bool render(struct image pass[3], struct scene *scene, const struct light *light, const char *sky_map,
                   const struct static_mesh *mesh, struct entity *entity, double x)
{
    static const char *const names[] = { "object", "plane", "shadow" };
    const struct plane flat = { { 0, 0, 1 }, 0 };
    struct error err = ERROR_NONE;
    struct receiver receiver;
    struct surroundings around;
    struct static_cut receivers = { 0 }, near = { 0 }, shades = { 0 }, rest = { 0 };
    struct shaded_ground ground = { 0 };
    entity->world_from_entity = entity_stand(&flat, vec3(x, 0, 0), M_PI / 4);
    const struct model_include include = model_include(0, entity);
    struct passes p = { .scene = scene, .sky_map = sky_map, .light = light, .world_from_camera = above, .entities = entity,
                        .includes = &include, .entity_count = 1, .ground = { { 0, 0, 1 }, -0.5 }, .receivers = &ground,
                        .place_include = "frames/place.inc", .shades_include = "frames/shades.inc" };
    char *folder = string_format("%s/frames", out), *file = string_format("%s/place.inc", folder);
    char *shades_path = string_format("%s/shades.inc", folder);
    bool ok = receiver_create(&receiver, entity, &flat, light, x < 3, NULL, &err) &&
              surroundings_create(&around, &receiver, entity, 1, light, 3, &err) &&
              static_mesh_cut(mesh, &receivers, around.receivers, around.n, &err) &&
              static_mesh_cut(mesh, &near, around.shades, around.shade_count, &err) &&
              shading_part(&shades, &rest, &near, &receivers, &light->sun_direction, light->has_sun, &err) &&
              place_include_write(file, &receivers, &rest, &err) &&
              shades_include_write(shades_path, &shades, (const size_t[TOLD_KINDS]){ shades.triangles }, &err) &&
              view_cover(&p.view, &camera, (struct rect){ 0, 0, WIDTH, HEIGHT }, 1, &err) &&
              shaded_ground_of_cut(&ground, &receivers, &err) && shade_ground(&ground, &p, &receiver, &near, &err) &&
              model_include_write(&include, NULL, out, entity, &err) && passes_write(folder, &p, &err);
    for (int i = 0; ok && i < 3; i++) {
        char *path = string_format("%s/%s.exr", folder, names[i]);
        ok = povray(out, names[i], WIDTH, HEIGHT, "-A") && image_read(&pass[i], path, &err);
        free(path);
    }
    if (!ok) printf("# %s %s; %s/povray.log\n", err.file, err.text, out);
    free(folder);
    free(file);
    free(shades_path);
    shaded_ground_release(&ground);
    static_cut_release(&receivers);
    static_cut_release(&near);
    static_cut_release(&shades);
    static_cut_release(&rest);
    surroundings_release(&around);
    receiver_release(&receiver);
    return ok;
}

/* Green at the height z over (x, y). */
static const float *at(const struct image *pass, double x, double y, double z)
{
    struct error err = ERROR_NONE;
    struct vec2 q = { 0, 0 };
    camera_project(&camera, &q, pose_apply(pose_inverse(above), vec3(x, y, z)), &err);
    return image_f32(pass, (int)q.x, (int)q.y);
}

static void release(struct image pass[3])
{
    for (int i = 0; i < 3; i++) image_release(&pass[i]);
}

/* Where the ground of the plane pass is lit as a level ground in the open is, and where the wall's shade leaves the sky. */
static void check_ground(const struct image pass[3], const struct scene *scene, const struct light *light)
{
    double open = scene->ground_albedo[1] * light->irradiance[1];
    double sky = open - scene->ground_albedo[1] * light->sun_color[1] * light->sun_direction.z;
    const float *lit = at(&pass[PLANE], 3.7, -0.5, 0), *dark = at(&pass[PLANE], 2, -2.5, 0);
    OK(lit[3] > 0.99f && dark[3] > 0.99f, "both sides of the shade's edge receive");
    NEAR((double)lit[1], open, 0.25 * open, "ground in the sun has the light of open ground, but for the wall's share of the sky");
    OK((double)dark[1] < sky && (double)dark[1] > 0.3 * sky, "in the wall's shade the plane pass has the sky's light alone (%.3f of %.3f)",
       (double)dark[1], sky);
    NEAR((double)at(&pass[SHADOW], 2, -2.5, 0)[1], (double)dark[1], 0.1 * (double)dark[1],
         "and a shadow pass that hardly differs: the sun is not taken twice");
    size_t edge = 0, edge_wrong = 0, brighter = 0, changed = 0;
    for (int y = 1; y + 1 < HEIGHT; y++)
        for (int x = 1; x + 1 < WIDTH; x++) {
            const float *p = image_f32(&pass[PLANE], x, y), *s = image_f32(&pass[SHADOW], x, y);
            bool border = false, foot = fabs((x + 0.5 - 80) / 5 + 3) < 0.5; /* there half the sky is gone already */
            for (int k = 0; k < 9; k++) border = border || image_f32(&pass[PLANE], x + k % 3 - 1, y + k / 3 - 1)[3] == 0;
            edge += border && p[3] > 0;
            edge_wrong += p[3] != s[3] || (border && !foot && p[3] > 0 && fabs((double)(s[1] / p[1]) - 1) > 0.025);
            if (p[3] == 0) continue;
            brighter += s[1] > 1.001f * p[1];
            changed += s[1] < 0.9f * p[1];
        }
    OK(changed > 20, "the box takes light from the ground (%zu px)", changed);
    OK(brighter == 0, "nothing is brighter for the box's shade");
    OK(edge > 50 && edge_wrong == 0, "along the receivers' edges plane and shadow pass agree (%zu px)", edge);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct scene scene = { .path = "scene.yaml", .sky = SKY_CLEAR, .sun = SUN_GIVEN, .sun_azimuth_rad = 3 * M_PI / 2,
                           .sun_elevation_rad = M_PI / 4, .turbidity = 3, .sun_scale = 1, .ground = { { 0, 0, 1 }, 0 },
                           .ground_albedo = { 0.2, 0.2, 0.2 }, .quality = QUALITY_HIGH };
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct light light;
    struct solid box;
    struct image sun[3] = { { 0 } }, shade[3] = { { 0 } }, filled[3] = { { 0 } };
    char sky_map[SKY_MAP_SIZE];
    for (int i = -20; i < 20; i++)
        for (int k = -20; k < 20; k++)
            place_quad(&place, (const double[4][3]){ { i, k, 0 }, { i + 1, k, 0 }, { i + 1, k + 1, 0 }, { i, k + 1, 0 } }, 0);
    place_quad(&place, (const double[4][3]){ { 0, -15, 0 }, { 0, 15, 0 }, { 0, 15, 3 }, { 0, -15, 3 } }, 0);
    solid_box(&box, 2, 2, 1);
    for (size_t i = 0; i < box.mesh.vertices; i++) /* flat enough: the top's own light is what is measured */
        box.mesh.normal[i][0] = box.mesh.normal[i][1] = 0;
    box.material.base_color[0] = box.material.base_color[1] = box.material.base_color[2] = 0.5f;
    box.material.roughness = 1;
    struct entity entity = { .id = 1, .name = "box", .model_name = "box", .class_ = CLASS_OTHER, .model = &box.model };
    if (!OK(mkdtemp(out) != NULL && place_mesh(&mesh, &place, false, &err) && light_create(&light, &scene, &err) &&
            sky_map_write(sky_map, out, &light, &err), "a place and its light %s", err.text))
        return tap_done();

    if (OK(render(sun, &scene, &light, sky_map, mesh, &entity, 7), "a box in the sun is rendered") &&
        OK(render(shade, &scene, &light, sky_map, mesh, &entity, 1.4), "a box in the wall's shade is rendered")) {
        check_ground(shade, &scene, &light);
        double bright = (double)at(&sun[OBJECT], 7, 0, 1)[1], dark = (double)at(&shade[OBJECT], 1.4, 0, 1)[1];
        NEAR((double)at(&shade[OBJECT], 1.4, 0, 1)[3], 1, 1e-3, "the box is seen");
        double sun_share = light.sun_color[1] * light.sun_direction.z / light.irradiance[1];
        OK(dark < bright * (1 - sun_share) * 1.15, "in the wall's shade its top loses the sun (%.3f to %.3f)", bright, dark);
        OK(dark > 0.02 * bright, "and keeps some of the sky");
        scene.fill = 0.2;
        if (OK(render(filled, &scene, &light, sky_map, mesh, &entity, 7), "with a fill")) {
            double lift = (double)at(&filled[OBJECT], 7, 0, 1)[1] - bright, want = 0.2 * 0.5 * light.irradiance[1];
            NEAR(lift, want, 0.01 * want, "far from the wall its top is lifted by the fill times its albedo");
            OK(!memcmp(filled[PLANE].data, sun[PLANE].data, image_size(&sun[PLANE])) &&
               !memcmp(filled[SHADOW].data, sun[SHADOW].data, image_size(&sun[SHADOW])), "the ground is not");
        }
    }
    release(sun);
    release(shade);
    release(filled);
    solid_free(&box);
    place_free(&place);
    static_mesh_destroy(mesh);
    light_release(&light);
    povray_remove(out);
    return tap_done();
}

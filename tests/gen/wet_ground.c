/* Wet ground, as the plane pass renders it, against Fresnel as Schlick has it and the overcast sky of Moon and Spencer: beside
 * its own light it shows, straight from above, its mirror share of the sky overhead, and more of a darker sky aslant. Rough
 * ground shows the mean of the sky round there. */
#include "gen/render/passes.h"

#include "lib/file.h"
#include "tests/gen/povray.h"
#include "tests/gen/shade.h"
#include "tests/gen/solid.h"
#include "tests/tap.h"

enum { WIDTH = 120, HEIGHT = 120 };
#define HEIGHT_M 2.0
#define MIRROR 0.06
#define ALBEDO 0.1

/* Of a level surface's irradiance / pi: the zenith of this sky is 9/7 of it. */
static double sky_at(double sine)
{
    return 9.0 / 7 * (1 + 2 * sine) / 3;
}

static double mirror_at(double cosine)
{
    return (MIRROR + (1 - MIRROR) * pow(1 - cosine, 5)) * sky_at(cosine);
}

static double rough_at(double cosine, double roughness)
{
    struct wet_rays rays;
    double sum = 0;
    wet_rays(&rays, &(struct wet){ MIRROR, roughness }, vec3(0, 0, 1), vec3(sqrt(1 - cosine * cosine), 0, cosine), WET_RAYS_MAX);
    for (size_t i = 0; i < rays.n; i++) sum += rays.weight[i] * sky_at(rays.direction[i].z);
    return sum;
}

static void check(double roughness)
{
    const struct camera camera = { .model = CAMERA_PINHOLE, .width_px = WIDTH, .height_px = HEIGHT, .params = { 35, 35, 60, 60 } };
    const struct pose above = { { { { 1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } } }, { 0, 0, HEIGHT_M } };
    struct scene scene = { .path = "scene.yaml", .sky = SKY_OVERCAST, .sun = SUN_NONE, .sun_scale = 1, .ground = { { 0, 0, 1 }, 0 },
                           .ground_albedo = { ALBEDO, ALBEDO, ALBEDO }, .wet = { MIRROR, roughness }, .quality = QUALITY_STANDARD };
    struct error err = ERROR_NONE;
    char out[] = "wet_ground.XXXXXX", sky_map[SKY_MAP_SIZE];
    struct light light;
    struct receiver receiver;
    struct shaded_ground ground;
    struct solid box;
    struct image plane;
    solid_box(&box, 2, 2, 1);
    struct entity entity = { .id = 1, .name = "box", .model_name = "box", .class_ = CLASS_OTHER, .model = &box.model,
                             .world_from_entity = entity_stand(&scene.ground, vec3(0, 0, 0), 0) };
    const struct model_include include = model_include(0, &entity);
    struct passes p = { .scene = &scene, .sky_map = sky_map, .light = &light, .world_from_camera = above, .entities = &entity,
                        .includes = &include, .entity_count = 1, .ground = scene.ground, .receivers = &ground };
    if (!OK(mkdtemp(out) != NULL, "a folder to render in")) return;
    char *folder = string_format("%s/frames", out), *path = string_format("%s/plane.exr", folder);
    bool ok = light_create(&light, &scene, &err) && sky_map_write(sky_map, out, &light, &err) &&
              receiver_create(&receiver, &entity, &scene.ground, &light, false, NULL, &err) &&
              view_cover(&p.view, &camera, (struct rect){ 0, 0, WIDTH, HEIGHT }, 1, &err) &&
              shaded_ground_of_plane(&ground, &scene.ground, &receiver, 1, &err) && shade_ground(&ground, &p, &receiver, NULL, &err) &&
              model_include_write(&include, NULL, out, &entity, &err) && passes_write(folder, &p, &err) &&
              povray(out, "plane", p.view.width_px, p.view.height_px, "-A") && image_read(&plane, path, &err);
    if (!OK(ok, "wet ground of roughness %.1f is rendered %s; %s/povray.log", roughness, err.text, out)) return;
    double across = (double)p.view.width_px / WIDTH;
    for (int deg = 0; deg <= 55; deg += 11) {
        double cosine = cos(deg * M_PI / 180), want = ALBEDO + (roughness > 0 ? rough_at(cosine, roughness) : mirror_at(cosine)), aside_px = 35 * tan(deg * M_PI / 180);
        int x = (int)((60 + aside_px) * across), y = p.view.height_px / 2;
        const float *seen = image_f32(&plane, x, y);
        OK(seen[3] == 1, "%d deg aslant the ground receives", deg);
        NEAR((double)seen[1], want, 0.01 * want, "%d deg aslant it shows its own light and its mirror share of the sky", deg);
    }
    image_release(&plane);
    shaded_ground_release(&ground);
    receiver_release(&receiver);
    light_release(&light);
    solid_free(&box);
    free(folder);
    free(path);
    povray_remove(out);
}

int main(void)
{
    check(0);
    check(0.4);
    return tap_done();
}

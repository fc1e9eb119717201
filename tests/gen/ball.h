/* A ball among surroundings taken from a picture, as POV-Ray renders it. */
#ifndef STAFFAGE_TESTS_GEN_BALL_H
#define STAFFAGE_TESTS_GEN_BALL_H

#include "gen/light/orthophoto.h"
#include "gen/render/passes.h"
#include "gen/render/place_sdl.h"
#include "tests/gen/povray.h"
#include "tests/gen/solid.h"
#include "tests/gen/view_above.h"
#include "tests/tap.h"

enum { WIDTH = 160, HEIGHT = 120, ROUND = 64 };

static const struct camera camera = { .model = CAMERA_PINHOLE, .width_px = WIDTH, .height_px = HEIGHT, .params = { 180, 180, 80, 60 } };
static const struct vec3 eye = { 0, -8, 5 }, middle = { 0, 0, 1 };
static char out[] = "surroundings.XXXXXX";
static struct scene scene = {
    .path = "scene.yaml", .sky = SKY_CLEAR, .sun = SUN_GIVEN, .sun_azimuth_rad = 1, .sun_elevation_rad = 0.8, .turbidity = 3, .sun_scale = 1,
    .ground = { { 0, 0, 1 }, 0 }, .ground_albedo = { 0.3, 0.3, 0.3 }, .quality = QUALITY_DRAFT,
};

/* What stands around, when it has a picture. */
static struct { struct image map; struct vec3 from_m, centre_m; double radius_m; const struct relief *relief;
                const struct hidden_place *hidden; bool no_relief_map; } circle;

/* Of radius 1, its middle at `middle`. */
static void ball(struct solid *solid)
{
    solid_egg(solid, 2, 2, 2, ROUND);
    for (size_t i = 0; i < solid->mesh.vertices; i++)
        for (int k = 0; k < 3; k++) solid->mesh.normal[i][k] = solid->mesh.position_m[i][k] - (k == 2);
}

/* Is a pixel's centre on one side of all edges of a convex outline? */
static bool inside(const struct occluder *o, int x, int y)
{
    int left = 0, right = 0;
    for (size_t i = 0; i < o->polygon_count; i++) {
        struct vec2 a = o->polygon_px[i], b = o->polygon_px[(i + 1) % o->polygon_count];
        *((b.x - a.x) * (y + 0.5 - a.y) < (b.y - a.y) * (x + 0.5 - a.x) ? &left : &right) += 1;
    }
    return !left || !right;
}

/* Where nothing stands before the ground. */
static bool hide(struct image *unhidden, const struct occluder *occluder)
{
    struct error err = ERROR_NONE;
    if (!image_init(unhidden, WIDTH, HEIGHT, 1, PIXEL_U8, &err)) return false;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) *image_u8(unhidden, x, y) = inside(occluder, x, y) ? 0 : 255;
    return true;
}

/* The object pass of a ball, over the ground that the picture shows or, without one, the scene's; beside what stands there. */
static bool render(struct image *pass, const struct light *light, const struct entity *entity, struct image *picture,
                   const struct occluder *occluder)
{
    struct error err = ERROR_NONE;
    char sky_map[SKY_MAP_SIZE], *folder = string_format("%s/frames", out), *path = string_format("%s/object.exr", folder);
    char *fine = string_format("%s/fine.png", folder), *coarse = string_format("%s/coarse.png", folder);
    char *standing = string_format("%s/standing.exr", folder);
    const struct model_include include = model_include(0, entity);
    const struct shaded_ground nothing = { 0 };
    struct image unhidden = { 0 };
    struct pass_standing thing = { .radiance = "frames/standing.exr" };
    struct pass_surroundings around = { .orthophoto = "frames/fine.png", .orthophoto_coarse = "frames/coarse.png", .standing = &thing };
    struct passes p = { .scene = &scene, .sky_map = sky_map, .light = light, .world_from_camera = looking(eye, middle), .entities = entity,
                        .includes = &include, .entity_count = 1, .ground = scene.ground, .receivers = &nothing };
    bool ok = folder_make(folder, &err) && sky_map_write(sky_map, out, light, &err) &&
              view_cover(&p.view, &camera, (struct rect){ 0, 0, WIDTH, HEIGHT }, 1, &err) && model_include_write(&include, NULL, out, entity, &err);
    if (ok && picture) {
        struct orthophoto ground;
        struct seen seen = { .picture = picture, .camera = &camera, .world_from_camera = p.world_from_camera, .k = { 1, 1, 1 } };
        seen_init(&seen);
        if (occluder) {
            ok = hide(&unhidden, occluder);
            seen.unhidden = &unhidden;
        }
        struct orthophoto_input in = { .seen = &seen, .light = light, .ground = &scene.ground, .entities = entity, .n = 1, .ground_albedo = { 0.3, 0.3, 0.3 } };
        ok = ok && orthophoto_create(&ground, &in, &err) && image_write(fine, &ground.mirrored, &err) && image_write(coarse, &ground.bouncing, &err);
        struct pass_standing *s = &around.standing[0];
        if (ok && occluder) ok = standing_create(&s->thing, &seen, occluder, NULL, &err) && s->thing.count && image_write(standing, &s->thing.radiance, &err);
        around.standing_count = occluder != NULL;
        around.low_m = ground.low_m;
        around.high_m = ground.high_m;
        memcpy(around.ground_albedo, ground.elsewhere, sizeof around.ground_albedo);
        if (circle.map.data) {
            char *map = string_format("%s/panorama.exr", folder);
            ok = ok && image_write(map, &circle.map, &err);
            free(map);
            strcpy(around.sky_map, "frames/panorama.exr");
            around.seen_from_m = circle.from_m;
            around.circle_m = circle.centre_m;
            around.circle_radius_m = circle.radius_m;
            if (circle.relief) {
                char *relief = string_format("%s/relief.inc", folder), *hidden = string_format("%s/hidden.exr", folder);
                ok = ok && (!circle.hidden || image_write(hidden, &circle.hidden->radiance, &err)) &&
                     relief_include_write(relief, circle.relief, circle.hidden, "frames/hidden.exr", &err);
                free(relief);
                free(hidden);
                strcpy(around.relief_include, "frames/relief.inc");
                if (!circle.no_relief_map) strcpy(around.relief_map, around.sky_map);
            }
        }
        p.surroundings = &around;
        orthophoto_release(&ground);
    }
    ok = ok && passes_write(folder, &p, &err) && povray(out, "object", WIDTH, HEIGHT, "-A -J") && image_read(pass, path, &err);
    if (!ok) printf("# %s %s; %s/povray.log\n", err.file, err.text, out);
    free(folder);
    free(path);
    free(fine);
    free(coarse);
    free(standing);
    standing_release(&thing.thing);
    image_release(&unhidden);
    return ok;
}

#endif

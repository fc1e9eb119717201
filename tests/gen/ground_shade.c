/* Shade on the ground of photographs: of one whose shade is known everywhere, and of a real one at pixels picked by eye. */
#include "gen/estimate/ground_shade.h"
#include "gen/estimate/sun_share.h"

#include "tests/gen/craig.h"
#include "tests/gen/place.h"
#include "tests/gen/street.h"
#include "tests/gen/view_above.h"
#include "tests/tap.h"

#define SKY_SEEN 0.8 /* of the sky, by what casts shadows */

static struct stage stage_of(const struct scene *scene)
{
    return (struct stage){ .scene = scene, .surface = { .plane = scene->ground } };
}

/* A light whose shadows have this ratio, if they see SKY_SEEN of the sky. */
static bool light_of(struct light *light, struct scene *scene, const double ratio[3])
{
    struct error err = ERROR_NONE;
    scene->sky = SKY_CLEAR;
    scene->turbidity = 3;
    scene->sun_scale = 1;
    scene->has_sky_share = true;
    for (int c = 0; c < 3; c++) scene->sky_share[c] = ratio[c] / SKY_SEEN;
    return OK(light_create(light, scene, &err), "light %s", err.text);
}

/* Is it the same some way round a point? */
static bool is_even(bool (*shade)(struct vec3 p), struct vec3 p, double way_m)
{
    for (int i = 0; i < 16; i++)
        if (shade(vec3(p.x + way_m * cos(i * M_PI / 8), p.y + way_m * sin(i * M_PI / 8), 0)) != shade(p)) return false;
    return true;
}

static bool is_tar(struct vec3 p) { return fabs(p.x + 6 - sin(p.y)) < 0.3; }
static bool is_paint(struct vec3 p) { return p.y > 24.1 && p.y < 26.9 && fmod(p.x + 40, 2) < 0.7; }

struct count { int right, all; };
static double part(struct count c) { return (double)c.right / fmax(1, c.all); }
static void add(struct count *c, bool right) { c->right += right, c->all++; }

/* The map over the street, to 1.5 m beyond the picture in the east. In: unhidden or NULL */
static bool map_of(struct sun_share *share, struct ground_shade *shade, struct scene *scene, const struct image *image,
                   const struct image *unhidden, const struct light *light)
{
    struct error err = ERROR_NONE;
    struct stage stage = stage_of(scene);
    struct vec3 corner[] = { { -10, 10, 0 }, { 16.5, 10, 0 }, { 16.5, 30, 0 }, { -10, 30, 0 } };
    struct receiver receiver = { .corner_m = corner, .corners = 4 };
    struct seen seen = { .picture = image, .camera = &lens, .world_from_camera = above(), .k = { 2, 3, 4 }, .unhidden = unhidden };
    seen_init(&seen);
    struct sun_share_input in = { .shade = shade, .seen = &seen, .ground = &scene->ground, .receivers = &receiver, .n = 1 };
    return OK(ground_shade_find(shade, &stage, image, unhidden, &scene->shots[0], light, &err) && sun_share_create(share, &in, &err),
              "the shade is looked for %s", err.text);
}

static void test_street(void)
{
    struct scene_camera camera;
    struct scene_shot shot;
    static char name[] = "street.png";
    struct scene scene = scene_of(&camera, &shot, name);
    struct made m = { .ratio = { 0.15, 0.2, 0.3 }, .balance = { 1.1, 1, 0.8 }, .shade = street_shade };
    struct error err = ERROR_NONE;
    struct image image, unhidden;
    struct light light;
    struct ground_shade shade;
    struct sun_share share, again;
    struct count lit = { 0 }, dark = { 0 }, tar = { 0 }, paint = { 0 }, hidden = { 0 }, line = { 0 }, beyond = { 0 };
    make_image(&image, &m);
    if (!light_of(&light, &scene, m.ratio) || !map_of(&share, &shade, &scene, &image, NULL, &light)) return;
    double truth = 0;
    for (int y = 0; y < STREET_HEIGHT; y++)
        for (int x = 0; x < STREET_WIDTH; x++) truth += street_shade(ground_at(x, y)) / (double)(STREET_WIDTH * STREET_HEIGHT);
    NEAR(shade.share, truth, 0.06, "so much of the ground in view is shaded");
    for (double y = 10.1; y < 29.9; y += 0.1)
        for (double x = -9.9; x < 12.9; x += 0.1) {
            struct vec3 p = vec3(x, y, 0);
            bool shaded = street_shade(p);
            double sun = sun_share_at(&share, (struct vec2){ x, y });
            if (!is_even(street_shade, p, 0.25)) continue;
            add(shaded ? &dark : &lit, shaded ? sun < 0.15 : sun > 0.9);
            if (shaded && is_paint(p)) add(&paint, sun < 0.15);
            if (shaded && fabs(y - 15) < 0.25) add(&line, sun < 0.15);
            if (!shaded && is_tar(p)) add(&tar, sun > 0.9);
        }
    OK(part(lit) > 0.995, "what is in the sun is lit: %.4f of it", part(lit));
    OK(part(dark) > 0.97, "what is not is shaded: %.4f", part(dark));
    OK(tar.all > 300 && part(tar) > 0.99, "tar in the sun is no shade: %.4f of %d", part(tar), tar.all);
    OK(paint.all > 40 && part(paint) > 0.9, "white paint in the shade is shaded: %.4f of %d", part(paint), paint.all);
    OK(line.all > 40 && part(line) > 0.9, "a yellow line in the shade, too: %.4f of %d", part(line), line.all);
    for (double y = 12; y < 28; y += 0.1)
        for (double x = 14.8; x < 15.5; x += 0.1) add(&beyond, sun_share_at(&share, (struct vec2){ x, y }) < 0.6);
    OK(part(beyond) > 0.98, "shade goes on at the picture's edge, and fades beyond: %.4f", part(beyond));
    NEAR(sun_share_at(&share, (struct vec2){ 50, 0 }), 1, 0, "far away the ground is lit");

    /* Two signs before the ground, one before its shade. */
    if (!image_init(&unhidden, STREET_WIDTH, STREET_HEIGHT, 1, PIXEL_U8, &err)) return;
    for (int y = 0; y < STREET_HEIGHT; y++)
        for (int x = 0; x < STREET_WIDTH; x++) {
            struct vec3 p = ground_at(x, y);
            *image_u8(&unhidden, x, y) = hypot(p.x - 11.8, p.y - 20) < 0.6 || hypot(p.x + 1, p.y - 20) < 0.6 ? 0 : 255;
        }
    for (int y = 0; y < STREET_HEIGHT; y++)
        for (int x = 0; x < STREET_WIDTH; x++)
            if (!*image_u8(&unhidden, x, y)) fill_px(&image, x, y, x + 1, y + 1, 0.6, 0.1, 0.1);
    struct ground_shade behind;
    if (map_of(&again, &behind, &scene, &image, &unhidden, &light)) {
        for (int i = 0; i < 16; i++) {
            add(&hidden, sun_share_at(&again, (struct vec2){ 11.8 + 0.4 * cos(i), 20 + 0.4 * sin(i) }) < 0.15);
            add(&hidden, sun_share_at(&again, (struct vec2){ -1 + 0.4 * cos(i), 20 + 0.4 * sin(i) }) > 0.9);
        }
        OK(part(hidden) > 0.99, "what a sign hides is as the ground beside it: %.3f", part(hidden));
        sun_share_release(&again);
        ground_shade_release(&behind);
    }
    sun_share_release(&share);
    ground_shade_release(&shade);
    light_release(&light);
    image_release(&image);
    image_release(&unhidden);
}

/* Photographs whose dark ground is no shade of the light that the scene has. */
static void test_no_shade(void)
{
    static const struct { struct made made; double light[3]; const char *what; } cases[] = {
        { { .ratio = { 1, 1, 1 }, .balance = { 1, 1, 1 }, .shade = no_shade }, { 0.15, 0.2, 0.3 }, "a street with no shade has none" },
        { { .ratio = { 0.2, 0.2, 0.2 }, .balance = { 1, 1, 1 }, .shade = street_shade }, { 0.15, 0.2, 0.3 }, "dark asphalt, as grey as the other, is no shade" },
        { { .ratio = { 0.15, 0.2, 0.3 }, .balance = { 1, 1, 1 }, .shade = street_shade }, { 0.5, 0.58, 0.7 }, "what is much deeper than the light's shade is none" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct scene_camera camera;
        struct scene_shot shot;
        static char name[] = "street.png";
        struct scene scene = scene_of(&camera, &shot, name);
        struct image image;
        struct light light;
        struct ground_shade shade;
        struct sun_share share;
        make_image(&image, &cases[i].made);
        if (!light_of(&light, &scene, cases[i].light) || !map_of(&share, &shade, &scene, &image, NULL, &light)) return;
        OK(!shade.found && !share.map.data && !(shade.share > 0), "%s", cases[i].what);
        NEAR(sun_share_at(&share, (struct vec2){ 11, 20 }), 1, 0, "the sun reaches all of it");
        light_release(&light);
        image_release(&image);
    }
}

/* On craig's ground in the morning sun. */
static const int craig_shade[][2] = { { 888, 1415 }, { 1250, 1298 }, { 1408, 1344 }, { 653, 1325 }, { 459, 1321 }, { 204, 1388 }, { 850, 1440 },
                                      { 880, 1400 }, { 1260, 1280 }, { 100, 840 }, { 835, 473 } };
static const int craig_sun[][2] = { { 975, 1415 }, { 1250, 1395 }, { 1462, 1344 }, { 653, 1395 }, { 459, 1369 }, { 900, 340 }, { 1000, 900 }, { 560, 730 },
                                    { 1185, 895 }, { 1250, 1000 }, { 1345, 718 }, { 1730, 890 }, { 1950, 1440 }, { 700, 870 }, { 1500, 600 }, { 850, 1100 } };

static void test_craig(void)
{
    struct error err = ERROR_NONE;
    struct scene *scene = NULL;
    struct image image = { 0 };
    struct light light;
    struct ground_shade shade;
    if (!tap_shared()) {
        SKIP("shade, tar, drain covers and markings on craig's asphalt", "no ../shared");
        return;
    }
    bool ok = craig_scene(&scene, "sunny_2021-05-01T14-53-40.jpg",
                          "north_deg: 40\nlight: {sky: clear, sky_share: [0.14, 0.18, 0.26]}\nexposure: {patch_px: [890, 690, 1030, 780]}", &err) &&
              image_read(&image, scene->shots[0].photograph, &err) && light_create(&light, scene, &err);
    struct stage stage = stage_of(scene);
    if (!OK(ok && ground_shade_find(&shade, &stage, &image, NULL, &scene->shots[0], &light, &err), "craig in the sun %s", err.text)) return;
    for (size_t i = 0; i < sizeof craig_shade / sizeof *craig_shade + sizeof craig_sun / sizeof *craig_sun; i++) {
        bool shaded = i < sizeof craig_shade / sizeof *craig_shade;
        const int *q = shaded ? craig_shade[i] : craig_sun[i - sizeof craig_shade / sizeof *craig_shade];
        double linear[3], sun = -1;
        for (int c = 0; c < 3; c++) linear[c] = (double)linear_from_srgb(image_u8(&image, q[0], q[1])[c] / 255.0f);
        ground_shade_sun(&shade, &sun, (struct vec2){ q[0] + 0.5, q[1] + 0.5 }, linear);
        NEAR(sun, shaded ? 0 : 1, 0.1, "%s at pixel %d, %d", shaded ? "shade" : "sun", q[0], q[1]);
    }
    OK(shade.share > 0.02 && shade.share < 0.08, "%.3f of the ground is shaded", shade.share);
    ground_shade_release(&shade);
    light_release(&light);
    image_release(&image);
    scene_destroy(scene);
}

/* --- over a mesh --- */

static const struct vec3 mesh_sun = { 0.6, 0, 0.8 };
static bool is_in(struct vec3 p, double x0, double x1, double y0, double y1) { return p.x > x0 && p.x < x1 && p.y > y0 && p.y < y1; }

/* A tree's shade, a lamp post's, and that of a wall 1 m high. */
static bool wall_shade(struct vec3 p) { return is_in(p, -0.75, 0, 11, 14); }
static bool seen_shade(struct vec3 p) { return is_in(p, 5, 8, 17, 23) || is_in(p, -3.6, -2.8, 11, 29) || wall_shade(p); }

/* A roof 6 m up that casts a rectangle. */
static void add_roof(struct place *place, double x0, double x1, double y0, double y1)
{
    double z = 6, along = z * mesh_sun.x / mesh_sun.z;
    place_quad(place, (const double[4][3]){ { x0 + along, y0, z }, { x1 + along, y0, z }, { x1 + along, y1, z }, { x0 + along, y1, z } }, 0);
}

/* It casts the tree's shade 0.4 m farther east, another where the sun shines, the wall's, and none of a post. */
static bool make_mesh(struct static_mesh **mesh)
{
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    place_ground(&place, 0, 0);
    add_roof(&place, 5.4, 8.4, 17, 23);
    add_roof(&place, -2, 1, 26, 29);
    place_quad(&place, (const double[4][3]){ { 0, 11, 0 }, { 0, 14, 0 }, { 0, 14, 1 }, { 0, 11, 1 } }, 0);
    bool ok = place_mesh(mesh, &place, false, &err);
    place_free(&place);
    return OK(ok, "a mesh %s", err.text);
}

/* z of the mesh, something before it over a rectangle of the ground. */
static bool make_depth(struct image *depth, const struct static_mesh *mesh)
{
    struct error err = ERROR_NONE;
    if (!image_init(depth, STREET_WIDTH, STREET_HEIGHT, 1, PIXEL_F32, &err)) return false;
    for (int y = 0; y < STREET_HEIGHT; y++)
        for (int x = 0; x < STREET_WIDTH; x++) {
            struct static_hit hit;
            struct vec3 p = ground_at(x, y), eye = above().translation, way = vec3_unit(vec3_sub(p, eye));
            static_mesh_hits(mesh, &hit, eye, &way, 1);
            *image_f32(depth, x, y) = is_in(p, 7, 10, 18, 22) ? 15 : (float)(hit.range_m * -way.z);
        }
    return true;
}

static double through_at(const struct sun_share *share, struct vec3 p)
{
    const struct sun_share through = { .map = share->through, .low_m = share->low_m, .high_m = share->high_m };
    bool inside = is_in(p, share->low_m.x, share->high_m.x, share->low_m.y, share->high_m.y);
    return inside && share->through.data ? sun_share_at(&through, (struct vec2){ p.x, p.y }) : 0;
}

/* What of the sun reaches the ground past the mesh and the map. */
static double sun_past(const struct sun_share *share, const struct static_mesh *mesh, struct vec3 p)
{
    double past = static_mesh_blocks(mesh, p, mesh_sun, 0.05, 1000) ? through_at(share, p) : 1;
    return past * sun_share_at(share, (struct vec2){ p.x, p.y });
}

static void check_past(const struct sun_share *share, const struct static_mesh *mesh)
{
    struct count lit = { 0 }, dark = { 0 }, wall = { 0 }, behind = { 0 };
    size_t moved = 0;
    for (double y = 10.3; y < 29.9; y += 0.1)
        for (double x = -9.9; x < 12.7; x += 0.1) {
            struct vec3 p = vec3(x, y, 0);
            double sun = sun_past(share, mesh, p);
            bool shaded = seen_shade(p), cast = static_mesh_blocks(mesh, p, mesh_sun, 0.05, 1000);
            if (is_in(p, 8.1, 8.3, 19, 21) || is_in(p, 8.5, 9, 19, 21)) add(&behind, cast ? sun < 0.05 : sun > 0.95);
            if (is_in(p, 7, 10, 18, 22) || !is_even(seen_shade, p, 0.25)) continue;
            moved += shaded != cast;
            add(shaded ? &dark : &lit, shaded ? sun < 0.15 : sun > 0.9);
            if (wall_shade(p)) add(&wall, sun_share_at(share, (struct vec2){ x, y }) > 0.99 && sun < 0.05);
        }
    OK(moved > 1000, "the mesh is wrong at %zu points", moved);
    OK(part(lit) > 0.995, "what is in the sun is lit, whatever the mesh says: %.4f of it", part(lit));
    OK(part(dark) > 0.97, "what is not is shaded: %.4f", part(dark));
    OK(wall.all > 20 && part(wall) > 0.9, "a wall that is lower than the entities casts its shade itself: %.4f", part(wall));
    OK(behind.all > 100 && part(behind) > 0.99, "where the photograph shows something else the mesh's shade stays: %.4f", part(behind));
}

/* The first roof casts where the photograph does not tell, too. */
static void check_part(const struct sun_share *share, const struct static_mesh *mesh)
{
    static const struct vec2 corner[] = { { -20, 0 }, { 20, 0 }, { 20, 40 }, { -20, 40 } };
    const struct prism all = { .corner_m = corner, .corners = 4, .axis = { 0, 0, 1 }, .below_m = -1, .above_m = 10 };
    struct error err = ERROR_NONE;
    struct static_cut cut;
    if (!OK(static_mesh_cut(mesh, &cut, &all, 1, &err), "a cut %s", err.text)) return;
    size_t count[TOLD_KINDS], roofs = 0, told = 0;
    if (!OK(sun_share_part(count, share, &cut, mesh_sun, &err), "parts %s", err.text)) return;
    for (size_t i = 0; i < cut.triangles; i++) {
        const float *p = cut.position_m[cut.triangle[i][0]];
        bool other_roof = p[2] > 5 && p[1] > 25;
        roofs += other_roof;
        told += other_roof && i >= cut.triangles - count[TOLD];
    }
    OK(roofs == 2 && told == 2 && count[TOLD] == 2 && count[TOLD_IN_PART] > 2, "of the mesh the roof casts no more that shades what the photograph shows in the sun");
    static_cut_release(&cut);
}

static void test_mesh(void)
{
    struct scene_camera camera;
    struct scene_shot shot;
    static char name[] = "street.png";
    struct scene scene = scene_of(&camera, &shot, name);
    struct made m = { .ratio = { 0.15, 0.2, 0.3 }, .balance = { 1.1, 1, 0.8 }, .shade = seen_shade };
    struct error err = ERROR_NONE;
    struct static_mesh *mesh = NULL;
    struct image image, depth;
    struct light light;
    struct ground_shade shade;
    struct sun_share share;
    struct vec3 corner[] = { { -10, 10, 0 }, { 13, 10, 0 }, { 13, 30, 0 }, { -10, 30, 0 } };
    struct receiver receiver = { .corner_m = corner, .corners = 4 };
    scene.sun_azimuth_rad = 90 * DEG;
    scene.sun_elevation_rad = asin(mesh_sun.z);
    make_image(&image, &m);
    if (!make_mesh(&mesh) || !make_depth(&depth, mesh) || !light_of(&light, &scene, m.ratio)) return;
    struct stage stage = stage_of(&scene);
    stage.mesh = mesh;
    struct seen seen = { .picture = &image, .camera = &lens, .world_from_camera = above(), .k = { 2, 3, 4 } };
    seen_init(&seen);
    struct sun_share_input in = { .shade = &shade, .seen = &seen, .ground = &scene.ground, .receivers = &receiver, .n = 1, .place = mesh,
                                  .place_depth = &depth, .towards_sun = mesh_sun, .height_m = 1.5, .top_m = 1.5 };
    if (OK(ground_shade_find(&shade, &stage, &image, NULL, &scene.shots[0], &light, &err) && sun_share_create(&share, &in, &err), "over a mesh %s", err.text)) {
        check_past(&share, mesh);
        check_part(&share, mesh);
        sun_share_release(&share);
        ground_shade_release(&shade);
    }
    light_release(&light);
    image_release(&image);
    image_release(&depth);
    static_mesh_destroy(mesh);
}

int main(void)
{
    test_street();
    test_mesh();
    test_no_shade();
    test_craig();
    return tap_done();
}

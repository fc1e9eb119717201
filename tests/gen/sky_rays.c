/* What comes along the sky's rays to an entity's receiver where a wall stands beyond it, and on a plane below a sky with a dark half. */
#include "gen/trace/sky_rays.h"

#include "gen/light/sky_image.h"
#include "tests/gen/place.h"
#include "tests/tap.h"

enum { RAYS = 256 };
#define EYE_M 0.5
#define WALL_M 12.0  /* north of the receiver's middle */
#define ABOVE_M 6.0  /* the wall's top over the eye */
#define EDGE_M 3.0   /* of the receiver */

static const float wall_color[3] = { 0.2f, 0.1f, 0.05f };

static double level_of(const struct sky_rays *rays, double (*color)[3], int c)
{
    double sum = 0;
    for (size_t i = 0; i < rays->n; i++) sum += rays->direction[i].z * color[i][c];
    return sum;
}

static bool is(const double color[3], const double radiance[3], double solid_angle)
{
    bool same = true;
    for (int c = 0; c < 3; c++) same = same && fabs(color[c] - solid_angle * radiance[c]) <= 1e-6 + 1e-5 * color[c];
    return same;
}

/* A wall north of the receiver, and one within it, which is not looked at. */
static void check_place(const struct sky_rays *rays, const struct image *radiance, const struct receiver *receiver, double (*color)[3])
{
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    size_t walled = 0, wrong = 0;
    place_wall(&place, -2000, 2000, WALL_M, 0, EYE_M + ABOVE_M, 0);
    place_wall(&place, -2000, 2000, -EDGE_M / 2, 0, 30, 0);
    if (!OK(place_mesh(&mesh, &place, false, &err), "two walls %s", err.text)) return;
    sky_rays_round(color, rays, &(struct sky_round){ radiance, mesh }, receiver, vec3(0, 0, EYE_M));
    for (size_t i = 0; i < rays->n; i++) {
        struct vec3 d = rays->direction[i];
        bool wall = d.y > 0 && d.z / d.y < ABOVE_M / WALL_M;
        walled += wall;
        wrong += !is(color[i], wall ? (double[3]){ (double)wall_color[0], (double)wall_color[1], (double)wall_color[2] } : (double[3]){ 1, 1, 1 }, rays->solid_angle[i]);
    }
    OK(walled > 5, "%zu rays meet the wall beyond", walled);
    OK(wrong == 0, "and they bring what it shines with; all others, also those that a nearer wall ends, the sky's light");
    static_mesh_destroy(mesh);
    place_free(&place);
}

static void check_plane(const struct sky_rays *rays, const struct image *radiance, const struct receiver *receiver, double (*color)[3])
{
    double dark = 0, bright = 0, sky = 0;
    size_t n = 0;
    sky_rays_round(color, rays, &(struct sky_round){ radiance, NULL }, receiver, vec3(0, 0, EYE_M));
    for (int c = 0; c < 3; c++) NEAR(level_of(rays, color, c), level_of(rays, rays->color, c), 1e-6, "level ground receives what it does of the sky");
    for (size_t i = 0; i < rays->n; i++) {
        if (fabs(rays->direction[i].y) < 0.05) continue;
        if (rays->direction[i].y > 0) dark += color[i][0], n++;
        else bright += color[i][0];
        sky += rays->color[i][0];
    }
    NEAR(dark / bright, (double)wall_color[0], 0.02, "from the dark half so much less than from the bright one (%zu rays)", n);
    OK(bright > 0.6 * sky && sky > 0, "which brings more for it");
}

int main(void)
{
    struct scene scene = { .path = "scene.yaml", .sky = SKY_CIE, .sun = SUN_NONE, .cie_type = 5, .ground = { { 0, 0, 1 }, 0 },
                           .ground_albedo = { 0.1, 0.1, 0.1 } };
    struct vec3 corner[4] = { { -EDGE_M, -EDGE_M, 0 }, { EDGE_M, -EDGE_M, 0 }, { EDGE_M, EDGE_M, 0 }, { -EDGE_M, EDGE_M, 0 } };
    const struct receiver receiver = { corner, 4, 1 };
    struct error err = ERROR_NONE;
    struct light light;
    struct sky_rays rays = { 0 };
    struct image radiance;
    double color[RAYS][3];

    NEAR(receiver_reach(&receiver, vec3(0, 0, 0), (struct vec2){ 1, 0 }), EDGE_M, 1e-12, "from the middle of a square it is half of it to its edge");
    NEAR(receiver_reach(&receiver, vec3(1, -1, 7), (struct vec2){ 0.6, 0.8 }), 2 / 0.6, 1e-12, "and from beside it, aslant, to the nearer of two edges");
    OK(receiver_reach(&receiver, vec3(4, 0, 0), (struct vec2){ 1, 0 }) == 0, "from beyond, nothing");

    if (!OK(light_create(&light, &scene, &err) && sky_rays_init(&rays, &light, RAYS, &err) &&
            image_init(&radiance, light.sky.width_px, light.sky.height_px, 3, PIXEL_F32, &err), "an even sky %s", err.text))
        return tap_done();
    double all = 0;
    for (size_t i = 0; i < rays.n; i++) all += rays.direction[i].z * rays.solid_angle[i];
    NEAR(all, 1, 0.01, "the rays' solid angles, by their cosines, are pi's share of the hemisphere");
    sky_rays_round(color, &rays, &(struct sky_round){ 0 }, &receiver, vec3(0, 0, EYE_M));
    OK(!memcmp(color, rays.color, sizeof color), "where nothing stands round there is the sky");
    for (int y = 0; y < radiance.height_px; y++)
        for (int x = 0; x < radiance.width_px; x++)
            for (int c = 0; c < 3; c++) image_f32(&radiance, x, y)[c] = x < radiance.width_px / 2 ? wall_color[c] : 1;
    check_place(&rays, &radiance, &receiver, color);
    check_plane(&rays, &radiance, &receiver, color);
    image_release(&radiance);
    sky_rays_release(&rays);
    light_release(&light);
    return tap_done();
}

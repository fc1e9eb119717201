/* What mirrors meet of a place: a wall, a post before it, and the ground. */
#include "gen/light/relief.h"

#include "gen/light/orthophoto.h"

#include "tests/gen/place.h"
#include "tests/gen/solid.h"
#include "tests/tap.h"

#define WALL_Y 30.0
#define POST_Y 8.0

/* Of a triangle: do all corners lie on a plane y = at? */
static bool upright_at(const struct relief_part *r, const uint32_t triangle[3], double at)
{
    for (int k = 0; k < 3; k++)
        if (fabs(r->point_m[triangle[k]].y - at) > 1e-4) return false;
    return true;
}

/* Is a corner, above the ground, on that plane? */
static bool stands_at(const struct relief_part *r, const uint32_t triangle[3], double at)
{
    for (int k = 0; k < 3; k++)
        if (fabs(r->point_m[triangle[k]].y - at) <= 1e-4 && r->point_m[triangle[k]].z > 1e-4) return true;
    return false;
}

static double highest(const struct relief_part *r, const uint32_t triangle[3])
{
    return fmax(fmax(r->point_m[triangle[0]].z, r->point_m[triangle[1]].z), r->point_m[triangle[2]].z);
}

static double nearest_y(const struct relief_part *r, const uint32_t triangle[3])
{
    return fmin(fmin(r->point_m[triangle[0]].y, r->point_m[triangle[1]].y), r->point_m[triangle[2]].y);
}

static double farthest_y(const struct relief_part *r, const uint32_t triangle[3])
{
    return fmax(fmax(r->point_m[triangle[0]].y, r->point_m[triangle[1]].y), r->point_m[triangle[2]].y);
}

/* A board 2 m before a wall, 8 m away: ranges differ by a quarter. */
static void test_gap(void)
{
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct relief r;
    const double board_y = 8, wall_y = 10;
    place_ground(&place, 0, 0);
    place_wall(&place, -20, 20, wall_y, 0, 9, 0);
    place_wall(&place, -1, 1, board_y, 0, 5, 0);
    struct relief_input in = { .from_m = { 0, 0, 1 } };
    if (!OK(place_mesh(&mesh, &place, false, &err), "a board near a wall")) return;
    in.place = mesh;
    if (OK(relief_create(&r, &in, &err), "its relief: %s", err.text)) {
        size_t wall = 0, board = 0, between = 0;
        for (size_t i = 0; i < r.seen.triangles; i++) {
            const uint32_t *t = r.seen.triangle[i];
            wall += upright_at(&r.seen, t, wall_y);
            board += upright_at(&r.seen, t, board_y);
            between += stands_at(&r.seen, t, board_y) && stands_at(&r.seen, t, wall_y);
        }
        OK(wall > 200 && board > 30, "both stand where they stand (%zu and %zu faces)", wall, board);
        OK(between == 0, "nothing spans the 2 m between them (%zu)", between);
        relief_release(&r);
    }
    static_mesh_destroy(mesh);
    place_free(&place);
}

/* A wall that goes away 2 m beside the look: neighbours on it are up to half as far again as each other. */
static void test_grazing(void)
{
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct relief r;
    place_ground(&place, 0, 0);
    place_quad(&place, (const double[4][3]){ { 2, 3, 0 }, { 2, 60, 0 }, { 2, 60, 8 }, { 2, 3, 8 } }, 0);
    struct relief_input in = { .from_m = { 0, 0, 1 } };
    if (!OK(place_mesh(&mesh, &place, false, &err), "a wall along the look")) return;
    in.place = mesh;
    if (OK(relief_create(&r, &in, &err), "its relief: %s", err.text)) {
        double near = INFINITY, far = 0, whole = 0; /* of the faces that stand on the row of level looks */
        for (size_t i = 0; i < r.seen.triangles; i++) {
            const struct vec3 *p = r.seen.point_m;
            struct vec3 a = p[r.seen.triangle[i][0]], b = p[r.seen.triangle[i][1]], c = p[r.seen.triangle[i][2]];
            if (fabs(a.x - 2) + fabs(b.x - 2) + fabs(c.x - 2) > 1e-4 || fabs(a.z - 1) + fabs(b.z - 1) > 1e-4 || !(c.z > 1)) continue;
            near = fmin(near, fmin(a.y, b.y));
            far = fmax(far, fmax(a.y, b.y));
            whole += fabs(a.y - b.y);
        }
        /* A step is 1.4 degrees: the last look that meets it does so 41 m away. */
        OK(near < 3.2 && far > 40, "it stands from its near end to where looks meet it last (%.2f m to %.2f m)", near, far);
        NEAR(whole, far - near, 1e-3, "without a gap");
        relief_release(&r);
    }
    static_mesh_destroy(mesh);
    place_free(&place);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct solid box;
    struct relief r;
    static const struct vec2 near[] = { { -3, -3 }, { 3, -3 }, { 3, 3 }, { -3, 3 } };
    const struct prism known = { near, 4, 0, { 0, 0, 1 }, -1, 1 };
    solid_box(&box, 4, 2, 1.5);
    struct entity entity = { .id = 1, .name = "box", .model = &box.model, .world_from_entity = pose_identity() };
    place_ground(&place, 0, 0);
    place_wall(&place, -20, 20, WALL_Y, 0, 6, 0);
    place_wall(&place, -1, 1, POST_Y, 0, 5, 0);
    struct relief_input in = { .from_m = { 0, 0, 1 }, .entities = &entity, .n = 1, .known = &known };
    if (!OK(place_mesh(&mesh, &place, false, &err), "a place")) return tap_done();
    in.place = mesh;
    if (!OK(relief_create(&r, &in, &err), "its relief: %s", err.text)) return tap_done();
    size_t wall = 0, post = 0, ground = 0, between = 0, behind = 0, floor = 0;
    double wall_top = 0, post_top = 0, farthest = 0, nearest = INFINITY;
    for (size_t i = 0; i < r.seen.triangles; i++) {
        const uint32_t *t = r.seen.triangle[i];
        bool of_wall = upright_at(&r.seen, t, WALL_Y), of_post = upright_at(&r.seen, t, POST_Y);
        wall += of_wall;
        floor += highest(&r.seen, t) < 1e-4 && farthest_y(&r.seen, t) > 20 && farthest_y(&r.seen, t) < WALL_Y - 1e-3;
        post += of_post;
        between += nearest_y(&r.seen, t) < POST_Y + 1e-4 && farthest_y(&r.seen, t) > WALL_Y - 1e-4;
        if (of_wall) wall_top = fmax(wall_top, highest(&r.seen, t));
        if (of_post) post_top = fmax(post_top, highest(&r.seen, t));
    }
    for (size_t i = 0; i < r.ground.triangles; i++) {
        struct vec3 a = r.ground.point_m[r.ground.triangle[i][0]], b = r.ground.point_m[r.ground.triangle[i][1]], c = r.ground.point_m[r.ground.triangle[i][2]];
        ground += fabs(a.z) + fabs(b.z) + fabs(c.z) > 1e-4;
        farthest = fmax(farthest, fmax(hypot(a.x, a.y), fmax(hypot(b.x, b.y), hypot(c.x, c.y))));
        behind += fabs(a.x) < 0.6 && a.y > POST_Y && a.y < POST_Y + 1.5;
        nearest = fmin(nearest, fmax(fabs(a.x), fabs(a.y)));
    }
    OK(wall > 200 && post > 30, "the wall stands where it stands, and so does the post (%zu and %zu faces)", wall, post);
    /* A step is 1.4 degrees: 0.73 m at the wall, 0.2 m at the post. */
    NEAR(wall_top, 6, 0.75, "as high as it is");
    NEAR(post_top, 5, 0.25, "the post, too");
    OK(between == 0, "nothing spans the gap between post and wall (%zu)", between);
    OK(r.ground.triangles > 100 && ground == 0, "ground with an orthophoto is level (%zu faces)", r.ground.triangles);
    OK(behind > 4, "also behind the post (%zu faces)", behind);
    OK(floor > 20, "so is the ground beyond, as far as the wall (%zu faces)", floor);
    OK(farthest <= orthophoto_whole(&entity) + 1e-6 && farthest > 0.7 * orthophoto_whole(&entity), "as far as the orthophoto is whole (%.2f m)", farthest);
    OK(nearest > 1, "and not where it is known already (%.2f m)", nearest);
    relief_release(&r);
    /* The ground ends at y = -10. */
    entity.world_from_entity.translation = vec3(0, -8, 0);
    if (OK(relief_create(&r, &in, &err), "where the place ends")) {
        size_t bad = 0, beyond = 0;
        for (size_t i = 0; i < r.ground.points; i++) bad += !isfinite(r.ground.point_m[i].z);
        for (size_t i = 0; i < r.ground.triangles; i++) beyond += r.ground.point_m[r.ground.triangle[i][0]].y < -10;
        OK(bad == 0 && beyond == 0 && r.ground.triangles > 100, "so does the ground (%zu, %zu)", bad, beyond);
        relief_release(&r);
    }
    static_mesh_destroy(mesh);
    place_free(&place);
    solid_free(&box);
    test_gap();
    test_grazing();
    return tap_done();
}

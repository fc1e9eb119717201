/* What stands before a place in a picture from 6 m up, and whether the place has it itself. */
#include "gen/light/standing.h"

#include "tests/gen/view_above.h"
#include "tests/tap.h"

enum { WIDTH = 400, HEIGHT = 300 };

static const struct camera camera = { .model = CAMERA_PINHOLE, .width_px = WIDTH, .height_px = HEIGHT, .params = { 300, 300, 200, 150 } };
static const struct vec3 eye = { 0, 0, 6 };
static struct image picture, depth;

/* What the place has: level ground at height 0 and, before it, upright blocks across the view. */
struct block { double half_m, near_m, far_m, high_m; };

/* How far along a ray, in lengths of it, a block begins. */
static double block_begins(const struct block *b, struct vec3 ray)
{
    double low[3] = { -b->half_m, b->near_m, 0 }, high[3] = { b->half_m, b->far_m, b->high_m };
    double from[3] = { eye.x, eye.y, eye.z }, along[3] = { ray.x, ray.y, ray.z }, begins = 0, ends = INFINITY;
    for (int k = 0; k < 3; k++) {
        double one = (low[k] - from[k]) / along[k], other = (high[k] - from[k]) / along[k];
        begins = fmax(begins, fmin(one, other));
        ends = fmin(ends, fmax(one, other));
    }
    return begins < ends ? begins : INFINITY;
}

static void depth_of(const struct seen *seen, const struct block *block)
{
    struct error err = ERROR_NONE;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            struct vec3 ray;
            if (!camera_unproject(&camera, &ray, (struct vec2){ x + 0.5, y + 0.5 }, &err)) abort();
            struct vec3 world = mat3_apply(seen->world_from_camera.rotation, ray);
            double length = world.z < 0 ? -eye.z / world.z : INFINITY;
            if (block) length = fmin(length, block_begins(block, world));
            *image_f32(&depth, x, y) = isfinite(length) ? (float)(length * ray.z) : NAN;
        }
}

/* A block's outline, or that of a sheet: far_m as near_m. Its foot is the middle of its front. */
static struct occluder outline(struct vec2 polygon[6], const struct seen *seen, const struct block *b)
{
    struct vec3 corner[6] = { { -b->half_m, b->near_m, 0 }, { b->half_m, b->near_m, 0 }, { b->half_m, b->near_m, b->high_m },
                              { b->half_m, b->far_m, b->high_m }, { -b->half_m, b->far_m, b->high_m }, { -b->half_m, b->near_m, b->high_m } };
    for (int i = 0; i < 6; i++)
        if (!seen_project(seen, &polygon[i], corner[i])) abort();
    return (struct occluder){ .name = "thing", .polygon_px = polygon, .polygon_count = 6, .foot_m = { 0, b->near_m, 0 } };
}

static bool create(struct standing *standing, const struct seen *seen, const struct block *thing, const struct image *place_depth)
{
    struct error err = ERROR_NONE;
    struct vec2 polygon[6];
    struct occluder occluder = outline(polygon, seen, thing);
    return standing_create(standing, seen, &occluder, place_depth, &err);
}

static void stands(const struct seen *seen, const struct block *thing, const struct image *place_depth, bool want, const char *what)
{
    struct standing standing;
    if (!OK(create(&standing, seen, thing, place_depth), "%s", what)) return;
    OK(want == (standing.count > 0) && want == (standing.outline != NULL) && want == (standing.radiance.data != NULL), "it %s (%zu corners)",
       want ? "stands" : "is left out, and nothing is held of it", standing.count);
    standing_release(&standing);
}

/* A car of 1.8 m, as deep as wide, 14 m off and 1.5 m high. Its roof's far edge is seen through its front's plane at
 * 6 - 4.5 * 14 / 15.8 = 2.0127 m. */
static const struct block car = { 0.9, 14, 15.8, 1.5 };

static void test_sizes(const struct seen *seen)
{
    struct standing s;
    if (!OK(create(&s, seen, &car, NULL), "a car over a plane")) return;
    OK(s.count == 6, "stands, with all its corners (%zu)", s.count);
    NEAR(s.size_m.x, 1.8, 1e-6, "as wide as its front");
    NEAR(s.size_m.y, 2.0127, 1e-3, "as high as it is seen on its front's plane");
    struct vec3 low = s.world_from_rectangle.translation, out = mat3_column(s.world_from_rectangle.rotation, 2);
    OK(fabs(low.x + 0.9) < 1e-6 && fabs(low.y - 14) < 1e-6 && fabs(low.z) < 1e-6, "its rectangle begins at its front's lower left corner");
    OK(fabs(out.y + 1) < 1e-9, "and faces the camera");
    if (OK(s.radiance.width_px > 20 && s.radiance.height_px > 20, "it has a picture")) {
        const float *middle = image_f32(&s.radiance, s.radiance.width_px / 2, s.radiance.height_px / 2);
        NEAR((double)middle[0], 0.8, 0.01, "in its own red");
        NEAR((double)middle[1], 0.2, 0.01, "and green");
    }
    standing_release(&s);
}

static void test_place(const struct seen *seen)
{
    /* All the ground seen through the hedge is nearer behind it than it is wide. */
    const struct block hedge = { 3, 14, 14, 0.8 }, post = { 0.15, 20, 20, 7.5 }, thick_post = { 0.15, 20, 20.3, 7.5 };
    const struct block wall = { 40, 30, 31, 40 }, low_car = { 0.9, 14, 15.8, 0.1 };
    depth_of(seen, NULL);
    stands(seen, &car, &depth, true, "a car that the place has not: there is plain ground");
    stands(seen, &hedge, &depth, true, "a wide hedge that the place has not");
    depth_of(seen, &car);
    stands(seen, &car, &depth, false, "a car that the place has");
    stands(seen, &car, NULL, true, "the same over a plane");
    depth_of(seen, &low_car);
    stands(seen, &car, &depth, true, "a car of which the place has its ground plan alone, 0.1 m high");
    depth_of(seen, &wall);
    stands(seen, &post, &depth, true, "a post 10 m before a wall of the place");
    depth_of(seen, &thick_post);
    stands(seen, &post, &depth, false, "a post that the place has");
    for (int i = 0; i < WIDTH * HEIGHT; i++) ((float *)depth.data)[i] = NAN;
    stands(seen, &car, &depth, true, "a car past all that the place has");
}

/* What is seen from above 45 degrees shows its top and no side. */
static void test_above(const struct seen *ahead)
{
    const struct block far_car = { 0.9, 6.5, 8.3, 1.5 }, near_car = { 0.9, 5.5, 7.3, 1.5 };
    struct seen seen = *ahead;
    struct error err = ERROR_NONE;
    struct standing standing;
    struct vec2 polygon[6];
    seen.world_from_camera = looking(eye, vec3(0, 6, 0));
    seen_init(&seen);
    depth_of(&seen, NULL);
    stands(&seen, &far_car, &depth, true, "a car that is seen from 43 degrees above");
    stands(&seen, &near_car, &depth, false, "one that is seen from 47 degrees");
    struct occluder occluder = outline(polygon, &seen, &near_car);
    occluder.foot_m = vec3(0, 0, 0);
    OK(standing_create(&standing, &seen, &occluder, &depth, &err) && standing.count == 0, "nothing stands right below the camera");
}

static void test_outside(const struct seen *seen)
{
    struct error err = ERROR_NONE;
    struct standing standing;
    const struct vec2 beside[4] = { { 410, 100 }, { 450, 130 }, { 450, 170 }, { 410, 200 } };
    struct occluder occluder = { .name = "thing", .polygon_px = beside, .polygon_count = 4, .foot_m = { 10, 14, 0 } };
    for (int over_place = 0; over_place < 2; over_place++)
        OK(standing_create(&standing, seen, &occluder, over_place ? &depth : NULL, &err) && standing.count == 0 && !standing.outline,
           "nothing is left of an outline beside the picture, over a %s", over_place ? "place" : "plane");
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct seen seen = { .picture = &picture, .camera = &camera, .world_from_camera = looking(eye, vec3(0, 6 / tan(20 * M_PI / 180), 0)), .k = { 0.5, 0.5, 0.5 } };
    seen_init(&seen);
    if (!OK(image_init(&picture, WIDTH, HEIGHT, 3, PIXEL_U8, &err) && image_init(&depth, WIDTH, HEIGHT, 1, PIXEL_F32, &err), "a picture")) return tap_done();
    fill_px(&picture, 0, 0, WIDTH, HEIGHT, 0.4, 0.1, 0.1);
    test_sizes(&seen);
    test_place(&seen);
    test_above(&seen);
    test_outside(&seen);
    image_release(&picture);
    image_release(&depth);
    return tap_done();
}

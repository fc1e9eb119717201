#include "post/spread.h"

#include "tests/post/layers.h"
#include "tests/tap.h"

#define W 53
#define H 37
#define POINTS 12

static const int points[POINTS][2] = { { 3, 4 }, { 50, 2 }, { 20, 20 }, { 21, 22 }, { 8, 33 }, { 52, 36 },
                                       { 0, 15 }, { 40, 18 }, { 33, 9 }, { 27, 35 }, { 13, 13 }, { 45, 30 } };

static double distance_to(int k, int x, int y) { return hypot(points[k][0] - x, points[k][1] - y); }

static double least_distance(int x, int y)
{
    double least = 1e9;
    for (int k = 0; k < POINTS; k++) least = fmin(least, distance_to(k, x, y));
    return least;
}

int main(void)
{
    struct image values = filled(W, H, 3, NAN);
    struct error err = ERROR_NONE;
    for (int k = 0; k < POINTS; k++) fill(&values, points[k][0], points[k][1], points[k][0] + 1, points[k][1] + 1, (float[]){ (float)k, 7, -1 });
    if (!OK(spread_known(&values, &err), "values are spread")) return tap_done();
    int wrong = 0, incomplete = 0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            const float *v = image_f32(&values, x, y);
            wrong += distance_to((int)v[0], x, y) > least_distance(x, y) + 1e-9;
            incomplete += v[1] != 7 || v[2] != -1;
        }
    NEAR(wrong, 0, 0, "every pixel has those of the nearest, by all distances measured one by one");
    NEAR(incomplete, 0, 0, "of all channels");
    image_release(&values);

    values = filled(5, 4, 1, NAN);
    OK(spread_known(&values, &err) && isnan(*image_f32(&values, 2, 2)), "where nothing is known nothing becomes known");
    image_release(&values);

    struct image mask;
    if (!image_init(&mask, W, H, 1, PIXEL_U8, &err)) return 1;
    for (int k = 0; k < POINTS; k++) *image_u8(&mask, points[k][0], points[k][1]) = 200;
    OK(spread_mask(&mask, 5, &err), "marks are spread");
    wrong = 0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) wrong += *image_u8(&mask, x, y) != (least_distance(x, y) <= 5);
    NEAR(wrong, 0, 0, "over a disc round each");
    image_release(&mask);
    return tap_done();
}

#include "gen/trace/polygon.h"

#include "tests/tap.h"

#define SIZE 40

/* All samples of a SIZE x SIZE picture. */
static long sample(uint64_t samples[SIZE][SIZE], const struct vec2 *points, size_t n)
{
    struct polygon polygon;
    long count = 0;
    if (!polygon_init(&polygon, points, n)) return -1;
    for (int y = 0; y < SIZE; y++) {
        polygon_row_samples(&polygon, samples[y], y, 0, SIZE);
        for (int x = 0; x < SIZE; x++) count += __builtin_popcountll(samples[y][x]);
    }
    polygon_release(&polygon);
    return count;
}

/* Where a triangle is, by the side of its edges on which a point lies. */
static bool in_triangle(const struct vec2 t[3], double x, double y)
{
    int left = 0;
    for (int i = 0; i < 3; i++) {
        struct vec2 a = t[i], b = t[(i + 1) % 3];
        left += (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) > 0;
    }
    return left == 0 || left == 3;
}

int main(void)
{
    static uint64_t one[SIZE][SIZE], other[SIZE][SIZE];
    static const struct vec2 triangle[3] = { { 3.313, 2.171 }, { 37.237, 11.719 }, { 9.931, 36.433 } };
    sample(one, triangle, 3);
    struct polygon polygon;
    bool inside[SIZE];
    int wrong = 0;
    OK(polygon_init(&polygon, triangle, 3), "a triangle");
    for (int y = 0; y < SIZE; y++) {
        polygon_row_centres(&polygon, inside, y, 0, SIZE);
        for (int x = 0; x < SIZE; x++) {
            wrong += inside[x] != in_triangle(triangle, x + 0.5, y + 0.5);
            for (int k = 0; k < 64; k++)
                wrong += (int)(one[y][x] >> k & 1) !=
                         in_triangle(triangle, x + (k % 8 + 0.5) / 8, y + (k / 8 + 0.5) / 8);
        }
    }
    OK(wrong == 0, "each centre and each sample is on the side of its edges that it should be on (%d wrong)", wrong);
    struct rect bounds = polygon_bounds(&polygon, SIZE, SIZE);
    OK(bounds.x0 == 3 && bounds.y0 == 2 && bounds.x1 == 38 && bounds.y1 == 37,
       "its bounds hold every pixel that it touches");
    bounds = polygon_bounds(&polygon, 20, 10);
    OK(bounds.x1 == 20 && bounds.y1 == 10, "and end with the picture");
    polygon_row_centres(&polygon, inside, 10, 5, 15);
    for (int x = 5; x < 15; x++) wrong += inside[x - 5] != in_triangle(triangle, x + 0.5, 10.5);
    OK(wrong == 0, "a part of a row is as in the whole");
    polygon_release(&polygon);

    /* A slanted line cuts a square: what belongs to both sides, and what to none? */
    static const struct vec2 left[4] = { { 2, 2 }, { 14.37, 2 }, { 23.9, 30 }, { 2, 30 } };
    static const struct vec2 right[4] = { { 14.37, 2 }, { 30, 2 }, { 30, 30 }, { 23.9, 30 } };
    long total = sample(one, left, 4) + sample(other, right, 4);
    bool apart = true;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) apart = apart && !(one[y][x] & other[y][x]);
    OK(apart && total == 28L * 28 * 64, "neighbours share no sample and leave none between them");

    static const struct vec2 turned[4] = { { 2, 30 }, { 23.9, 30 }, { 14.37, 2 }, { 2, 2 } };
    sample(other, turned, 4);
    OK(!memcmp(one, other, sizeof one), "either way round is the same");

    /* 20 x 20 with a hole of 10 x 10, in one line that goes in and comes back on itself. */
    static const struct vec2 frame[10] = { { 5, 5 },   { 25, 5 },  { 25, 25 }, { 5, 25 },  { 5, 5 },
                                           { 10, 10 }, { 20, 10 }, { 20, 20 }, { 10, 20 }, { 10, 10 } };
    OK(sample(one, frame, 10) == (400L - 100) * 64 && one[15][15] == 0 && one[7][7] == UINT64_MAX,
       "twice around is outside: a hole");
    static const struct vec2 beyond[4] = { { -50, -50 }, { 90, -50 }, { 90, 90 }, { -50, 90 } };
    OK(sample(one, beyond, 4) == SIZE * SIZE * 64L, "one that reaches beyond the picture covers all of it");
    static const struct vec2 beside[3] = { { 50, 5 }, { 60, 5 }, { 55, 20 } };
    OK(sample(one, beside, 3) == 0, "one beside the picture covers nothing");
    return tap_done();
}

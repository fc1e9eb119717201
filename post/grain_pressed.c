#include "post/grain.h"

#include <math.h>

#define ROWS_PX 32      /* of each level: whole blocks, whatever the sampling */
#define COLUMNS_PX 128
#define LEVEL_STEP (256.0 / GRAIN_LEVELS)
#define TIMES 2         /* that the answer is improved */
#define CHANGE_MAX 2.0  /* of a variance, each time: what a file's steps swallow whole is not known */

static double level_at(int y) { return (y / ROWS_PX + 0.5) * LEVEL_STEP; }

/* Variance of (R+G+B)/sqrt(3) in the rows of a level, without that of rounding. */
static double variance_of(const struct image *rgb, int level)
{
    double sum = 0, squares = 0, n = ROWS_PX * COLUMNS_PX;
    for (int y = level * ROWS_PX; y < (level + 1) * ROWS_PX; y++)
        for (int x = 0; x < COLUMNS_PX; x++) {
            const uint8_t *px = image_u8(rgb, x, y);
            int v = px[0] + px[1] + px[2];
            sum += v;
            squares += v * v;
        }
    return fmax((squares - sum * sum / n) / n / 3 - 1.0 / 12, 0);
}

/* Even greys of all levels with the grain on them, pressed. In/out: rgb; levels, cover (all 1): to work in */
static bool press(struct image *rgb, struct image *levels, const struct image *cover, const struct grain *grain, const struct compression *c,
                  struct error *err)
{
    const struct rect whole = { 0, 0, COLUMNS_PX, GRAIN_LEVELS * ROWS_PX };
    const struct draw_key key = { .seed = 1 };
    for (int y = 0; y < whole.y1; y++)
        for (int i = 0; i < 3 * COLUMNS_PX; i++) image_f32(levels, 0, y)[i] = (float)level_at(y);
    if (!grain_add(levels, cover, grain, key, whole, COLUMNS_PX, err)) return false;
    const float *from = levels->data;
    uint8_t *to = rgb->data;
    for (size_t i = 0; i < image_size(rgb); i++) to[i] = (uint8_t)(fminf(fmaxf(from[i], 0), 255) + 0.5f);
    return compression_apply(rgb, whole, c, err);
}

bool grain_before_compression(struct grain *grain, const struct compression *compression, struct error *err)
{
    struct image rgb = { 0 }, levels = { 0 }, cover = { 0 };
    struct compression c = *compression;
    struct grain g = *grain;
    c.width_px = COLUMNS_PX;
    c.height_px = GRAIN_LEVELS * ROWS_PX;
    bool ok = image_init(&rgb, c.width_px, c.height_px, 3, PIXEL_U8, err) && image_init(&levels, c.width_px, c.height_px, 3, PIXEL_F32, err) &&
              image_init(&cover, c.width_px, c.height_px, 1, PIXEL_F32, err);
    for (size_t i = 0; ok && i < image_size(&cover) / sizeof(float); i++) ((float *)cover.data)[i] = 1;
    for (int k = 0; ok && k < TIMES; k++) {
        ok = press(&rgb, &levels, &cover, &g, &c, err);
        for (int i = 0; ok && i < GRAIN_LEVELS; i++) {
            double wanted = grain->covariance[i][0][0], got = variance_of(&rgb, i);
            if (wanted <= 0) continue;
            double change = fmin(fmax(wanted / fmax(got, 1e-9), 1 / CHANGE_MAX), CHANGE_MAX);
            for (int j = 0; j < 9; j++) g.covariance[i][j / 3][j % 3] *= change;
        }
    }
    image_release(&rgb);
    image_release(&levels);
    image_release(&cover);
    if (ok) *grain = g;
    return ok;
}

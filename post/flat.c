#include "post/flat.h"

#include <math.h>
#include <stdlib.h>

#define STEP_PX 8 /* patches begin at whole times that: a block of a file's brightness then lies in one half alone */
#define COUNT_MAX 40000.0

void flat_patches_release(struct flat_patches *patches)
{
    free(patches->patch);
    *patches = (struct flat_patches){ 0 };
}

/* Two diagonal quarters of it are a half, the others the other. */
static void look_at_halves(struct flat_patch *patch, const struct image *rgb)
{
    enum { QUARTER_PX = FLAT_SIDE_PX / 2, HALF = FLAT_SIDE_PX * FLAT_SIDE_PX / 2 };
    double sum[2] = { 0 };
    for (int j = 0; j < FLAT_SIDE_PX; j++) {
        const uint8_t *px = image_u8(rgb, patch->x, patch->y + j);
        double ramp = patch->level + (j - (FLAT_SIDE_PX - 1) / 2.0) * patch->down - (FLAT_SIDE_PX - 1) / 2.0 * patch->right;
        for (int i = 0; i < FLAT_SIDE_PX; i++, px += 3, ramp += patch->right) {
            double off = px[0] + px[1] + px[2] - 3 * ramp;
            sum[i / QUARTER_PX ^ j / QUARTER_PX] += off * off;
        }
    }
    for (int h = 0; h < 2; h++) patch->variance[h] = sum[h] / 3 / (HALF - 1.5);
}

static bool look(struct flat_patch *patch, const struct image *rgb, int x, int y)
{
    /* Of whole numbers, with twice the distance from the middle: the ramp is exact. */
    int64_t sum = 0, right = 0, down = 0, spread = 0;
    for (int j = 0; j < FLAT_SIDE_PX; j++) {
        const uint8_t *px = image_u8(rgb, x, y + j);
        int row = 2 * j + 1 - FLAT_SIDE_PX;
        spread += (int64_t)row * row * FLAT_SIDE_PX;
        for (int i = 0; i < FLAT_SIDE_PX; i++, px += 3) {
            for (int c = 0; c < 3; c++)
                if (px[c] == 0 || px[c] == 255) return false;
            int v = px[0] + px[1] + px[2];
            sum += v;
            right += v * (2 * i + 1 - FLAT_SIDE_PX);
            down += v * row;
        }
    }
    const double n = FLAT_SIDE_PX * FLAT_SIDE_PX, s = (double)spread, mean = (double)sum / n;
    *patch = (struct flat_patch){ x, y, mean / 3, 2 * (double)right / s / 3, 2 * (double)down / s / 3, { 0 } };
    look_at_halves(patch, rgb);
    return true;
}

static int start_of(int i, double step) { return (int)(i * step) / STEP_PX * STEP_PX; }

double flat_patch_variance(const struct flat_patch *patch)
{
    return (patch->variance[0] + patch->variance[1]) / 2;
}

bool flat_patches_find(struct flat_patches *patches, const struct image *rgb, struct error *err)
{
    double step = fmax(sqrt((double)rgb->width_px * rgb->height_px / COUNT_MAX), STEP_PX);
    size_t room = ((size_t)(rgb->width_px / step) + 1) * ((size_t)(rgb->height_px / step) + 1);
    *patches = (struct flat_patches){ malloc(room * sizeof *patches->patch), 0 };
    if (!patches->patch) return error_set(err, ERR_MEMORY, "no memory for the patches of a photograph");
    for (int j = 0; start_of(j, step) + FLAT_SIDE_PX <= rgb->height_px; j++)
        for (int i = 0; start_of(i, step) + FLAT_SIDE_PX <= rgb->width_px; i++)
            if (look(&patches->patch[patches->count], rgb, start_of(i, step), start_of(j, step))) patches->count++;
    return true;
}

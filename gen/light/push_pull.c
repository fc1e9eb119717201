#include "gen/light/push_pull.h"

#include <stdlib.h>

/* Sums of squares of four, their weight at most 1: the coarse image knows where any of the fine one does. */
static void pull(float (*coarse)[4], const float (*fine)[4], int width, int height)
{
    int half = (width + 1) / 2;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < 4; c++) coarse[(y / 2) * half + x / 2][c] += fine[y * width + x][c];
    for (int i = 0; i < half * ((height + 1) / 2); i++) {
        float weight = coarse[i][3];
        for (int c = 0; c < 4 && weight > 1; c++) coarse[i][c] /= weight;
    }
}

static int within(int i, int n) { return i < 0 ? 0 : i < n ? i : n - 1; }

/* What the fine image lacks, from between the four nearest of the coarse one. */
static void push(float (*fine)[4], const float (*coarse)[4], int width, int height)
{
    int half_width = (width + 1) / 2, half_height = (height + 1) / 2;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            float *f = fine[y * width + x], lack = 1 - f[3];
            if (lack <= 0) continue;
            int cx = x / 2, cy = y / 2, sx = within(x % 2 ? cx + 1 : cx - 1, half_width), sy = within(y % 2 ? cy + 1 : cy - 1, half_height);
            const float *near = coarse[cy * half_width + cx], *beside = coarse[cy * half_width + sx];
            const float *above = coarse[sy * half_width + cx], *across = coarse[sy * half_width + sx];
            for (int c = 0; c < 4; c++) f[c] += lack * (9 * near[c] + 3 * beside[c] + 3 * above[c] + across[c]) / 16;
        }
}

bool push_pull(float (*rgbw)[4], int width, int height, struct error *err)
{
    int half_width = (width + 1) / 2, half_height = (height + 1) / 2;
    if (width == 1 && height == 1) {
        for (int c = 0; c < 4 && rgbw[0][3] > 0; c++) rgbw[0][c] /= c < 3 ? rgbw[0][3] : 1;
        if (rgbw[0][3] > 0) rgbw[0][3] = 1;
        return true;
    }
    float (*coarse)[4] = calloc((size_t)half_width * (size_t)half_height, sizeof *coarse);
    if (!coarse) return error_set(err, ERR_MEMORY, "no memory to fill a picture");
    pull(coarse, (const float (*)[4])rgbw, width, height);
    bool ok = push_pull(coarse, half_width, half_height, err);
    if (ok) push(rgbw, (const float (*)[4])coarse, width, height);
    free(coarse);
    return ok;
}

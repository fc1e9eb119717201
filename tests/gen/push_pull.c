#include "gen/light/push_pull.h"

#include "tests/tap.h"

int main(void)
{
    enum { W = 37, H = 23 };
    static float p[W * H][4];
    struct error err = ERROR_NONE;
    /* The left third is known to be 1, the right third 3; a pixel of the first is known by half. */
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            float weight = x < W / 3 || x >= W - W / 3 ? 1 : 0, value = x < W / 2 ? 1 : 3;
            if (x == 3 && y == 5) weight = 0.5f;
            for (int c = 0; c < 3; c++) p[y * W + x][c] = value * weight;
            p[y * W + x][3] = weight;
        }
    if (!OK(push_pull(p, W, H, &err), "a picture with a gap is filled")) return tap_done();
    int changed = 0, outside = 0;
    double step = 0, middle = 0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            bool known = x < W / 3 || x >= W - W / 3;
            double v = (double)p[y * W + x][0];
            changed += known && fabs(v - (x < W / 2 ? 1 : 3)) > 1e-6;
            outside += v < 1 - 1e-6 || v > 3 + 1e-6 || fabsf(p[y * W + x][3] - 1) > 1e-5f;
            if (x > 0) step = fmax(step, fabs(v - (double)p[y * W + x - 1][0]));
            if (x == W / 2) middle += v / H;
        }
    OK(changed == 0, "what is known stays, what is known by half is as its neighbours");
    OK(outside == 0, "the gap is between what lies round it, and known after");
    NEAR(middle, 2, 0.3, "half way across it is half way between");
    OK(step < 1, "without a step (%.2f)", step);
    float nothing[6][4] = { { 0 } };
    OK(push_pull(nothing, 3, 2, &err) && nothing[4][3] == 0, "a picture of which nothing is known stays so");
    float one[1][4] = { { 1, 2, 3, 0.5f } };
    OK(push_pull(one, 1, 1, &err) && one[0][2] == 6 && one[0][3] == 1, "a single pixel is filled, too");
    return tap_done();
}

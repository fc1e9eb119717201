#include "post/transfer.h"

#include "tests/tap.h"

#define N 9

static float b[N * N * 3], o[N * N * 4], p[N * N * 4], s[N * N * 4];

static void fill(float *at, float color, float alpha)
{
    at[0] = at[1] = at[2] = color;
    at[3] = alpha;
}

int main(void)
{
    struct image photograph = { N, N, 3, PIXEL_F32, b }, object = { N, N, 4, PIXEL_F32, o },
                 plane = { N, N, 4, PIXEL_F32, p }, shadow = { N, N, 4, PIXEL_F32, s }, out;
    struct transfer_input in = { &photograph, &object, &plane, &shadow, NULL, NULL, { 2, 2, 2 } };
    struct error err = ERROR_NONE;
    for (int i = 0; i < N * N; i++) {
        b[3 * i] = b[3 * i + 1] = b[3 * i + 2] = 0.5f;
        fill(p + 4 * i, 0.2f, 1);
        fill(s + 4 * i, 0.2f, 1);
    }

    /* An entity of 3 x 3 pixels about (4,4): erosion leaves its middle. */
    for (int y = 3; y <= 5; y++)
        for (int x = 3; x <= 5; x++) fill(o + 4 * (y * N + x), 0.3f, 1);
    if (!OK(transfer_ratio(&out, &in, &err), "a small entity")) return tap_done();
    /* The Gaussian of 5, sigma 1.1: 1, exp(-1/2.42), exp(-4/2.42), over their sum 2.70602:
     * 0.369546, 0.244460, 0.070766. Half mask, half blur:
     * middle (1 + 0.369546^2)/2 = 0.568282, beside it 0.369546 * 0.244460 / 2 = 0.0451697.
     * On both, k I_all = 2 * 0.3 = 0.6 and B I_all/I_pl = 0.5 * 0.3/0.2 = 0.75. */
    NEAR(image_f32(&out, 4, 4)[0], 0.568282 * 0.6 + (1 - 0.568282) * 0.75, 1e-5, "its middle is mostly the entity");
    NEAR(image_f32(&out, 5, 4)[0], 0.0451697 * 0.6 + (1 - 0.0451697) * 0.75, 1e-5, "the eroded rim is mostly the ratio");
    OK(image_f32(&out, 7, 4)[0] == 0.5f, "beyond, the photograph stays to the last bit");
    image_release(&out);

    /* A see-through entity everywhere: no contour, I_all = 0.1 + 0.2 * (1 - 0.5) = 0.2 */
    for (int i = 0; i < N * N; i++) fill(o + 4 * i, 0.1f, 0.5f);
    if (!OK(transfer_ratio(&out, &in, &err), "an entity that fills the window")) return tap_done();
    NEAR(image_f32(&out, 0, 0)[0], 0.4, 1e-6, "is not eroded at the window's border: 2 * 0.2");
    NEAR(image_f32(&out, 4, 4)[0], 0.4, 1e-6, "and shows the rendered ground through itself");
    image_release(&out);

    /* No plane is rendered: an entity of half a pixel's cover at (4,4), k O + (1 - a) B = 2 * 0.1 + 0.5 * 0.5 */
    memset(p, 0, sizeof p);
    memset(s, 0, sizeof s);
    memset(o, 0, sizeof o);
    fill(o + 4 * (4 * N + 4), 0.1f, 0.5f);
    if (!OK(transfer_ratio(&out, &in, &err), "an entity beyond the plane")) return tap_done();
    NEAR(image_f32(&out, 4, 4)[0], 0.45, 1e-6, "stands before the photograph's ground");
    OK(image_f32(&out, 5, 4)[0] == 0.5f, "and what is beside it stays to the last bit");
    image_release(&out);
    uint8_t half[N * N];
    memset(half, 51, sizeof half); /* 0.2 */
    struct image visible = { N, N, 1, PIXEL_U8, half };
    for (int i = 0; i < N * N; i++) fill(o + 4 * i, 0.4f, 1);
    in.visible = &visible;
    if (!OK(transfer_ratio(&out, &in, &err), "that something hides in part")) return tap_done();
    NEAR(image_f32(&out, 4, 4)[0], 0.5 * 0.8 + 2 * 0.4 * 0.2, 1e-5, "is there by that part");
    image_release(&out);
    in.visible = NULL;

    /* Ground in columns 0..4 under a shadow of one half; with half of the receiver hidden in row 8. */
    uint8_t g[N * N];
    memset(g, 255, sizeof g);
    for (int x = 0; x < N; x++) g[8 * N + x] = 102; /* 0.4 */
    struct image receiver = { N, N, 1, PIXEL_U8, g };
    in.receiver = &receiver;
    memset(o, 0, sizeof o);
    for (int y = 0; y < N; y++)
        for (int x = 0; x < N; x++) {
            fill(p + 4 * (y * N + x), x < 5 ? 0.2f : 0, x < 5 ? 1 : 0);
            fill(s + 4 * (y * N + x), x < 5 ? 0.1f : 0, x < 5 ? 1 : 0);
        }
    if (!OK(transfer_ratio(&out, &in, &err), "a shadow alone")) return tap_done();
    NEAR(image_f32(&out, 3, 4)[0], 0.25, 1e-6, "shades the plane: 0.5 * 0.1/0.2");
    OK(image_f32(&out, 4, 4)[0] == 0.5f, "but not its eroded edge");
    OK(image_f32(&out, 6, 4)[0] == 0.5f, "nor what is not plane");
    NEAR(image_f32(&out, 0, 8)[0], 0.4, 1e-6, "and only as much as is seen of it: 0.5 * (1 + 0.4 * (0.5 - 1))");
    image_release(&out);
    return tap_done();
}

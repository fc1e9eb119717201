#include "post/transfer.h"

#include "tests/tap.h"

#define N 10

/* A post of 0.3 over ground of 0.2, its edge in pixel 3, with a car of 0.9 behind it: what a pixel shows of both is known. */
static void at_a_soft_edge(void)
{
    enum { WIDTH = 7 };
    static const float share[WIDTH] = { 0, 0, 0, 0.4f, 1, 1, 1 };
    float b[WIDTH * 3], o[WIDTH * 4], none[WIDTH * 4] = { 0 };
    uint8_t v[WIDTH], g[WIDTH] = { 0 };
    for (int x = 0; x < WIDTH; x++) {
        v[x] = (uint8_t)(share[x] * 255);
        for (int c = 0; c < 3; c++) {
            b[3 * x + c] = 0.3f * (1 - share[x]) + 0.2f * share[x];
            o[4 * x + c] = 0.9f;
        }
        o[4 * x + 3] = 1;
    }
    struct image photograph = { WIDTH, 1, 3, PIXEL_F32, b }, object = { WIDTH, 1, 4, PIXEL_F32, o }, nothing = { WIDTH, 1, 4, PIXEL_F32, none },
                 visible = { WIDTH, 1, 1, PIXEL_U8, v }, receiver = { WIDTH, 1, 1, PIXEL_U8, g }, out;
    struct transfer_input in = { &photograph, &object, &nothing, &nothing, &visible, &receiver, { 1, 1, 1 } };
    struct error err = ERROR_NONE;
    if (!OK(transfer_layers(&out, &in, &err), "with something that hides, and is soft")) return;
    NEAR(image_f32(&out, 3, 0)[0], 0.3 * 0.6 + 0.9 * 0.4, 1e-6, "its edge keeps its own light, and gets the entity's for the ground's");
    OK(image_f32(&out, 2, 0)[0] == 0.3f, "within it stays to the last bit");
    NEAR(image_f32(&out, 4, 0)[0], 0.9, 1e-6, "beside it the entity is whole");
    image_release(&out);

    /* A round post turns away from the light: its edge has 0.18. */
    for (int c = 0; c < 3; c++) b[3 * 3 + c] = 0.18f * 0.6f + 0.2f * 0.4f;
    if (!OK(transfer_layers(&out, &in, &err), "with something round that hides")) return;
    NEAR(image_f32(&out, 3, 0)[0], 0.18 * 0.6 + 0.9 * 0.4, 1e-6, "an edge darker than the rest keeps its own light, too");
    image_release(&out);
    for (int c = 0; c < 3; c++) b[3 * 3 + c] = 0.3f * 0.6f + 0.2f * 0.4f;

    /* The same with a shadow of 0.3 on the ground under the entity. */
    float plane[WIDTH * 4], shadow[WIDTH * 4];
    for (int i = 0; i < WIDTH * 4; i++) {
        plane[i] = 1;
        shadow[i] = i % 4 == 3 ? 1 : 0.3f;
    }
    struct image lit = { WIDTH, 1, 4, PIXEL_F32, plane }, shaded = { WIDTH, 1, 4, PIXEL_F32, shadow };
    in.plane = &lit;
    in.shadow = &shaded;
    in.receiver = &visible;
    if (!OK(transfer_layers(&out, &in, &err), "and in the shade")) return;
    NEAR(image_f32(&out, 3, 0)[0], 0.3 * 0.6 + 0.9 * 0.4, 1e-6, "what hides is not in the entity's shade");
    image_release(&out);
}

int main(void)
{
    at_a_soft_edge();
    /*                    same  half  solid edge  no ground  dark  bounce part  hidden  g .4 */
    float b[N * 3] = { 0.4f, 0.4f, 0.4f,  0.4f, 0.4f, 0.4f,  0.7f, 0.7f, 0.7f,  0.8f, 0.8f, 0.8f,  0.6f, 0.6f, 0.6f,
                       0.6f, 0.6f, 0.6f,  0.1f, 0.1f, 0.1f,  0.4f, 0.4f, 0.4f,  0.5f, 0.5f, 0.5f,  0.5f, 0.5f, 0.5f };
    float o[N * 4] = { [8] = 0.3f, 0.1f, 0.05f, 1,  [12] = 0.1f, 0.1f, 0.1f, 0.5f,  [32] = 0.3f, 0.3f, 0.3f, 1 };
    float p[N * 4] = { 0.2f, 0.2f, 0.2f, 1,  0.2f, 0.2f, 0.2f, 1,  0.2f, 0.2f, 0.2f, 1,  0.4f, 0.4f, 0.4f, 1,  0, 0, 0, 0,
                       0, 0, 0, 1,  0.1f, 0.1f, 0.1f, 1,  0.1f, 0.1f, 0.1f, 0.5f,  0.2f, 0.2f, 0.2f, 1,  0.2f, 0.2f, 0.2f, 1 };
    float s[N * 4] = { 0.2f, 0.2f, 0.2f, 1,  0.1f, 0.05f, 0.2f, 1,  0.02f, 0.02f, 0.02f, 1,  0.1f, 0.1f, 0.1f, 1,  0, 0, 0, 0,
                       0.5f, 0.5f, 0.5f, 1,  1, 1, 1, 1,  0.05f, 0.05f, 0.05f, 0.5f,  0.1f, 0.1f, 0.1f, 1,  0.1f, 0.1f, 0.1f, 1 };
    uint8_t v[N] = { 255, 255, 255, 255, 255, 255, 255, 255, 51, 255 };  /* 51/255 = 0.2 */
    uint8_t g[N] = { 255, 255, 255, 255, 255, 255, 255, 255, 0, 102 };   /* 102/255 = 0.4 */
    struct image photograph = { N, 1, 3, PIXEL_F32, b }, object = { N, 1, 4, PIXEL_F32, o },
                 plane = { N, 1, 4, PIXEL_F32, p }, shadow = { N, 1, 4, PIXEL_F32, s },
                 visible = { N, 1, 1, PIXEL_U8, v }, receiver = { N, 1, 1, PIXEL_U8, g }, out;
    struct transfer_input in = { &photograph, &object, &plane, &shadow, &visible, &receiver, { 2, 2, 4 } };
    struct error err = ERROR_NONE;
    if (!OK(transfer_layers(&out, &in, &err), "the layers are merged")) return tap_done();

    OK(image_f32(&out, 0, 0)[0] == 0.4f, "where S equals P the photograph stays to the last bit");
    NEAR(image_f32(&out, 1, 0)[0], 0.2, 1e-7, "half the light: 0.4 * 0.1/0.2");
    NEAR(image_f32(&out, 1, 0)[1], 0.1, 1e-7, "each channel by its own ratio: 0.4 * 0.05/0.2");
    OK(image_f32(&out, 1, 0)[2] == 0.4f, "and an unshaded channel stays");
    NEAR(image_f32(&out, 2, 0)[0], 0.6, 1e-7, "a solid entity hides the photograph: 2 * 0.3");
    NEAR(image_f32(&out, 2, 0)[2], 0.2, 1e-7, "exposed by channel: 4 * 0.05");
    NEAR(image_f32(&out, 3, 0)[0], 0.3, 1e-7, "under a soft edge the ground is shaded: 0.8 * 0.1/0.4 * (1 - 0.5) + 2 * 0.1");
    OK(image_f32(&out, 4, 0)[0] == 0.6f, "where there is no ground nothing changes");
    OK(image_f32(&out, 5, 0)[0] == 0.6f, "black ground has no ratio");
    NEAR(image_f32(&out, 6, 0)[0], 0.4, 1e-7, "a ratio of 10 is held to 4: 0.1 * 4");
    NEAR(image_f32(&out, 7, 0)[0], 0.3, 1e-7, "half ground: 0.4 * (1 + 0.5 * (0.5 - 1))");
    NEAR(image_f32(&out, 8, 0)[0], 0.52, 1e-7, "behind an occluder: 0.5 * (1 - 0.2) + 2 * 0.3 * 0.2, and no shadow on it");
    NEAR(image_f32(&out, 9, 0)[0], 0.4, 1e-7, "ground seen by 0.4: 0.5 * (1 + 0.4 * (0.5 - 1))");
    image_release(&out);

    in.visible = in.receiver = NULL;
    if (!OK(transfer_layers(&out, &in, &err), "no occluders are given")) return tap_done();
    NEAR(image_f32(&out, 8, 0)[0], 0.6, 1e-7, "then the entity is there as a whole: 2 * 0.3");
    NEAR(image_f32(&out, 9, 0)[0], 0.25, 1e-7, "and the shadow: 0.5 * 0.5");
    image_release(&out);
    return tap_done();
}

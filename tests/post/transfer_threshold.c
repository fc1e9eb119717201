#include "lib/class.h"
#include "post/transfer.h"

#include "tests/tap.h"

#define N 8
#define CAR (1 + CLASS_CAR)
#define PERSON (1 + CLASS_PERSON)

static double value(const struct image *out, int x)
{
    return (double)image_f32(out, x, 0)[0];
}

int main(void)
{
    /* alpha of the shadow: 0.1, 0.2; of the entities: 0.5, 0.5, 0.8, 0.8, 0.1, 0.
     * In 255ths: 25.5, 51; 127.5, 127.5, 204, 204, 25.5, 0 */
    const uint8_t class_of[N] = { 0, 0, PERSON, CAR, CAR, 0, CAR, CAR };
    const float alpha[N] = { 0, 0, 0.5f, 0.5f, 0.8f, 0.8f, 0.1f, 0 };
    const float color[N] = { 0, 0, 0.1f, 0.1f, 0.4f, 0.4f, 0.01f, 0 };
    const float left[N] = { 0.9f, 0.8f, 1, 1, 1, 1, 1, 1 };
    float b[N * 3], o[N * 4], p[N * 4], s[N * 4];
    for (int i = 0; i < N; i++)
        for (int c = 0; c < 4; c++) {
            if (c < 3) b[3 * i + c] = 0.8f;
            o[4 * i + c] = c < 3 ? color[i] : alpha[i];
            p[4 * i + c] = 1;
            s[4 * i + c] = c < 3 ? left[i] : 1;
        }
    struct image photograph = { N, 1, 3, PIXEL_F32, b }, object = { N, 1, 4, PIXEL_F32, o },
                 plane = { N, 1, 4, PIXEL_F32, p }, shadow = { N, 1, 4, PIXEL_F32, s },
                 classes = { N, 1, 1, PIXEL_U8, (void *)class_of }, out;
    struct transfer_input in = { &photograph, &object, &plane, &shadow, NULL, NULL, { 1, 1, 1 } };
    struct transfer_thresholds t = { .t1 = 30, .t2 = 200, .t3 = 96 };
    struct error err = ERROR_NONE;

    if (!OK(transfer_threshold(&out, &in, &classes, &t, &err), "overwriting from the threshold upwards")) return tap_done();
    OK(image_f32(&out, 0, 0)[0] == 0.8f, "a shadow of 25.5 is not above T1 = 30: the photograph stays to the last bit");
    NEAR(value(&out, 1), 0.64, 1e-6, "one of 51 is blended: 0.8 * (1 - 0.2)");
    NEAR(value(&out, 2), 0.2, 1e-6, "a person of 127.5 reaches T3 = 96 and overwrites: 0.1 / 0.5");
    NEAR(value(&out, 3), 0.5, 1e-6, "a car of 127.5 does not reach T2 = 200: 0.8 * 0.5 + 0.1");
    NEAR(value(&out, 4), 0.5, 1e-6, "a car of 204 does: 0.4 / 0.8");
    NEAR(value(&out, 5), 0.56, 1e-6, "without a class it is blended: 0.8 * (1 - 0.8) + 0.4");
    OK(image_f32(&out, 6, 0)[0] == 0.8f, "a car of 25.5 is below both");
    OK(image_f32(&out, 7, 0)[0] == 0.8f, "a class without alpha writes nothing");
    image_release(&out);

    t.overwrite_below = true;
    if (!OK(transfer_threshold(&out, &in, &classes, &t, &err), "overwriting below the threshold")) return tap_done();
    NEAR(value(&out, 1), 0.64, 1e-6, "shadows are the same");
    NEAR(value(&out, 2), 0.5, 1e-6, "a person of 127.5 is blended: 0.8 * 0.5 + 0.1");
    NEAR(value(&out, 3), 0.2, 1e-6, "a car of 127.5 overwrites: 0.1 / 0.5");
    NEAR(value(&out, 4), 0.56, 1e-6, "a car of 204 is blended: 0.8 * 0.2 + 0.4");
    NEAR(value(&out, 6), 0.1, 1e-6, "a car of 25.5 overwrites too: 0.01 / 0.1");
    OK(image_f32(&out, 7, 0)[0] == 0.8f, "a class without alpha still writes nothing");
    image_release(&out);

    t = (struct transfer_thresholds){ .t1 = 127.5, .t2 = 127.5, .t3 = 96 };
    if (!OK(transfer_threshold(&out, &in, &classes, &t, &err), "an alpha that equals its threshold")) return tap_done();
    NEAR(value(&out, 3), 0.2, 1e-6, "reaches the class threshold: 0.1 / 0.5");
    image_release(&out);
    return tap_done();
}

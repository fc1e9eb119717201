#include "post/transfer.h"

#include "tests/tap.h"

int main(void)
{
    /*                nothing            shadow             entity             edge over shadow    brighter ground */
    float b[15] = { 0.4f, 0.4f, 0.4f,  0.4f, 0.4f, 0.4f,  0.4f, 0.4f, 0.4f,  0.8f, 0.8f, 0.8f,  0.4f, 0.4f, 0.4f };
    float o[20] = { [8] = 0.3f, 0.2f, 0.1f, 1,  [12] = 0.1f, 0.1f, 0.1f, 0.5f };
    float p[20] = { 0.2f, 0.2f, 0.2f, 1,  0.2f, 0.2f, 0.2f, 1,  0.2f, 0.2f, 0.2f, 1,  0.2f, 0.2f, 0.2f, 1,  0.2f, 0.2f, 0.2f, 1 };
    float s[20] = { 0.2f, 0.2f, 0.2f, 1,  0.05f, 0.05f, 0.05f, 1,  0, 0, 0, 1,  0.1f, 0.1f, 0.1f, 1,  0.3f, 0.3f, 0.3f, 1 };
    struct image photograph = { 5, 1, 3, PIXEL_F32, b }, object = { 5, 1, 4, PIXEL_F32, o },
                 plane = { 5, 1, 4, PIXEL_F32, p }, shadow = { 5, 1, 4, PIXEL_F32, s }, out;
    struct transfer_input in = { &photograph, &object, &plane, &shadow, NULL, NULL, { 2, 1, 1 } };
    struct error err = ERROR_NONE;

    float caught[4];
    transfer_caught(caught, &in, 1);
    NEAR(caught[3], 0.75, 1e-6, "a shadow that leaves a quarter of the light is caught with alpha 0.75");
    NEAR(caught[0], 0, 0, "and is black");
    transfer_caught(caught, &in, 3);
    NEAR(caught[3], 0.75, 1e-6, "an edge of 0.5 over a shadow of 0.5: 0.5 + 0.5 * 0.5");

    if (!OK(transfer_alpha(&out, &in, &err), "the layers are merged")) return tap_done();
    OK(image_f32(&out, 0, 0)[0] == 0.4f, "where nothing was caught the photograph stays to the last bit");
    NEAR(image_f32(&out, 1, 0)[0], 0.1, 1e-7, "shadow: 0.4 * (1 - 0.75)");
    NEAR(image_f32(&out, 2, 0)[0], 0.6, 1e-7, "entity: 2 * 0.3");
    NEAR(image_f32(&out, 2, 0)[1], 0.2, 1e-7, "entity, green: 1 * 0.2");
    NEAR(image_f32(&out, 3, 0)[0], 0.4, 1e-7, "edge: 0.8 * (1 - 0.75) + 2 * 0.1");
    OK(image_f32(&out, 4, 0)[0] == 0.4f, "a catcher never brightens");
    image_release(&out);
    return tap_done();
}

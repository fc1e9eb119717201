#include "post/mask.h"

#include "tests/tap.h"

int main(void)
{
    uint16_t ids[5 * 7] = {
        0, 0, 0, 0, 0, 0, 0,
        0, 0, 9, 4, 0, 0, 0,
        0, 0, 9, 4, 0, 0, 0,
        0, 0, 0, 0, 0, 0, 0,
        3, 0, 0, 0, 0, 0, 0,
    };
    /* alpha in the window x 1..5, y 0..3 */
    float a[4 * 5] = {
        0, 0.1f, 0.2f, 0, 0,
        0, 1,    0,    0.5f, 0.5f,
        0, 1,    1,    0, 0,
        0, 0,    0.3f, 0, 0,
    };
    const uint16_t want[5 * 7] = {
        0, 0, 9, 9, 0, 0, 0,
        0, 0, 9, 0, 4, 0, 0,
        0, 0, 9, 4, 0, 0, 0,
        0, 0, 0, 9, 0, 0, 0,
        3, 0, 0, 0, 0, 0, 0,
    };
    float object[4 * 5 * 4] = { 0 };
    for (int i = 0; i < 4 * 5; i++) object[4 * i + 3] = a[i];
    struct image instance = { 7, 5, 1, PIXEL_U16, ids }, layer = { 5, 4, 4, PIXEL_F32, object };
    struct rect window = { 1, 0, 6, 4 };
    struct error err = ERROR_NONE;
    OK(mask_dilate(&instance, &layer, NULL, window, &err), "the ids are dilated");
    int wrong = 0;
    for (int i = 0; i < 5 * 7; i++) wrong += ids[i] != want[i];
    NEAR(wrong, 0, 0, "ids grow by a pixel where alpha is, give way to none, and end where alpha ends");
    OK(ids[4 * 7] == 3, "outside the window nothing changes");

    uint8_t v[4 * 5];
    memset(v, 255, sizeof v);
    v[0 * 5 + 1] = 0;
    struct image visible = { 5, 4, 1, PIXEL_U8, v };
    OK(mask_dilate(&instance, &layer, &visible, window, &err), "with an occluder");
    OK(ids[0 * 7 + 2] == 0, "a hidden pixel has no id");
    OK(ids[0 * 7 + 3] == 9, "one that is seen keeps it");
    return tap_done();
}

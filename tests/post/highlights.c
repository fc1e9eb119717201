#include "post/highlights.h"

#include "tests/post/taken.h"
#include "tests/tap.h"

#include <string.h>

#define W 400
#define H 300

/* Light of which the part x^-1.3 is brighter than x, through the camera's curve as its definition says. */
static struct image photograph(double knee)
{
    struct image rgb = grey(W, H, 0);
    for (int i = 0; i < 3 * W * H; i++) {
        double x = 0.05 * pow((rand() + 1.0) / (RAND_MAX + 1.0), -1 / 1.3);
        double y = x <= knee ? x : knee < 1 ? knee + (1 - knee) * (1 - exp((knee - x) / (1 - knee))) : 1;
        ((uint8_t *)rgb.data)[i] = srgb_byte(y);
    }
    return rgb;
}

int main(void)
{
    static const double knees[] = { 0.4, 0.6, 0.8, 1 };
    struct highlights h;
    srand(4);
    for (int i = 0; i < 4; i++) {
        struct image rgb = photograph(knees[i]);
        highlights_measure(&h, &rgb);
        OK(h.told, "highlights are told (misfit %g)", h.misfit);
        NEAR(h.knee / knees[i], 1, 0.15, "they begin at %g", knees[i]);
        image_release(&rgb);
    }
    struct image rgb = grey(W, H, 80);
    highlights_measure(&h, &rgb);
    OK(!h.told && h.knee == 1, "a picture without bright parts tells nothing");
    image_release(&rgb);

    struct image object;
    struct error err = ERROR_NONE;
    if (!image_init(&object, 3, 1, 4, PIXEL_F32, &err)) return 99;
    const float colors[3][4] = { { 0.1f, 0.1f, 0.1f, 1 }, { 0.5f, 0.5f, 0.5f, 0.5f }, { 9, 9, 9, 1 } };
    memcpy(object.data, colors, sizeof colors);
    highlights_keep(&object, 0.5, (double[]){ 2, 2, 2 });
    NEAR((double)image_f32(&object, 0, 0)[0], 0.1, 1e-8, "below the knee all stays");
    /* 0.5 / 0.5 * 2 = 2: 0.5 + 0.5 (1 - exp(-3)) = 0.97511, over 2, by half */
    NEAR((double)image_f32(&object, 1, 0)[0], 0.97511 / 2 * 0.5, 1e-4, "above, it comes nearer to white, whatever the cover");
    OK(image_f32(&object, 2, 0)[0] <= 0.5f && image_f32(&object, 2, 0)[0] > 0.499f, "and never beyond");
    image_release(&object);
    return tap_done();
}

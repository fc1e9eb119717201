#include "post/blacks.h"

#include "tests/post/taken.h"
#include "tests/tap.h"

#define W 400
#define H 300

/* A place with as much of every level, seen by a camera that shows level `black` as 0: a straight line from there to
 * 128, above which all is as it is; and noise. */
static struct image photograph(double black, double noise_levels)
{
    struct image rgb = grey(W, H, 0);
    uint8_t *px = rgb.data;
    for (size_t i = 0; i < image_size(&rgb); i++) {
        double light = 256 * (rand() / (RAND_MAX + 1.0)) + noise_levels * noise();
        double level = light < 128 ? 128 - (128 - light) * 128 / (128 - black) : light;
        px[i] = (uint8_t)(level > 0 ? level < 255 ? level + 0.5 : 255 : 0);
    }
    return rgb;
}

int main(void)
{
    struct blacks b;
    srand(7);
    for (int black = 10; black <= 40; black += 10) {
        struct image rgb = photograph(black, 1.5);
        blacks_measure(&b, &rgb);
        /* between 0 and 128 a level of the camera's holds fewer of the light's */
        double expected = black * 128.0 / (128 - black);
        if (expected <= 48) NEAR(b.level / expected, 1, 0.1, "blacks that are crushed below %d are told", black);
        image_release(&rgb);
    }
    struct image rgb = photograph(0, 3);
    blacks_measure(&b, &rgb);
    OK(b.level == 0 && b.channel[1] < 4, "a camera that keeps its blacks is let alone (%.1f)", b.channel[1]);
    for (int i = 0; i < 3 * W * 30; i++) ((uint8_t *)rgb.data)[i] = 0;
    blacks_measure(&b, &rgb);
    OK(b.level == 0 && b.channel[1] < 4, "and so is one with a black bar above");
    struct image fisheye = photograph(0, 3);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            if (hypot(x - W / 2, y - H / 2) > H / 2 + 24)
                for (int c = 0; c < 3; c++) image_u8(&fisheye, x, y)[c] = 0;
    blacks_measure(&b, &fisheye);
    OK(b.level == 0 && b.channel[1] < 4, "or a fisheye's circle (%.1f)", b.channel[1]);
    image_release(&fisheye);
    for (int y = 100; y < 200; y++)
        for (int i = 300; i < 900; i++) ((uint8_t *)rgb.data)[3 * W * y + i] = 0;
    blacks_measure(&b, &rgb);
    OK(b.level == 0 && b.channel[1] > 48, "or with one painted in");
    for (int c = 0; c < 3; c += 2)
        for (int i = 0; i < W * H; i++) ((uint8_t *)rgb.data)[3 * i + c] = 77;
    blacks_measure(&b, &rgb);
    OK(b.level == 0, "one channel tells nothing of the camera");
    image_release(&rgb);

    NEAR(blacks_crush(20, 20), 0, 0, "the black level comes out as 0");
    NEAR(blacks_crush(20, 5), 0, 0, "and so does what is darker");
    NEAR(blacks_crush(20, 74), 64, 1e-12, "half way to the middle stays half way");
    OK(blacks_crush(20, 128) == 128 && blacks_crush(20, 255) == 255, "what is brighter is as it is");
    double worst = 0;
    for (int level = 0; level < 256; level++) worst = fmax(worst, fabs(blacks_crush(20, blacks_lift(20, level)) - level));
    NEAR(worst, 0, 1e-12, "lifting undoes it");

    struct image dark = grey(2, 1, 40), linear;
    struct error err = ERROR_NONE;
    ((uint8_t *)dark.data)[5] = 200;
    if (!image_init(&linear, 2, 1, 3, PIXEL_F32, &err)) return 99;
    blacks_lift_image(&linear, &dark, 20);
    /* 20 + 40 * 108 / 128 = 53.75 of 255 is 0.03656 in linear light; 200 is 0.57758 */
    NEAR((double)image_f32(&linear, 0, 0)[0], 0.03656, 1e-4, "a photograph's dark parts are lifted to their light");
    NEAR((double)image_f32(&linear, 1, 0)[2], 0.57758, 1e-4, "its bright parts are what they were");
    image_release(&linear);
    image_release(&dark);
    return tap_done();
}

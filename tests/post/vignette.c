#include "post/vignette.h"

#include "tests/post/taken.h"
#include "tests/tap.h"

#define W 640
#define H 480

/* Ground that gets lighter to the right, in blocks of different brightness, under a lens that takes the
 * share `fall_off` of the light from the corners. */
static struct image photograph(double fall_off, double slope)
{
    struct image rgb = grey(W, H, 0);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            double dx = x + 0.5 - W / 2.0, dy = y + 0.5 - H / 2.0, r2 = (dx * dx + dy * dy) / (W * W / 4.0 + H * H / 4.0);
            double block = 0.15 + 0.25 * ((x / 80 * 7 + y / 80 * 5) % 4) / 3;
            double light = block * (1 + slope * dx / W) * (1 - fall_off * r2);
            for (int c = 0; c < 3; c++) image_u8(&rgb, x, y)[c] = byte(255 * (double)srgb_from_linear((float)light) + noise());
        }
    return rgb;
}

static struct vignette measured(double fall_off, double slope)
{
    struct image rgb = photograph(fall_off, slope);
    struct flat_patches patches;
    struct vignette v;
    struct error err = ERROR_NONE;
    if (!flat_patches_find(&patches, &rgb, &err)) exit(99);
    vignette_measure(&v, &patches, W, H);
    flat_patches_release(&patches);
    image_release(&rgb);
    return v;
}

int main(void)
{
    static const double falls[] = { 0.2, 0.4, 0.6 };
    srand(2);
    for (int i = 0; i < 3; i++) {
        struct vignette v = measured(falls[i], 0);
        OK(v.agree, "the quarters of a picture agree (%g %g %g %g)", v.quarter[0], v.quarter[1], v.quarter[2], v.quarter[3]);
        NEAR(v.fall_off / falls[i], 1, 0.15, "its corners lose %g of their light", falls[i]);
    }
    OK(!measured(0, 0).agree || measured(0, 0).fall_off < 0.03, "an even picture has no vignetting");
    OK(!measured(0.05, 0.9).agree, "light that falls from one side is not the lens's");

    struct image object;
    struct error err = ERROR_NONE;
    if (!image_init(&object, 2, 1, 4, PIXEL_F32, &err)) return 99;
    for (int i = 0; i < 8; i++) ((float *)object.data)[i] = 0.5f;
    vignette_shade(&object, 0.4, (struct vec2){ W / 2.0, H / 2.0 }, (struct rect){ 0, 0, 2, 1 }, W, H);
    NEAR((double)((float *)object.data)[0], 0.5 * (1 - 0.4 * ((W - 1.0) * (W - 1) + (H - 1.0) * (H - 1)) / ((double)W * W + (double)H * H)), 1e-6,
         "what is put into a corner is as dark as the corner");
    NEAR((double)((float *)object.data)[3], 0.5, 0, "and covers as much");
    image_release(&object);
    return tap_done();
}

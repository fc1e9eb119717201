#include "post/sharpening.h"

#include "tests/post/taken.h"
#include "tests/tap.h"

#include <string.h>

#define W 60
#define H 40

static struct image floats(int channels)
{
    struct image image;
    struct error err = ERROR_NONE;
    if (!image_init(&image, W, H, channels, PIXEL_F32, &err)) exit(99);
    return image;
}

/* A place with texture; a dark thing with a soft edge stands in it from x = 30 on, and a shade lies from y = 25 on. */
static void paint(struct image *place, struct image *with, struct image *cover, double shade)
{
    srand(5);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            double texture = 120 + 4 * noise(), a = erfc((30 - x - 0.5) / 0.5) / 2;
            if (a < 1e-4) a = 0;
            *image_f32(cover, x, y) = (float)a;
            for (int c = 0; c < 3; c++) {
                image_f32(place, x, y)[c] = (float)texture;
                image_f32(with, x, y)[c] = (float)((1 - a) * texture * (y < 25 ? 1 : shade) + a * 40);
            }
        }
}

static double most_off(const struct image *a, const struct image *b, int x0, int x1, int y0, int y1)
{
    double most = 0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            most = fmax(most, fabs((double)image_f32(a, x, y)[0] - (double)image_f32(b, x, y)[0]));
    return most;
}

/* Brightness, sharpened and taken back. */
static void check_taken_back(const struct image *picture)
{
    struct error err = ERROR_NONE;
    for (int i = 0; i < 2; i++) {
        const double amount = i ? 1.5 : 0.4;
        struct image sharp = floats(3), one = floats(1);
        memcpy(sharp.data, picture->data, image_size(picture));
        camera_sharpens(&sharp, amount);
        for (size_t k = 0; k < (size_t)W * H; k++) ((float *)one.data)[k] = ((float *)sharp.data)[3 * k];
        OK(sharpening_take_back(&one, amount, &err), "a sharpening of %g is taken back", amount);
        double most = 0;
        for (int y = 4; y < H - 4; y++)
            for (int x = 4; x < W - 4; x++) most = fmax(most, fabs((double)*image_f32(&one, x, y) - (double)image_f32(picture, x, y)[0]));
        NEAR(most, 0, 1.5, "and what was before is there again");
        image_release(&sharp);
        image_release(&one);
    }
}

/* What the camera's own picture would be: of the place and the thing, sharpened together. */
int main(void)
{
    struct image place = floats(3), with = floats(3), cover = floats(1), photograph, truth;
    struct error err = ERROR_NONE;
    paint(&place, &with, &cover, 1);
    photograph = floats(3);
    truth = floats(3);
    memcpy(photograph.data, place.data, image_size(&place));
    memcpy(truth.data, with.data, image_size(&with));
    camera_sharpens(&photograph, 0.5);
    camera_sharpens(&truth, 0.5);
    struct image got = floats(3);
    for (size_t i = 0; i < (size_t)W * H; i++)
        for (size_t c = 0; c < 3; c++) {
            float a = ((float *)cover.data)[i];
            ((float *)got.data)[3 * i + c] = (1 - a) * ((float *)photograph.data)[3 * i + c] + a * 40;
        }
    check_taken_back(&with);
    double plain = most_off(&got, &truth, 24, 36, 4, 36);
    if (!OK(sharpening_add(&got, &photograph, &cover, 0.5, &err), "what is put in is sharpened")) return tap_done();
    OK(plain > 8 && most_off(&got, &truth, 24, 36, 4, 36) < 1, "as if the camera had seen it: off by %.1f, without by %.1f",
       most_off(&got, &truth, 24, 36, 4, 36), plain);
    OK(most_off(&got, &photograph, 0, 26, 0, H) < 1e-3, "and the photograph is not sharpened twice");
    NEAR((double)image_f32(&got, W - 1, H - 1)[0], 40, 1e-3, "at the picture's border as elsewhere");

    /* A shade without a thing. */
    memset(cover.data, 0, image_size(&cover));
    for (size_t i = 0; i < (size_t)W * H * 3; i++) ((float *)got.data)[i] = ((float *)photograph.data)[i] * (i / (3 * W) < 25 ? 1.0f : 0.5f);
    struct image shaded = floats(3);
    memcpy(shaded.data, got.data, image_size(&got));
    OK(sharpening_add(&got, &photograph, &cover, 0.5, &err), "a shadow is sharpened");
    OK(most_off(&got, &shaded, 0, W, 31, H) < 1e-3, "within, the texture stays what it was");
    OK(image_f32(&got, 10, 24)[0] > image_f32(&shaded, 10, 24)[0] + 5 && image_f32(&got, 10, 25)[0] < image_f32(&shaded, 10, 25)[0] - 5,
       "and its edge is steeper");
    struct image *all[] = { &place, &with, &cover, &photograph, &truth, &got, &shaded };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) image_release(all[i]);
    return tap_done();
}

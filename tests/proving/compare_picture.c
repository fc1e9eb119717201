/* The figures of the proving ground, on pictures of which they are known. */
#include "scenes/proving-ground/compare_picture.h"

#include "lib/rect.h"
#include "tests/tap.h"

enum { SIZE = 64 };

static void paint(struct image *image, struct rect part, uint8_t r, uint8_t g, uint8_t b)
{
    for (int y = part.y0; y < part.y1; y++)
        for (int x = part.x0; x < part.x1; x++) {
            uint8_t *p = image_u8(image, x, y);
            p[0] = r;
            p[1] = g;
            p[2] = b;
        }
}
static struct image light_of(const struct image *srgb)
{
    struct image linear;
    struct error err = ERROR_NONE;
    if (!image_linear_from_srgb(&linear, srgb, &err)) exit(1);
    return linear;
}

static const struct rect all = { 0, 0, SIZE, SIZE }, entity = { 8, 8, 24, 24 }, shade = { 30, 30, 50, 50 };

static struct picture_input pictures(void)
{
    struct picture_input in;
    struct error err = ERROR_NONE;
    if (!image_init(&in.photograph, SIZE, SIZE, 3, PIXEL_U8, &err) || !image_init(&in.truth, SIZE, SIZE, 3, PIXEL_U8, &err) ||
        !image_init(&in.result, SIZE, SIZE, 3, PIXEL_U8, &err) || !image_init(&in.owner, SIZE, SIZE, 1, PIXEL_U8, &err))
        exit(1);
    for (int y = entity.y0; y < entity.y1; y++)
        for (int x = entity.x0; x < entity.x1; x++) *image_u8(&in.owner, x, y) = 1;
    paint(&in.photograph, all, 188, 188, 188); /* linear 0.5028 */
    paint(&in.truth, all, 188, 188, 188);
    paint(&in.truth, shade, 137, 137, 137);    /* linear 0.2502 */
    paint(&in.truth, entity, 255, 0, 0);
    memcpy(in.result.data, in.truth.data, image_size(&in.truth));
    return in;
}

static struct comparison measured(struct picture_input *in)
{
    struct comparison c = { 0 };
    struct error err = ERROR_NONE;
    in->photograph_light = light_of(&in->photograph);
    in->truth_light = light_of(&in->truth);
    OK(compare_picture(&c, in, &err), "pictures of one size are compared");
    image_release(&in->photograph_light);
    image_release(&in->truth_light);
    return c;
}
static void release(struct picture_input *in)
{
    image_release(&in->photograph);
    image_release(&in->truth);
    image_release(&in->result);
    image_release(&in->owner);
}

int main(void)
{
    struct picture_input in = pictures();
    struct comparison c = measured(&in);
    NEAR(c.changed_px, 16 * 16 + 20 * 20, 0, "what changes: an entity and its shadow");
    NEAR(c.ssim, 1, 1e-12, "the truth itself: SSIM of 1");
    NEAR(c.color_error, 0, 0, "the truth itself: no distance of colours");
    NEAR(c.shade_error, 0, 1e-6, "the truth itself: the same shade");

    paint(&in.result, shade, 140, 140, 140);
    paint(&in.result, entity, 252, 3, 3);
    c = measured(&in);
    NEAR(c.psnr_db, 20 * log10(255 / 3.0), 1e-9, "three levels off everywhere: PSNR of 20 log10(255 / 3)");

    /* No shadow, and an entity of another colour. */
    paint(&in.result, all, 188, 188, 188);
    paint(&in.result, entity, 255, 255, 255);
    c = measured(&in);
    /* sRGB's red is L* 53.24, a* 80.09, b* 67.20; white is 100, 0, 0. */
    NEAR(c.color_error, sqrt(46.76 * 46.76 + 80.09 * 80.09 + 67.20 * 67.20), 0.05, "white for red: the distance that CIE 1976 gives");
    NEAR(c.mean_color_error, c.color_error, 1e-9, "one colour each: their means are as far apart");
    /* Of 3 x 3 px means: 18 x 18 lie inside, at 2 edges and 4 corners a part does. */
    double inside = 0.4976, sum = (18 * 18 * 9 + 4 * 18 * (6 + 3) + 4 * (4 + 2 * 2 + 1)) / 9.0 * (1 - inside);
    NEAR(c.shade_bias, sum / (22 * 22), 0.002, "no shadow: as much too bright as the shadow is dark");
    NEAR(c.shade_error, c.shade_bias, 1e-9, "no shadow: nowhere too dark");
    release(&in);

    in = pictures();
    struct comparison none = { .psnr_db = -1 };
    struct error err = ERROR_NONE;
    in.photograph_light = light_of(&in.photograph);
    in.truth_light = light_of(&in.photograph);
    memcpy(in.result.data, in.photograph.data, image_size(&in.photograph));
    OK(!compare_picture(&none, &in, &err) && err.code == ERR_INPUT && none.psnr_db < 0, "pictures in which nothing changes are refused");
    image_release(&in.photograph_light);
    image_release(&in.truth_light);
    release(&in);
    return tap_done();
}

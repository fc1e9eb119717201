#include "lib/photograph.h"

#include "tests/tap.h"

#include <unistd.h>

#define W 8
#define H 6

static char folder[] = "staffage-photograph-XXXXXX";

/* Write an image into the folder; the name points into static storage. */
static const char *file(const char *name, const struct image *image)
{
    static char path[256];
    struct error err = ERROR_NONE;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (image && !image_write(path, image, &err)) error_print(&err, "photograph.test");
    return path;
}

/* The text of the error is that of the file in the folder. */
static bool says(const struct error *err, enum error_code code, const char *text)
{
    printf("# %s: %s\n", err->file, err->text);
    return err->code == code && !strncmp(err->file, folder, strlen(folder)) && !strcmp(err->text, text);
}

static void check_photograph(void)
{
    uint8_t rgba[W * H * 4];
    uint16_t deep[W * H * 3];
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 4; c++) {
            rgba[4 * i + c] = (uint8_t)(5 * i + c);
            if (c < 3) deep[3 * i + c] = (uint16_t)(257 * (5 * i + c) + 100);
        }
    struct image with_alpha = { W, H, 4, PIXEL_U8, rgba }, in_16_bits = { W, H, 3, PIXEL_U16, deep }, rgb;
    struct error err = ERROR_NONE;
    if (!OK(photograph_read(&rgb, file("rgba.png", &with_alpha), W, H, &err), "a photograph with alpha is read")) return;
    int wrong = 0;
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 3; c++) wrong += ((uint8_t *)rgb.data)[3 * i + c] != rgba[4 * i + c];
    OK(rgb.channels == 3 && wrong == 0, "its colours keep every bit");
    image_release(&rgb);

    if (!OK(photograph_read(&rgb, file("deep.png", &in_16_bits), W, H, &err), "one of 16 bits is read")) return;
    wrong = 0;
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 3; c++) wrong += ((uint8_t *)rgb.data)[3 * i + c] != rgba[4 * i + c];
    OK(wrong == 0, "and rounded to the nearest of 8 bits");
    image_release(&rgb);

    uint8_t checks[W * H];
    for (int i = 0; i < W * H; i++) checks[i] = (i % W + i / W) % 2 ? 255 : 0;
    struct image grey = { W, H, 1, PIXEL_U8, checks };
    const char *path = file("grey.png", &grey);
    if (!OK(photograph_read(&rgb, path, W / 2, H / 2, &err), "a grey one is scaled")) return;
    /* half white, half black is 0.5 in linear light, which is 187.5 in sRGB (a mean of the bytes would be 128) */
    NEAR(image_u8(&rgb, 1, 1)[0], 187.5, 0.5, "in linear light");
    OK(rgb.channels == 3 && rgb.width_px == W / 2 && rgb.height_px == H / 2, "to the size of the result");
    image_release(&rgb);

    OK(!photograph_read(&rgb, path, 4, 5, &err) &&
           says(&err, ERR_INPUT, "is 8 x 6 pixels: not in proportion to the scene's 4 x 5"),
       "another aspect ratio is refused");
}

int main(void)
{
    if (!mkdtemp(folder)) return 1;
    check_photograph();
    const char *const names[] = { "rgba.png", "deep.png", "grey.png" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) unlink(file(names[i], NULL));
    rmdir(folder);
    return tap_done();
}

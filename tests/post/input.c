#include "post/input.h"

#include "tests/tap.h"

#include <unistd.h>

#define W 8
#define H 6

static char folder[] = "staffage-input-XXXXXX";

/* Write an image into the folder; the name points into static storage. */
static const char *file(const char *name, const struct image *image)
{
    static char path[256];
    struct error err = ERROR_NONE;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (image && !image_write(path, image, &err)) error_print(&err, "input.test");
    return path;
}

/* The text of the error is that of the file in the folder. */
static bool says(const struct error *err, enum error_code code, const char *text)
{
    printf("# %s: %s\n", err->file, err->text);
    return err->code == code && !strncmp(err->file, folder, strlen(folder)) && !strcmp(err->text, text);
}

static void check_pass(void)
{
    float pixels[W * H * 4] = { 0 };
    pixels[0] = INFINITY;
    pixels[1] = -0.25f;
    pixels[3] = 1.001f;
    struct image image = { W, H, 4, PIXEL_F32, pixels }, colors = { W, H, 3, PIXEL_F32, pixels }, pass;
    struct error err = ERROR_NONE;
    const char *path = file("pass.exr", &image);
    if (!OK(input_pass(&pass, path, W, H, &err), "a pass is read")) return;
    const float *p = pass.data;
    OK(p[0] == 65504, "what overflowed is the largest half float");
    OK(p[1] == 0, "negative light is none");
    OK(p[3] == 1, "alpha ends at 1");
    image_release(&pass);

    OK(!input_pass(&pass, path, W + 1, H, &err) && says(&err, ERR_INPUT, "is 8 x 6 pixels: 9 x 6 would be right"),
       "another size is refused");
    err = ERROR_NONE;
    path = file("colors.exr", &colors);
    OK(!input_pass(&pass, path, W, H, &err) && says(&err, ERR_INPUT, "has 3 float channels: 4 float would be right"),
       "a pass without alpha is refused");
    err = ERROR_NONE;
    pixels[4 * (2 * W + 5) + 1] = NAN;
    path = file("nan.exr", &image);
    OK(!input_pass(&pass, path, W, H, &err) && says(&err, ERR_RENDER, "pixel 5,2 is not a number: render it again"),
       "a pixel that is not a number is refused");
    err = ERROR_NONE;
    OK(!input_pass(&pass, file("absent.exr", NULL), W, H, &err) && says(&err, ERR_INPUT, "does not exist"),
       "a pass that is missing is refused");
    err = ERROR_NONE;
    for (int i = 0; i < W * H * 4; i++) pixels[i] = (float)((unsigned)i * 2654435761u % 1000); /* nothing that packs well */
    path = file("cut.exr", &image);
    OK(truncate(path, 500) == 0 && !input_pass(&pass, path, W, H, &err) && err.code == ERR_INPUT && !strcmp(err.file, path),
       "a truncated pass is refused: %s", err.text);
}

int main(void)
{
    if (!mkdtemp(folder)) return 1;
    check_pass();
    const char *const names[] = { "pass.exr", "colors.exr", "nan.exr", "cut.exr" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) unlink(file(names[i], NULL));
    rmdir(folder);
    return tap_done();
}

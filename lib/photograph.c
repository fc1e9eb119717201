#include "lib/photograph.h"

#include <math.h>

bool photograph_in_proportion(const struct image *image, const char *path, int width_px, int height_px, struct error *err)
{
    double height = (double)image->height_px * width_px / image->width_px;
    return fabs(height - height_px) <= 1 ||
           error_at(err, ERR_INPUT, path, 0, 0, "is %d x %d pixels: not in proportion to the scene's %d x %d",
                    image->width_px, image->height_px, width_px, height_px);
}

bool photograph_is_of_integers(const struct image *image, const char *path, struct error *err)
{
    return image->type != PIXEL_F32 ||
           error_at(err, ERR_INPUT, path, 0, 0, "is a float image: a photograph has 8 or 16 bits a channel");
}

/* The colour channels alone. */
static bool keep_rgb(struct image *rgb, const struct image *in, struct error *err)
{
    if (!image_init(rgb, in->width_px, in->height_px, 3, PIXEL_U8, err)) return false;
    size_t n = (size_t)in->width_px * (size_t)in->height_px, stride = (size_t)in->channels;
    const uint8_t *from = in->data;
    uint8_t *to = rgb->data;
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < 3; c++) *to++ = from[i * stride + (stride >= 3 ? c : 0)];
    return true;
}

bool photograph_read(struct image *rgb, const char *path, int width_px, int height_px, struct error *err)
{
    struct image stored, linear = { 0 };
    if (!image_read(&stored, path, err)) return false;
    bool ok = false, scaled = stored.width_px != width_px || stored.height_px != height_px;
    if (scaled && !photograph_in_proportion(&stored, path, width_px, height_px, err)) goto out;
    if (!photograph_is_of_integers(&stored, path, err)) goto out;
    if (!scaled && stored.type == PIXEL_U8) {
        if (stored.channels == 3) {
            *rgb = stored;
            return true;
        }
        ok = keep_rgb(rgb, &stored, err);
        goto out;
    }
    if (!image_linear_from_srgb(&linear, &stored, err)) goto out;
    image_release(&stored);
    if (scaled) {
        struct image small;
        if (!image_resize(&small, &linear, width_px, height_px, err)) goto out;
        image_release(&linear);
        linear = small;
    }
    ok = image_srgb_from_linear(rgb, &linear, err);
out:
    image_release(&linear);
    image_release(&stored);
    return ok;
}

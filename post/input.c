#include "post/input.h"

#include "lib/photograph.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HALF_MAX 65504.0f

static const char *type_name(enum pixel_type type)
{
    return type == PIXEL_U8 ? "8-bit" : type == PIXEL_U16 ? "16-bit" : "float";
}

bool input_image(struct image *image, const char *path, int width_px, int height_px, int channels,
                 enum pixel_type type, struct error *err)
{
    struct image read;
    if (!image_read(&read, path, err)) return false;
    if (read.width_px != width_px || read.height_px != height_px)
        error_at(err, ERR_INPUT, path, 0, 0, "is %d x %d pixels: %d x %d would be right", read.width_px,
                 read.height_px, width_px, height_px);
    else if (read.channels != channels || read.type != type)
        error_at(err, ERR_INPUT, path, 0, 0, "has %d %s channels: %d %s would be right", read.channels,
                 type_name(read.type), channels, type_name(type));
    if (err->code != ERR_OK) {
        image_release(&read);
        return false;
    }
    *image = read;
    return true;
}

bool input_pass(struct image *pass, const char *path, int width_px, int height_px, struct error *err)
{
    struct image read;
    if (!input_image(&read, path, width_px, height_px, 4, PIXEL_F32, err)) return false;
    float *v = read.data;
    size_t n = (size_t)width_px * (size_t)height_px * 4;
    for (size_t i = 0; i < n; i++) {
        if (isnan(v[i])) {
            size_t at = i / 4;
            image_release(&read);
            return error_at(err, ERR_RENDER, path, 0, 0, "pixel %zu,%zu is not a number: render it again",
                            at % (size_t)width_px, at / (size_t)width_px);
        }
        float largest = i % 4 == 3 ? 1 : HALF_MAX;
        v[i] = v[i] < 0 ? 0 : v[i] > largest ? largest : v[i];
    }
    *pass = read;
    return true;
}

bool input_nearest(struct image *image, const char *path, int width_px, int height_px, struct error *err)
{
    struct image stored, scaled;
    if (!image_read(&stored, path, err)) return false;
    if (stored.width_px == width_px && stored.height_px == height_px) {
        *image = stored;
        return true;
    }
    bool ok = photograph_in_proportion(&stored, path, width_px, height_px, err) &&
              image_init(&scaled, width_px, height_px, stored.channels, stored.type, err);
    size_t pixel = image_pixel_size(&stored), sw = (size_t)stored.width_px, sh = (size_t)stored.height_px;
    size_t w = (size_t)width_px, h = (size_t)height_px;
    for (size_t y = 0; ok && y < h; y++)
        for (size_t x = 0; x < w; x++) {
            size_t from = (2 * y + 1) * sh / (2 * h) * sw + (2 * x + 1) * sw / (2 * w);
            memcpy((char *)scaled.data + (y * w + x) * pixel, (const char *)stored.data + from * pixel, pixel);
        }
    image_release(&stored);
    if (ok) *image = scaled;
    return ok;
}

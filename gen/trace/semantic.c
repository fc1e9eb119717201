#include "gen/trace/semantic.h"

#include <stdlib.h>
#include <string.h>

/* The label of a pixel; NULL: none of the palette. */
static const struct palette_label *find(const struct palette_label *labels, size_t n, const uint8_t *pixel, int channels)
{
    for (size_t i = 0; i < n; i++)
        if (channels == 1 ? labels[i].id == *pixel : !memcmp(labels[i].color, pixel, 3)) return &labels[i];
    return NULL;
}

static bool fail(const uint8_t *pixel, int channels, int x, int y, const char *path, enum palette palette, struct error *err)
{
    if (channels == 1)
        return error_at(err, ERR_INPUT, path, 0, 0, "pixel (%d, %d) has id %d, which the palette \"%s\" has not", x, y, *pixel, palette_name((int)palette));
    return error_at(err, ERR_INPUT, path, 0, 0, "pixel (%d, %d) has colour #%02x%02x%02x, which the palette \"%s\" has not: labels.palette names the right one",
                    x, y, pixel[0], pixel[1], pixel[2], palette_name((int)palette));
}

bool semantic_read(struct image *ids, const char *path, enum palette palette, struct error *err)
{
    struct image image, out;
    size_t n;
    const struct palette_label *labels = palette_labels(palette, &n), *last = NULL;
    if (!image_read(&image, path, err)) return false;
    bool ok = image.type == PIXEL_U8 || error_at(err, ERR_INPUT, path, 0, 0, "a semantic image must have 8 bits a channel");
    if (!ok || !image_init(&out, image.width_px, image.height_px, 1, PIXEL_U8, err)) {
        image_release(&image);
        return false;
    }
    const uint8_t *before = NULL;
    for (int y = 0; ok && y < image.height_px; y++)
        for (int x = 0; ok && x < image.width_px; x++) {
            const uint8_t *pixel = image_u8(&image, x, y);
            if (image.channels == 1 && *pixel == SEMANTIC_VOID) {
                *image_u8(&out, x, y) = SEMANTIC_VOID;
                continue;
            }
            if (!last || memcmp(before, pixel, image_pixel_size(&image)) != 0) last = find(labels, n, pixel, image.channels);
            before = pixel;
            if (last) *image_u8(&out, x, y) = last->id;
            else ok = fail(pixel, image.channels, x, y, path, palette, err);
        }
    image_release(&image);
    if (ok) *ids = out;
    else image_release(&out);
    return ok;
}

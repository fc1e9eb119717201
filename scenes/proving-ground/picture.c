#include "picture.h"

enum { GAP_PX = 4, CONTRAST = 4 };

bool picture_beside(struct image *picture, const struct image *result, const struct image *truth, struct rect part, struct error *err)
{
    if (result->width_px != truth->width_px || result->height_px != truth->height_px || result->channels != 3 || truth->channels != 3)
        return error_set(err, ERR_INPUT, "result and truth are of two sizes");
    if (part.x0 < 0 || part.y0 < 0 || part.x1 > truth->width_px || part.y1 > truth->height_px || part.x0 >= part.x1 || part.y0 >= part.y1)
        return error_set(err, ERR_INPUT, "%d,%d to %d,%d is no part of a picture of %d x %d pixels", part.x0, part.y0, part.x1, part.y1,
                         truth->width_px, truth->height_px);
    int width = part.x1 - part.x0, height = part.y1 - part.y0;
    if (!image_init(picture, 3 * width + 2 * GAP_PX, height, 3, PIXEL_U8, err)) return false;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < 3; c++) {
                int ours = image_u8(result, part.x0 + x, part.y0 + y)[c], other = image_u8(truth, part.x0 + x, part.y0 + y)[c];
                int off = 128 + CONTRAST * (ours - other);
                image_u8(picture, x, y)[c] = (uint8_t)ours;
                image_u8(picture, width + GAP_PX + x, y)[c] = (uint8_t)other;
                image_u8(picture, 2 * (width + GAP_PX) + x, y)[c] = (uint8_t)(off < 0 ? 0 : off > 255 ? 255 : off);
            }
    return true;
}

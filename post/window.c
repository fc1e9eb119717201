#include "post/window.h"

#include <assert.h>
#include <string.h>

bool window_inside(struct rect w, int width_px, int height_px)
{
    return w.x0 >= 0 && w.y0 >= 0 && w.x0 < w.x1 && w.y0 < w.y1 && w.x1 <= width_px && w.y1 <= height_px;
}

bool window_cut(struct image *out, const struct image *in, struct rect w, struct error *err)
{
    assert(window_inside(w, in->width_px, in->height_px));
    struct image cut;
    if (!image_init(&cut, w.x1 - w.x0, w.y1 - w.y0, in->channels, in->type, err)) return false;
    size_t pixel = image_pixel_size(in), row = (size_t)cut.width_px * pixel;
    for (int y = 0; y < cut.height_px; y++) {
        size_t from = ((size_t)(w.y0 + y) * (size_t)in->width_px + (size_t)w.x0) * pixel;
        memcpy((char *)cut.data + (size_t)y * row, (const char *)in->data + from, row);
    }
    *out = cut;
    return true;
}

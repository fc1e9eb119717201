#include "post/transfer.h"

bool transfer_alpha(struct image *out, const struct transfer_input *in, struct error *err)
{
    if (!image_init(out, in->photograph->width_px, in->photograph->height_px, 3, PIXEL_F32, err)) return false;
    const float *b = in->photograph->data;
    float *to = out->data, caught[4];
    size_t n = (size_t)out->width_px * (size_t)out->height_px;
    for (size_t i = 0; i < n; i++, b += 3, to += 3) {
        transfer_caught(caught, in, i);
        for (int c = 0; c < 3; c++) to[c] = b[c] * (1 - caught[3]) + caught[c];
    }
    return true;
}

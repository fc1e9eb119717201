#include "post/transfer.h"

bool transfer_layers(struct image *out, const struct transfer_input *in, struct error *err)
{
    if (!image_init(out, in->photograph->width_px, in->photograph->height_px, 3, PIXEL_F32, err)) return false;
    const float *b = in->photograph->data, *o = in->object->data, *p = in->plane->data, *s = in->shadow->data;
    float *to = out->data;
    size_t n = (size_t)out->width_px * (size_t)out->height_px;
    for (size_t i = 0; i < n; i++, b += 3, o += 4, p += 4, s += 4, to += 3) {
        float v = transfer_share(in->visible, i), g = transfer_share(in->receiver, i);
        for (int c = 0; c < 3; c++) {
            float shade = 1 + g * (transfer_ground(p, s, c) - 1);
            to[c] = b[c] * shade * (1 - o[3] * v) + (float)in->exposure[c] * o[c] * v;
        }
    }
    return true;
}

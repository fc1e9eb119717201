#include "post/depth.h"

bool depth_millimetres(struct image *out, const struct image *depth_m, struct error *err)
{
    if (!image_init(out, depth_m->width_px, depth_m->height_px, 1, PIXEL_U16, err)) return false;
    const float *from = depth_m->data;
    uint16_t *to = out->data;
    size_t n = (size_t)out->width_px * (size_t)out->height_px;
    for (size_t i = 0; i < n; i++) {
        double mm = (double)from[i] * 1000 + 0.5;
        to[i] = mm > 0 && mm < 65536 ? (uint16_t)mm : 0; /* a NaN is neither */
    }
    return true;
}

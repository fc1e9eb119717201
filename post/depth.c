#include "post/depth.h"

#include <math.h>
#include <string.h>

static uint16_t millimetres_of(float metres)
{
    double mm = (double)metres * 1000 + 0.5;
    return mm > 0 && mm < 65536 ? (uint16_t)mm : 0; /* a NaN is neither */
}

bool depth_overwrite(struct image *metres, struct image *millimetres, const struct image *before,
                     const struct image *entity, struct error *err)
{
    struct image m, mm;
    if (!image_init(&m, entity->width_px, entity->height_px, 1, PIXEL_F32, err)) return false;
    if (!image_init(&mm, entity->width_px, entity->height_px, 1, PIXEL_U16, err)) {
        image_release(&m);
        return false;
    }
    const float *e = entity->data;
    float *to_m = m.data;
    uint16_t *to_mm = mm.data;
    size_t n = (size_t)m.width_px * (size_t)m.height_px;
    for (size_t i = 0; i < n; i++) {
        if (!isnan(e[i]) || !before->data) {
            to_m[i] = e[i];
            to_mm[i] = millimetres_of(e[i]);
        } else if (before->type == PIXEL_U16) {
            to_mm[i] = ((const uint16_t *)before->data)[i];
            to_m[i] = to_mm[i] ? (float)to_mm[i] / 1000 : NAN;
        } else {
            memcpy(&to_m[i], (const float *)before->data + i, sizeof *to_m); /* whatever kind of NaN it is */
            to_mm[i] = millimetres_of(to_m[i]);
        }
    }
    *metres = m;
    *millimetres = mm;
    return true;
}

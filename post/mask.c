#include "post/mask.h"

#include "post/morphology.h"
#include "post/window.h"

bool mask_dilate(struct image *ids, const struct image *object, const struct image *visible,
                 struct rect w, struct error *err)
{
    struct image cut = { 0 }, wide = { 0 };
    bool ok = window_cut(&cut, ids, w, err) && morphology_dilate(&wide, &cut, err);
    for (int y = 0; ok && y < cut.height_px; y++)
        for (int x = 0; x < cut.width_px; x++) {
            bool seen = image_f32(object, x, y)[3] > 0 && (!visible || *image_u8(visible, x, y) > 0);
            uint16_t own = *image_u16(&cut, x, y);
            *image_u16(ids, w.x0 + x, w.y0 + y) = (uint16_t)(!seen ? 0 : own ? own : *image_u16(&wide, x, y));
        }
    image_release(&cut);
    image_release(&wide);
    return ok;
}

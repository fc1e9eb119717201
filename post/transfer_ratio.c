#include "post/morphology.h"
#include "post/transfer.h"

/* Pixels that a layer has anything in, without those at their boundary: 0 or 1. */
static bool eroded_mask(struct image *mask, const struct image *layer, struct error *err)
{
    struct image whole;
    if (!image_init(&whole, layer->width_px, layer->height_px, 1, PIXEL_F32, err)) return false;
    size_t n = (size_t)whole.width_px * (size_t)whole.height_px;
    const float *from = layer->data;
    float *to = whole.data;
    for (size_t i = 0; i < n; i++) to[i] = from[4 * i + 3] > 0;
    bool ok = morphology_erode(mask, &whole, err);
    image_release(&whole);
    return ok;
}

/* Along the contour of a mask, where it differs within 3 by 3 pixels, the mean of the mask and its blur. */
static bool soften_contour(struct image *mask, struct error *err)
{
    struct image outer = { 0 }, inner = { 0 }, blurred = { 0 };
    bool ok = morphology_dilate(&outer, mask, err) && morphology_erode(&inner, mask, err) &&
              morphology_blur(&blurred, mask, err);
    if (ok) {
        size_t n = (size_t)mask->width_px * (size_t)mask->height_px;
        const float *most = outer.data, *least = inner.data, *soft = blurred.data;
        float *m = mask->data;
        for (size_t i = 0; i < n; i++)
            if (most[i] > least[i]) m[i] = (m[i] + soft[i]) / 2;
    }
    image_release(&outer);
    image_release(&inner);
    image_release(&blurred);
    return ok;
}

bool transfer_ratio(struct image *out, const struct transfer_input *in, struct error *err)
{
    struct image objects = { 0 }, ground = { 0 };
    bool ok = eroded_mask(&objects, in->object, err) && soften_contour(&objects, err) &&
              eroded_mask(&ground, in->plane, err) &&
              image_init(out, in->photograph->width_px, in->photograph->height_px, 3, PIXEL_F32, err);
    if (ok) {
        const float *b = in->photograph->data, *o = in->object->data, *p = in->plane->data, *s = in->shadow->data;
        const float *m_obj = objects.data, *m_pl = ground.data;
        float *to = out->data;
        size_t n = (size_t)out->width_px * (size_t)out->height_px;
        for (size_t i = 0; i < n; i++, b += 3, o += 4, p += 4, s += 4, to += 3) {
            float object = m_obj[i] * transfer_share(in->visible, i);
            float plane = m_pl[i] * transfer_share(in->receiver, i) * (1 - object);
            for (int c = 0; c < 3; c++) {
                float k = (float)in->exposure[c], all = o[c] + s[c] * (1 - o[3]);
                to[c] = b[c] + object * (k * all - b[c]) + plane * b[c] * (transfer_ratio_of(all, p[c]) - 1);
                if (!(m_pl[i] > 0)) to[c] += (1 - m_obj[i]) * transfer_share(in->visible, i) * (k * o[c] - o[3] * b[c]);
            }
        }
    }
    image_release(&objects);
    image_release(&ground);
    return ok;
}

#include "lib/class.h"
#include "post/transfer.h"

/* Does the class threshold say that this pixel is overwritten? */
static bool overwrites(float alpha, uint8_t class_, const struct transfer_thresholds *t)
{
    if (class_ == 0 || !(alpha > 0)) return false;
    bool person = class_info((enum entity_class)(class_ - 1))->is_person;
    bool below = (double)alpha * 255 < (person ? t->t3 : t->t2);
    return below == t->overwrite_below;
}

bool transfer_threshold(struct image *out, const struct transfer_input *in, const struct image *classes,
                        const struct transfer_thresholds *t, struct error *err)
{
    if (!image_init(out, in->photograph->width_px, in->photograph->height_px, 3, PIXEL_F32, err)) return false;
    const float *b = in->photograph->data;
    const uint8_t *class_ = classes->data;
    float *to = out->data, caught[4];
    size_t n = (size_t)out->width_px * (size_t)out->height_px;
    for (size_t i = 0; i < n; i++, b += 3, to += 3) {
        transfer_caught(caught, in, i);
        bool overwrite = overwrites(caught[3], class_[i], t), blend = (double)caught[3] * 255 > t->t1;
        for (int c = 0; c < 3; c++)
            to[c] = overwrite ? caught[c] / caught[3] : blend ? b[c] * (1 - caught[3]) + caught[c] : b[c];
    }
    return true;
}

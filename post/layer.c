#include "post/layer.h"

#include "post/spread.h"

#include <string.h>

bool layer_copy(struct image *out, const struct image *in, struct error *err)
{
    if (!image_init(out, in->width_px, in->height_px, in->channels, in->type, err)) return false;
    memcpy(out->data, in->data, image_size(in));
    return true;
}

bool layer_reach(struct image *near, const struct image *layer, double reach_px, struct error *err)
{
    if (!image_init(near, layer->width_px, layer->height_px, 1, PIXEL_U8, err)) return false;
    size_t n = (size_t)layer->width_px * (size_t)layer->height_px, channels = (size_t)layer->channels;
    const float *from = layer->data;
    uint8_t *to = near->data;
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < channels; c++)
            if (from[i * channels + c] != 0) to[i] = 1;
    if (spread_mask(near, reach_px, err)) return true;
    image_release(near);
    return false;
}

void layer_replace(struct image *layer, struct image *made, bool good)
{
    if (!good) {
        image_release(made);
        return;
    }
    image_release(layer);
    *layer = *made;
    *made = (struct image){ 0 };
}

#include "post/transfer.h"

void transfer_caught(float rgba[4], const struct transfer_input *in, size_t i)
{
    const float *o = (const float *)in->object->data + 4 * i;
    const float *p = (const float *)in->plane->data + 4 * i, *s = (const float *)in->shadow->data + 4 * i;
    float v = transfer_share(in->visible, i), g = transfer_share(in->receiver, i), a = o[3] * v;
    /* a catcher is grey and only ever darkens */
    float light = 0.2126f * transfer_ground(p, s, 0) + 0.7152f * transfer_ground(p, s, 1) + 0.0722f * transfer_ground(p, s, 2);
    float shadow = light < 1 ? g * (1 - light) : 0;
    for (int c = 0; c < 3; c++) rgba[c] = (float)in->exposure[c] * o[c] * v;
    rgba[3] = a + (1 - a) * shadow;
}

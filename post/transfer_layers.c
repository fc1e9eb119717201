#include "post/transfer.h"

#include <math.h>

enum { REACH_PX = 4, WHOLE = 250, NONE = 12 }; /* WHOLE, NONE: of 255 */
#define LIMB 2.0f /* what is round turns away from the light at its edge, or to it: so many times less or more */

/* What is seen behind the soft edge of something that hides it, of the light of a pixel that shows both: what is behind is
 * as beside it, what hides is about as it is farther in. Where either is farther off, or nowhere, the pixel's own light.
 * In/out: rgb  the pixel's light */
static void behind(float rgb[3], const struct transfer_input *in, int x, int y, float seen)
{
    float sum[3] = { 0, 0, 0 }, low[3] = { 1e9f, 1e9f, 1e9f }, high[3] = { 0, 0, 0 }, beside = 0, within = 0;
    for (int v = y - REACH_PX; v <= y + REACH_PX; v++)
        for (int u = x - REACH_PX; u <= x + REACH_PX; u++) {
            if (u < 0 || v < 0 || u >= in->photograph->width_px || v >= in->photograph->height_px) continue;
            const float *b = image_f32(in->photograph, u, v);
            uint8_t share = *image_u8(in->visible, u, v);
            int far_px2 = (u - x) * (u - x) + (v - y) * (v - y);
            float weight = share >= WHOLE ? 1 / (float)(far_px2 * far_px2) : 0; /* the pixel itself is not whole */
            beside += weight;
            within += share <= NONE;
            for (int c = 0; c < 3; c++) {
                sum[c] += weight * b[c];
                if (share > NONE) continue;
                if (b[c] < low[c]) low[c] = b[c];
                if (b[c] > high[c]) high[c] = b[c];
            }
        }
    if (!(beside > 0) || !(within > 0)) return;
    for (int c = 0; c < 3; c++) {
        float hider = (rgb[c] - seen * sum[c] / beside) / (1 - seen);
        hider = fminf(fmaxf(hider, low[c] / LIMB), high[c] * LIMB);
        rgb[c] = (rgb[c] - (1 - seen) * hider) / seen;
    }
}

bool transfer_layers(struct image *out, const struct transfer_input *in, struct error *err)
{
    if (!image_init(out, in->photograph->width_px, in->photograph->height_px, 3, PIXEL_F32, err)) return false;
    const float *b = in->photograph->data, *o = in->object->data, *p = in->plane->data, *s = in->shadow->data;
    float *to = out->data;
    size_t width = (size_t)out->width_px, n = width * (size_t)out->height_px;
    for (size_t i = 0; i < n; i++, b += 3, o += 4, p += 4, s += 4, to += 3) {
        float v = transfer_share(in->visible, i), g = transfer_share(in->receiver, i), back[3] = { b[0], b[1], b[2] };
        if (o[3] * v > 0 && v * 255 < WHOLE) behind(back, in, (int)(i % width), (int)(i / width), v);
        for (int c = 0; c < 3; c++) {
            float shade = transfer_ground(p, s, c) - 1, bare = g - o[3] * (g < v ? g : v); /* of the ground, and how much of it is left */
            float light = b[c] + back[c] * shade * bare + v * ((float)in->exposure[c] * o[c] - o[3] * back[c]);
            to[c] = light > 0 ? light : 0;
        }
    }
    return true;
}

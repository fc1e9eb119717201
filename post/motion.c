#include "post/motion.h"

#include "post/kernel.h"
#include "post/layer.h"
#include "post/spread.h"

#include <math.h>

/* Hold the ways to MOTION_MAX_PX: beside a camera that passes close by, they have no end. */
static void hold(struct image *motion)
{
    size_t n = (size_t)motion->width_px * (size_t)motion->height_px;
    float *m = motion->data;
    for (size_t i = 0; i < n; i++, m += 3) {
        double length = hypot((double)m[0], (double)m[1]);
        if (length <= MOTION_MAX_PX) continue;
        for (int c = 0; c < 2; c++) m[c] = isfinite(length) ? (float)((double)m[c] * MOTION_MAX_PX / length) : 0;
    }
}

/* Blur one layer by the motion of each pixel. */
static bool blur(struct image *layer, const struct image *motion, const struct image *share, struct error *err)
{
    double longest = 0;
    size_t n = (size_t)motion->width_px * (size_t)motion->height_px;
    const float *m = motion->data;
    for (size_t i = 0; i < n; i++)
        if (!isnan(m[3 * i])) longest = fmax(longest, hypot((double)m[3 * i], (double)m[3 * i + 1]));
    struct image near = { 0 }, out = { 0 };
    bool ok = longest > 0 && layer_reach(&near, layer, longest / 2 + 1, err) && layer_copy(&out, layer, err);
    for (int y = 0; ok && y < layer->height_px; y++)
        for (int x = 0; ok && x < layer->width_px; x++) {
            const float *way = image_f32(motion, x, y);
            if (!*image_u8(&near, x, y) || isnan(way[0]) || (way[0] == 0 && way[1] == 0)) continue;
            struct kernel line;
            ok = kernel_line(&line, (double)way[0], (double)way[1], err);
            if (!ok) break;
            kernel_mean(image_f32(&out, x, y), &line, layer, share, x, y);
            kernel_release(&line);
        }
    layer_replace(layer, &out, ok);
    image_release(&near);
    return ok || err->code == ERR_OK;
}

/* The motion where a thing is known to be, and the nearest known one elsewhere. */
static bool motion_of(struct image *out, const struct image *motion, const struct image *layer, int channel, bool is_known(float),
                      struct error *err)
{
    if (!layer_copy(out, motion, err)) return false;
    hold(out);
    size_t n = (size_t)motion->width_px * (size_t)motion->height_px, channels = (size_t)layer->channels;
    const float *from = (const float *)layer->data + channel;
    for (size_t i = 0; i < n; i++)
        if (!is_known(from[i * channels])) ((float *)out->data)[3 * i] = NAN;
    return spread_known(out, err);
}

static bool is_number(float v) { return !isnan(v); }
static bool is_more_than_0(float v) { return v > 0; }

bool motion_blur(struct image *object, struct image *light, const struct image *motion, const struct image *depth,
                 const struct image *plane, const struct image *visible, const struct image *receiver, struct error *err)
{
    struct image of_entities = { 0 }, of_ground = { 0 };
    bool ok = motion_of(&of_entities, motion, depth, 0, is_number, err) &&
              motion_of(&of_ground, motion, plane, 3, is_more_than_0, err) &&
              blur(object, &of_entities, visible, err) && blur(light, &of_ground, receiver, err);
    image_release(&of_entities);
    image_release(&of_ground);
    return ok;
}

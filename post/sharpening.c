#include "post/sharpening.h"

#include "post/morphology.h"
#include "post/step.h"

#include <string.h>

#define TAKEN_BACK 0.002f /* of the sharpening may be left */

static float brightness(const float *px)
{
    return 0.2126f * px[0] + 0.7152f * px[1] + 0.0722f * px[2];
}

bool sharpening_add(struct image *levels, const struct image *before, const struct image *cover, double amount, struct error *err)
{
    struct image own = { 0 }, blurred = { 0 };
    size_t n = (size_t)levels->width_px * (size_t)levels->height_px;
    if (!image_init(&own, levels->width_px, levels->height_px, 3, PIXEL_F32, err)) return false;
    float *px = own.data, *to = levels->data;
    /* With how much of the picture there is round a pixel, for its border. */
    for (size_t i = 0; i < n; i++, px += 3) {
        px[0] = brightness(to + 3 * i);
        px[1] = brightness((const float *)before->data + 3 * i);
        px[2] = 1;
    }
    bool ok = morphology_gaussian(&blurred, &own, STEP_SHARPENING_PX, err);
    px = own.data;
    for (size_t i = 0; ok && i < n; i++, px += 3) {
        const float *mean = (const float *)blurred.data + 3 * i;
        float hidden = ((const float *)cover->data)[i];
        float through = hidden > 0 ? 1 - hidden : px[1] > 0 ? px[0] / px[1] : 1; /* a shadow dims what it shows */
        float more = (float)amount * (px[0] - mean[0] / mean[2] - through * (px[1] - mean[1] / mean[2]));
        for (size_t c = 0; c < 3; c++) to[3 * i + c] += more;
    }
    image_release(&own);
    image_release(&blurred);
    return ok;
}

/* Sharpened = own + amount * (own - blurred own): so own is (sharpened + amount * blurred own) / (1 + amount), again and again.
 * What is wrong shrinks by amount / (1 + amount) each time. */
bool sharpening_take_back(struct image *levels, double amount, struct error *err)
{
    struct image own;
    if (!image_init(&own, levels->width_px, levels->height_px, 1, PIXEL_F32, err)) return false;
    memcpy(own.data, levels->data, image_size(levels));
    size_t n = (size_t)levels->width_px * (size_t)levels->height_px;
    const float k = (float)amount;
    bool ok = true;
    for (float left = k; ok && left > TAKEN_BACK; left *= k / (1 + k)) {
        struct image blurred;
        ok = morphology_gaussian(&blurred, &own, STEP_SHARPENING_PX, err);
        for (size_t i = 0; ok && i < n; i++)
            ((float *)own.data)[i] = (((const float *)levels->data)[i] + k * ((const float *)blurred.data)[i]) / (1 + k);
        if (ok) image_release(&blurred);
    }
    image_release(levels);
    *levels = own;
    return ok;
}

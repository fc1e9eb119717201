#include "post/softness.h"

#include "post/layer.h"
#include "post/morphology.h"

#include <math.h>

/* Variance of a Gaussian that is sampled at whole pixels. */
static double sampled_variance(double sigma_px)
{
    double sum = 1, moment = 0;
    for (int k = 1; k <= 3; k++) {
        double w = 2 * exp(-k * k / (2 * sigma_px * sigma_px));
        sum += w;
        moment += w * k * k;
    }
    return moment / sum;
}

/* A narrow Gaussian falls between the pixels: the one whose samples blur as much. */
static double for_pixels(double sigma_px)
{
    double low = 0.1, high = 1;
    if (sigma_px >= 0.8) return sigma_px;
    for (int i = 0; i < 30; i++) {
        double middle = (low + high) / 2;
        if (sampled_variance(middle) < sigma_px * sigma_px) low = middle;
        else high = middle;
    }
    return high;
}

/* Weigh a layer by what can be seen of it, blur both, and divide: as kernel_mean does. */
static bool blur_seen(struct image *out, const struct image *layer, const struct image *share, double sigma_px, struct error *err)
{
    struct image weighed = { 0 }, hidden = { 0 }, covered = { 0 };
    bool ok = layer_copy(&weighed, layer, err) && image_init(&hidden, layer->width_px, layer->height_px, 1, PIXEL_F32, err);
    size_t n = (size_t)layer->width_px * (size_t)layer->height_px, channels = (size_t)layer->channels;
    const uint8_t *part = share->data;
    for (size_t i = 0; ok && i < n; i++) {
        float seen = (float)part[i] / 255;
        ((float *)hidden.data)[i] = 1 - seen;
        for (size_t c = 0; c < channels; c++) ((float *)weighed.data)[i * channels + c] *= seen;
    }
    ok = ok && morphology_gaussian(&covered, &hidden, sigma_px, err) && morphology_gaussian(out, &weighed, sigma_px, err);
    for (size_t i = 0; ok && i < n; i++) {
        float seen = 1 - ((float *)covered.data)[i];
        for (size_t c = 0; c < channels; c++) {
            float *v = (float *)out->data + i * channels + c;
            *v = seen > 1e-4f ? *v / seen : 0;
        }
    }
    image_release(&weighed);
    image_release(&hidden);
    image_release(&covered);
    return ok;
}

static bool blur(struct image *layer, const struct image *share, double sigma_px, struct error *err)
{
    struct image out = { 0 };
    bool ok = share ? blur_seen(&out, layer, share, sigma_px, err) : morphology_gaussian(&out, layer, sigma_px, err);
    layer_replace(layer, &out, ok);
    return ok;
}

bool softness_blur(struct image *object, struct image *light, const struct image *visible, const struct image *receiver,
                   double sigma_px, struct error *err)
{
    double sampled_px = for_pixels(sigma_px);
    return blur(object, visible, sampled_px, err) && blur(light, receiver, sampled_px, err);
}

bool softness_share(struct image *share, double sigma_px, struct error *err)
{
    struct image hidden = { 0 }, covered = { 0 };
    size_t n = (size_t)share->width_px * (size_t)share->height_px;
    uint8_t *part = share->data;
    bool ok = image_init(&hidden, share->width_px, share->height_px, 1, PIXEL_F32, err);
    for (size_t i = 0; ok && i < n; i++) ((float *)hidden.data)[i] = 255 - (float)part[i];
    ok = ok && morphology_gaussian(&covered, &hidden, for_pixels(sigma_px), err);
    for (size_t i = 0; ok && i < n; i++) part[i] = (uint8_t)lroundf(255 - ((float *)covered.data)[i]);
    image_release(&hidden);
    image_release(&covered);
    return ok;
}

/* Along rows, or along columns: three weights that blur by less than nothing. */
static bool narrow(struct image *layer, int dx, int dy, double variance_px2, struct error *err)
{
    struct image out;
    float beside = (float)(variance_px2 / 2);
    int w = layer->width_px, h = layer->height_px;
    if (!layer_copy(&out, layer, err)) return false;
    for (int y = dy; y < h - dy; y++)
        for (int x = dx; x < w - dx; x++) {
            const float *here = image_f32(layer, x, y), *before = image_f32(layer, x - dx, y - dy), *after = image_f32(layer, x + dx, y + dy);
            float *to = image_f32(&out, x, y);
            for (int c = 0; c < layer->channels; c++) to[c] = here[c] + beside * (2 * here[c] - before[c] - after[c]);
        }
    layer_replace(layer, &out, true);
    return true;
}

bool softness_take_back(struct image *object, struct image *light, double variance_px2, struct error *err)
{
    double v = fmin(variance_px2, SOFTNESS_TAKEN_BACK_MAX_PX2);
    if (!narrow(object, 1, 0, v, err) || !narrow(object, 0, 1, v, err) || !narrow(light, 1, 0, v, err) || !narrow(light, 0, 1, v, err))
        return false;
    size_t n = (size_t)object->width_px * (size_t)object->height_px;
    float *px = object->data;
    for (size_t i = 0; i < n; i++, px += 4) {
        float cover = px[3] > 0 ? px[3] < 1 ? px[3] : 1 : 0, scale = px[3] > 0 ? cover / px[3] : 0;
        for (int c = 0; c < 3; c++) px[c] = px[c] > 0 ? px[c] * scale : 0;
        px[3] = cover;
    }
    return true;
}

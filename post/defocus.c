#include "post/defocus.h"

#include "post/kernel.h"
#include "post/layer.h"
#include "post/spread.h"

#include <math.h>

/* Discs are made in steps of this, each when it is first wanted. */
#define STEPS_PER_PX 8

double defocus_diameter_px(double at_infinity_px, double focus_m, double z_m)
{
    if (!(z_m > 0)) return 0;
    return fmin(at_infinity_px * fabs(1 - focus_m / z_m), DEFOCUS_MAX_PX);
}

struct lens {
    double at_infinity_px, focus_m;
    struct kernel discs[(int)DEFOCUS_MAX_PX * STEPS_PER_PX + 1];
};

static const struct kernel *disc_of(struct lens *lens, double diameter_px, struct error *err)
{
    struct kernel *disc = &lens->discs[(int)lround(diameter_px * STEPS_PER_PX)];
    if (!disc->taps && !kernel_disc(disc, round(diameter_px * STEPS_PER_PX) / STEPS_PER_PX, err)) return NULL;
    return disc;
}

static bool blur(struct image *layer, struct lens *lens, const struct image *depth, const struct image *share, struct error *err)
{
    double widest = 0;
    size_t n = (size_t)depth->width_px * (size_t)depth->height_px;
    const float *z = depth->data;
    for (size_t i = 0; i < n; i++)
        widest = fmax(widest, defocus_diameter_px(lens->at_infinity_px, lens->focus_m, (double)z[i]));
    struct image near = { 0 }, out = { 0 };
    bool ok = layer_reach(&near, layer, widest / 2 + 1, err) && layer_copy(&out, layer, err);
    for (int y = 0; ok && y < layer->height_px; y++)
        for (int x = 0; ok && x < layer->width_px; x++) {
            if (!*image_u8(&near, x, y)) continue;
            double d = defocus_diameter_px(lens->at_infinity_px, lens->focus_m, (double)*image_f32(depth, x, y));
            if (d <= 1) continue;
            const struct kernel *disc = disc_of(lens, d, err);
            ok = disc != NULL;
            if (ok) kernel_mean(image_f32(&out, x, y), disc, layer, share, x, y);
        }
    layer_replace(layer, &out, ok);
    image_release(&near);
    return ok;
}

bool defocus_blur(struct image *object, struct image *light, const struct image *depth, const struct image *ground,
                  const struct image *visible, const struct image *receiver, double at_infinity_px, double focus_m,
                  struct error *err)
{
    struct lens lens = { .at_infinity_px = at_infinity_px, .focus_m = focus_m };
    struct image of_entities = { 0 }, of_ground = { 0 };
    bool ok = layer_copy(&of_entities, depth, err) && spread_known(&of_entities, err) &&
              layer_copy(&of_ground, ground->data ? ground : depth, err) && spread_known(&of_ground, err) &&
              blur(object, &lens, &of_entities, visible, err) && blur(light, &lens, &of_ground, receiver, err);
    for (size_t i = 0; i < sizeof lens.discs / sizeof *lens.discs; i++) kernel_release(&lens.discs[i]);
    image_release(&of_entities);
    image_release(&of_ground);
    return ok;
}

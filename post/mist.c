#include "post/mist.h"

#include "lib/air.h"
#include "post/layer.h"
#include "post/spread.h"

#include <math.h>

/* Premultiplied colour behind air that lets t through; the haze in units of the layer. */
static void fade(float *rgba, const struct mist *mist, double t)
{
    for (int c = 0; c < 3; c++)
        rgba[c] = (float)((double)rgba[c] * t + mist->haze[c] / mist->exposure[c] * (1 - t) * (double)rgba[3]);
}

/* Length of the ray through a pixel's middle where it has gone 1 m forwards; NaN without a ray. */
static double metres_per_depth(const struct camera *camera, int x, int y)
{
    struct vec3 direction;
    struct error none = ERROR_NONE;
    if (!camera_unproject(camera, &direction, (struct vec2){ x + 0.5, y + 0.5 }, &none)) return NAN;
    return 1 / direction.z;
}

bool mist_fade(struct image *object, struct image *plane, struct image *light, const struct mist *mist,
               const struct image *photograph, const struct image *entity, const struct image *ground,
               const struct camera *camera, struct rect w, struct error *err)
{
    struct image entity_z = { 0 }, ground_z = { 0 };
    bool ok = layer_copy(&entity_z, entity, err) && spread_known(&entity_z, err) && layer_copy(&ground_z, ground, err) &&
              spread_known(&ground_z, err);
    for (int y = 0; ok && y < object->height_px; y++)
        for (int x = 0; x < object->width_px; x++) {
            float *o = image_f32(object, x, y), *l = image_f32(light, x, y);
            if (!(o[3] > 0) && l[0] == 0 && l[1] == 0 && l[2] == 0) continue;
            double stretch = metres_per_depth(camera, w.x0 + x, w.y0 + y);
            fade(o, mist, air_transmission(mist->visibility_m, stretch * (double)*image_f32(&entity_z, x, y)));
            double t = air_transmission(mist->visibility_m, stretch * (double)*image_f32(&ground_z, x, y));
            fade(image_f32(plane, x, y), mist, t);
            const float *b = image_f32(photograph, x, y);
            for (int c = 0; c < 3; c++) {
                double air = mist->haze[c] * (1 - t);
                l[c] *= air < (double)b[c] ? (float)(1 - air / (double)b[c]) : 0;
            }
        }
    image_release(&entity_z);
    image_release(&ground_z);
    return ok;
}

void mist_veil(struct image *rgb, const struct image *ground, double visibility_m, const double haze[3],
               const struct camera *camera)
{
    for (int y = 0; y < rgb->height_px; y++)
        for (int x = 0; x < rgb->width_px; x++) {
            double distance = metres_per_depth(camera, x, y) * (double)*image_f32(ground, x, y);
            double t = isfinite(distance) ? air_transmission(visibility_m, distance) : 0;
            uint8_t *px = image_u8(rgb, x, y);
            for (int c = 0; c < 3; c++) {
                double own = (double)linear_from_srgb((float)px[c] / 255);
                px[c] = (uint8_t)(srgb_from_linear((float)(own * t + haze[c] * (1 - t))) * 255 + 0.5f);
            }
        }
}

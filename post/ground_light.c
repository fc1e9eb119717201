#include "post/ground_light.h"

#include "post/transfer.h"

#include <string.h>

bool ground_light_take(struct image *light, const struct image *plane, const struct image *shadow, struct error *err)
{
    if (!image_init(light, plane->width_px, plane->height_px, 3, PIXEL_F32, err)) return false;
    const float *p = plane->data, *s = shadow->data;
    float *to = light->data;
    size_t n = (size_t)light->width_px * (size_t)light->height_px;
    for (size_t i = 0; i < n; i++, p += 4, s += 4, to += 3)
        for (int c = 0; c < 3; c++) to[c] = transfer_ground(p, s, c) - 1;
    return true;
}

void ground_light_put(struct image *plane, struct image *shadow, const struct image *light, const struct image *photograph,
                      const double exposure[3])
{
    const float *l = light->data, *b = photograph->data;
    float *p = plane->data, *s = shadow->data;
    size_t n = (size_t)light->width_px * (size_t)light->height_px;
    for (size_t i = 0; i < n; i++, p += 4, s += 4, l += 3, b += 3) {
        if (l[0] == 0 && l[1] == 0 && l[2] == 0) {
            memcpy(s, p, 4 * sizeof *p);
            continue;
        }
        for (int c = 0; c < 3; c++) {
            p[c] = p[c] > 0 && p[3] > 0 ? p[c] / p[3] : b[c] > 0 ? b[c] / (float)exposure[c] : 1;
            s[c] = p[c] * (1 + l[c]);
        }
        p[3] = s[3] = 1;
    }
}

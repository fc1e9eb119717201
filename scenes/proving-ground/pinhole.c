#include "pinhole.h"

#include <math.h>

#define MARGIN_PX 4

bool pinhole_cover(struct pinhole *pinhole, const struct camera *camera, double fineness, struct error *err)
{
    double least_x = INFINITY, most_x = -INFINITY, least_y = INFINITY, most_y = -INFINITY;
    int w = camera->width_px, h = camera->height_px;
    for (int i = 0; i < 2 * (w + h); i++) {
        struct vec2 q = i < w ? (struct vec2){ i, 0 } : i < 2 * w ? (struct vec2){ i - w + 1, h }
                      : i < 2 * w + h ? (struct vec2){ 0, i - 2 * w + 1 } : (struct vec2){ w, i - 2 * w - h };
        struct vec3 d;
        if (!camera_unproject(camera, &d, q, err)) return false;
        least_x = fmin(least_x, d.x / d.z);
        most_x = fmax(most_x, d.x / d.z);
        least_y = fmin(least_y, d.y / d.z);
        most_y = fmax(most_y, d.y / d.z);
    }
    double f = camera_intrinsics(camera).fx_px * fineness;
    *pinhole = (struct pinhole){ (int)ceil((most_x - least_x) * f) + 2 * MARGIN_PX, (int)ceil((most_y - least_y) * f) + 2 * MARGIN_PX,
                                 f, MARGIN_PX - least_x * f, MARGIN_PX - least_y * f };
    return true;
}

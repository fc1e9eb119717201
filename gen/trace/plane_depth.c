#include "gen/trace/plane_depth.h"

#include "gen/trace/rays.h"
#include "gen/trace/screen.h"

#include <math.h>

bool plane_depth(struct image *out, const struct plane *plane, const struct camera *camera, struct pose world_from_camera,
                 struct error *err)
{
    struct rays rays = { 0 };
    struct image depth = { 0 };
    struct sight_plane sight = sight_plane(plane->normal, plane->offset_m, world_from_camera);
    bool ok = rays_init(&rays, camera, err) && image_init(&depth, camera->width_px, camera->height_px, 1, PIXEL_F32, err);
    for (int y = 0; ok && y < depth.height_px; y++) {
        rays_begin_row(&rays, y);
        for (int x = 0; x < depth.width_px; x++) {
            struct vec3 direction;
            double range = rays_get(&rays, &direction, x) ? sight_range(sight, direction) : INFINITY;
            *image_f32(&depth, x, y) = isfinite(range) ? (float)(range * direction.z) : NAN;
        }
    }
    rays_release(&rays);
    if (ok) *out = depth;
    return ok;
}

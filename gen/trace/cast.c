#include "gen/trace/cast.h"

#include "gen/trace/footprint.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define OUTSIDE_RAYS 4000000.0 /* at most about so many for what of an entity lies outside the photograph */

bool probes_init(struct probes *probes, int width_px, struct error *err)
{
    size_t n = 3 * (size_t)width_px;
    *probes = (struct probes){ malloc(n * sizeof *probes->direction), malloc(n * sizeof *probes->z),
                               malloc(n * sizeof *probes->range_m), malloc(n * sizeof *probes->x), 0 };
    return (probes->direction && probes->z && probes->range_m && probes->x) ||
           error_set(err, ERR_MEMORY, "no memory for a row of rays");
}

void probes_release(struct probes *probes)
{
    free(probes->direction);
    free(probes->z);
    free(probes->range_m);
    free(probes->x);
    *probes = (struct probes){ 0 };
}

bool cast_init(struct cast *cast, const struct tracer *tracer, const struct camera *camera,
               struct pose world_from_camera, const struct entity *entity, struct error *err)
{
    *cast = (struct cast){ 0 };
    if (!tracer_shape(&cast->shape, &cast->own, tracer, entity->model, err)) return false;
    cast->entity_from_camera = pose_compose(pose_inverse(entity->world_from_entity), world_from_camera);
    struct vec3 min_m, max_m;
    if (!shape_bounds(cast->shape, &min_m, &max_m)) return true;
    int w = camera->width_px, h = camera->height_px;
    cast->reach_px = footprint(camera, pose_inverse(cast->entity_from_camera), min_m, max_m,
                               (struct rect){ -w, -h, 2 * w, 2 * h });
    cast->frame_px = rect_intersect(cast->reach_px, (struct rect){ 0, 0, w, h });
    size_t area = rect_area(cast->frame_px);
    double outside = (double)(rect_area(cast->reach_px) - area);
    cast->stride_px = outside > OUTSIDE_RAYS ? (int)ceil(sqrt(outside / OUTSIDE_RAYS)) : 1;
    if (area == 0) return true;
    cast->mask = calloc(area, sizeof *cast->mask);
    cast->depth_m = malloc(area * sizeof *cast->depth_m);
    if (!cast->mask || !cast->depth_m) return error_set(err, ERR_MEMORY, "no memory for the mask of %s", entity->name);
    for (size_t i = 0; i < area; i++) cast->depth_m[i] = NAN;
    return true;
}

void cast_release(struct cast *cast)
{
    shape_destroy(cast->own);
    free(cast->mask);
    free(cast->depth_m);
    *cast = (struct cast){ 0 };
}

void cast_probe(struct probes *probes, const struct cast *cast, struct rays *rays, int x0, int x1, int stride)
{
    size_t n = 0;
    for (int x = x0; x < x1; x += stride) {
        struct vec3 direction;
        if (!rays_get(rays, &direction, x)) continue;
        probes->x[n] = x;
        probes->z[n] = direction.z;
        probes->direction[n++] = mat3_apply(cast->entity_from_camera.rotation, direction);
    }
    shape_hits(cast->shape, probes->range_m, cast->entity_from_camera.translation, probes->direction, n);
    probes->n = n;
}

void cast_outside_row(struct cast *cast, struct probes *probes, struct rays *rays)
{
    int width = rays->camera->width_px, height = rays->camera->height_px, y = rays->y;
    bool beside = y >= 0 && y < height;
    struct rect reach = cast->reach_px;
    if (y < reach.y0 || y >= reach.y1 || (y - reach.y0) % cast->stride_px != 0) return;
    int spans[2][2] = { { reach.x0, beside && reach.x1 > 0 ? 0 : reach.x1 },
                        { reach.x0 > width ? reach.x0 : width, beside ? reach.x1 : 0 } };
    for (int s = 0; s < 2; s++) {
        cast_probe(probes, cast, rays, spans[s][0], spans[s][1], cast->stride_px);
        for (size_t k = 0; k < probes->n; k++) {
            if (!isfinite(probes->range_m[k])) continue;
            rect_add(&cast->outside_px, probes->x[k], y, cast->stride_px);
            cast->outside += (int64_t)cast->stride_px * cast->stride_px;
        }
    }
}

bool cast_crop(const struct cast *cast, struct entity_labels *out, struct error *err)
{
    size_t w = (size_t)(out->mask_px.x1 - out->mask_px.x0), h = (size_t)(out->mask_px.y1 - out->mask_px.y0);
    size_t stride = (size_t)(cast->frame_px.x1 - cast->frame_px.x0);
    out->mask = malloc(w * h * sizeof *out->mask);
    out->depth_m = malloc(w * h * sizeof *out->depth_m);
    if (!out->mask || !out->depth_m) return error_set(err, ERR_MEMORY, "no memory for the labels of a frame");
    for (size_t y = 0; y < h; y++) {
        size_t from = ((size_t)(out->mask_px.y0 - cast->frame_px.y0) + y) * stride +
                      (size_t)(out->mask_px.x0 - cast->frame_px.x0);
        memcpy(out->mask + y * w, cast->mask + from, w * sizeof *out->mask);
        memcpy(out->depth_m + y * w, cast->depth_m + from, w * sizeof *out->depth_m);
    }
    return true;
}

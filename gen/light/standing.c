#include "gen/light/standing.h"

#include "gen/light/push_pull.h"
#include "gen/trace/polygon.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEEPEST_RAD (45 * M_PI / 180)
#define LOWEST_M 0.3   /* what is lower is ground */
#define TEXELS_MAX 256 /* along a side of the rectangle */

/* Where the ray through a pixel position meets the upright plane at the foot. */
static bool on_plane(struct vec2 *at, const struct seen *seen, struct pose world_from_plane, struct vec2 q_px)
{
    struct error ignored = ERROR_NONE;
    struct vec3 ray, eye = pose_apply(pose_inverse(world_from_plane), seen->world_from_camera.translation);
    if (!camera_unproject(seen->camera, &ray, q_px, &ignored)) return false;
    ray = mat3_apply(mat3_transpose(world_from_plane.rotation), mat3_apply(seen->world_from_camera.rotation, ray));
    if (!(ray.z < -1e-6)) return false;
    *at = (struct vec2){ eye.x - eye.z / ray.z * ray.x, eye.y - eye.z / ray.z * ray.y };
    return true;
}

/* The part of the outline within the picture, in metres. False where the plane cannot hold it. */
static bool raise(struct standing *out, const struct seen *seen, const struct occluder *occluder)
{
    double width = seen->camera->width_px, height = seen->camera->height_px;
    for (size_t i = 0; i < occluder->polygon_count; i++) {
        struct vec2 q = occluder->polygon_px[i], *at = &out->outline[out->count];
        q = (struct vec2){ fmin(fmax(q.x, 0), width), fmin(fmax(q.y, 0), height) };
        if (!on_plane(at, seen, out->world_from_rectangle, q)) return false;
        /* A point come back to would close the outline there. */
        bool again = out->count && ((at->x == at[-1].x && at->y == at[-1].y) || (at->x == out->outline->x && at->y == out->outline->y));
        if (!again) out->count++;
    }
    return out->count >= 3;
}

/* The rectangle round the outline, and the outline in shares of it. False where the picture has but a line of it. */
static bool enclose(struct standing *out)
{
    struct vec2 low = out->outline[0], high = low;
    for (size_t i = 1; i < out->count; i++) {
        struct vec2 p = out->outline[i];
        low = (struct vec2){ fmin(low.x, p.x), fmin(low.y, p.y) };
        high = (struct vec2){ fmax(high.x, p.x), fmax(high.y, p.y) };
    }
    out->size_m = (struct vec2){ high.x - low.x, high.y - low.y };
    if (!(out->size_m.x > 0 && out->size_m.y > 0)) return false;
    out->world_from_rectangle.translation = pose_apply(out->world_from_rectangle, vec3(low.x, low.y, 0));
    for (size_t i = 0; i < out->count; i++)
        out->outline[i] = (struct vec2){ (out->outline[i].x - low.x) / out->size_m.x, (out->outline[i].y - low.y) / out->size_m.y };
    return true;
}

static struct vec3 texel_point(const struct standing *out, int x, int y)
{
    return pose_apply(out->world_from_rectangle, vec3((x + 0.5) / out->radiance.width_px * out->size_m.x,
                                                      (1 - (y + 0.5) / out->radiance.height_px) * out->size_m.y, 0));
}

/* A texel's radiance by the share of it within the outline. Returns that share. */
static float look(float rgbw[4], const struct standing *out, const struct seen *seen, int x, int y, uint64_t samples)
{
    struct vec3 p = texel_point(out, x, y);
    struct vec2 q;
    double rgb[3];
    if (!samples || !seen_project(seen, &q, p)) return 0;
    rgbw[3] = (float)__builtin_popcountll(samples) / 64;
    seen_radiance(seen, rgb, q);
    seen_clear_air(seen, rgb, vec3_norm(vec3_sub(p, seen->world_from_camera.translation)));
    for (int c = 0; c < 3; c++) rgbw[c] = rgbw[3] * (float)rgb[c];
    return rgbw[3];
}

/* What the picture shows of the place at a texel: how high, and how far before the plane. False where there is nothing. */
static bool meet_place(double *z_m, double *before_m, const struct standing *out, const struct seen *seen, const struct image *place_depth,
                       int x, int y)
{
    struct vec3 p = texel_point(out, x, y), ray;
    struct vec2 q;
    struct error ignored = ERROR_NONE;
    if (!seen_project(seen, &q, p) || !camera_unproject(seen->camera, &ray, q, &ignored)) return false;
    double depth = (double)*image_f32(place_depth, (int)q.x, (int)q.y);
    if (!isfinite(depth)) return false;
    struct vec3 met = pose_apply(seen->world_from_camera, vec3_scale(ray, depth / ray.z));
    *z_m = met.z;
    *before_m = vec3_dot(vec3_sub(met, p), mat3_column(out->world_from_rectangle.rotation, 2));
    return true;
}

/* Does the place stand up itself behind most of the outline, no farther from the plane than the outline is wide in the mean? Ground
 * that is seen through it is less than half as high as the texel it is seen through.
 * In: rgbw  weight: the texel's share within the outline */
static bool place_has(const struct standing *out, const struct seen *seen, const struct image *place_depth, float (*rgbw)[4])
{
    int width = out->radiance.width_px, height = out->radiance.height_px;
    double all = 0, stands = 0, ground = INFINITY, z, before;
    for (int i = 0; i < width * height; i++) all += (double)rgbw[i][3];
    double deep = all * out->size_m.x / (width * height);
    for (int i = 0; i < width * height; i++)
        if (rgbw[i][3] > 0 && meet_place(&z, &before, out, seen, place_depth, i % width, i / width) && fabs(before) <= deep) ground = fmin(ground, z);
    for (int i = 0; i < width * height; i++) {
        if (!(rgbw[i][3] > 0) || !meet_place(&z, &before, out, seen, place_depth, i % width, i / width) || fabs(before) > deep) continue;
        double up = texel_point(out, i % width, i / width).z - ground;
        if (z - ground > fmax(LOWEST_M, up / 2)) stands += (double)rgbw[i][3];
    }
    return 2 * stands > all;
}

/* Nothing is left of an outline that encloses no texel's part, nor of one that the place has itself. */
static bool paint(struct standing *out, const struct seen *seen, const struct image *place_depth, struct error *err)
{
    int width = out->radiance.width_px, height = out->radiance.height_px;
    float (*rgbw)[4] = calloc((size_t)width * (size_t)height, sizeof *rgbw), seen_of_it = 0;
    uint64_t *samples = calloc((size_t)width, sizeof *samples);
    struct vec2 *texels = calloc(out->count, sizeof *texels);
    struct polygon polygon = { 0 };
    for (size_t i = 0; texels && i < out->count; i++)
        texels[i] = (struct vec2){ out->outline[i].x * width, (1 - out->outline[i].y) * height };
    bool ok = (rgbw && samples && texels && polygon_init(&polygon, texels, out->count)) ||
              error_set(err, ERR_MEMORY, "no memory for what stands in a picture");
    for (int y = 0; ok && y < height; y++) {
        polygon_row_samples(&polygon, samples, y, 0, width);
        for (int x = 0; x < width; x++) seen_of_it += look(rgbw[y * width + x], out, seen, x, y, samples[x]);
    }
    bool left_out = ok && (!(seen_of_it > 0) || (place_depth && place_has(out, seen, place_depth, rgbw)));
    ok = ok && push_pull(rgbw, width, height, err);
    for (int i = 0; ok && i < width * height; i++) memcpy((float *)out->radiance.data + 3 * i, rgbw[i], 3 * sizeof(float));
    if (left_out) out->count = 0;
    polygon_release(&polygon);
    free(texels);
    free(samples);
    free(rgbw);
    return ok;
}

bool standing_create(struct standing *standing, const struct seen *seen, const struct occluder *occluder, const struct image *place_depth,
                     struct error *err)
{
    struct standing out = { 0 };
    struct vec3 eye = seen->world_from_camera.translation, away = vec3_sub(occluder->foot_m, eye), up = vec3(0, 0, 1);
    double range = vec3_norm(away);
    *standing = (struct standing){ 0 };
    if (-away.z > range * sin(STEEPEST_RAD)) return true;
    away = vec3_unit(vec3(away.x, away.y, 0));
    out.world_from_rectangle = (struct pose){ mat3_from_columns(vec3_cross(away, up), up, vec3_scale(away, -1)), occluder->foot_m };
    out.outline = calloc(occluder->polygon_count, sizeof *out.outline);
    if (!out.outline) return error_set(err, ERR_MEMORY, "no memory for what stands in a picture");
    bool ok = true;
    if (raise(&out, seen, occluder) && enclose(&out)) {
        double texel_m = fmax(range * seen->pixel_rad, fmax(out.size_m.x, out.size_m.y) / TEXELS_MAX);
        ok = image_init(&out.radiance, (int)fmax(1, ceil(out.size_m.x / texel_m - 1e-9)), (int)fmax(1, ceil(out.size_m.y / texel_m - 1e-9)), 3,
                        PIXEL_F32, err) &&
             paint(&out, seen, place_depth, err);
    } else
        out.count = 0;
    if (ok && out.count) *standing = out;
    else standing_release(&out);
    return ok;
}

void standing_release(struct standing *standing)
{
    image_release(&standing->radiance);
    free(standing->outline);
    *standing = (struct standing){ 0 };
}

#include "import/colmap_records.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool colmap_fault(const struct colmap_records *records, const char *file, size_t where, struct error *err,
                  const char *format, ...)
{
    char text[sizeof err->text];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (records->binary) return error_at(err, ERR_INPUT, file, 0, 0, "byte %zu: %s", where, text);
    return error_at(err, ERR_INPUT, file, (int)where, 1, "%s", text);
}

static bool make_room(void *items, size_t *room, size_t count, size_t size, struct error *err)
{
    if (count < *room) return true;
    size_t more = *room ? 2 * *room : 64;
    void **at = items, *grown = realloc(*at, more * size);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
    *at = grown;
    *room = more;
    return true;
}

static bool finite3(struct vec3 v) { return isfinite(v.x) && isfinite(v.y) && isfinite(v.z); }

bool colmap_add_camera(struct colmap_records *r, const struct colmap_camera *camera, struct error *err)
{
    const struct camera *c = &camera->camera;
    if (c->width_px < 1 || c->height_px < 1 || c->width_px > 65535 || c->height_px > 65535)
        return colmap_fault(r, r->cameras_file, camera->where, err,
                            "camera %llu: the size must be from 1 to 65535 px, not %d x %d",
                            (unsigned long long)camera->id, c->width_px, c->height_px);
    for (int i = 0; i < camera_model_param_count(c->model); i++)
        if (!isfinite(c->params[i]))
            return colmap_fault(r, r->cameras_file, camera->where, err, "camera %llu: parameter %d is not finite",
                                (unsigned long long)camera->id, i + 1);
    struct camera_intrinsics in = camera_intrinsics(c);
    if (!(in.fx_px > 0 && in.fy_px > 0))
        return colmap_fault(r, r->cameras_file, camera->where, err, "camera %llu: the focal length must be above 0",
                            (unsigned long long)camera->id);
    if (!make_room(&r->cameras, &r->camera_room, r->camera_count, sizeof *camera, err)) return false;
    r->cameras[r->camera_count++] = *camera;
    return true;
}

bool colmap_add_image(struct colmap_records *r, const struct colmap_image *image, const char *name,
                      size_t name_length, struct error *err)
{
    struct quat q = image->camera_from_world_q;
    double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    if (!name_length) return colmap_fault(r, r->images_file, image->where, err, "the image has no name");
    if (!(isfinite(square) && square > 0))
        return colmap_fault(r, r->images_file, image->where, err, "image \"%.*s\": the quaternion is no rotation",
                            (int)name_length, name);
    if (!finite3(image->camera_from_world_t))
        return colmap_fault(r, r->images_file, image->where, err, "image \"%.*s\": the translation is not finite",
                            (int)name_length, name);
    if (!make_room(&r->images, &r->image_room, r->image_count, sizeof *image, err)) return false;
    struct colmap_image *added = &r->images[r->image_count];
    *added = *image;
    added->name = strndup(name, name_length);
    if (!added->name) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
    added->first = r->keypoint_count;
    added->count = 0;
    r->image_count++;
    return true;
}

bool colmap_add_keypoint(struct colmap_records *r, const struct colmap_keypoint *keypoint, struct error *err)
{
    if (!isfinite(keypoint->q_px.x) || !isfinite(keypoint->q_px.y))
        return colmap_fault(r, r->images_file, keypoint->where, err, "the position of a keypoint is not finite");
    if (!make_room(&r->keypoints, &r->keypoint_room, r->keypoint_count, sizeof *keypoint, err)) return false;
    r->keypoints[r->keypoint_count++] = *keypoint;
    r->images[r->image_count - 1].count++;
    return true;
}

bool colmap_add_point(struct colmap_records *r, const struct colmap_point *point, struct error *err)
{
    if (!finite3(point->p) || !isfinite(point->error_px))
        return colmap_fault(r, r->points_file, point->where, err, "point %llu is not finite",
                            (unsigned long long)point->id);
    if (!make_room(&r->points, &r->point_room, r->point_count, sizeof *point, err)) return false;
    r->points[r->point_count++] = *point;
    return true;
}

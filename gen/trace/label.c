#include "gen/trace/label.h"

#include "lib/class.h"
#include "lib/file.h"
#include "lib/rle.h"

#include <dirent.h>
#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static json_t *json_vec3(struct vec3 v)
{
    return json_pack("[fff]", v.x, v.y, v.z);
}

static json_t *json_pose(struct pose p)
{
    struct quat q = quat_from_mat3(p.rotation);
    return json_pack("{s:[ffff], s:o}", "quaternion_wxyz", q.w, q.x, q.y, q.z, "translation_m", json_vec3(p.translation));
}

static json_t *json_box(struct rect r)
{
    return json_pack("[iiii]", r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0);
}

static json_t *json_camera(const struct label_context *c)
{
    struct camera_intrinsics k = camera_intrinsics(c->camera);
    json_t *params = json_array(), *matrix = json_array();
    for (int i = 0; i < camera_model_param_count(c->camera->model); i++)
        json_array_append_new(params, json_real(c->camera->params[i]));
    const struct mat3 *r = &c->world_from_camera.rotation;
    double t[3] = { c->world_from_camera.translation.x, c->world_from_camera.translation.y,
                    c->world_from_camera.translation.z };
    for (int i = 0; i < 3; i++)
        json_array_append_new(matrix, json_pack("[ffff]", r->m[i][0], r->m[i][1], r->m[i][2], t[i]));
    return json_pack("{s:s, s:[ii], s:o, s:[[fff],[fff],[fff]], s:o}", "model", camera_model_name(c->camera->model),
                     "size_px", c->camera->width_px, c->camera->height_px, "params", params,
                     "K", k.fx_px, 0.0, k.cx_px, 0.0, k.fy_px, k.cy_px, 0.0, 0.0, 1.0, "world_from_camera", matrix);
}

static json_t *json_hiders(const struct entity_labels *l)
{
    json_t *list = json_array();
    static const char *const kinds[] = { [HIDER_ENTITY] = "entity", [HIDER_OCCLUDER] = "occluder", [HIDER_PLACE] = "place" };
    for (size_t i = 0; i < l->hider_count; i++) {
        const struct hider *h = &l->hiders[i];
        json_array_append_new(list, json_pack("{s:s, s:s, s:I, s:I}", "kind", kinds[h->kind],
                                              "name", h->name, "id", (json_int_t)h->id, "pixels", (json_int_t)h->pixels));
    }
    return list;
}

static json_t *json_entity(const struct label_context *c, const struct entity_labels *l, size_t index,
                           struct pose camera_from_world)
{
    const struct entity *e = &c->entities[index];
    struct vec3 corners[8], size = vec3_sub(e->model->max_m, e->model->min_m);
    json_t *world = json_array(), *camera = json_array();
    entity_corners(corners, e);
    for (int i = 0; i < 8; i++) {
        json_array_append_new(world, json_vec3(corners[i]));
        json_array_append_new(camera, json_vec3(pose_apply(camera_from_world, corners[i])));
    }
    return json_pack("{s:i, s:s, s:s, s:i, s:s, s:b, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:I, s:I, s:I, s:f, s:f, s:o, s:o*}",
                     "id", (int)e->id, "name", e->name, "class", class_info(e->class_)->name,
                     "semantic_id", (int)palette_entity(c->palette, e->class_).id,
                     "model", e->model_name, "in_frame", (int)l->in_frame,
                     "world_from_entity", json_pose(e->world_from_entity),
                     "camera_from_entity", json_pose(pose_compose(camera_from_world, e->world_from_entity)),
                     "size_m", json_vec3(size), "box_3d_world_m", world, "box_3d_camera_m", camera,
                     "box_visible_px", json_box(l->box_visible_px), "box_amodal_px", json_box(l->box_amodal_px),
                     "pixels_visible", (json_int_t)l->pixels_visible, "pixels_amodal", (json_int_t)l->pixels_amodal,
                     "pixels_total", (json_int_t)l->pixels_total, "visible_fraction", l->visible_fraction,
                     "truncation", l->truncation, "hidden_by", json_hiders(l),
                     "velocity_m_s", c->velocity_m_s ? json_vec3(c->velocity_m_s[index]) : NULL);
}

static bool write_json(const char *folder, const char *name, json_t *json, struct error *err)
{
    char *text = json ? json_dumps(json, JSON_INDENT(1) | JSON_REAL_PRECISION(12)) : NULL;
    char *path = string_format("%s/%s", folder, name);
    bool ok = text && path ? file_write(path, text, strlen(text), err)
                           : error_set(err, ERR_MEMORY, "no memory for %s", name);
    free(path);
    free(text);
    json_decref(json);
    return ok;
}

static bool write_labels(const char *folder, const struct frame_labels *labels, const struct label_context *c,
                         struct error *err)
{
    struct pose camera_from_world = pose_inverse(c->world_from_camera);
    json_t *entities = json_array();
    for (size_t i = 0; i < labels->entity_count; i++)
        json_array_append_new(entities, json_entity(c, &labels->entities[i], i, camera_from_world));
    json_t *root = json_pack("{s:i, s:s, s:s*, s:s*, s:o*, s:o, s:o*, s:o}", "version", 1, "frame", c->frame,
                             "photograph", c->photograph ? path_name(c->photograph) : NULL, "time", c->time,
                             "time_s", isnan(c->time_s) ? NULL : json_real(c->time_s), "camera", json_camera(c),
                             "sun_direction", c->has_sun ? json_vec3(c->sun_direction) : NULL, "entities", entities);
    return write_json(folder, "labels.json", root, err);
}

static json_t *json_depth_range(const struct entity_labels *l)
{
    size_t n = (size_t)(l->mask_px.x1 - l->mask_px.x0) * (size_t)(l->mask_px.y1 - l->mask_px.y0);
    double least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i < n; i++) {
        if (!l->mask[i]) continue;
        least = fmin(least, (double)l->depth_m[i]);
        most = fmax(most, (double)l->depth_m[i]);
    }
    return json_pack("[ff]", least, most);
}

/* The depth of an entity's whole mask, cut to the mask's rectangle. */
static bool write_amodal_depth(const char *folder, const struct entity *e, const struct entity_labels *l,
                               struct error *err)
{
    struct image depth = { l->mask_px.x1 - l->mask_px.x0, l->mask_px.y1 - l->mask_px.y0, 1, PIXEL_F32, l->depth_m };
    char *path = string_format("%s/amodal/%05d.exr", folder, (int)e->id);
    bool ok = path ? image_write(path, &depth, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

static bool write_amodal(const char *folder, const struct frame_labels *labels, const struct label_context *c,
                         struct error *err)
{
    int width = c->camera->width_px, height = c->camera->height_px;
    json_t *list = json_array();
    bool ok = true;
    for (size_t i = 0; ok && i < labels->entity_count; i++) {
        const struct entity_labels *l = &labels->entities[i];
        struct rle rle;
        if (!l->in_frame) continue;
        ok = rle_encode(&rle, l->mask, l->mask_px, width, height, err);
        if (!ok) break;
        char *counts = rle_to_string(&rle), depth[32];
        snprintf(depth, sizeof depth, "%05d.exr", (int)c->entities[i].id);
        json_array_append_new(list, json_pack("{s:i, s:{s:[ii], s:s}, s:o, s:s, s:o}", "id", (int)c->entities[i].id,
                                              "segmentation", "size", height, width, "counts", counts ? counts : "",
                                              "depth_range_m", json_depth_range(l), "depth", depth,
                                              "depth_box_px", json_box(l->mask_px)));
        ok = counts || error_set(err, ERR_MEMORY, "no memory for a mask");
        free(counts);
        rle_release(&rle);
        ok = ok && write_amodal_depth(folder, &c->entities[i], l, err);
    }
    json_t *root = json_pack("{s:i, s:s, s:o}", "version", 1, "frame", c->frame, "entities", list);
    if (!ok) {
        json_decref(root);
        return false;
    }
    return write_json(folder, "amodal.json", root, err);
}

/* Depths of entities that an earlier run saw in this frame. */
static bool remove_stale(const char *amodal_folder, const struct frame_labels *labels, const struct label_context *c,
                         struct error *err)
{
    DIR *dir = opendir(amodal_folder);
    if (!dir) return error_at(err, ERR_IO, amodal_folder, 0, 0, "cannot be read: %s", strerror(errno));
    for (struct dirent *file; (file = readdir(dir));) {
        unsigned id;
        char name[32];
        if (file->d_name[0] == '.') continue;
        bool stale = true; /* and so is what a write that was killed left */
        if (sscanf(file->d_name, "%5u.exr", &id) == 1) {
            snprintf(name, sizeof name, "%05u.exr", id);
            for (size_t i = 0; stale && !strcmp(name, file->d_name) && i < labels->entity_count; i++)
                stale = c->entities[i].id != id || !labels->entities[i].in_frame;
        }
        if (stale) unlinkat(dirfd(dir), file->d_name, 0);
    }
    closedir(dir);
    return true;
}

static bool write_image(const char *folder, const char *name, const struct image *image, struct error *err)
{
    if (!image || !image->data) return true;
    char *path = string_format("%s/%s", folder, name);
    bool ok = path ? image_write(path, image, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

bool labels_write(const char *folder, const struct frame_labels *labels, const struct label_context *context,
                  struct error *err)
{
    char *amodal = string_format("%s/amodal", folder);
    bool ok = amodal ? folder_make(amodal, err) && remove_stale(amodal, labels, context, err)
                     : error_set(err, ERR_MEMORY, "no memory for a path");
    free(amodal);
    return ok && write_image(folder, "instance.png", &labels->instance, err) &&
           write_image(folder, "depth.exr", &labels->depth, err) &&
           write_image(folder, "visible.png", &labels->visible, err) &&
           write_image(folder, "receiver.png", &labels->receiver, err) &&
           write_image(folder, "place_depth.exr", &labels->place_depth, err) &&
           write_image(folder, "place_labels.png", &labels->place_label, err) &&
           write_image(folder, "motion.exr", context->motion, err) &&
           write_amodal(folder, labels, context, err) && write_labels(folder, labels, context, err);
}

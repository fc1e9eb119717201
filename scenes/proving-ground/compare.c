#include "compare.h"

#include "compare_hand.h"
#include "compare_picture.h"
#include "write_pov.h"

#include "lib/file.h"
#include "lib/rle.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

/* What POV-Ray saw, in the photograph's pixels: whose each is, and how far away; 0 where nobody's. */
struct seen { struct image owner, depth_m; };

static bool seen_init(struct seen *s, const struct camera *camera, struct error *err)
{
    *s = (struct seen){ 0 };
    return image_init(&s->owner, camera->width_px, camera->height_px, 1, PIXEL_U8, err) &&
           image_init(&s->depth_m, camera->width_px, camera->height_px, 1, PIXEL_F32, err);
}
static void seen_release(struct seen *s)
{
    image_release(&s->owner);
    image_release(&s->depth_m);
}

static bool read_named(struct image *image, struct error *err, char *path)
{
    bool ok = path ? image_read(image, path, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

/* n: of the entity alone, 0 for all of them among the street. */
static bool seen_read(struct seen *s, const struct comparison_files *files, const struct proving_case *c, const struct camera *camera,
                      size_t n, struct error *err)
{
    struct image picture = { 0 };
    struct rect w;
    char *path = n ? string_format("%s/%zu-alone-%zu.png", files->folder, files->shot, n)
                   : string_format("%s/%zu-labels.png", files->folder, files->shot);
    bool ok = seen_init(s, camera, err) && label_window(&w, c, files->shot, camera, n, err) && read_named(&picture, err, path);
    if (ok && (picture.type != PIXEL_U16 || picture.channels < 3 || picture.width_px != w.x1 - w.x0 || picture.height_px != w.y1 - w.y0 + 1))
        ok = error_set(err, ERR_INPUT, "a label picture is not of its window");
    for (int y = 0; ok && y < w.y1 - w.y0; y++)
        for (int x = 0; x < picture.width_px; x++) {
            const uint16_t *p = image_u16(&picture, x, y + 1);
            *image_u8(&s->owner, w.x0 + x, w.y0 + y) = (uint8_t)((p[1] + PROVING_ID_SCALE / 2) / PROVING_ID_SCALE);
            *image_f32(&s->depth_m, w.x0 + x, w.y0 + y) = (float)p[0] / 65535 * PROVING_DEPTH_M;
        }
    image_release(&picture);
    return ok;
}

static void seen_box(double box[4], const struct seen *s, uint8_t id, size_t *pixels)
{
    int x0 = s->owner.width_px, y0 = s->owner.height_px, x1 = 0, y1 = 0;
    *pixels = 0;
    for (int y = 0; y < s->owner.height_px; y++)
        for (int x = 0; x < s->owner.width_px; x++) {
            if (*image_u8(&s->owner, x, y) != id) continue;
            ++*pixels;
            if (x < x0) x0 = x;
            if (x + 1 > x1) x1 = x + 1;
            if (y < y0) y0 = y;
            if (y + 1 > y1) y1 = y + 1;
        }
    double found[4] = { x0, y0, x1 - x0, y1 - y0 };
    for (int i = 0; i < 4; i++) box[i] = *pixels ? found[i] : 0;
}

/* --- the tool's labels --- */

static void json_numbers(double *to, const json_t *array, size_t n)
{
    for (size_t i = 0; i < n; i++) to[i] = json_number_value(json_array_get(array, i));
}

static double box_distance(const json_t *label, const double truth[4])
{
    double b[4], worst = 0;
    json_numbers(b, label, 4);
    for (int i = 0; i < 4; i++) {
        double ours = i < 2 ? b[i] : b[i - 2] + b[i], other = i < 2 ? truth[i] : truth[i - 2] + truth[i];
        worst = fmax(worst, fabs(ours - other));
    }
    return worst;
}

struct outputs { struct image instance, semantic_id, depth; json_t *labels, *amodal; };

static json_t *read_json(struct error *err, char *path)
{
    json_error_t wrong;
    json_t *json = path ? json_load_file(path, 0, &wrong) : NULL;
    if (!json) error_set(err, ERR_INPUT, "%s: %s", path ? path : "", path ? wrong.text : "no memory");
    free(path);
    return json;
}

static bool outputs_read(struct outputs *o, const char *out, size_t shot, struct error *err)
{
    *o = (struct outputs){ 0 };
    return read_named(&o->instance, err, string_format("%s/instance/%06zu.png", out, shot)) &&
           read_named(&o->semantic_id, err, string_format("%s/semantic_id/%06zu.png", out, shot)) &&
           read_named(&o->depth, err, string_format("%s/depth/%06zu.exr", out, shot)) &&
           (o->labels = read_json(err, string_format("%s/labels/%06zu.json", out, shot))) &&
           (o->amodal = read_json(err, string_format("%s/amodal/%06zu.json", out, shot)));
}
static void outputs_release(struct outputs *o)
{
    image_release(&o->instance);
    image_release(&o->semantic_id);
    image_release(&o->depth);
    json_decref(o->labels);
    json_decref(o->amodal);
}

static json_t *of_id(const json_t *root, size_t id)
{
    json_t *list = json_object_get(root, "entities"), *item;
    size_t i;
    json_array_foreach(list, i, item) if (json_integer_value(json_object_get(item, "id")) == (json_int_t)id) return item;
    return NULL;
}

/* --- one entity --- */

static int semantic_of(const char *class_) /* Cityscapes' labelIds */
{
    return !strcmp(class_, "person") ? 24 : 26;
}

static void compare_visible(struct comparison *to, const struct outputs *o, const struct seen *all, size_t id, const char *class_)
{
    double both = 0, either = 0, depth = 0, right = 0;
    for (int y = 0; y < all->owner.height_px; y++)
        for (int x = 0; x < all->owner.width_px; x++) {
            bool ours = *image_u16(&o->instance, x, y) == id, truth = *image_u8(&all->owner, x, y) == id;
            either += ours || truth;
            if (!ours || !truth) continue;
            both++;
            depth += fabs((double)*image_f32(&o->depth, x, y) - (double)*image_f32(&all->depth_m, x, y));
            right += *image_u8(&o->semantic_id, x, y) == semantic_of(class_);
        }
    to->mask_iou = fmin(to->mask_iou, both / fmax(1, either));
    to->depth_m = fmax(to->depth_m, depth / fmax(1, both));
    to->semantic_share = fmin(to->semantic_share, right / fmax(1, both));
}

static bool compare_amodal(struct comparison *to, const struct outputs *o, const struct comparison_files *files, const struct seen *alone,
                           size_t id, struct error *err)
{
    json_t *label = of_id(o->amodal, id);
    const char *counts = json_string_value(json_object_get(json_object_get(label, "segmentation"), "counts"));
    const char *file = json_string_value(json_object_get(label, "depth"));
    if (!counts || !file) return error_set(err, ERR_INPUT, "entity %zu has no whole mask", id);
    int width = alone->owner.width_px, height = alone->owner.height_px;
    double box[4];
    json_numbers(box, json_object_get(label, "depth_box_px"), 4);
    struct rle rle;
    struct image depth = { 0 };
    uint8_t *mask = malloc((size_t)width * (size_t)height);
    if (!mask) return error_set(err, ERR_MEMORY, "no memory for a mask");
    bool ok = rle_from_string(&rle, counts, width, height, err);
    if (ok) {
        rle_decode(mask, &rle);
        rle_release(&rle);
        ok = read_named(&depth, err, string_format("%s/amodal/%06zu/%s", files->out, files->shot, file));
    }
    double both = 0, either = 0, off = 0;
    for (int y = 0; ok && y < height; y++)
        for (int x = 0; x < width; x++) {
            bool ours = mask[(size_t)y * (size_t)width + (size_t)x], truth = *image_u8(&alone->owner, x, y) != 0;
            either += ours || truth;
            if (!ours || !truth) continue;
            both++;
            off += fabs((double)*image_f32(&depth, x - (int)box[0], y - (int)box[1]) - (double)*image_f32(&alone->depth_m, x, y));
        }
    to->amodal_iou = fmin(to->amodal_iou, both / fmax(1, either));
    to->amodal_depth_m = fmax(to->amodal_depth_m, off / fmax(1, both));
    image_release(&depth);
    free(mask);
    return ok;
}

/* The extent of an entity's model, along its own axes, as POV-Ray said it. */
static bool read_extent(struct vec3 *least, struct vec3 *most, const struct comparison_files *files, size_t id, struct error *err)
{
    char *path = string_format("%s/%zu-labels.log", files->folder, files->shot), *text = NULL, key[32];
    size_t size;
    bool ok = path && file_read(&text, &size, path, err);
    snprintf(key, sizeof key, "extent %zu:", id);
    const char *at = ok ? strstr(text, key) : NULL;
    if (ok && (!at || sscanf(at + strlen(key), "%lf %lf %lf %lf %lf %lf", &least->x, &least->y, &least->z, &most->x, &most->y, &most->z) != 6))
        ok = error_at(err, ERR_INPUT, path, 0, 0, "does not say the extent of entity %zu", id);
    free(path);
    free(text);
    return ok;
}

static bool compare_pose(struct comparison *to, const json_t *label, const struct comparison_files *files, const struct proving_case *c,
                         const struct camera *camera, size_t id, struct error *err)
{
    struct pose truth = proving_entity_pose(&c->entities[id - 1]), camera_from_world = pose_inverse(proving_shot_pose(&c->shots[files->shot]));
    json_t *pose = json_object_get(label, "world_from_entity"), *corners = json_object_get(label, "box_3d_world_m");
    double q[4], t[3], size[3];
    struct vec3 least, most;
    json_numbers(q, json_object_get(pose, "quaternion_wxyz"), 4);
    json_numbers(t, json_object_get(pose, "translation_m"), 3);
    json_numbers(size, json_object_get(label, "size_m"), 3);
    if (!read_extent(&least, &most, files, id, err)) return false;
    struct mat3 turn = mat3_multiply(mat3_transpose(truth.rotation), mat3_from_quat((struct quat){ q[0], q[1], q[2], q[3] }));
    double cosine = (turn.m[0][0] + turn.m[1][1] + turn.m[2][2] - 1) / 2;
    to->position_m = fmax(to->position_m, vec3_norm(vec3_sub(vec3(t[0], t[1], t[2]), truth.translation)));
    to->turn_deg = fmax(to->turn_deg, acos(fmin(1, fmax(-1, cosine))) * 180 / M_PI);
    struct vec3 extent = vec3_sub(most, least);
    to->size_m = fmax(to->size_m, fmax(fabs(size[0] - extent.x), fmax(fabs(size[1] - extent.y), fabs(size[2] - extent.z))));
    for (int i = 0; i < 8; i++) {
        struct vec3 p = vec3(i & 4 ? most.x : least.x, i & 2 ? most.y : least.y, i & 1 ? most.z : least.z);
        double ours[3];
        struct vec2 a, b;
        json_numbers(ours, json_array_get(corners, (size_t)i), 3);
        if (!camera_project(camera, &a, pose_apply(camera_from_world, pose_apply(truth, p)), err) ||
            !camera_project(camera, &b, pose_apply(camera_from_world, vec3(ours[0], ours[1], ours[2])), err))
            return false;
        to->corner_px = fmax(to->corner_px, hypot(a.x - b.x, a.y - b.y));
    }
    return true;
}

static bool compare_entity(struct comparison *to, const struct outputs *o, const struct comparison_files *files,
                           const struct proving_case *c, const struct camera *camera, const struct seen *all, size_t id, struct error *err)
{
    struct seen alone;
    json_t *label = of_id(o->labels, id);
    double box[4];
    size_t visible, whole;
    if (!label) return error_set(err, ERR_INPUT, "entity %zu has no label", id);
    bool ok = seen_read(&alone, files, c, camera, id, err);
    if (ok) {
        seen_box(box, all, (uint8_t)id, &visible);
        to->box_px = fmax(to->box_px, box_distance(json_object_get(label, "box_visible_px"), box));
        seen_box(box, &alone, (uint8_t)id, &whole);
        to->amodal_box_px = fmax(to->amodal_box_px, box_distance(json_object_get(label, "box_amodal_px"), box));
        double share = json_number_value(json_object_get(label, "visible_fraction"));
        to->visible_share = fmax(to->visible_share, fabs(share - (double)visible / fmax(1, (double)whole)));
        if (visible) compare_visible(to, o, all, id, c->entities[id - 1].class_);
        ok = compare_amodal(to, o, files, &alone, id, err) && compare_pose(to, label, files, c, camera, id, err);
    }
    seen_release(&alone);
    return ok;
}

bool compare(struct comparison *result, const struct comparison_files *files, const struct proving_case *c,
             const struct camera *camera, struct error *err)
{
    struct comparison to = { .mask_iou = 1, .amodal_iou = 1, .semantic_share = 1 };
    struct seen all = { 0 };
    struct outputs o = { 0 };
    struct picture_input in = { 0 };
    size_t n = files->shot;
    bool ok = seen_read(&all, files, c, camera, 0, err) && outputs_read(&o, files->out, n, err) &&
              read_named(&in.photograph, err, string_format("%s/photograph-%zu.jpg", files->folder, n)) &&
              read_named(&in.truth, err, string_format("%s/truth-%zu.jpg", files->folder, n)) &&
              read_named(&in.photograph_light, err, string_format("%s/photograph-%zu.exr", files->folder, n)) &&
              read_named(&in.truth_light, err, string_format("%s/truth-%zu.exr", files->folder, n)) &&
              (!files->plain || read_named(&in.plain, err, string_format("%s/plain-%zu.png", files->folder, n))) &&
              read_named(&in.result, err, string_format("%s/rgb/%06zu.png", files->out, n));
    in.owner = all.owner; /* borrowed */
    ok = ok && compare_picture(&to, &in, err) && compare_hand(&to, &in, err);
    for (size_t i = 1; ok && i <= proving_entity_count(c); i++) ok = compare_entity(&to, &o, files, c, camera, &all, i, err);
    if (ok) *result = to;
    image_release(&in.photograph);
    image_release(&in.truth);
    image_release(&in.plain);
    image_release(&in.result);
    image_release(&in.photograph_light);
    image_release(&in.truth_light);
    seen_release(&all);
    outputs_release(&o);
    return ok;
}

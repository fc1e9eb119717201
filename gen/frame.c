#include "gen/frame_impl.h"

#include "gen/shutter.h"
#include "gen/trace/label.h"
#include "gen/trace/place.h"
#include "gen/trace/plane_depth.h"
#include "gen/world/prism.h"
#include "lib/file.h"
#include "lib/manifest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void frame_name(char name[FRAME_NAME_SIZE], const struct scene_shot *shot)
{
    snprintf(name, FRAME_NAME_SIZE, "%06d", shot->number);
}

static void frame_release(struct frame *f)
{
    for (size_t i = 0; f->receivers && i < f->moment.n; i++) receiver_release(&f->receivers[i]);
    for (size_t i = 0; i < f->occluder_count; i++) free((void *)f->occluders[i].polygon_px);
    surroundings_release(&f->around);
    free(f->receivers);
    free(f->occluders);
    free(f->matters);
    image_release(&f->motion);
    image_release(&f->picture);
    frame_labels_release(&f->labels);
    moment_release(&f->moment);
}

/* --- who is there --- */

struct vec2 frame_scaled_px(const struct frame *f, struct vec2 q)
{
    const struct camera *given = &f->scene->cameras[f->shot->camera].camera;
    return (struct vec2){ q.x * f->camera->width_px / given->width_px, q.y * f->camera->height_px / given->height_px };
}

static bool place_occluders(struct frame *f, struct error *err)
{
    const struct scene *s = f->scene;
    for (size_t i = 0; i < s->occluder_count; i++) {
        const struct scene_occluder *o = &s->occluders[i];
        if (!o->in_each_shot && &s->shots[o->shot] != f->shot) continue;
        struct occluder *out = &f->occluders[f->occluder_count];
        struct vec2 *polygon = calloc(o->polygon_count, sizeof *polygon);
        if (!polygon) return error_set(err, ERR_MEMORY, "no memory for an occluder");
        for (size_t k = 0; k < o->polygon_count; k++) polygon[k] = frame_scaled_px(f, o->polygon_px[k]);
        *out = (struct occluder){ .name = o->name, .polygon_px = polygon, .polygon_count = o->polygon_count };
        f->occluder_count++;
        if (!stage_ground_at(&out->foot_m, f->stage, f->shot, o->ground_px, err)) {
            stage_fail(s, o->source, err);
            return error_prefix(err, "occluder \"%s\": ", o->name);
        }
    }
    return true;
}

struct plane frame_local_ground(const struct frame *f, const struct entity *entity)
{
    if (!f->stage->mesh) return f->scene->ground;
    struct vec3 normal = mat3_column(entity->world_from_entity.rotation, 2);
    return (struct plane){ normal, vec3_dot(normal, entity->world_from_entity.translation) };
}

/* Does the place keep the sun from ground round an entity? */
static bool shaded_around(const struct frame *f, const struct entity *entity)
{
    enum { ROUND = 16 };
    static const double off_ground_m = 0.3;
    const struct vec3 size = vec3_sub(entity->model->max_m, entity->model->min_m), sun = f->context->light->sun_direction;
    double radius = hypot(size.x, size.y) / 2 + size.z;
    if (!f->stage->mesh || !f->context->light->has_sun) return false;
    for (int k = 0; k < ROUND; k++) {
        double angle = 2 * M_PI * k / ROUND;
        struct vec3 p = pose_apply(entity->world_from_entity, vec3(radius * cos(angle), radius * sin(angle), off_ground_m));
        if (static_mesh_blocks(f->stage->mesh, p, sun, 0, 1000)) return true;
    }
    return false;
}

static bool set_stage(struct frame *f, struct error *err)
{
    const struct scene *s = f->scene;
    if (!moment_at(&f->moment, f->stage, f->shot->time_s, err)) return false;
    f->receivers = calloc(f->moment.n + 1, sizeof *f->receivers);
    f->occluders = calloc(s->occluder_count + 1, sizeof *f->occluders);
    f->matters = calloc(f->moment.n + 1, sizeof *f->matters);
    if (!f->receivers || !f->occluders || !f->matters) return error_set(err, ERR_MEMORY, "no memory for a frame");
    for (size_t i = 0; i < f->moment.n; i++) {
        struct plane ground = frame_local_ground(f, &f->moment.entities[i]);
        if (!receiver_create(&f->receivers[i], &f->moment.entities[i], &ground, f->context->light,
                             shaded_around(f, &f->moment.entities[i]), s->wet.reflection > 0 ? &f->shot->world_from_camera.translation : NULL, err))
            return false;
    }
    struct vec3 min_m, max_m = { 0, 0, 0 };
    if (f->stage->mesh) static_mesh_bounds(f->stage->mesh, &min_m, &max_m);
    return place_occluders(f, err) && surroundings_create(&f->around, f->receivers, f->moment.entities, f->moment.n,
                                                          f->context->light, max_m.z, err);
}

static struct trace_input trace_input(const struct frame *f)
{
    return (struct trace_input){
        .camera = f->camera, .world_from_camera = f->shot->world_from_camera,
        .entities = f->moment.entities, .entity_count = f->moment.n,
        .occluders = f->occluders, .occluder_count = f->occluder_count,
        .ground = f->stage->mesh ? NULL : &f->scene->ground,
        .place = f->stage->mesh, .receivers = f->around.receivers, .receiver_count = f->around.n,
    };
}

/* --- what changes --- */

bool frame_ground_at(struct vec3 *p, const struct frame *f, struct vec2 q)
{
    struct error ignored = ERROR_NONE;
    struct pose world_from_camera = f->shot->world_from_camera;
    if (!f->stage->mesh) return ground_from_pixel(p, &f->scene->ground, f->camera, world_from_camera, q, &ignored);
    int x = (int)fmin(q.x, f->camera->width_px - 1), y = (int)fmin(q.y, f->camera->height_px - 1);
    double z = (double)*image_f32(&f->labels.place_depth, x, y);
    struct vec3 ray;
    if (!isfinite(z) || !camera_unproject(f->camera, &ray, (struct vec2){ x + 0.5, y + 0.5 }, &ignored)) return false;
    *p = pose_apply(world_from_camera, vec3_scale(ray, z / ray.z));
    return true;
}

/* How far blur carries what is put in. */
static int blur_reach_px(const struct frame *f)
{
    const struct scene *s = f->scene;
    double softness_px = s->softness_auto && f->photograph[0] ? MANIFEST_SOFTNESS_AUTO_MAX_PX : s->softness_px;
    bool sharpened = s->sharpening > 0 || (s->sharpening_auto && f->photograph[0]);
    if (softness_px <= 0 && s->defocus_px <= 0 && !f->motion.data && !sharpened) return 0;
    double reach = ceil(3 * softness_px) + 2 + (sharpened ? MANIFEST_SHARPENING_REACH_PX : 0), most = 0;
    for (size_t i = 0; s->defocus_px > 0 && i < f->moment.n; i++) {
        struct vec3 way = vec3_sub(f->moment.entities[i].world_from_entity.translation, f->shot->world_from_camera.translation);
        most = fmax(most, s->defocus_px * fabs(1 - s->focus_m / fmax(vec3_norm(way), 0.1)) / 2);
    }
    reach += most;
    most = 0;
    for (int y = 0; f->motion.data && y < f->motion.height_px; y++)
        for (int x = 0; x < f->motion.width_px; x++) {
            const float *m = image_f32(&f->motion, x, y);
            most = fmax(most, (double)hypotf(m[0], m[1]));
        }
    return (int)ceil(fmin(reach + most / 2, f->camera->width_px));
}

static bool in_receiver(const struct frame *f, size_t i, struct vec3 p)
{
    return f->stage->mesh ? prism_contains(&f->around.receivers[i], p) : receiver_contains(&f->receivers[i], p);
}

/* The part of the photograph that can change: entities as traced, and receivers found by
 * rays on a coarse grid, which works whatever lies behind the camera or beyond the lens. */
static struct rect changed_window(struct frame *f)
{
    enum { STEP = 8 };
    struct rect window = { 0 };
    int width = f->camera->width_px, height = f->camera->height_px, border = 2 + blur_reach_px(f);
    for (size_t i = 0; i < f->moment.n; i++) {
        const struct entity_labels *l = &f->labels.entities[i];
        if (l->pixels_visible > 0) window = rect_unite(window, l->mask_px);
        f->matters[i] = l->pixels_visible > 0;
    }
    for (int y = 0; y < height + STEP; y += STEP)
        for (int x = 0; x < width + STEP; x += STEP) {
            struct vec3 p;
            if (!frame_ground_at(&p, f, (struct vec2){ fmin(x, width), fmin(y, height) })) continue;
            for (size_t i = 0; i < f->moment.n; i++)
                if (in_receiver(f, i, p)) {
                    f->matters[i] = true;
                    window = rect_unite(window, (struct rect){ x - STEP, y - STEP, x + STEP, y + STEP });
                }
        }
    if (window.x1 <= window.x0) return window;
    /* Anti-aliased edges reach a pixel beyond the traced ones. */
    window = (struct rect){ window.x0 - border, window.y0 - border, window.x1 + border, window.y1 + border };
    return (struct rect){ window.x0 > 0 ? window.x0 : 0, window.y0 > 0 ? window.y0 : 0,
                          window.x1 < width ? window.x1 : width, window.y1 < height ? window.y1 : height };
}

/* --- labels --- */

/* Mist needs to know how far away the ground is, a plane as well. */
static bool write_plane_depth(const struct frame *f, struct error *err)
{
    struct image depth = { 0 };
    char *path = string_format("%s/place_depth.exr", f->folder);
    bool ok = (path || error_set(err, ERR_MEMORY, "no memory for a path")) &&
              plane_depth(&depth, &f->scene->ground, f->camera, f->shot->world_from_camera, err) &&
              image_write(path, &depth, err);
    image_release(&depth);
    free(path);
    return ok;
}

static bool trace(struct frame *f, struct error *err)
{
    struct trace_input in = trace_input(f);
    char time[UTC_TEXT_SIZE] = "";
    if (f->scene->has_time) utc_time_text(time, f->scene->time_utc, f->shot->time_s);
    struct label_context context = {
        .frame = f->name, .photograph = f->photograph[0] ? f->photograph : NULL, .camera = f->camera,
        .world_from_camera = f->shot->world_from_camera,
        .has_sun = f->context->light->has_sun, .sun_direction = f->context->light->sun_direction,
        .entities = f->moment.entities, .entity_count = f->moment.n,
        .time = time[0] ? time : NULL, .time_s = f->scene->has_times ? f->shot->time_s : NAN,
        .velocity_m_s = f->scene->has_times ? f->moment.velocity_m_s : NULL,
        .palette = f->scene->palette,
    };
    if (!trace_frame(&f->labels, f->context->tracer, &in, err)) return false;
    if (f->scene->exposure_s > 0) {
        if (!shutter_motion(&f->motion, f->stage, f->shot, &f->moment, &in, &f->labels, err)) return false;
        context.motion = &f->motion;
    }
    return labels_write(f->folder, &f->labels, &context, err) &&
           (!f->scene->has_mist || f->stage->mesh || write_plane_depth(f, err));
}

/* The picture of a new view: the static mesh in its own colours. */
static bool write_background(struct frame *f, struct error *err)
{
    struct place_view view = { 0 };
    char *path = string_format("%s/background.png", f->folder);
    bool ok = (path || error_set(err, ERR_MEMORY, "no memory for a path")) &&
              place_render(&view, f->stage->mesh, f->camera, f->shot->world_from_camera, err) &&
              image_write(path, &view.rgb, err);
    f->picture = view.rgb;
    view.rgb = (struct image){ 0 };
    place_view_release(&view);
    free(path);
    return ok;
}

static char *passes_key_path(const char *folder)
{
    return string_format("%s/passes.key", folder);
}

bool frame_has_passes_key(const char *folder)
{
    char *path = passes_key_path(folder);
    bool has = path && file_exists(path);
    free(path);
    return has;
}

static bool write_passes_key(const struct frame *f, struct error *err)
{
    char *path = passes_key_path(f->folder);
    bool ok = path ? file_write_if_changed(path, f->keys->passes, strlen(f->keys->passes), err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

bool frame_make(struct frame_result *result, const struct frame_context *context, const struct scene_shot *shot,
                const struct camera *camera, const char *folder, const char *photograph, const struct frame_keys *keys,
                struct error *err)
{
    const struct scene *s = context->scene;
    struct frame f = { .context = context, .scene = s, .stage = context->stage, .shot = shot, .camera = camera,
                       .name = result->name, .folder = folder, .photograph = photograph, .keys = keys };
    bool ok = set_stage(&f, err) && trace(&f, err) && (photograph[0] || write_background(&f, err));
    if (ok) {
        struct rect window = changed_window(&f);
        result->empty = window.x1 <= window.x0 || window.y1 <= window.y0;
        if (!result->empty)
            ok = (view_cover(&result->view, camera, window, pass_settings(s->quality).fineness, err) || stage_fail(s, shot->source, err)) &&
                 frame_expose(&f, err) && frame_write_passes(&f, &result->view, err) && write_passes_key(&f, err);
    }
    ok = ok && frame_write_manifest(&f, result, err);
    frame_release(&f);
    return ok;
}

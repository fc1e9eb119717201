#include "gen/frame.h"

#include "gen/moment.h"
#include "gen/render/place_sdl.h"
#include "gen/shutter.h"
#include "gen/sunlit.h"
#include "gen/trace/label.h"
#include "gen/trace/place.h"
#include "gen/trace/plane_depth.h"
#include "gen/world/prism.h"
#include "gen/world/receiver.h"
#include "gen/world/shading.h"
#include "gen/world/surroundings.h"
#include "lib/file.h"
#include "lib/manifest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A frame while it is made. */
struct frame {
    const struct frame_context *context;
    const struct scene *scene;      /* the context's */
    const struct stage *stage;
    const struct scene_shot *shot;
    const struct camera *camera;
    const char *name, *folder, *photograph, *key;
    struct moment moment;
    struct receiver *receivers;     /* (moment.n) */
    struct surroundings around;     /* with a static mesh */
    struct occluder *occluders;     /* (scene->occluder_count) polygons at the size of the result; owned */
    struct frame_labels labels;
    bool *matters;                  /* (moment.n) seen, or shading what is seen */
    struct image motion;            /* empty: nothing blurs by moving */
};

static void frame_release(struct frame *f)
{
    for (size_t i = 0; f->receivers && i < f->moment.n; i++) receiver_release(&f->receivers[i]);
    for (size_t i = 0; f->occluders && i < f->scene->occluder_count; i++) free((void *)f->occluders[i].polygon_px);
    surroundings_release(&f->around);
    free(f->receivers);
    free(f->occluders);
    free(f->matters);
    image_release(&f->motion);
    frame_labels_release(&f->labels);
    moment_release(&f->moment);
}

/* --- who is there --- */

static struct vec2 scaled_px(const struct frame *f, struct vec2 q)
{
    const struct camera *given = &f->scene->cameras[f->shot->camera].camera;
    return (struct vec2){ q.x * f->camera->width_px / given->width_px, q.y * f->camera->height_px / given->height_px };
}

static bool place_occluders(struct frame *f, struct error *err)
{
    const struct scene *s = f->scene;
    for (size_t i = 0; i < s->occluder_count; i++) {
        const struct scene_occluder *o = &s->occluders[i];
        struct vec2 *polygon = calloc(o->polygon_count, sizeof *polygon);
        if (!polygon) return error_set(err, ERR_MEMORY, "no memory for an occluder");
        for (size_t k = 0; k < o->polygon_count; k++) polygon[k] = scaled_px(f, o->polygon_px[k]);
        f->occluders[i] = (struct occluder){ .name = o->name, .polygon_px = polygon, .polygon_count = o->polygon_count };
        if (!stage_ground_at(&f->occluders[i].foot_m, f->stage, f->shot, o->ground_px, err)) {
            stage_fail(s, o->source, err);
            return error_prefix(err, "occluder \"%s\": ", o->name);
        }
    }
    return true;
}

/* The ground right below an entity. */
static struct plane local_ground(const struct frame *f, const struct entity *entity)
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
        struct plane ground = local_ground(f, &f->moment.entities[i]);
        if (!receiver_create(&f->receivers[i], &f->moment.entities[i], &ground, f->context->light,
                             shaded_around(f, &f->moment.entities[i]), err))
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
        .occluders = f->occluders, .occluder_count = f->scene->occluder_count,
        .ground = f->stage->mesh ? NULL : &f->scene->ground,
        .place = f->stage->mesh, .receivers = f->around.receivers, .receiver_count = f->around.n,
    };
}

/* --- what changes --- */

/* What ground a pixel position shows. */
static bool seen_ground(struct vec3 *p, const struct frame *f, struct vec2 q)
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
    if (s->softness_px <= 0 && s->defocus_px <= 0 && !f->motion.data) return 0;
    double reach = ceil(3 * s->softness_px) + 2, most = 0;
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
            if (!seen_ground(&p, f, (struct vec2){ fmin(x, width), fmin(y, height) })) continue;
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

/* --- what is written --- */

static void ground_radiance(double rgb[3], const struct frame *f)
{
    const struct scene *s = f->scene;
    light_irradiance(rgb, f->context->light, s->ground.normal);
    for (int c = 0; c < 3; c++) rgb[c] *= s->ground_albedo[c];
    if (s->ground_reflection <= 0 || s->exposure_given || s->exposure_of_roads) return;
    /* A wet ground mirrors the sky as well: as seen in the middle of the exposure patch. */
    struct vec2 middle = { (s->exposure_patch_px[0].x + s->exposure_patch_px[1].x) / 2,
                           (s->exposure_patch_px[0].y + s->exposure_patch_px[1].y) / 2 };
    struct error ignored = ERROR_NONE;
    struct vec3 p;
    if (!ground_from_pixel(&p, &s->ground, f->camera, f->shot->world_from_camera, scaled_px(f, middle), &ignored)) return;
    struct vec3 d = vec3_unit(vec3_sub(p, f->shot->world_from_camera.translation));
    double cosine = -vec3_dot(d, s->ground.normal), sky[3];
    double share = s->ground_reflection + (1 - s->ground_reflection) * pow(1 - cosine, 5);
    light_sky_radiance(sky, f->context->light, vec3_add(d, vec3_scale(s->ground.normal, 2 * cosine)));
    for (int c = 0; c < 3; c++) rgb[c] += share * sky[c];
}

static struct rect patch_px(const struct frame *f)
{
    struct vec2 a = scaled_px(f, f->scene->exposure_patch_px[0]), b = scaled_px(f, f->scene->exposure_patch_px[1]);
    return (struct rect){ (int)floor(a.x), (int)floor(a.y), (int)ceil(b.x), (int)ceil(b.y) };
}

/* Out: to (1024), empty for no path */
static bool absolute(char to[1024], const char *path, struct error *err)
{
    to[0] = 0;
    if (!path) return true;
    char *real = realpath(path, NULL);
    bool ok = real && strlen(real) < 1024;
    if (ok) snprintf(to, 1024, "%s", real);
    else error_at(err, ERR_INPUT, path, 0, 0, real ? "the path is too long: 1023 bytes are possible" : "does not exist");
    free(real);
    return ok;
}

static bool sample_roads(struct manifest *m, const struct frame *f, struct error *err)
{
    const struct scene *s = f->scene;
    return sunlit_pixels(&m->exposure_sample_px, &m->exposure_samples, f->stage, f->context->light, f->camera,
                         f->shot->world_from_camera, err) &&
           (m->exposure_samples > 0 ||
            error_at(err, ERR_INPUT, s->path, s->exposure_source.line, s->exposure_source.column,
                     "exposure.roads: frame %s shows no road in full light to be fitted to: give exposure.value, or leave "
                     "the shot in line %d out", f->name, f->shot->source.line));
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Through how much air the ground is seen that the exposure is fitted to: the median of its pixels. */
static bool measure_exposure_distance(struct manifest *m, const struct frame *f, struct error *err)
{
    struct vec2 middle = { (m->exposure_patch_px.x0 + m->exposure_patch_px.x1) / 2.0,
                           (m->exposure_patch_px.y0 + m->exposure_patch_px.y1) / 2.0 };
    size_t n = m->exposure_samples ? m->exposure_samples : 1, known = 0;
    double *range = calloc(n, sizeof *range);
    if (!range) return error_set(err, ERR_MEMORY, "no memory for a manifest");
    for (size_t i = 0; i < n; i++) {
        struct vec3 p;
        if (seen_ground(&p, f, m->exposure_samples ? m->exposure_sample_px[i] : middle))
            range[known++] = vec3_norm(vec3_sub(p, f->shot->world_from_camera.translation));
    }
    qsort(range, known, sizeof *range, ascending);
    if (known) m->exposure_distance_m = range[known / 2];
    free(range);
    return true;
}

static bool write_manifest(const struct frame *f, const struct frame_result *result, struct error *err)
{
    static const char *const transfers[] = { "layers", "ratio", "threshold", "alpha" };
    const struct scene *s = f->scene;
    struct manifest m = {
        .width_px = f->camera->width_px, .height_px = f->camera->height_px,
        .camera = *f->camera, .world_from_camera = f->shot->world_from_camera,
        .empty = result->empty, .view = result->view, .receiver_reduction = result->receiver_reduction,
        .exposure_given = s->exposure_given, .exposure = s->exposure, .white_balance = s->white_balance,
        .t1 = s->t1, .t2 = s->t2, .t3 = s->t3,
        .overwrite_below = s->overwrite == OVERWRITE_BELOW, .mask_dilated = s->mask == MASK_DILATED,
        .has_shares = s->occluder_count > 0 || f->stage->mesh, .has_place = f->labels.place_depth.data != NULL,
        .has_place_labels = f->labels.place_label.data != NULL, .palette = s->palette, .new_view = !f->photograph[0],
        .has_mist = s->has_mist, .visibility_m = s->visibility_m, .haze = { s->haze[0], s->haze[1], s->haze[2] },
        .has_motion = f->motion.data != NULL, .defocus_px = s->defocus_px, .focus_m = s->focus_m,
        .softness_px = s->softness_px, .entity_count = f->moment.n,
    };
    snprintf(m.frame, sizeof m.frame, "%s", result->name);
    snprintf(m.photograph, sizeof m.photograph, "%s", f->photograph);
    snprintf(m.key, sizeof m.key, "%s", f->key);
    if (!absolute(m.semantic, f->shot->semantic, err) || !absolute(m.depth, f->shot->depth, err)) return false;
    snprintf(m.transfer, sizeof m.transfer, "%s", transfers[s->transfer]);
    ground_radiance(m.ground_radiance, f);
    if (s->exposure_of_roads && !m.empty && !sample_roads(&m, f, err)) {
        free(m.exposure_sample_px);
        return false;
    }
    if (!s->exposure_given && !s->exposure_of_roads) m.exposure_patch_px = patch_px(f);
    if (s->has_mist && !s->exposure_given && !measure_exposure_distance(&m, f, err)) {
        free(m.exposure_sample_px);
        return false;
    }
    m.entities = calloc(f->moment.n + 1, sizeof *m.entities);
    if (!m.entities) {
        free(m.exposure_sample_px);
        return error_set(err, ERR_MEMORY, "no memory for a manifest");
    }
    for (size_t i = 0; i < f->moment.n; i++) {
        m.entities[i].id = f->moment.entities[i].id;
        m.entities[i].class_ = f->moment.entities[i].class_;
        snprintf(m.entities[i].name, sizeof m.entities[i].name, "%s", f->moment.entities[i].name);
    }
    char *path = string_format("%s/frame.json", f->folder);
    bool ok = path ? manifest_write(path, &m, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    free(m.entities);
    free(m.exposure_sample_px);
    return ok;
}

/* The picture of a new view: the static mesh in its own colours. */
static bool write_background(const struct frame *f, struct error *err)
{
    struct place_view view = { 0 };
    char *path = string_format("%s/background.png", f->folder);
    bool ok = (path || error_set(err, ERR_MEMORY, "no memory for a path")) &&
              place_render(&view, f->stage->mesh, f->camera, f->shot->world_from_camera, err) &&
              image_write(path, &view.rgb, err);
    place_view_release(&view);
    free(path);
    return ok;
}

/* The parts of the static mesh that the entities that matter need, and a plane below them.
 * Out: path of the include, relative to the output folder */
static bool write_place(char path[64], struct plane *below, const struct frame *f, struct error *err)
{
    struct static_cut receivers = { 0 }, around = { 0 }, shades = { 0 }, rest = { 0 };
    struct vec3 *lights = NULL;
    size_t light_count = 0;
    struct prism *near = calloc(f->around.n + 1, sizeof *near), *above = calloc(f->around.shade_count + 1, sizeof *above);
    size_t near_count = 0, above_count = 0, per_entity = f->around.n ? f->around.shade_count / f->around.n : 0;
    bool ok = (near && above) || error_set(err, ERR_MEMORY, "no memory for the place");
    for (size_t i = 0; ok && i < f->around.n; i++) {
        if (!f->matters[i]) continue;
        near[near_count++] = f->around.receivers[i];
        for (size_t k = 0; k < per_entity; k++) above[above_count++] = f->around.shades[i * per_entity + k];
    }
    ok = ok && static_mesh_cut(f->stage->mesh, &receivers, near, near_count, err) &&
         static_mesh_cut(f->stage->mesh, &around, above, above_count, err) &&
         pass_lights(&lights, &light_count, f->scene, f->context->light, err) &&
         shading_part(&shades, &rest, &around, &receivers, lights, light_count, err);
    snprintf(path, 64, "frames/%s/place.inc", f->name);
    char *file = string_format("%s/place.inc", f->folder);
    ok = ok && (file || error_set(err, ERR_MEMORY, "no memory for a path")) &&
         place_include_write(file, &receivers, &shades, &rest, err);
    double lowest = INFINITY;
    for (size_t i = 0; i < f->moment.n; i++)
        if (f->matters[i]) lowest = fmin(lowest, f->moment.entities[i].world_from_entity.translation.z);
    for (size_t i = 0; i < receivers.vertices; i++) lowest = fmin(lowest, (double)receivers.position_m[i][2]);
    *below = (struct plane){ vec3(0, 0, 1), lowest - 0.5 };
    static_cut_release(&receivers);
    static_cut_release(&around);
    static_cut_release(&shades);
    static_cut_release(&rest);
    free(lights);
    free(file);
    free(near);
    free(above);
    return ok;
}

static bool write_passes(struct frame *f, const struct view *view, struct error *err)
{
    const struct frame_context *c = f->context;
    struct entity *entities = calloc(f->moment.n + 1, sizeof *entities);
    struct receiver *receivers = calloc(f->moment.n + 1, sizeof *receivers);
    struct model_include *includes = calloc(f->moment.n + 1, sizeof *includes);
    size_t n = 0;
    char place[64];
    bool ok = (entities && receivers && includes) || error_set(err, ERR_MEMORY, "no memory for a frame");
    for (size_t i = 0; ok && i < f->moment.n; i++) {
        if (!f->matters[i]) continue;
        size_t model = f->moment.model_index[i];
        bool posed = f->moment.entities[i].model != f->stage->models[model];
        entities[n] = f->moment.entities[i];
        receivers[n] = f->receivers[i];
        includes[n] = posed ? model_include_posed(f->name, &entities[n]) : model_include(model, &entities[n]);
        ok = model_include_write(&includes[n], posed ? NULL : c->includes, c->out_folder, &entities[n], err);
        n++;
    }
    struct passes passes = {
        .scene = f->scene, .sky_map = c->sky_map, .light = c->light, .view = *view,
        .world_from_camera = f->shot->world_from_camera, .entities = entities, .includes = includes, .entity_count = n,
        .ground = f->scene->ground, .receivers = receivers, .receiver_count = n,
        .place_include = f->stage->mesh ? place : NULL,
    };
    ok = ok && (!f->stage->mesh || write_place(place, &passes.ground, f, err)) && passes_write(f->folder, &passes, err);
    free(entities);
    free(receivers);
    free(includes);
    return ok;
}

bool frame_make(struct frame_result *result, const struct frame_context *context, const struct scene_shot *shot,
                const struct camera *camera, const char *folder, const char *photograph, const char *key,
                struct error *err)
{
    const struct scene *s = context->scene;
    struct frame f = { .context = context, .scene = s, .stage = context->stage, .shot = shot, .camera = camera,
                       .name = result->name, .folder = folder, .photograph = photograph, .key = key };
    bool ok = set_stage(&f, err) && trace(&f, err) && (photograph[0] || write_background(&f, err));
    if (ok) {
        struct rect window = changed_window(&f);
        result->empty = window.x1 <= window.x0 || window.y1 <= window.y0;
        result->receiver_reduction = pass_settings(s->quality, s->sky).receiver_reduction;
        if (!result->empty)
            ok = (view_cover(&result->view, camera, window, err) || stage_fail(s, shot->source, err)) &&
                 write_passes(&f, &result->view, err);
    }
    ok = ok && write_manifest(&f, result, err);
    frame_release(&f);
    return ok;
}

#include "gen/frame.h"

#include "gen/trace/label.h"
#include "gen/world/receiver.h"
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
    const struct scene_shot *shot;
    const struct camera *camera;
    const char *name, *folder, *photograph, *key;
    struct moment moment;
    struct receiver *receivers;     /* (moment.n) */
    struct occluder *occluders;     /* (scene->occluder_count) polygons at the size of the result; owned */
    struct frame_labels labels;
    bool *matters;                  /* (moment.n) seen, or shading what is seen */
};

static void frame_release(struct frame *f)
{
    for (size_t i = 0; f->receivers && i < f->moment.n; i++) receiver_release(&f->receivers[i]);
    for (size_t i = 0; f->occluders && i < f->scene->occluder_count; i++) free((void *)f->occluders[i].polygon_px);
    free(f->receivers);
    free(f->occluders);
    free(f->matters);
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
        if (!ground_from_pixel(&f->occluders[i].foot_m, &s->ground, f->camera, f->shot->world_from_camera,
                               scaled_px(f, o->ground_px), err)) {
            stage_fail(s, o->source, err);
            return error_prefix(err, "occluder \"%s\": ", o->name);
        }
    }
    return true;
}

static bool set_stage(struct frame *f, struct error *err)
{
    const struct scene *s = f->scene;
    if (!stage_at(&f->moment, f->context->stage, f->shot->time_s, err)) return false;
    f->receivers = calloc(f->moment.n + 1, sizeof *f->receivers);
    f->occluders = calloc(s->occluder_count + 1, sizeof *f->occluders);
    f->matters = calloc(f->moment.n + 1, sizeof *f->matters);
    if (!f->receivers || !f->occluders || !f->matters) return error_set(err, ERR_MEMORY, "no memory for a frame");
    for (size_t i = 0; i < f->moment.n; i++)
        if (!receiver_create(&f->receivers[i], &f->moment.entities[i], &s->ground, f->context->light, err)) return false;
    return place_occluders(f, err);
}

/* --- what changes --- */

/* The part of the photograph that can change: entities as traced, and receivers found by
 * rays on a coarse grid, which works whatever lies behind the camera or beyond the lens. */
static struct rect changed_window(struct frame *f)
{
    enum { STEP = 8 };
    struct rect window = { 0 };
    int width = f->camera->width_px, height = f->camera->height_px;
    for (size_t i = 0; i < f->moment.n; i++) {
        window = rect_unite(window, f->labels.entities[i].mask_px);
        f->matters[i] = f->labels.entities[i].in_frame;
    }
    for (int y = 0; y < height + STEP; y += STEP)
        for (int x = 0; x < width + STEP; x += STEP) {
            struct error ignored = ERROR_NONE;
            struct vec3 p;
            struct vec2 q = { fmin(x, width), fmin(y, height) };
            if (!ground_from_pixel(&p, &f->scene->ground, f->camera, f->shot->world_from_camera, q, &ignored)) continue;
            for (size_t i = 0; i < f->moment.n; i++)
                if (receiver_contains(&f->receivers[i], p)) {
                    f->matters[i] = true;
                    window = rect_unite(window, (struct rect){ x - STEP, y - STEP, x + STEP, y + STEP });
                }
        }
    if (window.x1 <= window.x0) return window;
    /* Anti-aliased edges reach a pixel beyond the traced ones. */
    window = (struct rect){ window.x0 - 2, window.y0 - 2, window.x1 + 2, window.y1 + 2 };
    return (struct rect){ window.x0 > 0 ? window.x0 : 0, window.y0 > 0 ? window.y0 : 0,
                          window.x1 < width ? window.x1 : width, window.y1 < height ? window.y1 : height };
}

/* --- what is written --- */

static void ground_radiance(double rgb[3], const struct frame *f)
{
    const struct scene *s = f->scene;
    light_irradiance(rgb, f->context->light, s->ground.normal);
    for (int c = 0; c < 3; c++) rgb[c] *= s->ground_albedo[c];
    if (s->ground_reflection <= 0 || s->exposure_given) return;
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
        .has_shares = s->occluder_count > 0, .entity_count = f->moment.n,
    };
    snprintf(m.frame, sizeof m.frame, "%s", result->name);
    snprintf(m.photograph, sizeof m.photograph, "%s", f->photograph);
    snprintf(m.key, sizeof m.key, "%s", f->key);
    snprintf(m.transfer, sizeof m.transfer, "%s", transfers[s->transfer]);
    ground_radiance(m.ground_radiance, f);
    if (!s->exposure_given) m.exposure_patch_px = patch_px(f);
    m.entities = calloc(f->moment.n + 1, sizeof *m.entities);
    if (!m.entities) return error_set(err, ERR_MEMORY, "no memory for a manifest");
    for (size_t i = 0; i < f->moment.n; i++) {
        m.entities[i].id = f->moment.entities[i].id;
        m.entities[i].class_ = f->moment.entities[i].class_;
        snprintf(m.entities[i].name, sizeof m.entities[i].name, "%s", f->moment.entities[i].name);
    }
    char *path = string_format("%s/frame.json", f->folder);
    bool ok = path ? manifest_write(path, &m, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    free(m.entities);
    return ok;
}

static bool write_passes(struct frame *f, const struct view *view, struct error *err)
{
    const struct frame_context *c = f->context;
    struct entity *entities = calloc(f->moment.n + 1, sizeof *entities);
    struct receiver *receivers = calloc(f->moment.n + 1, sizeof *receivers);
    size_t *model_index = calloc(f->moment.n + 1, sizeof *model_index), n = 0;
    bool ok = (entities && receivers && model_index) || error_set(err, ERR_MEMORY, "no memory for a frame");
    for (size_t i = 0; ok && i < f->moment.n; i++) {
        if (!f->matters[i]) continue;
        entities[n] = f->moment.entities[i];
        model_index[n] = f->moment.model_index[i];
        receivers[n] = f->receivers[i];
        ok = model_include_write(c->out_folder, model_index[n], &entities[n], err);
        n++;
    }
    struct passes passes = { f->scene, c->sky_map, c->light, *view, f->shot->world_from_camera, entities, model_index, n,
                             receivers, n };
    ok = ok && passes_write(f->folder, &passes, err);
    free(entities);
    free(receivers);
    free(model_index);
    return ok;
}

static bool trace(struct frame *f, struct error *err)
{
    struct trace_input in = {
        .camera = f->camera, .world_from_camera = f->shot->world_from_camera, .ground = &f->scene->ground,
        .entities = f->moment.entities, .entity_count = f->moment.n,
        .occluders = f->occluders, .occluder_count = f->scene->occluder_count,
    };
    struct label_context context = {
        .frame = f->name, .photograph = f->photograph, .camera = f->camera,
        .world_from_camera = f->shot->world_from_camera,
        .has_sun = f->context->light->has_sun, .sun_direction = f->context->light->sun_direction,
        .entities = f->moment.entities, .entity_count = f->moment.n, .time_s = NAN,
    };
    return trace_frame(&f->labels, f->context->tracer, &in, err) && labels_write(f->folder, &f->labels, &context, err);
}

bool frame_make(struct frame_result *result, const struct frame_context *context, const struct scene_shot *shot,
                const struct camera *camera, const char *folder, const char *photograph, const char *key,
                struct error *err)
{
    const struct scene *s = context->scene;
    struct frame f = { .context = context, .scene = s, .shot = shot, .camera = camera, .name = result->name,
                       .folder = folder, .photograph = photograph, .key = key };
    bool ok = set_stage(&f, err) && trace(&f, err);
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

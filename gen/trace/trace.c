#include "gen/trace/trace.h"

#include "gen/trace/backdrop.h"
#include "gen/trace/cast.h"
#include "gen/trace/rays.h"
#include "gen/trace/screen.h"
#include "gen/trace/shape.h"
#include "gen/trace/share.h"

#include <math.h>
#include <stdlib.h>

struct tracer {
    RTCDevice device;
    struct shape **shapes; /* (n) */
    size_t n;
};

bool tracer_create(struct tracer **tracer, const struct model *const *models, size_t n, struct error *err)
{
    struct tracer *t = calloc(1, sizeof *t);
    if (!t) return error_set(err, ERR_MEMORY, "no memory for a tracer");
    t->shapes = calloc(n + 1, sizeof *t->shapes);
    t->device = rtcNewDevice("threads=1");
    if (!t->shapes || !t->device) {
        error_set(err, ERR_MEMORY, "no memory for a tracer");
        goto failed;
    }
    if (!rtcGetDeviceProperty(t->device, RTC_DEVICE_PROPERTY_RAY_STREAM_SUPPORTED)) {
        error_set(err, ERR_BUG, "this Embree was built without ray streams");
        goto failed;
    }
    for (; t->n < n; t->n++)
        if (!shape_create(&t->shapes[t->n], t->device, models[t->n], err)) goto failed;
    *tracer = t;
    return true;
failed:
    tracer_destroy(t);
    return false;
}

void tracer_destroy(struct tracer *tracer)
{
    if (!tracer) return;
    for (size_t i = 0; i < tracer->n; i++) shape_destroy(tracer->shapes[i]);
    free(tracer->shapes);
    if (tracer->device) rtcReleaseDevice(tracer->device);
    free(tracer);
}

bool tracer_shape(const struct shape **shape, struct shape **own, const struct tracer *tracer, const struct model *model,
                  struct error *err)
{
    struct shape *made = NULL;
    const struct shape *found = NULL;
    for (size_t i = 0; i < tracer->n && !found; i++)
        if (shape_model(tracer->shapes[i]) == model) found = tracer->shapes[i];
    if (!found && !shape_create(&made, tracer->device, model, err)) return false;
    *shape = found ? found : made;
    *own = made;
    return true;
}

/* Things in front are counted as: entities, then screens, then the place. */
struct frame {
    struct rays rays;
    const struct entity *entities;
    struct cast *casts;
    size_t cast_count;
    struct screen *screens;
    size_t screen_count;
    struct backdrop backdrop;  /* with a place */
    struct sight_plane ground; /* of normal 0: none */
    struct probes probes;
    double *range_m;    /* (width) of the nearest entity in a row */
    ptrdiff_t *front;   /* (width) the thing in front; -1: none */
    size_t things;
    int64_t *counts;    /* (cast_count, things): pixels of an entity by what is in front there */
    struct image ahead; /* F32 1, where something static can hide: range of the nearest entity, INFINITY where there is none */
};

static bool frame_init(struct frame *frame, const struct tracer *tracer, const struct trace_input *in, struct error *err)
{
    size_t width = (size_t)in->camera->width_px, entities = in->entity_count, occluders = in->occluder_count;
    if (!rays_init(&frame->rays, in->camera, err) || !probes_init(&frame->probes, in->camera->width_px, err)) return false;
    frame->entities = in->entities;
    frame->things = entities + occluders + 1;
    frame->casts = calloc(entities + 1, sizeof *frame->casts);
    frame->screens = calloc(occluders + 1, sizeof *frame->screens);
    frame->range_m = malloc(width * sizeof *frame->range_m);
    frame->front = malloc(width * sizeof *frame->front);
    frame->counts = calloc(entities * frame->things + 1, sizeof *frame->counts);
    if (!frame->casts || !frame->screens || !frame->range_m || !frame->front || !frame->counts)
        return error_set(err, ERR_MEMORY, "no memory for the labels of a frame");
    if (in->ground) frame->ground = sight_plane(in->ground->normal, in->ground->offset_m, in->world_from_camera);
    for (; frame->cast_count < entities; frame->cast_count++) {
        const struct entity *entity = &in->entities[frame->cast_count];
        if (!cast_init(&frame->casts[frame->cast_count], tracer, in->camera, in->world_from_camera, entity, err))
            return false;
    }
    for (; frame->screen_count < occluders; frame->screen_count++)
        if (!screen_init(&frame->screens[frame->screen_count], in->camera, in->world_from_camera,
                         &in->occluders[frame->screen_count], err))
            return false;
    if (in->place && !backdrop_init(&frame->backdrop, in->place, in->camera, in->world_from_camera, err)) return false;
    return (occluders == 0 && !in->place) ||
           image_init(&frame->ahead, in->camera->width_px, in->camera->height_px, 1, PIXEL_F32, err);
}

static void frame_release(struct frame *frame)
{
    for (size_t i = 0; i <= frame->cast_count && frame->casts; i++) cast_release(&frame->casts[i]);
    for (size_t i = 0; i <= frame->screen_count && frame->screens; i++) screen_release(&frame->screens[i]);
    rays_release(&frame->rays);
    probes_release(&frame->probes);
    backdrop_release(&frame->backdrop);
    free(frame->casts);
    free(frame->screens);
    free(frame->range_m);
    free(frame->front);
    free(frame->counts);
    image_release(&frame->ahead);
}

/* Every entity's mask and depth in a row, and which is nearest. */
static void trace_row(struct frame *frame, int y)
{
    for (int x = 0; x < frame->rays.camera->width_px; x++) {
        frame->range_m[x] = INFINITY;
        frame->front[x] = -1;
    }
    for (size_t i = 0; i < frame->cast_count; i++) {
        struct cast *cast = &frame->casts[i];
        struct rect r = cast->frame_px;
        if (y < r.y0 || y >= r.y1) continue;
        size_t row = (size_t)(y - r.y0) * (size_t)(r.x1 - r.x0);
        cast_probe(&frame->probes, cast, &frame->rays, r.x0, r.x1, 1);
        for (size_t k = 0; k < frame->probes.n; k++) {
            int x = frame->probes.x[k];
            double range = frame->probes.range_m[k];
            if (!isfinite(range)) continue;
            cast->mask[row + (size_t)(x - r.x0)] = 1;
            cast->depth_m[row + (size_t)(x - r.x0)] = (float)(range * frame->probes.z[k]);
            if (range < frame->range_m[x]) {
                frame->range_m[x] = range;
                frame->front[x] = (ptrdiff_t)i;
            }
        }
    }
    if (frame->ahead.data)
        for (int x = 0; x < frame->rays.camera->width_px; x++)
            *image_f32(&frame->ahead, x, y) = (float)frame->range_m[x];
}

/* The place, in front of a row's entities or behind them. */
static void place_row(struct frame *frame, int y)
{
    struct backdrop *backdrop = &frame->backdrop;
    backdrop_row(backdrop, &frame->rays);
    struct vec3 eye = backdrop->world_from_camera.translation;
    for (int x = 0; x < backdrop->width_px; x++) {
        struct vec3 direction;
        double range = (double)*image_f32(&backdrop->range, x, y);
        if (frame->front[x] < 0 || range >= frame->range_m[x] || !rays_get(&frame->rays, &direction, x)) continue;
        direction = backdrop_direction(backdrop, direction);
        struct sighted entity = { vec3_add(eye, vec3_scale(direction, frame->range_m[x])), frame->range_m[x], 0 };
        if (!backdrop_hides(backdrop, direction, range, backdrop->triangle[(size_t)y * (size_t)backdrop->width_px + (size_t)x],
                            &entity))
            continue;
        frame->range_m[x] = range;
        frame->front[x] = (ptrdiff_t)frame->things - 1;
    }
}

/* What screens put in front of a row's entities. */
static void screen_row(struct frame *frame, int y)
{
    for (size_t k = 0; k < frame->screen_count; k++) {
        struct screen *screen = &frame->screens[k];
        struct rect r = screen->bounds_px;
        if (y < r.y0 || y >= r.y1) continue;
        polygon_row_centres(&screen->polygon, screen->inside, y, r.x0, r.x1);
        for (int x = r.x0; x < r.x1; x++) {
            struct vec3 direction;
            if (!screen->inside[x - r.x0] || frame->front[x] < 0 || !rays_get(&frame->rays, &direction, x)) continue;
            double range = sight_range(screen->plane, direction);
            if (range < frame->range_m[x]) {
                frame->range_m[x] = range;
                frame->front[x] = (ptrdiff_t)(frame->cast_count + k);
            }
        }
    }
}

/* The finished row: whose pixel it is, and what every entity there lies behind. */
static void label_row(struct frame *frame, struct frame_labels *labels, int y)
{
    for (int x = 0; x < labels->depth.width_px; x++) *image_f32(&labels->depth, x, y) = NAN;
    for (size_t i = 0; i < frame->cast_count; i++) {
        const struct cast *cast = &frame->casts[i];
        struct rect r = cast->frame_px;
        if (y < r.y0 || y >= r.y1) continue;
        size_t row = (size_t)(y - r.y0) * (size_t)(r.x1 - r.x0);
        struct entity_labels *out = &labels->entities[i];
        for (int x = r.x0; x < r.x1; x++) {
            size_t at = row + (size_t)(x - r.x0);
            if (!cast->mask[at]) continue;
            rect_add(&out->mask_px, x, y, 1);
            frame->counts[i * frame->things + (size_t)frame->front[x]]++;
            if ((size_t)frame->front[x] != i) continue;
            *image_u16(&labels->instance, x, y) = frame->entities[i].id;
            *image_f32(&labels->depth, x, y) = cast->depth_m[at];
            rect_add(&out->box_visible_px, x, y, 1);
            out->pixels_visible++;
        }
    }
}

static int by_pixels(const void *a, const void *b)
{
    const struct hider *x = a, *y = b;
    return x->pixels != y->pixels ? (x->pixels < y->pixels) - (x->pixels > y->pixels)
                                  : (x->id > y->id) - (x->id < y->id);
}

static bool list_hiders(const struct frame *frame, struct entity_labels *out, size_t index, struct error *err)
{
    size_t things = frame->things, n = 0;
    const int64_t *counts = &frame->counts[index * things];
    out->hiders = calloc(things, sizeof *out->hiders);
    if (!out->hiders) return error_set(err, ERR_MEMORY, "no memory for the labels of a frame");
    for (size_t k = 0; k < things; k++) {
        if (k == index || counts[k] == 0) continue;
        struct hider *hider = &out->hiders[n++];
        if (k < frame->cast_count)
            *hider = (struct hider){ HIDER_ENTITY, frame->entities[k].id, frame->entities[k].name, counts[k] };
        else if (k + 1 < things)
            *hider = (struct hider){ HIDER_OCCLUDER, 0, frame->screens[k - frame->cast_count].occluder->name, counts[k] };
        else
            *hider = (struct hider){ HIDER_PLACE, 0, "place", counts[k] };
    }
    out->hider_count = n;
    qsort(out->hiders, n, sizeof *out->hiders, by_pixels);
    return true;
}

static bool finish_entity(const struct frame *frame, struct entity_labels *out, size_t index, struct error *err)
{
    for (size_t k = 0; k < frame->things; k++) out->pixels_amodal += frame->counts[index * frame->things + k];
    const struct cast *cast = &frame->casts[index];
    out->in_frame = out->pixels_amodal > 0;
    out->pixels_total = out->pixels_amodal + cast->outside;
    out->box_amodal_px = rect_intersect(rect_unite(out->mask_px, cast->outside_px), cast->reach_px);
    out->visible_fraction = out->pixels_amodal > 0 ? (double)out->pixels_visible / (double)out->pixels_amodal : 0;
    out->truncation = out->pixels_total > 0 ? 1 - (double)out->pixels_amodal / (double)out->pixels_total : 1;
    if (!out->in_frame) return true;
    return list_hiders(frame, out, index, err) && cast_crop(cast, out, err);
}

static bool find_shares(struct frame_labels *labels, struct frame *frame, const struct trace_input *in, struct error *err)
{
    struct rect *entity_px = calloc(frame->cast_count + 1, sizeof *entity_px);
    if (!entity_px) return error_set(err, ERR_MEMORY, "no memory for the labels of a frame");
    for (size_t i = 0; i < frame->cast_count; i++) entity_px[i] = frame->casts[i].frame_px;
    struct share_input shares = {
        .rays = &frame->rays, .screens = frame->screens, .screen_count = frame->screen_count, .ground = frame->ground,
        .backdrop = in->place ? &frame->backdrop : NULL, .receivers = in->receivers, .receiver_count = in->receiver_count,
        .ahead = &frame->ahead, .entity_px = entity_px, .entity_count = frame->cast_count,
    };
    bool ok = shares_trace(&labels->visible, &labels->receiver, &shares, err);
    free(entity_px);
    return ok;
}

/* Give an image away. */
static struct image take(struct image *image)
{
    struct image taken = *image;
    *image = (struct image){ 0 };
    return taken;
}

bool trace_frame(struct frame_labels *labels, struct tracer *tracer, const struct trace_input *in, struct error *err)
{
    struct frame frame = { 0 };
    struct frame_labels out = { 0 };
    bool ok = false;
    const struct camera *camera = in->camera;
    if (!frame_init(&frame, tracer, in, err) ||
        !image_init(&out.instance, camera->width_px, camera->height_px, 1, PIXEL_U16, err) ||
        !image_init(&out.depth, camera->width_px, camera->height_px, 1, PIXEL_F32, err))
        goto out;
    out.entities = calloc(in->entity_count + 1, sizeof *out.entities);
    if (!out.entities) {
        error_set(err, ERR_MEMORY, "no memory for the labels of a frame");
        goto out;
    }
    out.entity_count = in->entity_count;
    for (int y = -camera->height_px; y < 2 * camera->height_px; y++) {
        rays_begin_row(&frame.rays, y);
        if (y >= 0 && y < camera->height_px) {
            trace_row(&frame, y);
            if (in->place) place_row(&frame, y);
            screen_row(&frame, y);
            label_row(&frame, &out, y);
        }
        for (size_t i = 0; i < frame.cast_count; i++) cast_outside_row(&frame.casts[i], &frame.probes, &frame.rays);
    }
    for (size_t i = 0; i < in->entity_count; i++)
        if (!finish_entity(&frame, &out.entities[i], i, err)) goto out;
    if (frame.ahead.data && !find_shares(&out, &frame, in, err)) goto out;
    out.place_depth = take(&frame.backdrop.depth);
    out.place_label = take(&frame.backdrop.label);
    *labels = out;
    ok = true;
out:
    if (!ok) frame_labels_release(&out);
    frame_release(&frame);
    return ok;
}

void frame_labels_release(struct frame_labels *labels)
{
    image_release(&labels->instance);
    image_release(&labels->depth);
    image_release(&labels->visible);
    image_release(&labels->receiver);
    image_release(&labels->place_depth);
    image_release(&labels->place_label);
    for (size_t i = 0; i < labels->entity_count; i++) {
        free(labels->entities[i].hiders);
        free(labels->entities[i].mask);
        free(labels->entities[i].depth_m);
    }
    free(labels->entities);
    *labels = (struct frame_labels){ 0 };
}

#include "gen/trace/trace.h"

#include "gen/trace/footprint.h"
#include "gen/trace/rays.h"
#include "gen/trace/screen.h"
#include "gen/trace/shape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define OUTSIDE_RAYS 4000000.0 /* at most about so many for what of an entity lies outside the photograph */

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

static const struct shape *tracer_shape(const struct tracer *tracer, const struct model *model)
{
    for (size_t i = 0; i < tracer->n; i++)
        if (shape_model(tracer->shapes[i]) == model) return tracer->shapes[i];
    return NULL;
}

/* An entity in this frame. */
struct cast {
    const struct shape *shape;
    struct shape *own;    /* the shape, where the tracer does not hold it */
    struct pose entity_from_camera;
    struct rect reach_px; /* where it can be, beyond the photograph as well */
    struct rect frame_px; /* the part of that inside the photograph */
    uint8_t *mask;        /* (h,w) of frame_px */
    float *depth_m;
    int stride_px;   /* each ray outside stands for stride x stride pixels */
    int64_t outside; /* amodal pixels outside */
    struct rect outside_px;
};

struct frame {
    struct rays rays;
    const struct entity *entities;
    struct cast *casts;
    size_t cast_count;
    struct screen *screens;
    size_t screen_count;
    struct sight_plane ground;
    double *range_m;       /* (width) of the nearest entity in a row */
    struct vec3 *probe;    /* (3 width) directions of rays at an entity, in its coordinates */
    double *probe_z;       /* the same rays' z in the camera */
    double *probe_range_m; /* where they meet it */
    int *probe_x;
    ptrdiff_t *front;   /* (width) what is in front: -1, an entity, or cast_count + a screen */
    int64_t *counts;    /* (cast_count, cast_count + screen_count): pixels of an entity by what is in front there */
    struct image ahead; /* F32 1, only with screens: range of the nearest entity, infinite where there is none */
};

/* Grow a rectangle to hold side x side pixels from (x, y) on as well. */
static void rect_add(struct rect *r, int x, int y, int side)
{
    *r = rect_unite(*r, (struct rect){ x, y, x + side, y + side });
}

static bool cast_init(struct cast *cast, const struct tracer *tracer, const struct camera *camera,
                      struct pose world_from_camera, const struct entity *entity, struct error *err)
{
    cast->shape = tracer_shape(tracer, entity->model);
    if (!cast->shape) {
        if (!shape_create(&cast->own, tracer->device, entity->model, err)) return false;
        cast->shape = cast->own;
    }
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

static bool frame_init(struct frame *frame, const struct tracer *tracer, const struct trace_input *in, struct error *err)
{
    size_t width = (size_t)in->camera->width_px, entities = in->entity_count, occluders = in->occluder_count;
    if (!rays_init(&frame->rays, in->camera, err)) return false;
    frame->entities = in->entities;
    frame->casts = calloc(entities + 1, sizeof *frame->casts);
    frame->screens = calloc(occluders + 1, sizeof *frame->screens);
    frame->range_m = malloc(width * sizeof *frame->range_m);
    frame->front = malloc(width * sizeof *frame->front);
    frame->counts = calloc(entities * (entities + occluders) + 1, sizeof *frame->counts);
    frame->probe = malloc(3 * width * sizeof *frame->probe);
    frame->probe_z = malloc(3 * width * sizeof *frame->probe_z);
    frame->probe_range_m = malloc(3 * width * sizeof *frame->probe_range_m);
    frame->probe_x = malloc(3 * width * sizeof *frame->probe_x);
    if (!frame->casts || !frame->screens || !frame->range_m || !frame->front || !frame->counts || !frame->probe ||
        !frame->probe_z || !frame->probe_range_m || !frame->probe_x)
        return error_set(err, ERR_MEMORY, "no memory for the labels of a frame");
    frame->ground = sight_plane(in->ground->normal, in->ground->offset_m, in->world_from_camera);
    frame->cast_count = entities;
    for (size_t i = 0; i < entities; i++)
        if (!cast_init(&frame->casts[i], tracer, in->camera, in->world_from_camera, &in->entities[i], err)) return false;
    frame->screen_count = occluders;
    for (size_t i = 0; i < occluders; i++)
        if (!screen_init(&frame->screens[i], in->camera, in->world_from_camera, &in->occluders[i], err)) return false;
    return occluders == 0 || image_init(&frame->ahead, in->camera->width_px, in->camera->height_px, 1, PIXEL_F32, err);
}

static void frame_release(struct frame *frame)
{
    for (size_t i = 0; i < frame->cast_count; i++) {
        shape_destroy(frame->casts[i].own);
        free(frame->casts[i].mask);
        free(frame->casts[i].depth_m);
    }
    for (size_t i = 0; i < frame->screen_count; i++) screen_release(&frame->screens[i]);
    rays_release(&frame->rays);
    free(frame->probe);
    free(frame->probe_z);
    free(frame->probe_range_m);
    free(frame->probe_x);
    free(frame->casts);
    free(frame->screens);
    free(frame->range_m);
    free(frame->front);
    free(frame->counts);
    image_release(&frame->ahead);
}

/* Rays at one entity, at every stride-th pixel from x0 on in the row that frame->rays is at: fills the probes. */
static size_t probe_row(struct frame *frame, const struct cast *cast, int x0, int x1, int stride)
{
    size_t n = 0;
    for (int x = x0; x < x1; x += stride) {
        struct vec3 direction;
        if (!rays_get(&frame->rays, &direction, x)) continue;
        frame->probe_x[n] = x;
        frame->probe_z[n] = direction.z;
        frame->probe[n++] = mat3_apply(cast->entity_from_camera.rotation, direction);
    }
    shape_hits(cast->shape, frame->probe_range_m, cast->entity_from_camera.translation, frame->probe, n);
    return n;
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
        size_t n = probe_row(frame, cast, r.x0, r.x1, 1);
        for (size_t k = 0; k < n; k++) {
            int x = frame->probe_x[k];
            double range = frame->probe_range_m[k];
            if (!isfinite(range)) continue;
            cast->mask[row + (size_t)(x - r.x0)] = 1;
            cast->depth_m[row + (size_t)(x - r.x0)] = (float)(range * frame->probe_z[k]);
            if (range < frame->range_m[x]) {
                frame->range_m[x] = range;
                frame->front[x] = (ptrdiff_t)i;
            }
        }
    }
    if (frame->screen_count > 0)
        for (int x = 0; x < frame->rays.camera->width_px; x++)
            *image_f32(&frame->ahead, x, y) = (float)frame->range_m[x];
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
    size_t things = frame->cast_count + frame->screen_count;
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
            frame->counts[i * things + (size_t)frame->front[x]]++;
            if ((size_t)frame->front[x] != i) continue;
            *image_u16(&labels->instance, x, y) = frame->entities[i].id;
            *image_f32(&labels->depth, x, y) = cast->depth_m[at];
            rect_add(&out->box_visible_px, x, y, 1);
            out->pixels_visible++;
        }
    }
}

/* A row's amodal pixels above, below and beside the photograph. */
static void trace_outside(struct frame *frame, int y)
{
    int width = frame->rays.camera->width_px, height = frame->rays.camera->height_px;
    bool beside = y >= 0 && y < height;
    for (size_t i = 0; i < frame->cast_count; i++) {
        struct cast *cast = &frame->casts[i];
        struct rect reach = cast->reach_px;
        if (y < reach.y0 || y >= reach.y1 || (y - reach.y0) % cast->stride_px != 0) continue;
        int spans[2][2] = { { reach.x0, beside && reach.x1 > 0 ? 0 : reach.x1 },
                            { reach.x0 > width ? reach.x0 : width, beside ? reach.x1 : 0 } };
        for (int s = 0; s < 2; s++) {
            size_t n = probe_row(frame, cast, spans[s][0], spans[s][1], cast->stride_px);
            for (size_t k = 0; k < n; k++) {
                if (!isfinite(frame->probe_range_m[k])) continue;
                rect_add(&cast->outside_px, frame->probe_x[k], y, cast->stride_px);
                cast->outside += (int64_t)cast->stride_px * cast->stride_px;
            }
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
    size_t things = frame->cast_count + frame->screen_count, n = 0;
    const int64_t *counts = &frame->counts[index * things];
    out->hiders = calloc(things, sizeof *out->hiders);
    if (!out->hiders) return error_set(err, ERR_MEMORY, "no memory for the labels of a frame");
    for (size_t k = 0; k < things; k++) {
        if (k == index || counts[k] == 0) continue;
        out->hiders[n++] = k < frame->cast_count
                               ? (struct hider){ HIDER_ENTITY, frame->entities[k].id, frame->entities[k].name, counts[k] }
                               : (struct hider){ HIDER_OCCLUDER, 0, frame->screens[k - frame->cast_count].occluder->name, counts[k] };
    }
    out->hider_count = n;
    qsort(out->hiders, n, sizeof *out->hiders, by_pixels);
    return true;
}

/* Keep of an entity's mask and depth what its pixels need. */
static bool crop(const struct cast *cast, struct entity_labels *out, struct error *err)
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

static bool finish_entity(const struct frame *frame, struct entity_labels *out, size_t index, struct error *err)
{
    size_t things = frame->cast_count + frame->screen_count;
    for (size_t k = 0; k < things; k++) out->pixels_amodal += frame->counts[index * things + k];
    const struct cast *cast = &frame->casts[index];
    out->in_frame = out->pixels_amodal > 0;
    out->pixels_total = out->pixels_amodal + cast->outside;
    out->box_amodal_px = rect_intersect(rect_unite(out->mask_px, cast->outside_px), cast->reach_px);
    out->visible_fraction = out->pixels_amodal > 0 ? (double)out->pixels_visible / (double)out->pixels_amodal : 0;
    out->truncation = out->pixels_total > 0 ? 1 - (double)out->pixels_amodal / (double)out->pixels_total : 1;
    if (!out->in_frame) return true;
    return list_hiders(frame, out, index, err) && crop(cast, out, err);
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
            screen_row(&frame, y);
            label_row(&frame, &out, y);
        }
        trace_outside(&frame, y);
    }
    for (size_t i = 0; i < in->entity_count; i++)
        if (!finish_entity(&frame, &out.entities[i], i, err)) goto out;
    if (in->occluder_count > 0 && !screens_share(&out.visible, &out.receiver, frame.screens, frame.screen_count,
                                             &frame.rays, &frame.ahead, frame.ground, err))
        goto out;
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
    for (size_t i = 0; i < labels->entity_count; i++) {
        free(labels->entities[i].hiders);
        free(labels->entities[i].mask);
        free(labels->entities[i].depth_m);
    }
    free(labels->entities);
    *labels = (struct frame_labels){ 0 };
}

/* Labels by ray casting through the photograph's own lens: one ray a pixel centre,
 * one owner a pixel. Embree over each model once; rays are taken into entity space. */
#ifndef STAFFAGE_GEN_TRACE_H
#define STAFFAGE_GEN_TRACE_H

#include "gen/entity.h"
#include "lib/camera.h"
#include "lib/image.h"
#include "lib/view.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Search trees over models: one a model, shared by its entities. */
struct tracer;
bool tracer_create(struct tracer **tracer, const struct model *const *models, size_t n, struct error *err);
void tracer_destroy(struct tracer *tracer);

/* A static thing that stands before part of the picture: a polygon in the photograph, upright at
 * a ground point. It hides what lies further (camera z at that pixel, vertical plane through the
 * foot facing the camera). */
struct occluder {
    const char *name;             /* borrowed */
    const struct vec2 *polygon_px;
    size_t polygon_count;
    struct vec3 foot_m;           /* world */
};

/* Who hides part of an entity. */
struct hider { uint16_t id; /* 0: an occluder */ const char *name; int64_t pixels; };

struct entity_labels {
    bool in_frame;                /* any amodal pixel inside the photograph */
    struct rect box_visible_px, box_amodal_px; /* half open; box_amodal over the whole plane, not cut by the frame */
    int64_t pixels_visible, pixels_amodal;     /* inside the photograph */
    int64_t pixels_total;         /* amodal, with those outside the photograph */
    double visible_fraction;      /* visible / amodal (inside) */
    double truncation;            /* 1 - amodal inside / total */
    struct hider *hiders;         /* most pixels first */
    size_t hider_count;
    struct rect mask_px;          /* part of the photograph that mask and depth cover */
    uint8_t *mask;                /* amodal, (h,w) of mask_px, 0 or 1 */
    float *depth_m;               /* amodal z, (h,w) of mask_px, NaN outside the mask */
};

struct frame_labels {
    struct image instance;        /* U16 1: entity id, 0 none */
    struct image depth;           /* F32 1: z of the visible entity, NaN elsewhere */
    struct image visible;         /* U8 1: 255 x share of an entity seen at this pixel that no occluder hides; empty without occluders */
    struct image receiver;        /* U8 1: the same for the ground; empty without occluders */
    struct entity_labels *entities; /* (n) in the order of the entities */
    size_t entity_count;
};

/* Err: ERR_MEMORY; labels untouched on failure. Embree's own threads are not used: one core a process. */
bool trace_frame(struct frame_labels *labels, struct tracer *tracer, const struct camera *camera,
                 struct pose world_from_camera, const struct plane *ground,
                 const struct entity *entities, size_t entity_count,
                 const struct occluder *occluders, size_t occluder_count, struct error *err);
void frame_labels_release(struct frame_labels *labels);

#endif

/* Labels by ray casting through the photograph's own lens: one ray a pixel centre,
 * one owner a pixel. Embree over each model once; rays are taken into entity space. */
#ifndef STAFFAGE_GEN_TRACE_H
#define STAFFAGE_GEN_TRACE_H

#include "gen/world/entity.h"
#include "gen/world/static_mesh.h"
#include "gen/trace/shape.h"
#include "lib/camera.h"
#include "lib/image.h"
#include "lib/view.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* An entity's soft edge in a rendered picture lies within so many pixels of those that it owns. */
#define EDGE_PX 2

/* Search trees over models: one a model, shared by its entities. */
struct tracer;
/* The models are borrowed and must outlive the tracer. Err: ERR_MEMORY */
bool tracer_create(struct tracer **tracer, const struct model *const *models, size_t n, struct error *err);
void tracer_destroy(struct tracer *tracer);
/* The search tree over a model; one that is not the tracer's (posed for a frame) gets its own.
 * Out: *own: NULL, or what the caller destroys
 * Err: ERR_MEMORY */
bool tracer_shape(const struct shape **shape, struct shape **own, const struct tracer *tracer, const struct model *model,
                  struct error *err);

/* A static thing that stands before part of the picture: a polygon in the photograph (even-odd
 * rule), upright at a ground point. It stands in the vertical plane through its foot that faces
 * the camera, and hides what the ray through a pixel's centre meets beyond that plane. */
struct occluder {
    const char *name;             /* borrowed */
    const struct vec2 *polygon_px;
    size_t polygon_count;
    struct vec3 foot_m;           /* world */
};

/* Who hides part of an entity: a pixel counts for the one thing that is nearest there. So an
 * entity's visible pixels and its hiders' pixels add up to its amodal pixels in the photograph. */
enum hider_kind { HIDER_ENTITY, HIDER_OCCLUDER, HIDER_PLACE };
struct hider { enum hider_kind kind; uint16_t id; /* of an entity, else 0 */ const char *name; /* of the place: "place" */ int64_t pixels; };

struct entity_labels {
    bool in_frame;                /* any amodal pixel inside the photograph */
    struct rect box_visible_px, box_amodal_px; /* half open; empty (all 0) when there is none; box_amodal
                                   * reaches as far as pixels_total counts */
    int64_t pixels_visible, pixels_amodal;     /* inside the photograph */
    int64_t pixels_total;         /* amodal, with those outside the photograph, up to one picture beyond each side
                                   * and as far as the lens has rays; an area outside of more than 4 Mpx
                                   * is sampled, every stride-th pixel of every stride-th row */
    double visible_fraction;      /* visible / amodal (inside); 0 when nothing is inside */
    double truncation;            /* 1 - amodal inside / total; 1 when nothing is inside */
    struct hider *hiders;         /* most pixels first */
    size_t hider_count;
    struct rect mask_px;          /* part of the photograph that mask and depth cover */
    uint8_t *mask;                /* amodal, (h,w) of mask_px, 0 or 1 */
    float *depth_m;               /* amodal z, (h,w) of mask_px, NaN outside the mask */
};

struct frame_labels {
    struct image instance;        /* U16 1: entity id, 0 none */
    struct image depth;           /* F32 1: z of the visible entity, NaN elsewhere */
    struct image visible;         /* U8 1: 255 x share (8 x 8 samples) of the entity at this pixel, or of that at the nearest
                                   * pixel at most EDGE_PX away, that nothing static hides; 255 elsewhere; empty without
                                   * occluders and place */
    struct image receiver;        /* U8 1: the same for what receives shadows: the ground plane, or the place within
                                   * the receivers; empty without occluders and place */
    struct image place_depth;     /* F32 1: z of the place, whatever entity is before it, NaN where there is none;
                                   * empty without a place */
    struct image place_label;     /* U8 1: label of the place's face there, 0 without; empty unless it has labels */
    struct entity_labels *entities; /* (n) in the order of the entities */
    size_t entity_count;
};

/* What a frame shows. All borrowed. */
struct trace_input {
    const struct camera *camera;
    struct pose world_from_camera;
    const struct entity *entities;      /* one whose model is not the tracer's (posed for this frame) is indexed here */
    size_t entity_count;
    const struct occluder *occluders;
    size_t occluder_count;
    const struct plane *ground;         /* what receives shadows, without a place */
    const struct static_mesh *place;    /* NULL: none. It hides entities, and receives shadows within `receivers` */
    const struct prism *receivers;      /* (receiver_count) */
    size_t receiver_count;
};

/* A pixel belongs to the nearest entity that its ray meets, unless an occluder or the place is nearer.
 * Err: ERR_MEMORY; ERR_INPUT: an occluder's foot right below or above the camera; labels untouched on
 *      failure. Embree's own threads are not used: one core a process. */
bool trace_frame(struct frame_labels *labels, struct tracer *tracer, const struct trace_input *in, struct error *err);
void frame_labels_release(struct frame_labels *labels);

#endif

/* An entity as one frame's rays meet it: where it can be, its mask and its depth. */
#ifndef STAFFAGE_GEN_TRACE_CAST_H
#define STAFFAGE_GEN_TRACE_CAST_H

#include "gen/trace/rays.h"
#include "gen/trace/shape.h"
#include "gen/trace/trace.h"

/* Rays at one entity in one row, and where they meet it. */
struct probes {
    struct vec3 *direction; /* (3 width) in the entity's coordinates */
    double *z;              /* the same rays' z in the camera */
    double *range_m;        /* INFINITY where they meet nothing */
    int *x;
    size_t n;
};
bool probes_init(struct probes *probes, int width_px, struct error *err);
void probes_release(struct probes *probes);

struct cast {
    const struct shape *shape;
    struct shape *own;    /* the shape, where it was made for this frame */
    struct pose entity_from_camera;
    struct rect reach_px; /* where it can be, beyond the photograph as well */
    struct rect frame_px; /* the part of that inside the photograph */
    uint8_t *mask;        /* (h,w) of frame_px */
    float *depth_m;
    int stride_px;   /* each ray outside stands for stride x stride pixels */
    int64_t outside; /* amodal pixels outside */
    struct rect outside_px;
};

/* Err: ERR_MEMORY. cast_release may be called after a failure, too. */
bool cast_init(struct cast *cast, const struct tracer *tracer, const struct camera *camera,
               struct pose world_from_camera, const struct entity *entity, struct error *err);
void cast_release(struct cast *cast);

/* Every stride-th pixel from x0 on in the row that rays is at. */
void cast_probe(struct probes *probes, const struct cast *cast, struct rays *rays, int x0, int x1, int stride);
/* Count a row's amodal pixels above, below and beside the photograph. */
void cast_outside_row(struct cast *cast, struct probes *probes, struct rays *rays);
/* Keep of the mask and the depth what out->mask_px covers. */
bool cast_crop(const struct cast *cast, struct entity_labels *out, struct error *err);

/* Grow a rectangle to hold side x side pixels from (x, y) on as well. */
static inline void rect_add(struct rect *r, int x, int y, int side)
{
    *r = rect_unite(*r, (struct rect){ x, y, x + side, y + side });
}

#endif

/* The place as one picture sees it: what the ray through each pixel's centre meets of the static mesh. */
#ifndef STAFFAGE_GEN_TRACE_BACKDROP_H
#define STAFFAGE_GEN_TRACE_BACKDROP_H

#include "gen/trace/rays.h"
#include "gen/world/static_mesh.h"
#include "lib/camera.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stdint.h>

/* What lies less than this in front of an entity, or less than this above its surface, is what it stands on. */
#define BACKDROP_CONTACT_M 0.03

struct backdrop {
    const struct static_mesh *place; /* borrowed */
    struct pose world_from_camera;
    double pixel_rad;                /* between neighbouring pixels */
    int width_px;
    struct image range;              /* F32 1: INFINITY where there is nothing */
    struct image depth;              /* F32 1: z, NaN where there is nothing */
    struct image label;              /* U8 1, 0 where there is none; empty unless the place has labels */
    uint32_t *triangle;              /* (h,w) */
    struct vec3 *direction;          /* (width) a row's rays, world */
    struct static_hit *hit;
    double *cosine;                  /* from range to z */
    int *x;
};

/* Err: ERR_MEMORY. backdrop_release may be called after a failure, too. */
bool backdrop_init(struct backdrop *backdrop, const struct static_mesh *place, const struct camera *camera,
                   struct pose world_from_camera, struct error *err);
void backdrop_release(struct backdrop *backdrop);

/* Trace the row that rays is at. */
void backdrop_row(struct backdrop *backdrop, struct rays *rays);

struct vec3 backdrop_direction(const struct backdrop *backdrop, struct vec3 camera_direction);
/* The place's point that a pixel sees. False where there is none. */
bool backdrop_point(const struct backdrop *backdrop, struct vec3 *p_m, struct vec3 camera_direction, int x, int y);

/* A point of an entity that a ray towards it is held against. */
struct sighted {
    struct vec3 point_m; /* world */
    double range_m;
    double beside_px;    /* how far the ray may pass beside it */
};
/* Does the place, met by a ray at `range_m` on `triangle`, hide the point? A road does not hide the wheels that stand on it,
 * even where the mesh lies some millimetres higher: see BACKDROP_CONTACT_M. */
bool backdrop_hides(const struct backdrop *backdrop, struct vec3 direction, double range_m, uint32_t triangle,
                    const struct sighted *point);

#endif

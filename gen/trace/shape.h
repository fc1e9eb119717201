/* A model as rays meet it: Embree's search tree over its triangles, both sides
 * solid. Texels of MASK materials below the cutoff are not there. */
#ifndef STAFFAGE_GEN_SHAPE_H
#define STAFFAGE_GEN_SHAPE_H

#include "gen/model/model.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <embree3/rtcore.h>
#include <stdbool.h>

struct shape;

/* model is borrowed and must outlive the shape.
 * Err: ERR_MEMORY */
bool shape_create(struct shape **shape, RTCDevice device, const struct model *model, struct error *err);
void shape_destroy(struct shape *shape);

const struct model *shape_model(const struct shape *shape);
/* The box around the triangles, model coordinates. False for a model without any. */
bool shape_bounds(const struct shape *shape, struct vec3 *min_m, struct vec3 *max_m);

/* Where rays first meet the model.
 * Out: range_m (n) along each ray, > 0; INFINITY where it meets nothing
 * In:  origin_m, directions (n) unit, in model coordinates; neighbours in the list had better be neighbours in space */
void shape_hits(const struct shape *shape, double *range_m, struct vec3 origin_m, const struct vec3 *directions,
                size_t n);

/* Where a ray first meets the model: on a triangle of a mesh, at the weights u and v of its second and third corner. */
struct shape_point { unsigned mesh, triangle; double range_m, u, v; };
/* direction unit, in model coordinates; what lies nearer than 1 mm does not count. False: it meets nothing. */
bool shape_meet(const struct shape *shape, struct shape_point *point, struct vec3 origin_m, struct vec3 direction);

/* Take from light what the model stops of it: all, but for holes and what is transparent.
 * In/out: share (n) times what passes along each ray; a ray whose share is 0 costs nothing
 * In:     origin_m, directions (n) unit, in model coordinates; what lies nearer than 1 mm does not count */
void shape_shade(const struct shape *shape, float *share, struct vec3 origin_m, const struct vec3 *directions, size_t n);

#endif

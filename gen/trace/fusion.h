/* What semantic images of a place say of the faces of its mesh. */
#ifndef STAFFAGE_GEN_FUSION_H
#define STAFFAGE_GEN_FUSION_H

#include "gen/world/static_mesh.h"
#include "lib/camera.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stddef.h>
#include <stdint.h>

/* Votes. */
struct fusion;

/* mesh: indexed, borrowed. Err: ERR_MEMORY */
bool fusion_create(struct fusion **fusion, const struct static_mesh *mesh, struct error *err);
void fusion_destroy(struct fusion *fusion);

/* The ray through each pixel's centre votes for the face that it meets, with the cosine of the angle at which
 * it does; a pixel beside one of another label counts a quarter.
 * In: ids U8 1, of the camera's size; STATIC_LABEL_UNKNOWN has no vote */
bool fusion_add(struct fusion *fusion, const struct image *ids, const struct camera *camera,
                struct pose world_from_camera, struct error *err);

struct fusion_counts { size_t voted, filled, unknown; };
/* A face gets the label of most of its votes, where it has FUSION_SUPPORT pixels' worth and more than half of
 * them agree. The others take that of the nearest such face along the surface (over a crease it is farther),
 * at most fill_m away, or STATIC_LABEL_UNKNOWN.
 * Out: label (triangles) */
#define FUSION_SUPPORT 0.5
bool fusion_decide(const struct fusion *fusion, uint8_t *label, struct fusion_counts *counts, double fill_m,
                   struct error *err);

#endif

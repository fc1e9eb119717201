/* The part of a photograph in which a box can be seen, through any lens. */
#ifndef STAFFAGE_GEN_FOOTPRINT_H
#define STAFFAGE_GEN_FOOTPRINT_H

#include "gen/world/static_mesh.h"
#include "lib/camera.h"
#include "lib/vec.h"
#include "lib/rect.h"

/* A rectangle within `limits_px` (which may reach beyond the photograph) that covers every
 * pixel whose ray meets the box; at most some pixels larger than needed as long as the whole
 * box lies before the lens. Empty (all 0) when nothing of the box is seen.
 * In: box min_m, max_m in its own coordinates */
struct rect footprint(const struct camera *camera, struct pose camera_from_box, struct vec3 min_m, struct vec3 max_m,
                      struct rect limits_px);
/* The same for a prism in world coordinates, within the photograph. */
struct rect footprint_prism(const struct camera *camera, struct pose camera_from_world, const struct prism *prism);

#endif

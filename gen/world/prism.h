/* What lies in or reaches into a prism (gen/world/static_mesh.h). */
#ifndef STAFFAGE_GEN_PRISM_H
#define STAFFAGE_GEN_PRISM_H

#include "gen/world/static_mesh.h"
#include "lib/vec.h"

#include <stdbool.h>

struct box3 { double low[3], high[3]; };

/* The box around it. */
struct box3 prism_bounds(const struct prism *prism);
/* Is the point within it or on its border? */
bool prism_contains(const struct prism *prism, struct vec3 p_m);
/* Exact: has the triangle a point within the prism or on its border? */
bool prism_meets_triangle(const struct prism *prism, const float *const corner_m[3]);
/* False only where no point of the box is within. */
bool prism_may_meet_box(const struct prism *prism, const struct box3 *box);

#endif

/* What reaches into a prism (gen/world/static_mesh.h). */
#ifndef STAFFAGE_GEN_PRISM_H
#define STAFFAGE_GEN_PRISM_H

#include "gen/world/static_mesh.h"

#include <stdbool.h>

struct box3 { double low[3], high[3]; };

/* Exact: has the triangle a point within the prism or on its border? */
bool prism_meets_triangle(const struct prism *prism, const float *const corner_m[3]);
/* False only where no point of the box is within. */
bool prism_may_meet_box(const struct prism *prism, const struct box3 *box);

#endif

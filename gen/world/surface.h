/* What entities stand on: a plane, or ribbons over the static mesh. */
#ifndef STAFFAGE_GEN_SURFACE_H
#define STAFFAGE_GEN_SURFACE_H

#include "gen/world/ground.h"
#include "gen/world/ribbon.h"
#include "gen/world/static_mesh.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

struct surface {
    bool has_mesh;
    struct plane plane;               /* without a mesh */
    const struct static_mesh *mesh;   /* indexed; the rest is borrowed, too */
    const struct ribbon *ribbons;
    size_t ribbon_count;
};

/* Height and unit upward normal at (x, y); on the mesh beside the ribbons the normal is that of a
 * plane through the heights within half a metre. False over a hole of the mesh. */
bool surface_at(const struct surface *surface, double *z_m, struct vec3 *normal, double x_m, double y_m);
/* Stand a body of this length and width (wheelbase and track: pitch and roll; 0, 0 for people, who stand
 * upright) at (x, y) with a heading clockwise from +y. False over a hole. */
bool surface_stand(const struct surface *surface, struct pose *world_from_body, double x_m, double y_m,
                   double heading_rad, double length_m, double width_m);
/* Where a ray first meets the surface. */
bool surface_intersect(const struct surface *surface, struct vec3 *p_m, struct vec3 origin_m, struct vec3 direction);

#endif

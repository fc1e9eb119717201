/* The ground round entities as a mesh that knows the sky's light at its vertices, fine where shade is: what the plane
 * and shadow passes render. */
#ifndef STAFFAGE_GEN_SHADED_GROUND_H
#define STAFFAGE_GEN_SHADED_GROUND_H

#include "gen/trace/sky_sight.h"
#include "gen/world/ground.h"
#include "gen/world/receiver.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Nothing can keep the sun from any part of it: but for the entities, with them. */
struct sunlit { bool without, with; };

struct shaded_ground {
    struct vec3 *position_m, *normal; /* (vertices) world */
    struct sky_seen *sky;             /* (vertices) after shaded_ground_shade */
    bool *hidden;                     /* (vertices) the same: by an entity, from the eye */
    uint32_t (*triangle)[3];          /* (triangles) */
    struct sunlit *sunlit;            /* (triangles); NULL: not looked at */
    size_t vertices, triangles;
};

/* The part of a plane within receivers, in cells of a lattice that is the world's: an entity that moves leaves the others' as it is.
 * Out: ground; free with shaded_ground_release. Err: ERR_MEMORY */
bool shaded_ground_of_plane(struct shaded_ground *ground, const struct plane *plane, const struct receiver *receivers, size_t n,
                         struct error *err);
/* A cut of the static mesh, with smooth normals. */
bool shaded_ground_of_cut(struct shaded_ground *ground, const struct static_cut *cut, struct error *err);
void shaded_ground_release(struct shaded_ground *ground);
/* The triangles that are taken, or the others, lit as they are. In: taken (triangles). Out: *part, initialized here. Err: ERR_MEMORY */
bool shaded_ground_pick(struct shaded_ground *part, const struct shaded_ground *ground, const bool *taken, bool wanted, struct error *err);

/* Light the vertices, what is wet with what it mirrors to the eye, too, as if it were light that the albedo gives back; and halve edges between whose ends the entities' shade changes, if they can be seen, down to
 * fine_px as seen from an eye whose pixels are pixel_rad wide.
 * Err: ERR_MEMORY */
struct shaded_ground_detail { struct vec3 eye_m; double pixel_rad, fine_px; struct wet wet; double albedo[3]; /* where wet, above 0 */ };
bool shaded_ground_shade(struct shaded_ground *ground, const struct sky_sight *sight, struct shaded_ground_detail detail,
                      struct error *err);

#endif

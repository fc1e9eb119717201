/* What of the sun reaches the ground round the entities, past what stands in the photograph or beside it: a map. */
#ifndef STAFFAGE_GEN_SUN_SHARE_H
#define STAFFAGE_GEN_SUN_SHARE_H

#include "gen/estimate/ground_shade.h"
#include "gen/light/seen.h"
#include "gen/world/entity.h"
#include "gen/world/ground.h"
#include "gen/world/receiver.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

struct sun_share {
    struct image map;          /* U8, 1 channel: 255 in the sun, as it is at the edges and beyond; row 0 is the northmost; empty: all in the sun */
    struct image through;      /* likewise, over a mesh: 255 where the map tells and what the mesh casts counts no more, 0 else and beyond */
    struct vec2 low_m, high_m; /* world x, y of the corners that the map fills, on the plane */
    struct plane ground;       /* the plane; points above and below it are on it where the sun's rays through them meet it */
};

struct sun_share_input {
    const struct ground_shade *shade;
    const struct seen *seen;
    const struct plane *ground;        /* over a mesh a level below the entities */
    const struct receiver *receivers;  /* (n) the map reaches over these: where entities and their shadows are */
    size_t n;
    const struct static_mesh *place;   /* NULL: the ground is the plane; otherwise the rest, too */
    const struct image *place_depth;   /* as orthophoto_input's */
    struct vec3 towards_sun;
    double height_m, top_m;            /* of the tallest entity; of the highest over the plane */
};

/* Ground that something hides is as what it is beside, as is what is neither of the ground's surfaces: markings, drain
 * covers, cars. Beyond the picture shade fades: far out the ground is lit.
 * Over a mesh the map tells where the photograph does, or does round about; elsewhere the mesh's own shade stays. It stays, too,
 * where photograph and mesh have shade and what casts it is lower than the entities: the map keeps the sun from all that is
 * above the ground, the mesh from what is behind it.
 * Out: *share, initialized here; free with sun_share_release
 * Err: ERR_MEMORY */
bool sun_share_create(struct sun_share *share, const struct sun_share_input *in, struct error *err);
void sun_share_release(struct sun_share *share);

/* Sort a cut's triangles by what the map tells of where they can shade: nothing, something or all. */
enum told { TOLD_NOWHERE, TOLD_IN_PART, TOLD, TOLD_KINDS };
/* Out: count of each, in this order; without a map all are of the first */
bool sun_share_part(size_t count[TOLD_KINDS], const struct sun_share *share, struct static_cut *cut, struct vec3 towards_sun, struct error *err);

/* For POV-Ray the map hangs so far up the sun's rays from its ground: above all entities. */
double sun_share_hangs_m(const struct sun_share *share, struct vec3 towards_sun, const struct entity *entities, size_t n);

/* At world x, y of the plane, by the map alone: 0 to 1. */
double sun_share_at(const struct sun_share *share, struct vec2 at_m);
/* At a point above or below it, past a place that does or does not cast shade there; share may be NULL: the place alone counts. */
double sun_share_past(const struct sun_share *share, struct vec3 p_m, struct vec3 towards_sun, bool cast);

#endif

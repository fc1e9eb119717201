/* The ground round the entities, rectified from the picture: how much light it sends back, seen from right above. */
#ifndef STAFFAGE_GEN_ORTHOPHOTO_H
#define STAFFAGE_GEN_ORTHOPHOTO_H

#include "gen/estimate/sun_share.h"
#include "gen/light/light.h"
#include "gen/light/seen.h"
#include "gen/world/entity.h"
#include "gen/world/ground.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stddef.h>

/* Albedo: the radiance that the picture shows over what the sun and the open sky send there; over the sky's part alone
 * where the place keeps the sun away, or what of both is left in shade that the picture tells of. Other real shadows are in it. Ground that the picture does not show is as what it shows beside it. */
struct orthophoto {
    struct image mirrored;    /* U8, 3 channels, sRGB: what mirrors show; row 0 is the northmost */
    struct image bouncing;    /* the same in texels ORTHOPHOTO_COARSE times as large: what the light bounces from */
    struct vec2 low_m, high_m; /* world x, y of the corners that both images fill; the edge texels are of `elsewhere` */
    double elsewhere[3];      /* albedo beyond: the median of the ground that the picture shows */
    double color_gain[3];     /* with a place: radiance for a unit of its own linear colours, 1 / k without common ground */
};
#define ORTHOPHOTO_COARSE 8

struct orthophoto_input {
    const struct seen *seen;
    const struct light *light;
    const struct plane *ground;            /* without a place */
    const struct sun_share *sun;           /* then; NULL: the sun reaches all of it */
    struct wet wet;                        /* what the ground mirrors of the sky is none of its albedo */
    const struct static_mesh *place;       /* NULL: the ground is a plane */
    const struct image *place_depth;       /* F32: z of the place as the picture sees it, NaN where it has none */
    const struct entity *entities;         /* (n) the ground round these, to ORTHOPHOTO_REACH_M from their boxes */
    size_t n;
    double ground_albedo[3];               /* where the picture shows no ground */
};
#define ORTHOPHOTO_REACH_M 12.0

/* So far from an entity's middle, nothing of `elsewhere` is mixed in yet. */
double orthophoto_whole(const struct entity *entity);

/* Out: *orthophoto, initialized here; free with orthophoto_release
 * Err: ERR_MEMORY */
bool orthophoto_create(struct orthophoto *orthophoto, const struct orthophoto_input *in, struct error *err);
void orthophoto_release(struct orthophoto *orthophoto);

#endif

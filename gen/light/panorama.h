/* What stands round the entities, and the sky above it: all directions above the horizon, seen from among them.
 *
 * Over a plane the picture tells no distances. Its ground is taken for ground as far as seen_ground_reach; what it shows
 * beyond stands there, upright, on a circle round the camera, and where the camera does not look the circle goes on
 * with the same mirrored, lit as the side that is seen there. What something hides is filled from beside it. Over a place the
 * rays tell what stands where: as the picture shows it, or else in its own colours; what it shows past the place stands on a
 * circle round all of that. Higher up, and where neither tells, there is the
 * light's sky, with what stands around in it; but nothing stands on what the picture shows to be sky. */
#ifndef STAFFAGE_GEN_PANORAMA_H
#define STAFFAGE_GEN_PANORAMA_H

#include "gen/light/light.h"
#include "gen/light/seen.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

struct panorama {
    struct image radiance;  /* F32, 3 channels, laid out as sky_image.h says; below the horizon the light's own, of a
                             * place that from RELIEF_LOWEST_RAD (relief.h) */
    double radius_m;        /* over a plane: of the circle round the camera on which stands what the picture shows; 0: it shows nothing that stands */
};

struct panorama_input {
    const struct seen *seen;
    const struct light *light;
    struct vec3 from_m;               /* among the entities, at the height of a body */
    double height_m;                  /* of the camera above the ground */
    bool told;                        /* what stands around was told: a sky that is mirrored from elsewhere does not count before it */
    const struct static_mesh *place;  /* NULL: the ground is a plane */
    double beyond_m;                  /* what of the place is nearer, above the ground, is not there: what stands behind it is */
    double past_m;                    /* so far away, level, stands what the picture shows past the place; 0: it shows nothing there */
    const struct image *place_depth;  /* as orthophoto_input */
    double color_gain[3];             /* as the orthophoto's */
};

/* Out: *panorama, initialized here; free with panorama_release
 * Err: ERR_MEMORY */
bool panorama_create(struct panorama *panorama, const struct panorama_input *in, struct error *err);
/* The same at the size of the light's sky, with its ground. Out: lighting, initialized here. Err: ERR_MEMORY */
bool panorama_lighting(struct image *lighting, const struct panorama *panorama, const struct light *light, struct error *err);
void panorama_release(struct panorama *panorama);

#endif

/* The scenes that POV-Ray renders: the object, plane and shadow pass of a frame. */
#ifndef STAFFAGE_GEN_PASSES_H
#define STAFFAGE_GEN_PASSES_H

#include "gen/estimate/sun_share.h"
#include "gen/world/entity.h"
#include "gen/light/light.h"
#include "gen/light/standing.h"
#include "gen/render/model_sdl.h"
#include "gen/trace/shaded_ground.h"
#include "gen/scene/scene.h"
#include "lib/view.h"

#include <stdbool.h>
#include <stddef.h>

/* What rendering at a quality costs and gives. */
struct pass_settings {
    size_t sky_directions;     /* of which the ground's light is made */
    double fine_px;            /* where its shade changes, it is known at points so far apart */
    int radiosity_count;       /* in the object pass */
    double radiosity_error;
    double fineness;           /* of a lens's view, over the photograph */
    /* POV-Ray options. The plane and shadow passes share theirs: along the receivers' edges their ratio
     * is 1 only where both are sampled alike. */
    const char *object_antialias, *receiver_antialias;
};
struct pass_settings pass_settings(enum quality quality);

/* Write the light's sky map under a name made from its content, unless it is there.
 * Out: path, relative to the output folder */
#define SKY_MAP_SIZE 40
bool sky_map_write(char path[SKY_MAP_SIZE], const char *out_folder, const struct light *light, struct error *err);

/* What is round the entities in its own colours, in files: paths relative to the output folder. */
#define SURROUNDINGS_PATH_SIZE 64
struct pass_standing { struct standing thing; char radiance[SURROUNDINGS_PATH_SIZE]; };
struct pass_surroundings {
    char orthophoto[SURROUNDINGS_PATH_SIZE], orthophoto_coarse[SURROUNDINGS_PATH_SIZE];
    struct vec2 low_m, high_m;
    double ground_albedo[3];        /* beyond the orthophoto */
    char sky_map[SURROUNDINGS_PATH_SIZE]; /* "": the light's sky */
    struct vec3 seen_from_m, circle_m;    /* where the map is seen from; and the middle, on the ground, of the circle that what it */
    double circle_radius_m;               /* shows, of no relief, stands on; 0: there is none */
    struct image lighting;                /* all that stands round, and the sky, at the size of the light's; empty: that */
    /* Of relief_include_write: over a place what relief_map shows stands there, and sky_map shows what is beyond; "": none. */
    char relief_include[SURROUNDINGS_PATH_SIZE], relief_map[SURROUNDINGS_PATH_SIZE];
    struct pass_standing *standing; /* (standing_count) */
    size_t standing_count;
    struct sun_share sun_share;     /* of all passes */
    char sun_share_map[SURROUNDINGS_PATH_SIZE], sun_through_map[SURROUNDINGS_PATH_SIZE];
};

/* All that the three scenes of a frame say. */
struct passes {
    const struct scene *scene;
    const char *sky_map;            /* of light, in a file: path relative to the output folder */
    const struct light *light;
    struct view view;
    struct pose world_from_camera;
    const struct entity *entities;
    const struct model_include *includes; /* (entity_count) */
    size_t entity_count;
    struct plane ground;            /* what receives, on a plane; else a plane below all that is in the place's include */
    const struct shaded_ground *receivers; /* lit */
    /* Of place_include_write and shades_include_write, relative to the output folder; NULL: the ground is a plane. */
    const char *place_include, *shades_include;
    const struct pass_surroundings *surroundings; /* of the object pass, but for sun_share and lighting; NULL: bare ground of the scene's albedo under the sky */
};

/* Write object.pov, plane.pov and shadow.pov into frame_folder. */
bool passes_write(const char *frame_folder, const struct passes *passes, struct error *err);

#endif

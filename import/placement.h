/* Where a reconstruction lies in the world: which of the ways to tell it is taken, and what came of it. */
#ifndef STAFFAGE_IMPORT_PLACEMENT_H
#define STAFFAGE_IMPORT_PLACEMENT_H

#include "import/georeference.h"
#include "import/photo_facts.h"
#include "import/reconstruction.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

enum placement_way {
    PLACEMENT_DEFAULT,  /* the tool's own where that is east, north, up; else by GPS */
    PLACEMENT_GPS,
    PLACEMENT_POINTS,   /* control points from a file */
    PLACEMENT_DISTANCE, /* one known distance: scale and up, no place */
    PLACEMENT_NONE      /* the tool's frame as it is */
};

struct placement_request {
    enum placement_way way;
    const char *points_file;  /* POINTS */
    struct vec3 p[2];         /* DISTANCE: in the reconstruction's frame */
    double distance_m;
};

struct placement {
    enum placement_way way;   /* DEFAULT: kept as the tool has it */
    struct similarity world_from_reconstruction;
    bool has_place;
    double origin_lat_lon_h[3];
    struct tie *ties;         /* GPS, POINTS: about that origin */
    struct tie_residual *residuals;
    size_t tie_count;
    double rms_m;             /* of the inliers */
    struct upright upright;   /* DISTANCE */
};

/* With GPS and control points the world's origin is the median latitude and longitude of the ties, to
 * 1e-6 deg, at the median height of the sparse points (of the ties, where there are none), to 1 cm: the
 * ground lies about z = 0.
 * In:  facts (shot_count)
 * Out: placement; free with placement_release
 * Err: those of the way that is taken */
bool placement_find(struct placement *placement, const struct reconstruction *reconstruction,
                    const struct photo_facts *facts, const struct placement_request *request, struct error *err);
void placement_release(struct placement *placement);

/* A shot's pose in the world. */
struct pose placement_shot(const struct placement *placement, const struct recon_shot *shot);

#endif

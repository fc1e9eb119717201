/* From a reconstruction's own frame to metres, east, north and up. */
#ifndef STAFFAGE_IMPORT_GEOREFERENCE_H
#define STAFFAGE_IMPORT_GEOREFERENCE_H

#include "import/reconstruction.h"
#include "import/similarity.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

struct tie_residual { double horizontal_m, vertical_m; bool inlier; }; /* vertical_m: given minus fitted */

/* Robust similarity through ties: every triple or, when there are too many, draws by a fixed seed;
 * refined on the inliers (those within inlier_m) by least squares.
 * Out: enu_from_reconstruction; residuals (n); rms_m over the inliers (3D)
 * Err: ERR_INPUT without a place: fewer than 3; at one point or so near one line that the turn about it
 *      cannot be told from the noise (states how far they spread); or contradictory (fewer than half
 *      agree: names those that do not)
 * Src: Umeyama 1991; Fischler, Bolles 1981; Torr, Zisserman 2000 (the score) */
bool georeference_ties(struct similarity *enu_from_reconstruction, struct tie_residual *residuals, double *rms_m,
                       const struct tie *ties, size_t n, double inlier_m, struct error *err);

/* What tells up where no height is known, and how well. */
struct upright {
    bool by_points;      /* the normal of the sparse points' plane; else the cameras, held level, that look about */
    double spread_rad;   /* rms by which the cameras are rolled, or by which the points leave their plane */
};

/* Scale alone, from a known distance between two points of the reconstruction. The world's origin is
 * p[0]; its y axis, called north, is where the first shot looks or, looking down, the top of its picture.
 * Err: ERR_INPUT without a place: a distance that is none, points that are one, neither cameras nor
 *      points that tell up */
bool georeference_distance(struct similarity *world_from_reconstruction, struct upright *upright,
                           const struct reconstruction *reconstruction, const struct vec3 p[2], double distance_m,
                           struct error *err);

#endif

/* From a reconstruction's own frame to metres, east, north and up. */
#ifndef STAFFAGE_IMPORT_GEOREFERENCE_H
#define STAFFAGE_IMPORT_GEOREFERENCE_H

#include "import/reconstruction.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

/* A position in both frames. */
struct tie { const char *name; struct vec3 p_reconstruction, p_enu_m; };
struct tie_residual { double horizontal_m, vertical_m; bool inlier; };

/* Robust similarity through ties: every minimal triple or, when there are too many, draws by a fixed
 * seed; refined on the inliers by least squares.
 * Out: enu_from_reconstruction; residuals (n); rms_m over the inliers (3D)
 * Err: ERR_INPUT without a place: fewer than 3, on one line or at one point (states how far they spread),
 *      or contradictory (fewer than half agree within inlier_m; names those that do not)
 * Src: Umeyama 1991; Fischler, Bolles 1981 */
bool georeference_ties(struct similarity *enu_from_reconstruction, struct tie_residual *residuals, double *rms_m,
                       const struct tie *ties, size_t n, double inlier_m, struct error *err);

/* What an image's EXIF says of place, time and lens (libexif). */
struct photo_facts {
    bool has_position, has_height, has_time, has_exposure;
    double lat_lon_h[3];
    char time[32];        /* "2016-06-23T16:31:59", local, without an offset: EXIF has none */
    char offset[8];       /* "-05:00" where EXIF 2.31 gives it, else "" */
    double exposure_s, f_number, focal_mm;
};
/* Err: ERR_INPUT at path: missing, broken EXIF. No EXIF at all is no error. */
bool photo_facts_read(struct photo_facts *facts, const char *path, struct error *err);

/* Control points: lines "NAME X Y Z LATITUDE LONGITUDE HEIGHT" (reconstruction frame), '#' comments.
 * Err: ERR_INPUT at path:line:column */
bool control_points_read(struct tie **ties, size_t *n, double origin_lat_lon_h[3], const char *path, struct error *err);

/* Scale alone, from a known distance between two points of the reconstruction; up is the mean of the
 * cameras' upward axes when they look about (their spread is stated), the normal of the sparse points' plane otherwise. */
bool georeference_distance(struct similarity *world_from_reconstruction, const struct reconstruction *reconstruction,
                           const struct vec3 p[2], double distance_m, struct error *err);

#endif

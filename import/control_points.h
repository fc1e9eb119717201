/* Points known in the reconstruction and on the ground, from a text file. */
#ifndef STAFFAGE_IMPORT_CONTROL_POINTS_H
#define STAFFAGE_IMPORT_CONTROL_POINTS_H

#include "import/similarity.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Lines "NAME X Y Z LATITUDE LONGITUDE HEIGHT": a name without blanks, the reconstruction's own
 * coordinates, degrees and metres. '#' begins a comment.
 * Out: ties (free with control_points_release), n, origin_lat_lon_h: the first point's place
 * Err: ERR_INPUT at path:line:column: a field that is missing, too many or no number, a place that is
 *      none, a name twice; a file without a point */
bool control_points_read(struct tie **ties, size_t *n, double origin_lat_lon_h[3], const char *path, struct error *err);
void control_points_release(struct tie *ties, size_t n);

#endif

/* Ties from the positions in the photographs' own EXIF. */
#ifndef STAFFAGE_IMPORT_GPS_TIES_H
#define STAFFAGE_IMPORT_GPS_TIES_H

#include "import/photo_facts.h"
#include "import/reconstruction.h"
#include "import/similarity.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* In:  facts (reconstruction->shot_count), of each shot's photograph
 * Out: ties, one a shot that has latitude, longitude and height, in the shots' order; names belong to the
 *      reconstruction, the caller frees the array; origin_lat_lon_h: the first such shot's place
 * Err: ERR_INPUT without a place: fewer than 3 have GPS: how many, and what else can be given */
bool gps_ties(struct tie **ties, size_t *n, double origin_lat_lon_h[3], const struct reconstruction *reconstruction,
              const struct photo_facts *facts, struct error *err);

/* Where a shot was taken: its centre in the reconstruction's frame. */
struct vec3 shot_centre(const struct recon_shot *shot);

#endif

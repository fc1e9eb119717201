/* Local east-north-up coordinates around a geodetic origin: GeographicLib LocalCartesian.
 * Places are latitude deg, longitude deg, height m above the WGS 84 ellipsoid. */
#ifndef STAFFAGE_LIB_PLACE_H
#define STAFFAGE_LIB_PLACE_H

#include "lib/error.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Out: enu_m (3); untouched on failure
 * Err: ERR_INPUT: a latitude beyond 90 deg, or a number that is not finite */
bool place_enu_from_geodetic(double enu_m[3], const double origin_lat_lon_h[3], const double lat_lon_h[3],
                             struct error *err);
/* Out: lat_lon_h (3), longitude in [-180, 180]; untouched on failure
 * Err: as above */
bool place_geodetic_from_enu(double lat_lon_h[3], const double origin_lat_lon_h[3], const double enu_m[3],
                             struct error *err);

#ifdef __cplusplus
}
#endif
#endif

/* Local east-north-up coordinates around a geodetic origin: GeographicLib LocalCartesian. */
#ifndef STAFFAGE_GEN_PLACE_H
#define STAFFAGE_GEN_PLACE_H

#ifdef __cplusplus
extern "C" {
#endif

/* Out: enu_m (3). Angles in degrees, as the library takes them. */
void place_enu_from_geodetic(double enu_m[3], const double origin_lat_lon_h[3], const double lat_lon_h[3]);
/* Out: lat_lon_h (3). */
void place_geodetic_from_enu(double lat_lon_h[3], const double origin_lat_lon_h[3], const double enu_m[3]);

#ifdef __cplusplus
}
#endif
#endif

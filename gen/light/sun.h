/* Where the sun stands. */
#ifndef STAFFAGE_GEN_SUN_H
#define STAFFAGE_GEN_SUN_H

#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>

/* A moment, UTC. second may have a fraction, and 60 in a leap second. */
struct utc_time { int year, month, day, hour, minute; double second; };

/* Parse ISO 8601 with an offset ("2021-05-01T14:53:40Z", "...T10:53:40.5-04:00") to UTC.
 * Out: *utc; untouched on failure
 * Returns NULL, or what is wrong and what would be right (a static string). */
const char *utc_time_parse(struct utc_time *utc, const char *text);

/* Seconds from one moment to a later one; leap seconds are not counted. */
double utc_time_since(struct utc_time later, struct utc_time earlier);

/* A moment so many seconds later, to the millisecond: "2021-05-01T14:53:40.500Z". */
#define UTC_TEXT_SIZE 40
void utc_time_text(char text[UTC_TEXT_SIZE], struct utc_time utc, double later_s);

struct geodetic { double latitude_rad, longitude_rad, height_m; }; /* WGS 84, ellipsoidal height */

/* Pressure 0 leaves refraction out. Pressure is that of the place, not reduced to sea level. */
struct atmosphere { double pressure_hpa, temperature_c; };

struct sun_position {
    double azimuth_rad;   /* clockwise from north, [0, 2 pi) */
    double elevation_rad; /* of the centre; topocentric, refracted when there is an atmosphere and
                             the upper limb is above the horizon; negative when it has set */
    struct vec3 direction;/* unit, ENU, towards the sun's centre */
};

/* Topocentric sun by ERFA (parallax and aberration in, polar motion left out, UT1 = UTC + dut1_s).
 * UT1 stays within 0.9 s of UTC: dut1_s = 0 costs at most 0.004 deg.
 * Err: ERR_INPUT: a year outside 1960 to 2099, no such time, no such place or air; output untouched
 * Src: IAU SOFA (ERFA eraApco13, eraAb, eraAtioq); refraction: NREL/TP-560-34302 */
bool sun_position(struct sun_position *sun, struct utc_time utc, double dut1_s, struct geodetic place,
                  struct atmosphere air, struct error *err);

#endif

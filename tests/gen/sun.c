#include "gen/light/sun.h"

#include "tests/tap.h"

#define RAD (M_PI / 180)

/* Positions published by others. Figures were carried over as they stand there; zenith
 * angles became elevations. None has fewer than four decimals of a degree, so the
 * tolerance is 0.01 deg, most of it for UT1, which is taken as UTC here; where the source does
 * so too (DE440S) it is 0.0005 deg, a tenth of the aberration. NAN: the source does not give this coordinate.
 *
 * NREL: I. Reda, A. Andreas, Solar Position Algorithm for Solar Radiation Applications,
 *   NREL/TP-560-34302, the worked example.
 * PVLIB: NREL's SPA figures for the same place at height 0, in pvlib-python,
 *   pvlib/tests/test_solarposition.py, expected_solpos_multi.
 * SPA.C: output of NREL's own spa.c (2014-09-08), 1000 hPa, 10 deg C, height 0, delta_t 0 (which
 *   moves the sun by less than 0.001 deg), in klausbrunner/solarpositioning,
 *   src/test/resources/azimuth_zenith/spa_reference_testdata.csv.
 * HORIZONS FL: JPL Horizons listing of 2019-04-12, DE431, 29 N 81 W, 10 m, with refraction,
 *   in cosinekitty/astronomy, generate/horizons/Sun.txt.
 * HORIZONS EQ: JPL Horizons listings of 2019-04-13 for 0 N 0 E, with refraction
 *   (generate/horizons/Sun_equinox.txt) and airless (airless_Sun_equinox.txt), same repository.
 *   Horizons states no pressure; its air is that of 1010 hPa and 10 deg C.
 * HORIZONS 50: JPL Horizons, airless, 50 N 10 E, height 0, in pvlib/solposx,
 *   tests/test_solarposition.py, expected_nasa.
 * SKYFIELD: Skyfield with JPL's DE440, no refraction, height 0, same file, expected_skyfield
 *   for the rows of test_conditions.
 * DE440S: Skyfield with DE440s, no refraction, TT - UT1 = 69.184 s, sea level: the moments when the
 *   sun's centre crosses -0.8333 deg or the meridian, in klausbrunner/solarpositioning,
 *   src/test/resources/net/e175/klaus/solarpositioning/test/sunrise/jpl_events.csv. */
static const struct {
    const char *source, *time;
    double latitude_deg, longitude_deg, height_m, pressure_hpa, temperature_c, azimuth_deg, elevation_deg;
} published[] = {
    { "NREL", "2003-10-17T12:30:30-07:00", 39.742476, -105.1786, 1830.14, 820, 11, 194.34024, 90 - 50.11162 },

    { "PVLIB", "2003-10-17T12:30:30-07:00", 39.742476, -105.1786, 0, 0, 11, 194.340241, 39.872046 },
    { "PVLIB", "2003-10-18T12:30:30-07:00", 39.742476, -105.1786, 0, 820, 11, 194.311132, 39.521740 },

    { "SPA.C Auckland", "2010-03-15T00:30:00Z", -36.840556, 174.74, 0, 1000, 10, 0.047502, 90 - 34.572436 },
    { "SPA.C Auckland", "2010-03-15T06:30:00Z", -36.840556, 174.74, 0, 1000, 10, 268.277401, 90 - 88.368814 },
    { "SPA.C Auckland", "2010-06-15T03:30:00Z", -36.840556, 174.74, 0, 1000, 10, 315.749511, 90 - 74.707383 },
    { "SPA.C Auckland", "2010-12-15T18:30:00Z", -36.840556, 174.74, 0, 1000, 10, 107.175261, 90 - 73.622171 },
    { "SPA.C Brasilia", "2010-09-15T12:30:00Z", -15.793889, -47.882778, 0, 1000, 10, 67.595957, 90 - 43.034097 },
    { "SPA.C Brasilia", "2010-12-15T21:30:00Z", -15.793889, -47.882778, 0, 1000, 10, 246.057721, 90 - 88.596414 },
    { "SPA.C Longyearbyen, midnight sun", "2010-06-15T00:30:00Z", 78.22, 15.65, 0, 1000, 10, 21.613694,
      90 - 77.537134 },
    { "SPA.C Longyearbyen, polar night", "2010-12-15T12:30:00Z", 78.22, 15.65, 0, 1000, 10, 202.847721,
      90 - 102.475749 },
    { "SPA.C Singapore", "2010-03-15T09:30:00Z", 1.283333, 103.833333, 0, 1000, 10, 267.033298, 90 - 64.138730 },
    { "SPA.C Singapore", "2010-06-15T03:30:00Z", 1.283333, 103.833333, 0, 1000, 10, 44.499284, 90 - 31.863390 },

    { "HORIZONS FL", "2014-06-22T00:00:00Z", 29, -81, 10, 1010, 10, 294.5158, 4.4102 },
    { "HORIZONS FL", "2015-05-18T00:00:00Z", 29, -81, 10, 1010, 10, 291.6909, 1.4639 },
    { "HORIZONS FL", "2016-08-10T00:00:00Z", 29, -81, 10, 1010, 10, 287.2156, 1.3454 },
    { "HORIZONS FL", "2018-07-01T00:00:00Z", 29, -81, 10, 1010, 10, 294.0275, 4.6237 },

    { "HORIZONS EQ, refracted", "2019-03-19T06:08:00Z", 0, 0, 0, 1010, 10, 90.6558, 0.4950 },
    { "HORIZONS EQ, refracted", "2019-03-19T06:30:00Z", 0, 0, 0, 1010, 10, 90.6528, 5.6643 },
    { "HORIZONS EQ, refracted", "2019-03-19T08:30:00Z", 0, 0, 0, 1010, 10, 90.7579, 35.5429 },
    { "HORIZONS EQ, refracted", "2019-03-19T15:00:00Z", 0, 0, 0, 1010, 10, 269.2531, 46.9682 },
    { "HORIZONS EQ, airless", "2019-03-19T15:00:00Z", 0, 0, 0, 0, 10, 269.2531, 46.9524 },
    { "HORIZONS EQ, airless", "2019-03-19T13:00:00Z", 0, 0, 0, 0, 10, 267.5954, 76.9510 },

    { "HORIZONS 50", "2020-01-01T06:00:00Z", 50, 10, 0, 0, 10, 111.849769, -11.846393 },
    { "HORIZONS 50", "2020-01-01T08:00:00Z", 50, 10, 0, 0, 10, 134.336441, 4.244699 },
    { "HORIZONS 50", "2020-01-01T11:00:00Z", 50, 10, 0, 0, 10, 174.399466, 16.791713 },
    { "HORIZONS 50", "2020-01-01T15:00:00Z", 50, 10, 0, 0, 10, 228.325009, 2.693785 },

    { "SKYFIELD", "2020-10-17T12:30:00+00:00", 45, 10, 0, 0, 10, 204.91794786, 32.21731177 },
    { "SKYFIELD, clock ahead of UTC", "2020-10-17T12:30:00+02:00", 45, 10, 0, 0, 10, 169.37578931, 34.92239511 },
    { "SKYFIELD, clock behind UTC", "2020-10-17T12:30:00-02:00", 45, 10, 0, 0, 10, 234.18984836, 18.63535617 },
    { "SKYFIELD, leap day", "2020-02-29T12:30:00Z", 45, 10, 0, 0, 10, 197.66893877, 35.75683037 },
    { "SKYFIELD, south", "2020-10-17T12:30:00Z", -45, 10, 0, 0, 10, 326.23556156, 50.10684928 },
    { "SKYFIELD, equator", "2020-10-17T12:30:00Z", 0, 10, 0, 0, 10, 245.08983994, 66.85755467 },
    { "SKYFIELD, north pole", "2020-10-17T12:30:00Z", 90, 10, 0, 0, 10, 201.18798691, -9.5305175 },
    { "SKYFIELD, south pole", "2020-10-17T12:30:00Z", -90, 10, 0, 0, 10, 338.81201317, 9.52569869 },
    { "SKYFIELD, date line", "2020-10-17T12:30:00Z", 45, 180, 0, 0, 10, 18.64711844, -53.24128453 },
    { "SKYFIELD, date line from the west", "2020-10-17T12:30:00Z", 45, -180, 0, 0, 10, 18.64711844, -53.24128453 },

    { "DE440S, date line, rising", "2020-06-10T17:56:23.442Z", 0, 179.9, 0, 0, 10, NAN, -0.8333333 },
    { "DE440S, date line, setting", "2020-04-16T06:03:31.926Z", 0, 179.9, 0, 0, 10, NAN, -0.8333333 },
    { "DE440S, date line, transit", "2020-04-16T00:00:12.806Z", 0, 179.9, 0, 0, 10, 0, NAN },
    { "DE440S, Auckland, transit", "2024-12-21T00:19:05.371Z", -36.84, 174.74, 0, 0, 10, 0, NAN },
    { "DE440S, Vienna, equinox", "2024-03-20T17:07:47.200Z", 48.21, 16.37, 0, 0, 10, NAN, -0.8333333 },
    { "DE440S, south pole, the year's sunrise", "2024-09-20T09:26:22.500Z", -90, 0, 0, 0, 10, NAN, -0.8333333 },
};

static void check_published(void)
{
    for (size_t i = 0; i < sizeof published / sizeof *published; i++) {
        struct utc_time utc;
        struct sun_position sun = { 0 };
        struct error err = ERROR_NONE;
        struct geodetic place = { published[i].latitude_deg * RAD, published[i].longitude_deg * RAD,
                                  published[i].height_m };
        struct atmosphere air = { published[i].pressure_hpa, published[i].temperature_c };
        const char *wrong = utc_time_parse(&utc, published[i].time);
        bool good = !wrong && sun_position(&sun, utc, 0, place, air, &err);
        double azimuth_error = isnan(published[i].azimuth_deg) ? 0
            : remainder(sun.azimuth_rad / RAD - published[i].azimuth_deg, 360);
        double elevation_error = isnan(published[i].elevation_deg) ? 0
            : sun.elevation_rad / RAD - published[i].elevation_deg;
        double tolerance = strncmp(published[i].source, "DE440S", 6) ? 0.01 : 0.0005;
        OK(good && fabs(azimuth_error) < tolerance && fabs(elevation_error) < tolerance,
           "%s, %s: azimuth differs by %+.4f, elevation by %+.4f deg", published[i].source, published[i].time,
           azimuth_error, elevation_error);
    }
}

/* The moments of the photographs that come with their sun, as told with them (0.1 deg). */
static void check_photographs(void)
{
    static const struct { const char *what, *time; double latitude, longitude, azimuth, elevation; } photographs[] = {
        { "craig", "2021-05-01T14:53:40Z", 40.44694, -79.94902, 118.6, 50.0 },
        { "brighton", "2016-06-23T16:31:59-05:00", 46.8426, -91.9940, 257.6, 43.6 },
    };
    for (size_t i = 0; i < 2; i++) {
        struct utc_time utc;
        struct sun_position sun = { 0 };
        struct error err = ERROR_NONE;
        struct geodetic place = { photographs[i].latitude * RAD, photographs[i].longitude * RAD, 200 };
        OK(!utc_time_parse(&utc, photographs[i].time)
               && sun_position(&sun, utc, 0, place, (struct atmosphere){ 990, 15 }, &err),
           "%s has a sun", photographs[i].what);
        NEAR(sun.azimuth_rad / RAD, photographs[i].azimuth, 0.1, "%s: azimuth", photographs[i].what);
        NEAR(sun.elevation_rad / RAD, photographs[i].elevation, 0.1, "%s: elevation", photographs[i].what);
    }
}

static void check_behaviour(void)
{
    struct utc_time noon = { 2021, 3, 20, 12, 0, 0 };
    struct geodetic place = { 50 * RAD, 0, 0 };
    struct atmosphere none = { 0, 10 }, air = { 1010, 10 };
    struct sun_position sun, other;
    struct error err = ERROR_NONE;
    OK(sun_position(&sun, noon, 0, place, none, &err), "a spring noon has a sun");
    NEAR(vec3_norm(sun.direction), 1, 1e-15, "its direction is a unit vector");
    NEAR(sun.direction.x, cos(sun.elevation_rad) * sin(sun.azimuth_rad), 1e-15, "x is east");
    NEAR(sun.direction.y, cos(sun.elevation_rad) * cos(sun.azimuth_rad), 1e-15, "y is north");
    NEAR(sun.direction.z, sin(sun.elevation_rad), 1e-15, "z is up");

    OK(sun_position(&other, noon, 4, place, none, &err), "UT1 may differ from UTC");
    NEAR((other.azimuth_rad - sun.azimuth_rad) / RAD * cos(sun.elevation_rad), 4 * 360.0 / 86400, 1e-4,
         "four seconds of UT1 turn the earth by a sixtieth of a degree");

    /* 8.794 arc seconds is the sun's mean horizontal parallax (IAU 1976). On the equator
     * at an equinox's sunset the observer stands a whole earth radius to the side. */
    OK(sun_position(&sun, (struct utc_time){ 2021, 3, 20, 18, 0, 0 }, 0, (struct geodetic){ 0 }, none, &err)
           && sun_position(&other, (struct utc_time){ 2021, 3, 20, 18, 0, 0 }, 0, (struct geodetic){ 0, 0, -6378137 },
                           none, &err), "a sunset has a sun");
    NEAR((other.elevation_rad - sun.elevation_rad) / RAD * 3600, 8.794, 0.1,
         "parallax lowers the sun at the horizon by 8.8 arc seconds");

    struct utc_time night = { 2021, 12, 21, 0, 0, 0 };
    OK(sun_position(&sun, night, 0, place, none, &err) && sun_position(&other, night, 0, place, air, &err)
           && sun.elevation_rad < -60 * RAD && sun.elevation_rad == other.elevation_rad,
       "at night the sun is below the horizon, and air does not lift it");

    OK(sun_position(&sun, (struct utc_time){ 2016, 12, 31, 23, 59, 60.5 }, 0, place, none, &err)
           && sun_position(&other, (struct utc_time){ 2017, 1, 1, 0, 0, 0 }, 0, place, none, &err),
       "a leap second has a sun");
    double moved = vec3_norm(vec3_sub(other.direction, sun.direction)) / RAD;
    OK(moved > 0.001 && moved < 0.003, "which moves on by half a second until the next year (%.5f deg)", moved);
}

static void check_refusals(void)
{
    struct utc_time now = { 2021, 3, 20, 12, 0, 0 };
    struct geodetic here = { 0.5, 0.5, 0 };
    struct atmosphere air = { 1010, 10 };
    struct { const char *what, *says; struct utc_time utc; double dut1_s; struct geodetic place; struct atmosphere air; }
    bad[] = {
        { "a year before UTC", "1960 to 2099", { 1959, 12, 31, 23, 59, 59 }, 0, here, air },
        { "a year beyond the ephemeris", "1960 to 2099", { 2100, 1, 1, 0, 0, 0 }, 0, here, air },
        { "a thirteenth month", "is no time", { 2021, 13, 1, 0, 0, 0 }, 0, here, air },
        { "a UT1 that is not a number", "is no time", now, NAN, here, air },
        { "a latitude beyond the pole", "latitude is -90 to 90", now, 0, { 1.6, 0, 0 }, air },
        { "a longitude that is not a number", "no place has", now, 0, { 0, NAN, 0 }, air },
        { "negative pressure", "1010 hPa", now, 0, here, { -1, 10 } },
        { "absolute zero", "10 deg C", now, 0, here, { 1010, -273.15 } },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct sun_position sun = { .azimuth_rad = 7 };
        struct error err = ERROR_NONE;
        OK(!sun_position(&sun, bad[i].utc, bad[i].dut1_s, bad[i].place, bad[i].air, &err) && err.code == ERR_INPUT
               && strstr(err.text, bad[i].says) && sun.azimuth_rad == 7,
           "refuses %s: %s", bad[i].what, err.text);
    }
}

static void check_good_times(void)
{
    static const struct { const char *text; struct utc_time utc; } good[] = {
        { "2021-05-01T14:53:40Z", { 2021, 5, 1, 14, 53, 40 } },
        { "2021-05-01T10:53:40-04:00", { 2021, 5, 1, 14, 53, 40 } },
        { "2021-05-01T10:53:40.5-04:00", { 2021, 5, 1, 14, 53, 40.5 } },
        { "2021-05-01T10:53:40,125-04:00", { 2021, 5, 1, 14, 53, 40.125 } },
        { "2021-05-01T14:53:40+00:00", { 2021, 5, 1, 14, 53, 40 } },
        { "2021-05-01T20:38:40+05:45", { 2021, 5, 1, 14, 53, 40 } },
        { "2021-05-01T11:23:40-03:30", { 2021, 5, 1, 14, 53, 40 } },
        { "2021-05-02T03:00:00+14:00", { 2021, 5, 1, 13, 0, 0 } },
        { "2021-04-30T23:30:00-12:00", { 2021, 5, 1, 11, 30, 0 } },
        { "2021-03-01T00:30:00+01:00", { 2021, 2, 28, 23, 30, 0 } },
        { "2020-03-01T00:30:00+01:00", { 2020, 2, 29, 23, 30, 0 } },
        { "2000-02-29T23:30:00-01:00", { 2000, 3, 1, 0, 30, 0 } },
        { "2021-01-01T00:00:00+00:01", { 2020, 12, 31, 23, 59, 0 } },
        { "2020-12-31T23:59:59.75-00:30", { 2021, 1, 1, 0, 29, 59.75 } },
        { "2021-05-31T23:59:00-00:01", { 2021, 6, 1, 0, 0, 0 } },
        { "2016-12-31T23:59:60Z", { 2016, 12, 31, 23, 59, 60 } },
        { "2017-01-01T05:29:60.25+05:30", { 2016, 12, 31, 23, 59, 60.25 } },
        { "2015-06-30T16:59:60-07:00", { 2015, 6, 30, 23, 59, 60 } },
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        struct utc_time t = { 0 };
        const char *wrong = utc_time_parse(&t, good[i].text);
        const struct utc_time *want = &good[i].utc;
        OK(!wrong && t.year == want->year && t.month == want->month && t.day == want->day && t.hour == want->hour
               && t.minute == want->minute && fabs(t.second - want->second) < 1e-12,
           "%s is %04d-%02d-%02d %02d:%02d:%g UTC%s%s", good[i].text, t.year, t.month, t.day, t.hour, t.minute,
           t.second, wrong ? ": " : "", wrong ? wrong : "");
    }
    struct utc_time t = { 0 };
    OK(!utc_time_parse(&t, "2021-05-01T14:53:59.99999999999999999999Z") && t.second < 60 && t.second > 59.999999,
       "many nines do not round up to a leap second");
}

static void check_bad_times(void)
{
    static const struct { const char *text, *says; } bad[] = {
        { "2021-05-01T14:53:40", "no offset from UTC" },
        { "2021-05-01T14:53:40.5", "no offset from UTC" },
        { "", "YYYY-MM-DDThh:mm:ss" },
        { "2021-05-01", "YYYY-MM-DDThh:mm:ss" },
        { "2021-05-01 14:53:40Z", "YYYY-MM-DDThh:mm:ss" },
        { "2021-05-01t14:53:40Z", "YYYY-MM-DDThh:mm:ss" },
        { "2021-05-01T14:53Z", "YYYY-MM-DDThh:mm:ss" },
        { "20210501T145340Z", "YYYY-MM-DDThh:mm:ss" },
        { "21-05-01T14:53:40Z", "YYYY-MM-DDThh:mm:ss" },
        { "2021-5-1T14:53:40Z", "YYYY-MM-DDThh:mm:ss" },
        { " 2021-05-01T14:53:40Z", "YYYY-MM-DDThh:mm:ss" },
        { "+2021-05-01T14:53:40Z", "YYYY-MM-DDThh:mm:ss" },
        { "05/01/2021 14:53:40", "YYYY-MM-DDThh:mm:ss" },
        { "2021-05-01T14:53:40.Z", "decimal sign" },
        { "2021-00-01T14:53:40Z", "month is 01 to 12" },
        { "2021-13-01T14:53:40Z", "month is 01 to 12" },
        { "2021-05-00T14:53:40Z", "does not have this day" },
        { "2021-04-31T14:53:40Z", "does not have this day" },
        { "2021-02-29T14:53:40Z", "does not have this day" },
        { "1900-02-29T14:53:40Z", "does not have this day" },
        { "2021-05-01T24:00:00Z", "hour is 00 to 23" },
        { "2021-05-01T14:60:40Z", "minute is 00 to 59" },
        { "2021-05-01T14:53:61Z", "second is 00 to 59" },
        { "2021-05-01T23:59:60Z", "no leap second" },
        { "2016-12-31T23:58:60Z", "no leap second" },
        { "2016-12-31T23:59:60+01:00", "no leap second" },
        { "2021-05-01T14:53:40z", "written Z, +hh:mm or -hh:mm" },
        { "2021-05-01T14:53:40+0545", "written Z, +hh:mm or -hh:mm" },
        { "2021-05-01T14:53:40+5:45", "written Z, +hh:mm or -hh:mm" },
        { "2021-05-01T14:53:40-04", "written Z, +hh:mm or -hh:mm" },
        { "2021-05-01T14:53:40 -04:00", "written Z, +hh:mm or -hh:mm" },
        { "2021-05-01T14:53:40EST", "written Z, +hh:mm or -hh:mm" },
        { "2021-05-01T14:53:40+05:60", "-12:00 to +14:00" },
        { "2021-05-01T14:53:40+14:01", "-12:00 to +14:00" },
        { "2021-05-01T14:53:40-12:30", "-12:00 to +14:00" },
        { "2021-05-01T14:53:40-00:00", "write Z" },
        { "2021-05-01T14:53:40Z ", "ends with its offset" },
        { "2021-05-01T14:53:40-04:00:00", "ends with its offset" },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct utc_time t = { .year = 7 };
        const char *wrong = utc_time_parse(&t, bad[i].text);
        OK(wrong && strstr(wrong, bad[i].says) && t.year == 7, "refuses \"%s\": %s", bad[i].text,
           wrong ? wrong : "(taken)");
    }
}

static void check_time_texts(void)
{
    static const struct { const char *from; double later_s; const char *want; } texts[] = {
        { "2021-05-01T14:53:40.25Z", 0, "2021-05-01T14:53:40.250Z" },
        { "2016-06-23T16:31:59-05:00", 7, "2016-06-23T21:32:06.000Z" },
        { "2020-02-28T23:59:59.5Z", 0.5, "2020-02-29T00:00:00.000Z" },
        { "2019-12-31T23:00:00Z", 90000, "2020-01-02T00:00:00.000Z" },
        { "2021-01-01T00:00:00Z", -0.001, "2020-12-31T23:59:59.999Z" },
        { "2021-01-01T00:00:59.9996Z", 0, "2021-01-01T00:01:00.000Z" },
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct utc_time t;
        char text[UTC_TEXT_SIZE];
        utc_time_parse(&t, texts[i].from);
        utc_time_text(text, t, texts[i].later_s);
        OK(!strcmp(text, texts[i].want), "%g s after %s it is %s", texts[i].later_s, texts[i].from, text);
    }
}

int main(void)
{
    check_time_texts();
    check_published();
    check_photographs();
    check_behaviour();
    check_refusals();
    check_good_times();
    check_bad_times();
    return tap_done();
}

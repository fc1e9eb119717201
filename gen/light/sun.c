#include "gen/light/sun.h"

#include <erfa.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#define RAD_FROM_DEG (M_PI / 180)

/* --- time --- */

static bool read_digits(const char **text, int count, int *value)
{
    *value = 0;
    for (; count > 0; count--, (*text)++) {
        if (**text < '0' || **text > '9') return false;
        *value = 10 * *value + (**text - '0');
    }
    return true;
}

static bool read_mark(const char **text, const char *marks)
{
    if (!**text || !strchr(marks, **text)) return false;
    (*text)++;
    return true;
}

/* The digits after a decimal sign; at least one. */
static bool read_fraction(const char **text, double *fraction)
{
    const char *start = *text;
    *fraction = 0;
    for (double place = 0.1; **text >= '0' && **text <= '9'; place /= 10, (*text)++)
        *fraction += place * (**text - '0');
    return *text > start;
}

static int days_in_month(int year, int month)
{
    static const int days[] = { 31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
    bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return days[month - 1] + (month == 2 && leap);
}

static void next_day(struct utc_time *t)
{
    if (++t->day <= days_in_month(t->year, t->month)) return;
    t->day = 1;
    if (++t->month <= 12) return;
    t->month = 1;
    t->year++;
}

static void previous_day(struct utc_time *t)
{
    if (--t->day >= 1) return;
    if (--t->month < 1) {
        t->month = 12;
        t->year--;
    }
    t->day = days_in_month(t->year, t->month);
}

static bool is_leap_second(const struct utc_time *t)
{
    double day, fraction;
    return eraDtf2d("UTC", t->year, t->month, t->day, t->hour, t->minute, t->second, &day, &fraction) < 2;
}

const char *utc_time_parse(struct utc_time *utc, const char *text)
{
    struct utc_time t;
    int second;
    double fraction = 0;
    if (!(read_digits(&text, 4, &t.year) && read_mark(&text, "-") && read_digits(&text, 2, &t.month)
          && read_mark(&text, "-") && read_digits(&text, 2, &t.day) && read_mark(&text, "T")
          && read_digits(&text, 2, &t.hour) && read_mark(&text, ":") && read_digits(&text, 2, &t.minute)
          && read_mark(&text, ":") && read_digits(&text, 2, &second)))
        return "a time is written YYYY-MM-DDThh:mm:ss with its offset from UTC, as in 2021-05-01T10:53:40-04:00";
    if (read_mark(&text, ".,") && !read_fraction(&text, &fraction))
        return "digits are missing after the seconds' decimal sign, as in 10:53:40.5";

    if (t.month < 1 || t.month > 12) return "the month is 01 to 12";
    if (t.day < 1 || t.day > days_in_month(t.year, t.month)) return "the month does not have this day";
    if (t.hour > 23) return "the hour is 00 to 23; midnight is 00:00:00 of the next day";
    if (t.minute > 59) return "the minute is 00 to 59";
    if (second > 60) return "the second is 00 to 59, or 60 in a leap second";
    /* Many nines must not round up into the next second. */
    t.second = fmin(second + fraction, nextafter(second + 1, 0));

    if (!*text)
        return "the time has no offset from UTC; end it with Z if it is UTC, or with the offset of its clock, "
               "as in 2021-05-01T10:53:40-04:00";
    int offset_min = 0;
    if (!read_mark(&text, "Z")) {
        bool west = *text == '-';
        int hours, minutes;
        if (!(read_mark(&text, "+-") && read_digits(&text, 2, &hours) && read_mark(&text, ":")
              && read_digits(&text, 2, &minutes)))
            return "the offset from UTC is written Z, +hh:mm or -hh:mm, as in +05:45";
        offset_min = (hours * 60 + minutes) * (west ? -1 : 1);
        if (minutes > 59 || offset_min < -12 * 60 || offset_min > 14 * 60)
            return "offsets from UTC are -12:00 to +14:00";
        if (west && offset_min == 0) return "the offset -00:00 means that it is not known; write Z if the time is UTC";
    }
    if (*text) return "a time ends with its offset from UTC: Z, +hh:mm or -hh:mm";

    int minute_of_day = t.hour * 60 + t.minute - offset_min;
    if (minute_of_day < 0) previous_day(&t);
    if (minute_of_day >= 24 * 60) next_day(&t);
    minute_of_day = (minute_of_day + 24 * 60) % (24 * 60);
    t.hour = minute_of_day / 60;
    t.minute = minute_of_day % 60;
    if (second == 60 && !is_leap_second(&t)) return "there was no leap second then; the second is 00 to 59";
    *utc = t;
    return NULL;
}

double utc_time_since(struct utc_time later, struct utc_time earlier)
{
    const struct utc_time *t[2] = { &later, &earlier };
    double days[2], seconds[2];
    for (int i = 0; i < 2; i++) {
        double zero;
        eraCal2jd(t[i]->year, t[i]->month, t[i]->day, &zero, &days[i]);
        seconds[i] = t[i]->hour * 3600.0 + t[i]->minute * 60.0 + t[i]->second;
    }
    return (days[0] - days[1]) * 86400 + (seconds[0] - seconds[1]);
}

void utc_time_text(char text[UTC_TEXT_SIZE], struct utc_time utc, double later_s)
{
    const long long day_ms = 86400000;
    long long ms = llround((utc.hour * 3600.0 + utc.minute * 60.0 + utc.second + later_s) * 1000);
    for (; ms >= day_ms; ms -= day_ms) next_day(&utc);
    for (; ms < 0; ms += day_ms) previous_day(&utc);
    snprintf(text, UTC_TEXT_SIZE, "%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", utc.year, utc.month, utc.day, (int)(ms / 3600000),
             (int)(ms / 60000 % 60), (int)(ms / 1000 % 60), (int)(ms % 1000));
}

/* --- position --- */

/* By how much the air lifts the sun. Below the point where the upper limb has set
 * there is no refraction to speak of, and the formula has a pole.
 * Src: Reda & Andreas, NREL/TP-560-34302, 3.14.2 (Saemundsson's form) */
static double refraction_rad(double elevation_rad, struct atmosphere air)
{
    double e_deg = elevation_rad / RAD_FROM_DEG;
    double sun_radius_deg = 0.26667, horizon_refraction_deg = 0.5667;
    if (e_deg < -(sun_radius_deg + horizon_refraction_deg)) return 0;
    return air.pressure_hpa / 1010 * 283 / (273 + air.temperature_c)
           * 1.02 / (60 * tan((e_deg + 10.3 / (e_deg + 5.11)) * RAD_FROM_DEG)) * RAD_FROM_DEG;
}

bool sun_position(struct sun_position *sun, struct utc_time utc, double dut1_s, struct geodetic place,
                  struct atmosphere air, struct error *err)
{
    if (utc.year < 1960 || utc.year > 2099)
        return error_set(err, ERR_INPUT, "the sun's place is known for the years 1960 to 2099, not for %d", utc.year);
    if (!(fabs(place.latitude_rad) <= M_PI / 2 && isfinite(place.longitude_rad) && isfinite(place.height_m)))
        return error_set(err, ERR_INPUT, "no place has latitude %.9g, longitude %.9g deg, height %.9g m; "
                         "latitude is -90 to 90 deg", place.latitude_rad / RAD_FROM_DEG,
                         place.longitude_rad / RAD_FROM_DEG, place.height_m);
    if (!(air.pressure_hpa >= 0 && air.pressure_hpa < 2000 && air.temperature_c > -150 && air.temperature_c < 150))
        return error_set(err, ERR_INPUT, "no air has %.9g hPa and %.9g deg C; usual are 1010 hPa and 10 deg C",
                         air.pressure_hpa, air.temperature_c);
    double day, fraction, origins;
    if (!isfinite(dut1_s) || eraDtf2d("UTC", utc.year, utc.month, utc.day, utc.hour, utc.minute, utc.second,
                                      &day, &fraction) < 0)
        return error_set(err, ERR_INPUT, "%04d-%02d-%02dT%02d:%02d:%06.3fZ with UT1 - UTC = %.3f s is no time",
                         utc.year, utc.month, utc.day, utc.hour, utc.minute, utc.second, dut1_s);

    /* Apco13 takes UTC to TAI, TT and UT1, and the observer to where the earth has
     * carried him (Epv00), turned by precession, nutation (2006/2000A) and the day.
     * Air and polar motion are 0: the latter is below 0.0002 deg. */
    eraASTROM observer;
    if (eraApco13(day, fraction, dut1_s, place.longitude_rad, place.latitude_rad, place.height_m, 0, 0, 0, 0, 0, 0.55,
                  &observer, &origins) < 0)
        return error_set(err, ERR_BUG, "ERFA knows no time scales for the year %d", utc.year);

    /* eh is the unit vector from the sun to the observer himself, so its reverse holds
     * the parallax. While its light is under way the sun moves 0.01 arc seconds, and its
     * own mass does not bend its light: of Atciq's steps only aberration is left. */
    double to_sun[3], apparent[3], intermediate[3], ra, dec;
    for (int i = 0; i < 3; i++) to_sun[i] = -observer.eh[i];
    eraAb(to_sun, observer.v, observer.em, observer.bm1, apparent);
    eraRxp(observer.bpn, apparent, intermediate);
    eraC2s(intermediate, &ra, &dec);

    double azimuth, zenith, hour_angle, observed_dec, observed_ra;
    eraAtioq(ra, dec, &observer, &azimuth, &zenith, &hour_angle, &observed_dec, &observed_ra);

    double elevation = M_PI / 2 - zenith;
    elevation += refraction_rad(elevation, air);
    *sun = (struct sun_position){
        .azimuth_rad = azimuth < 2 * M_PI ? azimuth : 0,
        .elevation_rad = elevation,
        .direction = { cos(elevation) * sin(azimuth), cos(elevation) * cos(azimuth), sin(elevation) },
    };
    return true;
}

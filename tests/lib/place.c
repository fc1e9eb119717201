#include "lib/place.h"

#include "tests/tap.h"

/* East, north and up from the WGS 84 definition (a = 6378137 m, 1/f = 298.257223563):
 * both places as geocentric vectors, their difference turned into the origin's axes,
 * computed apart from GeographicLib and this program, in double precision. */
static const struct { const char *what; double origin[3], place[3], enu_m[3]; } truths[] = {
    { "straight up", { 40.44694, -79.94902, 300 }, { 40.44694, -79.94902, 310 }, { 0, 0, 10 } },
    { "across a town", { 40.44694, -79.94902, 300 }, { 40.44784, -79.94782, 305 },
      { 101.8049188, 99.9444006, 4.9984037 } },
    { "kilometres, where the earth's curve shows", { 47, 8, 500 }, { 47.01, 8.02, 520 },
      { 1520.9598723, 1111.9942852, 19.7219355 } },
    { "over the date line", { -36.85, 179.999, 10 }, { -36.84, -179.998, 25 },
      { 267.5945396, 1109.7475522, 14.8975500 } },
    { "past the north pole", { 89.999, 30, 0 }, { 89.9985, -120, 2 }, { -83.7705108, 256.7887953, 1.9942998 } },
    { "from the north pole", { 90, 0, 0 }, { 89.999, 90, 0 }, { 111.6939796, 0, -0.0009747 } },
    { "from the south pole", { -90, 0, 0 }, { -89.999, 0, 5 }, { 0, 111.6940668, 4.9990253 } },
    { "a quarter round the earth", { 0, 0, 0 }, { 0, 90, 0 }, { 6378137, 0, -6378137 } },
};

static void check_truths(void)
{
    for (size_t i = 0; i < sizeof truths / sizeof *truths; i++) {
        struct error err = ERROR_NONE;
        double enu[3] = { NAN, NAN, NAN }, back[3] = { NAN, NAN, NAN };
        bool good = place_enu_from_geodetic(enu, truths[i].origin, truths[i].place, &err)
                    && place_geodetic_from_enu(back, truths[i].origin, truths[i].enu_m, &err);
        double worst_m = 0, worst_back_m = 0;
        for (int k = 0; k < 3; k++) {
            worst_m = fmax(worst_m, fabs(enu[k] - truths[i].enu_m[k]));
            /* angles as metres on the ground */
            double m = k == 2 ? 1 : k == 1 ? 111320 * cos(truths[i].place[0] * M_PI / 180) : 111320;
            worst_back_m = fmax(worst_back_m, m * fabs(back[k] - truths[i].place[k]));
        }
        OK(good && worst_m < 1e-6, "%s: east, north, up within 1e-6 m (%.1e)", truths[i].what, worst_m);
        OK(good && worst_back_m < 1e-6, "%s: and back (%.1e)", truths[i].what, worst_back_m);
    }
}

static void check_round_trips(void)
{
    double worst_deg = 0, worst_m = 0;
    bool good = true;
    struct error err = ERROR_NONE;
    const double latitudes[] = { -89.99, -60, -0.5, 0, 23.4, 66.6, 89.9 };
    const double longitudes[] = { -180, -179.999, -93, 0, 12.5, 179.999, 180 };
    for (size_t i = 0; i < 7; i++)
        for (size_t j = 0; j < 7; j++) {
            double origin[3] = { latitudes[i], longitudes[j], 120 };
            double enu[3] = { 700, -1300, 40 }, place[3], enu_back[3], place_back[3];
            good = good && place_geodetic_from_enu(place, origin, enu, &err)
                   && place_enu_from_geodetic(enu_back, origin, place, &err)
                   && place_geodetic_from_enu(place_back, origin, enu_back, &err) && fabs(place[1]) <= 180;
            if (!good) break;
            for (int k = 0; k < 3; k++) worst_m = fmax(worst_m, fabs(enu_back[k] - enu[k]));
            for (int k = 0; k < 2; k++) worst_deg = fmax(worst_deg, fabs(place_back[k] - place[k]));
        }
    OK(good, "every place converts, and longitudes come back within 180 deg");
    NEAR(worst_m, 0, 1e-6, "east, north, up survive the way there and back");
    NEAR(worst_deg, 0, 1e-9, "latitude and longitude too");
}

static void check_refusals(void)
{
    const double good[3] = { 10, 20, 30 };
    const double bad[][3] = { { 90.0001, 0, 0 }, { -91, 0, 0 }, { NAN, 0, 0 }, { 0, INFINITY, 0 }, { 0, 0, NAN } };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        double out[3] = { 1, 2, 3 };
        struct error err = ERROR_NONE, err_origin = ERROR_NONE;
        OK(!place_enu_from_geodetic(out, good, bad[i], &err) && err.code == ERR_INPUT
               && !place_enu_from_geodetic(out, bad[i], good, &err_origin) && err_origin.code == ERR_INPUT
               && out[0] == 1 && out[1] == 2 && out[2] == 3,
           "refuses %g, %g, %g as place and as origin, and leaves the output alone", bad[i][0], bad[i][1], bad[i][2]);
    }
    double out[3] = { 1, 2, 3 };
    struct error err = ERROR_NONE;
    OK(!place_geodetic_from_enu(out, good, (double[3]){ NAN, 0, 0 }, &err) && err.code == ERR_INPUT && out[0] == 1,
       "refuses an offset that is not a number");
}

int main(void)
{
    check_truths();
    check_round_trips();
    check_refusals();
    return tap_done();
}

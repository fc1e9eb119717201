#include "gen/estimate/daylight_locus.h"

#include "gen/light/daylight.h"

#include <math.h>

#define TURBIDITY_MIN 1.7
#define TURBIDITY_STEP 0.2
/* Standard deviation of ln(blue / that of the model): craig sunny has -0.5, the flight over Brighton Beach 0.4. */
#define BLUE_SIGMA 0.5
#define BLUE_LEAST 0.1

struct daylight_locus daylight_locus(double sun_elevation_rad, double pressure)
{
    struct daylight_locus locus;
    for (int i = 0; i < LOCUS_STEPS; i++) {
        struct atmosphere_light air = { TURBIDITY_MIN + i * TURBIDITY_STEP, pressure };
        struct daylight d;
        double ratio[3];
        daylight_of_clear_sky(&d, sun_elevation_rad, air);
        for (int c = 0; c < 3; c++) ratio[c] = d.sky[c] / (d.sky[c] + d.sun[c] * sin(sun_elevation_rad));
        locus.depth[i] = log(ratio[1]);
        locus.blue[i] = log(ratio[2] / ratio[0]);
    }
    return locus;
}

double daylight_locus_likelihood(const struct daylight_locus *locus, double depth, double blue)
{
    int i = 0;
    while (i < LOCUS_STEPS - 1 && locus->depth[i] < depth) i++;
    double off = log(fmax(blue, BLUE_LEAST) / fmax(locus->blue[i], BLUE_LEAST)) / BLUE_SIGMA;
    return exp(-off * off / 2);
}

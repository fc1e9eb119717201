/* How blue the shade can be: deep shade goes with a clear sky, which is blue, and light shade with haze, which is white. */
#ifndef STAFFAGE_GEN_DAYLIGHT_LOCUS_H
#define STAFFAGE_GEN_DAYLIGHT_LOCUS_H

enum { LOCUS_STEPS = 42 };

/* From the clearest sky to the haziest. */
struct daylight_locus {
    double depth[LOCUS_STEPS];  /* ln of shade over lit, green */
    double blue[LOCUS_STEPS];   /* ln of (blue shade over lit / red shade over lit) */
};

/* Of a sun at an elevation above 0; pressure in units of that at sea level. */
struct daylight_locus daylight_locus(double sun_elevation_rad, double pressure);

/* 1 for shade as blue as the model's of that depth, less the farther from it; a camera's tone curve deepens shade and
 * its colour alike, so that half as blue or twice as blue is still likely. */
double daylight_locus_likelihood(const struct daylight_locus *locus, double depth, double blue);

#endif

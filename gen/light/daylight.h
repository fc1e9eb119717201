/* How much light, and of what colour, sun and sky give under a cloudless sky: one atmosphere for both. */
#ifndef STAFFAGE_GEN_DAYLIGHT_H
#define STAFFAGE_GEN_DAYLIGHT_H

struct atmosphere_light {
    double turbidity;        /* optical thickness of air and haze in units of that of clean air; at least 1 */
    double pressure;         /* of the place, in units of that at sea level */
};

/* Illuminances in lux, as linear Rec.709 (white D65), whose luminance is the illuminance. */
struct daylight {
    double sun[3];           /* on a surface that faces the sun */
    double sky[3];           /* of the whole sky on a level surface */
};

/* Of a sun at an elevation above 0.
 * Src: Bird, Riordan 1984, Simple Solar Spectral Model (SERI/TR-215-2436): 380 to 740 nm, rural haze;
 *      haze by turbidity: Preetham, Shirley, Smits 1999, appendix */
void daylight_of_clear_sky(struct daylight *daylight, double sun_elevation_rad, struct atmosphere_light air);

/* Illuminance of the sun before the atmosphere. */
double daylight_extraterrestrial_lx(void);

#endif

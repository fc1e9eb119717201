/* How bright a sky is in one direction beside another, and of what colour. How much light it gives in all is
 * said elsewhere: these are relative figures. */
#ifndef STAFFAGE_GEN_SKY_FORM_H
#define STAFFAGE_GEN_SKY_FORM_H

#include "lib/vec.h"

#include <stdbool.h>

struct perez { double a, b, c, d, e; };

/* A cloudless sky.
 * Src: Preetham, Shirley, Smits 1999, A Practical Analytic Model for Daylight, appendix */
struct clear_form {
    struct vec3 sun;
    struct perez luminance, x, y;
    double zenith_x, zenith_y; /* chromaticity */
};
/* The fit is good between these; beyond, it is that of the limit: at 2 it would crowd the light round the sun twice
 * as much as at 2.5, which clean air does not do. */
#define CLEAR_TURBIDITY_MIN 2.5
#define CLEAR_TURBIDITY_MAX 10
struct clear_form clear_form(struct vec3 sun, double turbidity);
double clear_form_luminance(const struct clear_form *form, struct vec3 direction);
/* Out: rgb linear Rec.709 of luminance 1 */
void clear_form_color(double rgb[3], const struct clear_form *form, struct vec3 direction);

/* The CIE's standard skies.
 * Src: CIE S 011/E:2003 (form), Kittler, Perez, Darula 1997, A New Generation of Sky Standards (turbidity, diffuse) */
#define CIE_SKY_TYPES 15
struct cie_sky {
    double a, b, c, d, e;
    bool turns;        /* is not the same all round: the sun's direction matters */
    bool shows_sun;
    bool clouded;      /* in part: what dims the sun is cloud */
    double turbidity;  /* luminous, typical, where the sun shows */
    double diffuse;    /* illuminance of the level ground by the sky alone, typical, in units of the sun's before the atmosphere */
};
/* In: type 1 ... 15 */
const struct cie_sky *cie_sky(int type);
double cie_sky_luminance(const struct cie_sky *sky, struct vec3 sun, struct vec3 direction);

/* The overcast sky of Moon and Spencer, (1 + 2 sin e) / 3: type 1 in its traditional form. */
double overcast_luminance(struct vec3 direction);

#endif

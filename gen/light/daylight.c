#include "gen/light/daylight.h"

#include <math.h>

/* Sunlight before the atmosphere (W m-2 nm-1), absorption of water (1/cm), ozone (1/cm) and mixed gases (1/km),
 * all from the report, at the wavelengths of the CIE 1931 colour matching functions. */
static const struct wavelength { double nm, sun, water, ozone, gas, matching[3]; } spectrum[] = {
    { 380, 1.104, 0, 0, 0, { 0.001368, 3.9e-05, 0.00645 } },
    { 390, 1.034, 0, 0, 0, { 0.004243, 0.00012, 0.02005 } },
    { 400, 1.479, 0, 0, 0, { 0.01431, 0.000396, 0.06785 } },
    { 410, 1.701, 0, 0, 0, { 0.04351, 0.00121, 0.2074 } },
    { 420, 1.74, 0, 0, 0, { 0.13438, 0.004, 0.6456 } },
    { 430, 1.587, 0, 0, 0, { 0.2839, 0.0116, 1.3856 } },
    { 440, 1.837, 0, 0, 0, { 0.34828, 0.023, 1.74706 } },
    { 450, 2.005, 0, 0.003, 0, { 0.3362, 0.038, 1.77211 } },
    { 460, 2.043, 0, 0.006, 0, { 0.2908, 0.06, 1.6692 } },
    { 470, 1.987, 0, 0.009, 0, { 0.19536, 0.09098, 1.28764 } },
    { 480, 2.027, 0, 0.014, 0, { 0.09564, 0.13902, 0.81295 } },
    { 490, 1.896, 0, 0.021, 0, { 0.03201, 0.20802, 0.46518 } },
    { 500, 1.909, 0, 0.03, 0, { 0.0049, 0.323, 0.272 } },
    { 510, 1.927, 0, 0.04, 0, { 0.0093, 0.503, 0.1582 } },
    { 520, 1.831, 0, 0.048, 0, { 0.06327, 0.71, 0.07825 } },
    { 530, 1.891, 0, 0.063, 0, { 0.1655, 0.862, 0.04216 } },
    { 540, 1.898, 0, 0.075, 0, { 0.2904, 0.954, 0.0203 } },
    { 550, 1.892, 0, 0.085, 0, { 0.43345, 0.99495, 0.00875 } },
    { 560, 1.866, 0, 0.103, 0, { 0.5945, 0.995, 0.0039 } },
    { 570, 1.84, 0, 0.12, 0, { 0.7621, 0.952, 0.0021 } },
    { 580, 1.809, 0.0326, 0.12, 0, { 0.9163, 0.87, 0.00165 } },
    { 590, 1.777, 0.0652, 0.119, 0, { 1.0263, 0.757, 0.0011 } },
    { 600, 1.752, 0.0441, 0.119, 0, { 1.0622, 0.631, 0.0008 } },
    { 610, 1.728, 0, 0.12, 0, { 1.0026, 0.503, 0.00034 } },
    { 620, 1.693, 0, 0.105, 0, { 0.85445, 0.381, 0.00019 } },
    { 630, 1.658, 0, 0.09, 0, { 0.6424, 0.265, 5e-05 } },
    { 640, 1.606, 0, 0.0804, 0, { 0.4479, 0.175, 2e-05 } },
    { 650, 1.555, 0, 0.0708, 0, { 0.2835, 0.107, 0 } },
    { 660, 1.526, 0, 0.0602, 0, { 0.1649, 0.061, 0 } },
    { 670, 1.519, 0.00171, 0.0485, 0.0161, { 0.0874, 0.032, 0 } },
    { 680, 1.47, 0.00886, 0.0383, 0.083, { 0.04677, 0.017, 0 } },
    { 690, 1.42, 0.016, 0.028, 0.15, { 0.0227, 0.00821, 0 } },
    { 700, 1.409, 0.0143, 0.023, 0.075, { 0.011359, 0.004102, 0 } },
    { 710, 1.399, 0.0125, 0.018, 0, { 0.00579, 0.002091, 0 } },
    { 720, 1.374, 2.02, 0.0141, 0, { 0.002899, 0.001047, 0 } },
    { 730, 1.346, 1.62, 0.0113, 0, { 0.00144, 0.00052, 0 } },
    { 740, 1.298, 0.061, 0.01, 0, { 0.00069, 0.000249, 0 } },
};
enum { WAVELENGTHS = sizeof spectrum / sizeof *spectrum };
#define STEP_NM 10
#define LUMEN_PER_W 683

/* The report's rural atmosphere over ground of 0.2. */
#define WATER_CM 1.5
#define OZONE_CM 0.3
#define GROUND 0.2
#define ASYMMETRY 0.65
#define HAZE_EXPONENT 1.3 /* with this the turbidity's share of haze is stated */

/* What gets through, by what takes it. */
struct transmittance { double rayleigh, haze, haze_scattered, haze_absorbed, gases, water; };

static struct transmittance transmittance(const struct wavelength *w, double air_mass, double ozone_mass,
                                          double haze_thickness, double haze_albedo, double pressure)
{
    double um2 = w->nm * w->nm * 1e-6, water = w->water * WATER_CM * air_mass, gas = w->gas * air_mass * pressure;
    return (struct transmittance){
        .rayleigh = exp(-air_mass * pressure / (um2 * um2 * (115.6406 - 1.335 / um2))),
        .haze = exp(-haze_thickness * air_mass),
        .haze_scattered = exp(-haze_albedo * haze_thickness * air_mass),
        .haze_absorbed = exp(-(1 - haze_albedo) * haze_thickness * air_mass),
        .gases = exp(-w->ozone * OZONE_CM * ozone_mass) * exp(-1.41 * gas / pow(1 + 118.93 * gas, 0.45)),
        .water = exp(-0.2385 * water / pow(1 + 20.07 * water, 0.45)),
    };
}

static double ozone_mass(double cos_zenith)
{
    const double height = 22.0 / 6370;
    return (1 + height) / sqrt(cos_zenith * cos_zenith + 2 * height);
}

/* Share of what haze scatters that goes on downward. */
static double scattered_down(double cos_zenith)
{
    double g = log(1 - ASYMMETRY);
    double a = g * (1.459 + g * (0.1595 + g * 0.4129)), b = g * (0.0783 + g * (-0.3824 - g * 0.5874));
    return 1 - 0.5 * exp((a + b * cos_zenith) * cos_zenith);
}

static void rgb_from_xyz(double rgb[3], const double xyz[3])
{
    rgb[0] = 3.2404542 * xyz[0] - 1.5371385 * xyz[1] - 0.4985314 * xyz[2];
    rgb[1] = -0.9692660 * xyz[0] + 1.8760108 * xyz[1] + 0.0415560 * xyz[2];
    rgb[2] = 0.0556434 * xyz[0] - 0.2040259 * xyz[1] + 1.0572252 * xyz[2];
    /* Out of the gamut, as the sun near the horizon: the nearest colour of that luminance. */
    double luminance = fmax(0, xyz[1]), least = fmin(fmin(rgb[0], rgb[1]), rgb[2]);
    if (least >= 0) return;
    double keep = luminance / (luminance - least);
    for (int c = 0; c < 3; c++) rgb[c] = fmax(0, luminance + keep * (rgb[c] - luminance));
}

void daylight_of_clear_sky(struct daylight *daylight, double sun_elevation_rad, struct atmosphere_light air)
{
    double cosine = sin(sun_elevation_rad), zenith_deg = 90 - sun_elevation_rad * 180 / M_PI;
    double air_mass = 1 / (cosine + 0.15 * pow(93.885 - zenith_deg, -1.253));
    double haze = fmax(0, 0.04608 * air.turbidity - 0.04586);
    double down = scattered_down(cosine), down_slant = scattered_down(1 / 1.8);
    double sun_xyz[3] = { 0 }, sky_xyz[3] = { 0 };
    for (int i = 0; i < WAVELENGTHS; i++) {
        const struct wavelength *w = &spectrum[i];
        double logarithm = log(w->nm / 400);
        double thickness = haze * pow(w->nm / 1000, -HAZE_EXPONENT), albedo = 0.945 * exp(-0.095 * logarithm * logarithm);
        struct transmittance t = transmittance(w, air_mass, ozone_mass(cosine), thickness, albedo, air.pressure);
        double sun = w->sun * t.rayleigh * t.haze * t.gases * t.water;
        double arriving = w->sun * cosine * t.gases * t.water * t.haze_absorbed;
        double sky = arriving * ((1 - pow(t.rayleigh, 0.95)) * 0.5 + pow(t.rayleigh, 1.5) * (1 - t.haze_scattered) * down);
        /* What the ground throws up, the sky throws back: seen from there, at an air mass of 1.8. */
        struct transmittance s = transmittance(w, 1.8, ozone_mass(1 / 1.8), thickness, albedo, air.pressure);
        double back = s.gases * s.water * s.haze_absorbed *
                      (0.5 * (1 - s.rayleigh) + (1 - down_slant) * s.rayleigh * (1 - s.haze_scattered));
        sky += (sun * cosine + sky) * back * GROUND / (1 - back * GROUND);
        if (w->nm <= 450) sky *= pow((w->nm + 550) / 1000, 1.8);
        for (int c = 0; c < 3; c++) {
            sun_xyz[c] += LUMEN_PER_W * STEP_NM * w->matching[c] * sun;
            sky_xyz[c] += LUMEN_PER_W * STEP_NM * w->matching[c] * sky;
        }
    }
    rgb_from_xyz(daylight->sun, sun_xyz);
    rgb_from_xyz(daylight->sky, sky_xyz);
}

double daylight_extraterrestrial_lx(void)
{
    double sum = 0;
    for (int i = 0; i < WAVELENGTHS; i++) sum += LUMEN_PER_W * STEP_NM * spectrum[i].matching[1] * spectrum[i].sun;
    return sum;
}

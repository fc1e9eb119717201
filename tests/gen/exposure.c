#include "gen/light/exposure.h"

#include "tests/tap.h"

#define W 20
#define H 10

static uint8_t pixels[W * H * 3];

static void paint(int x0, int x1, uint8_t r, uint8_t g, uint8_t b)
{
    for (int y = 0; y < H; y++)
        for (int x = x0; x < x1; x++) memcpy(pixels + 3 * (y * W + x), (uint8_t[]){ r, g, b }, 3);
}

static void refuses(const struct image *photograph, struct rect patch, const double radiance[3], const char *text)
{
    struct error err = ERROR_NONE;
    struct exposure e;
    bool refused = !exposure_fit(&e, photograph, patch, radiance, true, &err);
    OK(refused && err.code == ERR_INPUT && !strcmp(err.text, text), "refused: %s", err.text);
}

/* 188, 137, 99 are 0.50289, 0.25016, 0.12477 in linear light. */
static void check_samples(void)
{
    struct image photograph = { W, H, 3, PIXEL_U8, pixels };
    const double radiance[3] = { 0.1, 0.2, 0.4 };
    struct vec2 q[60];
    struct error err = ERROR_NONE;
    struct exposure e;
    paint(0, 10, 188, 137, 99);
    paint(10, 14, 30, 30, 30);    /* a shadow that nobody knows of */
    paint(14, 20, 255, 250, 240); /* a white line */
    for (int i = 0; i < 60; i++) q[i] = (struct vec2){ i % 20 + 0.5, i / 20 + 0.999 };
    if (!OK(exposure_fit_samples(&e, &photograph, q, 60, radiance, true, &err), "samples here and there are fitted")) return;
    OK(e.fitted && e.samples == 42, "those that are not saturated");
    NEAR(e.at_px.x, 7, 1e-9, "where these are: columns 0.5 to 13.5");
    NEAR(e.at_px.y, 1.999, 1e-9, "and rows 0.999 to 2.999");
    NEAR(e.k[0], 5.0289, 1e-3, "red: median 0.50289 / 0.1, though 12 of them lie in shadow");
    NEAR(e.k[2], 0.31193, 1e-3, "blue: 0.12477 / 0.4");
    OK(exposure_fit_samples(&e, &photograph, q, 60, radiance, false, &err) && e.k[0] == e.k[2], "without white balance one k");
    NEAR(e.k[1], 1.52625, 1e-3, "by luminance: 0.29484 / 0.19318");
    q[0].x = -0.001, q[1].y = H, q[2].x = NAN;
    OK(exposure_fit_samples(&e, &photograph, q, 30, radiance, true, &err) && e.samples == 21, "those outside the picture are left out");
    OK(!exposure_fit_samples(&e, &photograph, q, 28, radiance, true, &err) && err.code == ERR_INPUT &&
           strstr(err.text, "19 of 28 pixels of sunlit ground are in the picture and not saturated, at least 20 are needed"),
       "19 are too few: %s", err.text);
    err = ERROR_NONE;
    OK(!exposure_fit_samples(&e, &photograph, NULL, 0, radiance, true, &err) && strstr(err.text, "0 of 0"), "and so are none");
    err = ERROR_NONE;
    paint(0, 20, 0, 0, 0);
    OK(!exposure_fit_samples(&e, &photograph, q, 60, radiance, true, &err) && strstr(err.text, "are black"), "black is refused: %s", err.text);
    err = ERROR_NONE;
    OK(!exposure_fit_samples(&e, &photograph, q, 60, (double[]){ 0, 1, 1 }, true, &err) && strstr(err.text, "no radiance"), "and a ground without light");
}

/* Ground of 0.3 through air that keeps half of it back, with haze of 0.4 before it, is a pixel of 0.35. */
static void exposure_looks_through_the_air(void)
{
    const double radiance[3] = { 0.15, 0.15, 0.15 }, air[3] = { 0.4, 0.4, 0.4 }, bright[3] = { 0.9, 0.9, 0.9 };
    struct exposure e = { .fitted = true, .median = { 0.35, 0.35, 0.35 } };
    struct error err = ERROR_NONE;
    OK(exposure_clear(&e, 0.5, air, radiance, true, &err), "a haze that the ground is brighter than: %s", err.text);
    for (int c = 0; c < 3; c++) NEAR(e.k[c], 2, 1e-12, "the ground alone tells the exposure");
    OK(!exposure_clear(&e, 0.5, bright, radiance, true, &err) && err.code == ERR_INPUT, "a haze brighter than all of it is refused: %s", err.text);
}

int main(void)
{
    struct image photograph = { W, H, 3, PIXEL_U8, pixels };
    struct error err = ERROR_NONE;
    struct exposure e;
    const double radiance[3] = { 0.1, 0.2, 0.4 };
    const struct rect patch = { 0, 0, 10, 10 };

    /* sRGB 188, 137, 99 are 0.50289, 0.25016, 0.12477 in linear light (IEC 61966-2-1) */
    paint(0, 10, 188, 137, 99);
    paint(10, 20, 255, 255, 255);
    paint(0, 2, 160, 120, 90);
    paint(2, 4, 210, 150, 120);
    if (!OK(exposure_fit(&e, &photograph, patch, radiance, true, &err), "an even patch is fitted")) return tap_done();
    OK(e.at_px.x == 5 && e.at_px.y == 5, "where it is");
    NEAR(e.k[0], 5.0289, 1e-3, "red: median 0.50289 / 0.1, whatever a fifth of the pixels on either side are");
    NEAR(e.k[1], 1.2508, 1e-3, "green: 0.25016 / 0.2");
    NEAR(e.k[2], 0.31193, 1e-3, "blue: 0.12477 / 0.4");
    OK(exposure_fit(&e, &photograph, patch, radiance, false, &err), "without white balance");
    /* Rec.709 luminance 0.29484 of the patch, 0.19318 of the ground */
    NEAR(e.k[0], 1.52625, 1e-3, "one k by luminance: 0.29484 / 0.19318");
    OK(e.k[0] == e.k[1] && e.k[1] == e.k[2], "for all channels");

    e = exposure_given((double[3]){ 0.7, 0.8, 0.9 }, W, H);
    OK(e.k[0] == 0.7 && e.k[1] == 0.8 && e.k[2] == 0.9 && !e.fitted, "a given exposure is taken as it is");
    OK(e.at_px.x == 10 && e.at_px.y == 5, "for the middle of the picture");

    refuses(&photograph, (struct rect){ 15, 0, 21, 5 }, radiance,
            "exposure patch 15,0 to 21,5: lies outside the picture of 20 x 10 pixels, or is empty");
    refuses(&photograph, (struct rect){ 5, 5, 5, 8 }, radiance,
            "exposure patch 5,5 to 5,8: lies outside the picture of 20 x 10 pixels, or is empty");
    refuses(&photograph, (struct rect){ 4, 0, 14, 10 }, radiance,
            "exposure patch 4,0 to 14,10: 40.0 % of it is saturated: choose a patch of evenly lit ground, or give the exposure");
    refuses(&photograph, patch, (double[]){ 0.1, 0, 0.1 },
            "the rendered ground has no radiance (0.1 0 0.1): no exposure can be fitted to it");
    paint(0, 10, 137, 137, 137); /* 0.25016 */
    paint(0, 3, 50, 50, 50);     /* 0.03190: less than an eighth, on three tenths */
    refuses(&photograph, patch, radiance,
            "exposure patch 0,0 to 10,10: its bright parts are 7.8 times as bright as its dark ones: choose a patch of evenly lit ground");
    paint(0, 10, 0, 0, 0);
    refuses(&photograph, patch, radiance,
            "exposure patch 0,0 to 10,10: is black: choose a patch of evenly lit ground, or give the exposure");
    paint(0, 10, 128, 128, 128);
    memset(pixels, 255, 3);
    OK(exposure_fit(&e, &photograph, patch, radiance, true, &err), "one pixel of a hundred may be saturated");
    check_samples();
    exposure_looks_through_the_air();
    return tap_done();
}

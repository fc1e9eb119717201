#include "gen/estimate/estimate.h"

#include "lib/file.h"
#include "lib/luminance.h"

#include <math.h>
#include <stdlib.h>

static const char *const from_name[] = { "marks", "mesh", "photograph" };

static double exposure_of(const struct light_estimate *e, const double radiance[3], int c)
{
    return e->lit[c] > 0 && radiance[c] > 0 ? e->lit[c] / radiance[c] : 0;
}

/* Both triples, of R, G and B. */
static char *triple_text(const double v[3], const double sigma[3])
{
    return string_format("R %.3f +- %.3f G %.3f +- %.3f B %.3f +- %.3f", v[0], sigma[0], v[1], sigma[1], v[2], sigma[2]);
}

static char *shade_text(const struct light_estimate *e)
{
    const struct shade *s = &e->shade;
    double sky = luminance_of(e->sky_share), sigma = luminance_of(e->sky_share_sigma); /* the channels' errors go together */
    char *from = e->from == SHADE_FROM_MARKS ? string_format("%zu marked pair%s", s->edges, s->edges == 1 ? "" : "s")
                                             : string_format("%zu pixels of shadow edges in %zu places%s", s->edges, s->places,
                                                             e->from == SHADE_FROM_MESH ? ", which the mesh casts" : "");
    char *shade = triple_text(s->ratio, s->sigma), *share = triple_text(e->sky_share, e->sky_share_sigma);
    char *text = from && shade && share
        ? string_format("light: clear, sure to %.0f %%; shade to lit %s (from %s)\n"
                        "light: in the open the sky gives %s, sun to sky %.2f +- %.2f; turbidity %.1f\n", 100 * e->certainty, shade, from, share,
                        (1 - sky) / sky, sigma / (sky * sky), e->turbidity) : NULL;
    free(share);
    free(shade);
    free(from);
    return text;
}

/* Shares that no clear sky has come from pairs that are no shadows. */
static char *doubt_text(const struct light_estimate *e)
{
    static const double doubtful = 0.04;
    if (!e->clear || !(fabs(e->beyond) > doubtful)) return string_format("%s", "");
    const char *what = e->from == SHADE_FROM_MARKS ? "look at the pairs under light.shadows: " : "";
    return e->beyond > 0
        ? string_format("light: warning: the shade is brighter than any clear sky makes it at this height of the sun, by %.2f of the light in the "
                        "open: %sone side may be in the sun like the other, or the sky is not clear\n", e->beyond, what)
        : string_format("light: warning: the shade is darker than any clear sky makes it at this height of the sun, by %.2f of the light in the "
                        "open: %sthe two sides may be of different material, or hardly see the sky\n", -e->beyond, what);
}

static char *clouds_text(const struct light_estimate *e)
{
    return string_format("light: overcast, sure to %.0f %%: %s; where there is sun, mark a pair of pixels under light.shadows, or say "
                         "\"sky: clear\"\n", 100 * e->certainty,
                         e->shade.places ? "too little of what has an edge looks like a shadow" : "nothing on the ground looks like a shadow");
}

static char *check_text(const struct light_estimate *e)
{
    const struct sun_check *c = &e->check;
    if (!e->clear || !e->mesh) return string_format("%s", "");
    if (!e->has_check)
        return string_format("%s", "light: the mesh casts too few of these shadows to tell whether the sun stands where they put it\n");
    return string_format("light: by the shadows the sun stands %.1f +- %.1f deg %s and %.1f +- %.1f deg %s%s: %.0f %% of %zu edges agree with the "
                         "mesh's shadows, there %.0f %%\n", fabs(c->azimuth_off_deg), c->azimuth_sigma_deg,
                         c->azimuth_off_deg < 0 ? "anticlockwise" : "clockwise", fabs(c->elevation_off_deg), c->elevation_sigma_deg,
                         c->elevation_off_deg < 0 ? "lower" : "higher", c->at_limit ? " or more" : "", 100 * c->agree, c->edges, 100 * c->agree_there);
}

/* What is white and in the open is seldom burnt out by more: in its photographs a camera keeps most of what there is. */
char *light_estimate_doubt(const struct light_estimate *e, const double ground_radiance[3])
{
    static const double doubtful = 2;
    double k[3];
    for (int c = 0; c < 3; c++) k[c] = exposure_of(e, ground_radiance, c);
    double exposure = luminance_of(k);
    if (exposure <= doubtful) return string_format("%s", "");
    return string_format("light: warning: what is white would be %.1f times as bright in the open as the photograph can show, and so will be what is "
                         "put in: ground.albedo may be too low (concrete has 0.25 to 0.35, worn asphalt 0.12 to 0.2)\n", exposure);
}

static char *exposure_text(const struct light_estimate *e, const double radiance[3])
{
    if (!(e->lit[0] > 0)) return string_format("%s", "");
    double k[3], sigma[3];
    for (int c = 0; c < 3; c++) {
        k[c] = exposure_of(e, radiance, c);
        sigma[c] = k[c] * e->lit_sigma[c] / e->lit[c];
    }
    char *exposure = triple_text(k, sigma);
    char *text = exposure ? string_format("light: exposure %s, if ground.albedo is right\n", exposure) : NULL;
    free(exposure);
    return text;
}

char *light_estimate_text(const struct light_estimate *e, const double ground_radiance[3])
{
    char *light = e->clear ? shade_text(e) : clouds_text(e), *doubt = doubt_text(e), *check = check_text(e);
    char *exposure = exposure_text(e, ground_radiance);
    char *text = light && doubt && check && exposure ? string_format("%s%s%s%s", light, doubt, check, exposure) : NULL;
    free(doubt);
    free(light);
    free(check);
    free(exposure);
    return text;
}

json_t *light_estimate_json(const struct light_estimate *e, const double radiance[3])
{
    const struct shade *s = &e->shade;
    json_t *json = json_pack("{s:s, s:f, s:s, s:i}", "sky", e->clear ? "clear" : "overcast", "certainty", e->certainty, "from",
                             from_name[e->from], "photographs", (int)e->photographs);
    if (!json) return NULL;
    if (s->places) {
        json_object_set_new(json, "shade_to_lit", json_pack("[f,f,f]", s->ratio[0], s->ratio[1], s->ratio[2]));
        json_object_set_new(json, "shade_to_lit_sigma", json_pack("[f,f,f]", s->sigma[0], s->sigma[1], s->sigma[2]));
        json_object_set_new(json, "edges", json_integer((json_int_t)s->edges));
        json_object_set_new(json, "places", json_integer((json_int_t)s->places));
        json_object_set_new(json, "share", json_real(s->share));
    }
    if (e->clear) {
        json_object_set_new(json, "sky_share", json_pack("[f,f,f]", e->sky_share[0], e->sky_share[1], e->sky_share[2]));
        json_object_set_new(json, "sky_share_sigma", json_pack("[f,f,f]", e->sky_share_sigma[0], e->sky_share_sigma[1], e->sky_share_sigma[2]));
        json_object_set_new(json, "turbidity", json_real(e->turbidity));
        json_object_set_new(json, "beyond_clear_skies", json_real(e->beyond));
    }
    if (e->clear && e->has_check) {
        const struct sun_check *c = &e->check;
        json_object_set_new(json, "sun_check", json_pack("{s:f, s:f, s:f, s:f, s:f, s:f, s:i, s:b}",
            "azimuth_off_deg", c->azimuth_off_deg, "azimuth_sigma_deg", c->azimuth_sigma_deg,
            "elevation_off_deg", c->elevation_off_deg, "elevation_sigma_deg", c->elevation_sigma_deg,
            "agree", c->agree, "agree_there", c->agree_there, "edges", (int)c->edges, "at_limit", (int)c->at_limit));
    }
    if (e->lit[0] > 0) {
        json_t *k = json_array(), *sigma = json_array();
        for (int c = 0; c < 3; c++) {
            json_array_append_new(k, json_real(exposure_of(e, radiance, c)));
            json_array_append_new(sigma, json_real(exposure_of(e, radiance, c) * e->lit_sigma[c] / e->lit[c]));
        }
        json_object_set_new(json, "exposure", k);
        json_object_set_new(json, "exposure_sigma", sigma);
    }
    return json;
}

#include "gen/estimate/estimate.h"

#include "gen/estimate/estimate_impl.h"
#include "gen/light/daylight.h"
#include "gen/light/light.h"
#include "gen/light/sky_form.h"
#include "lib/luminance.h"

#include <math.h>
#include <stdlib.h>

/* Shadows found by their looks alone must be clearly bluer than what is lit; those that the place casts, only not redder. */
#define BLUER_BY_LOOKS 0.25
#define BLUER_BY_PLACE 0.05
#define PLACES_ENOUGH 12.0
#define PLACES_PLENTY 30
#define PLACES_OF_SURFACE 4
#define SHALLOW 0.3       /* of the light: deeper shade than that is the sun's */
#define SKY_SHARE_MAX 0.95
#define SKY_SEEN_SIGMA 0.08
#define EDGES_ENOUGH 300.0
#define TURBIDITY_LEAST 1.7
#define ELEVATION_USUAL (40 * M_PI / 180)

size_t estimate_shots(size_t shots[ESTIMATE_PHOTOGRAPHS], const struct scene *scene)
{
    size_t with = 0, n = 0, seen = 0;
    for (size_t i = 0; i < scene->shot_count; i++) with += scene->video || scene->shots[i].photograph;
    size_t wanted = with < ESTIMATE_PHOTOGRAPHS ? with : ESTIMATE_PHOTOGRAPHS;
    for (size_t i = 0; i < scene->shot_count && n < wanted; i++) {
        if (!scene->video && !scene->shots[i].photograph) continue;
        if (seen++ == n * with / wanted) shots[n++] = i;
    }
    return n;
}

static bool out_of_memory(struct error *err)
{
    return error_set(err, ERR_MEMORY, "no memory for an estimate of the light");
}

/* Odds of sun: shadows are of one depth and colour, which daylight allows, and nothing else on the ground is so deep
 * and so blue. On craig sunny 9 in 10 of the edges as deep agree; under clouds (craig wet, median, vtest) less than 1 in 5. */
static double odds_by_looks(const struct shade *shade)
{
    return pow(shade->purity / 0.35, 3) * fmin(3, shade->share / 0.01) * fmin(1, (double)shade->places / PLACES_ENOUGH) * shade->likelihood;
}

/* The same of all surfaces. What is alike on one surface may be two materials: on two it hardly is; and cars
 * and windows are among them, so that it takes more to be as sure. */
static double odds_by_surfaces(const struct shade *shade)
{
    int surfaces = 0;
    for (int i = 0; i < SHADE_SURFACES; i++) surfaces += shade->surface_places[i] >= PLACES_OF_SURFACE;
    return surfaces < 2 ? 0 : odds_by_looks(shade) * fmin(1, pow((double)shade->places / PLACES_PLENTY, 3)) / 3;
}

/* What stands there hides the sky as well, and so under clouds it casts shade, too, which is shallow. */
static double odds_by_depth(const struct shade *shade)
{
    double left = (shade->ratio[0] + shade->ratio[1] + shade->ratio[2]) / 3;
    return pow(fmin(1, fmax(0, 1 - left) / SHALLOW), 2);
}

/* The same where the place tells: of the edges that look like its shadows, so many it casts and so many it would
 * cast the other way round. Without sun they are as many. */
static double odds_by_place(const struct shade *shade, const struct gathered *g)
{
    size_t right = 0, wrong = 0;
    for (size_t i = 0; i < g->n; i++)
        if (shade_is(shade, &g->samples[i])) {
            right += g->told[i] > 0;
            wrong += g->told[i] < 0;
        }
    return pow((double)right / (3.0 * (double)wrong + 40), 2) * fmin(1, pow((double)shade->places / PLACES_ENOUGH, 2)) * odds_by_depth(shade);
}

static double pressure_of(const struct scene *s)
{
    return s->has_place ? exp(-s->place.height_m / 8434.0) : 1;
}

enum among { AMONG_COMMONEST, AMONG_SURFACES, AMONG_CAST };

static bool find_among(struct shade *shade, double *odds, const struct gathered *g, const struct daylight_locus *locus, enum among among,
                       struct error *err)
{
    struct shade_sample *samples = malloc((g->n + 1) * sizeof *samples);
    if (!samples) return out_of_memory(err);
    size_t n = 0;
    for (size_t i = 0; i < g->n; i++)
        if (among == AMONG_CAST ? g->told[i] > 0 : g->on_lit[i] && (among == AMONG_SURFACES || !g->samples[i].surface))
            samples[n++] = g->samples[i];
    bool ok = shade_find(shade, samples, n, among == AMONG_CAST ? BLUER_BY_PLACE : BLUER_BY_LOOKS, locus, err);
    free(samples);
    if (ok) *odds = among == AMONG_CAST ? odds_by_place(shade, g) : among == AMONG_SURFACES ? odds_by_surfaces(shade) : odds_by_looks(shade);
    return ok;
}

/* What the place casts is known to be shadow; but a reconstruction that lacks the trees casts few of them. Else the
 * ground's commonest surface tells, and others where it shows no shadow. */
bool find_shade(struct light_estimate *e, const struct gathered *g, const struct scene *scene, const struct vec3 *sun, struct error *err)
{
    struct daylight_locus locus = daylight_locus(sun ? asin(fmin(1, sun->z)) : ELEVATION_USUAL, pressure_of(scene));
    struct shade others, cast = { 0 };
    double odds, odds_others, odds_cast = 0;
    if (!find_among(&e->shade, &odds, g, &locus, AMONG_COMMONEST, err) || !find_among(&others, &odds_others, g, &locus, AMONG_SURFACES, err) ||
        (g->by_place && !find_among(&cast, &odds_cast, g, &locus, AMONG_CAST, err)))
        return false;
    e->from = SHADE_FROM_EDGES;
    bool sun_on_commonest = odds > 1;
    /* A few places on the commonest surface may all lie under its cars. */
    if (sun_on_commonest ? e->shade.places < PLACES_PLENTY && odds_others > 0 && others.places > 2 * e->shade.places : odds_others > odds) {
        e->shade = others;
        odds = fmax(odds, odds_others);
    } else if (shade_agrees(&e->shade, &others)) {
        odds = fmax(odds, odds_others);
    }
    if (odds_cast > 1 && (cast.places >= PLACES_PLENTY || odds_cast > odds)) {
        e->from = SHADE_FROM_MESH;
        e->shade = cast;
        odds = fmax(odds, odds_cast);
    }
    double sunny = odds / (1 + odds);
    e->clear = sunny > 0.5;
    /* Where hardly anything has an edge, nothing is told either way. */
    e->certainty = e->clear ? sunny : 1 - fmax(sunny, 0.5 * exp(-(double)g->n / EDGES_ENOUGH));
    return true;
}

static bool check_sun(struct light_estimate *e, const struct gathered *g, const struct stage *stage, struct vec3 sun, struct error *err)
{
    struct shadow_sides *sides = malloc((g->n + 1) * sizeof *sides);
    if (!sides) return out_of_memory(err);
    size_t n = 0;
    for (size_t i = 0; i < g->n; i++)
        if (shade_is(&e->shade, &g->samples[i])) sides[n++] = g->sides[i];
    bool ok = sun_check(&e->check, &e->has_check, stage->mesh, sun, sides, n, err);
    free(sides);
    return ok;
}

/* From light in the shade to the sky's share in the open. What casts a shadow that was found by its looks, or marked,
 * hides a part of the sky there as well, which is not known: on the proving ground SKY_SEEN is 0.77 to 0.91, and it makes
 * the shadows of what is put in there, and on craig sunny, as light as those of its neighbours. */
static void open_up(struct light_estimate *e)
{
    double seen = e->from == SHADE_FROM_MESH ? 1 : SKY_SEEN, seen_sigma = e->from == SHADE_FROM_MESH ? 0 : SKY_SEEN_SIGMA;
    for (int c = 0; c < 3; c++) {
        e->sky_share[c] = fmin(e->shade.ratio[c] / seen, SKY_SHARE_MAX);
        e->sky_share_sigma[c] = e->sky_share[c] * hypot(e->shade.sigma[c] / e->shade.ratio[c], seen_sigma / seen);
    }
}

/* The haziest sky is as bright as the sun and more, the clearest hardly a tenth: whose proportion is it? */
static double turbidity_of(double *beyond, const struct light_estimate *e, const struct scene *s, struct vec3 sun)
{
    double best = TURBIDITY_LEAST, least = INFINITY, wanted = luminance_of(e->sky_share);
    for (double t = TURBIDITY_LEAST; t <= CLEAR_TURBIDITY_MAX; t += 0.1) {
        struct atmosphere_light air = { t, pressure_of(s) };
        struct daylight d;
        daylight_of_clear_sky(&d, asin(fmin(1, sun.z)), air);
        double sky = luminance_of(d.sky), direct = luminance_of(d.sun) * sun.z, off = wanted - sky / (sky + direct);
        if (fabs(off) < least) {
            least = fabs(off);
            *beyond = off;
            best = t;
        }
    }
    return best;
}

static bool look_at_all(struct light_estimate *e, struct gathered *g, const struct stage *stage, const struct estimate_photograph *photographs,
                        size_t n, const struct vec3 *sun, struct error *err)
{
    bool ok = true;
    for (size_t i = 0; ok && i < n; i++) {
        struct looked_at l;
        ok = look_at(&l, stage, &photographs[i], i, sun, err) && gather_marks(g, &l, photographs[i].shot, err) &&
             (stage->scene->mark_count || gather_edges(g, &l, err));
        for (int c = 0; ok && c < 3 && !i && l.lit[0].found; c++) {
            e->lit[c] = exp(l.lit[0].ln[c]);
            e->lit_sigma[c] = e->lit[c] * l.lit[0].sigma[c];
        }
        looked_at_release(&l);
    }
    e->photographs = n;
    return ok;
}

static bool sun_is_wanted(const struct light_estimate *e, const struct scene *s, struct error *err)
{
    return error_at(err, ERR_INPUT, s->path, s->light_source.line, s->light_source.column,
                    "light: the photograph shows shadows of the sun (sure to %.0f %%), and where it stands is not known: give place and "
                    "time, or light.sun as {azimuth_deg, elevation_deg}; if there is no sun, \"sky: overcast\"", 100 * e->certainty);
}

bool light_estimate(struct light_estimate *estimate, const struct stage *stage, const struct estimate_photograph *photographs,
                    size_t n, struct error *err)
{
    const struct scene *s = stage->scene;
    struct light_estimate e = { 0 };
    struct vec3 sun = vec3(0, 0, 1);
    bool has_sun = s->sun != SUN_NONE;
    if (has_sun && !light_sun_direction(&sun, s, err)) return false;
    struct gathered g = { .by_place = stage->mesh && has_sun, .sun = sun, .marks = calloc(s->mark_count + 1, sizeof *g.marks) };
    bool ok = (g.marks || out_of_memory(err)) && look_at_all(&e, &g, stage, photographs, n, has_sun ? &sun : NULL, err);
    if (ok && g.mark_count) {
        e.from = SHADE_FROM_MARKS;
        e.clear = true;
        e.certainty = 1;
        ok = shade_of_marks(&e.shade, g.marks, g.mark_count, err);
    } else if (ok) {
        ok = find_shade(&e, &g, s, has_sun ? &sun : NULL, err);
    }
    if (ok && e.clear && !has_sun) ok = sun_is_wanted(&e, s, err);
    if (ok && e.clear) {
        open_up(&e);
        e.turbidity = turbidity_of(&e.beyond, &e, s, sun);
    }
    e.mesh = g.by_place && !g.mark_count;
    if (ok && e.clear && e.mesh) ok = check_sun(&e, &g, stage, sun, err);
    gathered_release(&g);
    if (ok) *estimate = e;
    return ok;
}

void light_estimate_apply(struct scene *scene, const struct light_estimate *e)
{
    scene->sky = e->clear ? SKY_CLEAR : SKY_OVERCAST;
    if (!e->clear) {
        scene->sun = SUN_NONE;
        return;
    }
    scene->turbidity = e->turbidity;
    scene->has_sky_share = true;
    for (int c = 0; c < 3; c++) scene->sky_share[c] = e->sky_share[c];
}

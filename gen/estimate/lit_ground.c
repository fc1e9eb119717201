#include "gen/estimate/lit_ground.h"

#include "gen/sunlit.h"

#include <math.h>
#include <stdlib.h>

/* The same surface: wear and grain change its brightness, hardly its colour. */
#define BRIGHT_WIDTH 0.5
#define COLOR_WIDTH 0.15
/* No camera's white balance is farther off. */
#define BALANCE_MAX 0.4
#define COLOR_BIN 0.06
#define BRIGHT_BIN 0.2
enum { COLOR_BINS = 40, BRIGHT_BINS = 40, CANDIDATES_MIN = 20, APART_PX = 16, SURFACES_MAX = 50 };

struct candidate { int16_t x, y; };
struct candidates { struct candidate *at; size_t n, room; };

static bool add(struct candidates *c, const struct tones *tones, int x, int y)
{
    if (x < 0 || y < 0 || x >= tones->width_px || y >= tones->height_px || !tones_good(tones, x, y)) return true;
    if (c->n == c->room) {
        c->room = c->room ? 2 * c->room : 1024;
        struct candidate *grown = realloc(c->at, c->room * sizeof *grown);
        if (!grown) return false;
        c->at = grown;
    }
    c->at[c->n++] = (struct candidate){ (int16_t)x, (int16_t)y };
    return true;
}

static bool add_patch(struct candidates *c, const struct scene *s, const struct tones *tones, const struct camera *camera,
                      const struct scene_shot *shot)
{
    const struct camera *given = &s->cameras[shot->camera].camera;
    double across = (double)camera->width_px / given->width_px / tones->reduction;
    double down = (double)camera->height_px / given->height_px / tones->reduction;
    bool ok = true;
    for (int y = (int)(s->exposure_patch_px[0].y * down); ok && y < s->exposure_patch_px[1].y * down; y++)
        for (int x = (int)(s->exposure_patch_px[0].x * across); ok && x < s->exposure_patch_px[1].x * across; x++)
            ok = add(c, tones, x, y);
    return ok;
}

static bool add_roads(struct candidates *c, const struct stage *stage, const struct tones *tones, const struct vec3 *sun,
                      const struct camera *camera, struct pose world_from_camera, struct error *err)
{
    struct light light = { .has_sun = sun != NULL, .sun_direction = sun ? *sun : vec3(0, 0, 1) };
    struct vec2 *q = NULL;
    size_t n;
    bool ok = sunlit_pixels(&q, &n, stage, &light, camera, world_from_camera, err);
    for (size_t i = 0; ok && i < n; i++) ok = add(c, tones, (int)q[i].x / tones->reduction, (int)q[i].y / tones->reduction);
    free(q);
    return ok;
}

static bool add_ground(struct candidates *c, const struct stage *stage, const struct tones *tones, const struct ground_view *view,
                       const struct vec3 *sun)
{
    bool ok = true;
    for (int y = 0; ok && y < tones->height_px; y += GROUND_STEP_PX)
        for (int x = 0; ok && x < tones->width_px; x += GROUND_STEP_PX) {
            struct vec3 p;
            if (!ground_view_at(&p, view, x, y)) continue;
            if (stage->mesh && sun && static_mesh_blocks(stage->mesh, p, *sun, 0.3, 1000)) continue;
            ok = add(c, tones, x, y);
        }
    return ok;
}

static double red_of(const float *ln) { return (double)ln[0] - (double)ln[1]; }
static double blue_of(const float *ln) { return (double)ln[2] - (double)ln[1]; }

/* Take those out that the ground's colour can not be, unless that leaves hardly any. */
static void keep_colored(struct candidates *c, const struct tones *tones, const double albedo[3])
{
    double red = log(albedo[0] / albedo[1]), blue = log(albedo[2] / albedo[1]);
    size_t n = 0;
    for (int round = 0; round < 2; round++) {
        size_t kept = 0;
        for (size_t i = 0; i < c->n; i++) {
            const float *ln = tones_at(tones, c->at[i].x, c->at[i].y);
            if (fabs(red_of(ln) - red) > BALANCE_MAX || fabs(blue_of(ln) - blue) > BALANCE_MAX) continue;
            if (round) c->at[kept] = c->at[i];
            kept++;
        }
        if (kept < CANDIDATES_MIN) return;
        n = kept;
    }
    c->n = n;
}

static int bin_of(double v, double bin, int bins)
{
    int i = (int)floor(v / bin) + bins / 2;
    return i < 0 ? 0 : i >= bins ? bins - 1 : i;
}

static bool find_commonest(double ln[3], const struct candidates *c, const struct tones *tones)
{
    uint32_t *count = calloc((size_t)COLOR_BINS * COLOR_BINS * BRIGHT_BINS, sizeof *count), best = 0;
    if (!count) return false;
    for (size_t i = 0; i < c->n; i++) {
        const float *at = tones_at(tones, c->at[i].x, c->at[i].y);
        int r = bin_of(red_of(at), COLOR_BIN, COLOR_BINS), b = bin_of(blue_of(at), COLOR_BIN, COLOR_BINS);
        /* ln of light is below 0 */
        int l = bin_of((double)at[1] + BRIGHT_BIN * BRIGHT_BINS / 2, BRIGHT_BIN, BRIGHT_BINS);
        uint32_t is = ++count[((size_t)r * COLOR_BINS + (size_t)b) * BRIGHT_BINS + (size_t)l];
        if (is < best) continue;
        best = is;
        for (int k = 0; k < 3; k++) ln[k] = (double)at[k];
    }
    free(count);
    return true;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* To the middle of those like it, over and over. */
static bool settle(struct lit_ground *g, const struct candidates *c, const struct tones *tones)
{
    double *v = malloc((c->n + 1) * sizeof *v);
    if (!v) return false;
    for (int round = 0; round < 6; round++) {
        double middle[3] = { 0 };
        for (int k = 0; k < 3; k++) {
            size_t n = 0;
            for (size_t i = 0; i < c->n; i++) {
                const float *ln = tones_at(tones, c->at[i].x, c->at[i].y);
                if (lit_ground_is(g, ln)) v[n++] = (double)ln[k];
            }
            g->found = n;
            if (!n) break;
            qsort(v, n, sizeof *v, ascending);
            middle[k] = v[n / 2];
            /* Neighbours show the same wear: a working pixel in so many counts. */
            double spread = (v[n * 84 / 100] - v[n * 16 / 100]) / 2;
            g->sigma[k] = 1.2533 * spread / sqrt(fmax(1, (double)n * GROUND_STEP_PX * GROUND_STEP_PX / (APART_PX * APART_PX)));
        }
        if (!g->found) break;
        for (int k = 0; k < 3; k++) g->ln[k] = middle[k];
    }
    free(v);
    return true;
}

bool lit_ground_is(const struct lit_ground *g, const float *ln)
{
    return fabs((double)ln[1] - g->ln[1]) < BRIGHT_WIDTH && fabs(red_of(ln) - (g->ln[0] - g->ln[1])) < COLOR_WIDTH &&
           fabs(blue_of(ln) - (g->ln[2] - g->ln[1])) < COLOR_WIDTH;
}

static bool list_pixels(struct vec2 **q_px, size_t *count, const struct lit_ground *g, const struct candidates *c, const struct tones *tones)
{
    size_t n = 0, seen = 0;
    struct vec2 *q = malloc((LIT_GROUND_MAX + 1) * sizeof *q);
    if (!q) return false;
    size_t wanted = g->found < LIT_GROUND_MAX ? g->found : LIT_GROUND_MAX;
    for (size_t i = 0; i < c->n && n < wanted; i++) {
        if (!lit_ground_is(g, tones_at(tones, c->at[i].x, c->at[i].y))) continue;
        if (seen++ == n * g->found / wanted) q[n++] = tones_photograph_px(tones, c->at[i].x, c->at[i].y);
    }
    *q_px = q;
    *count = n;
    return true;
}

bool lit_ground_find(struct lit_ground *ground, struct vec2 **q_px, size_t *n, const struct stage *stage, const struct tones *tones,
                     const struct ground_view *view, const struct vec3 *sun, const struct camera *camera,
                     const struct scene_shot *shot, struct error *err)
{
    const struct scene *s = stage->scene;
    bool patch = !s->exposure_given && !s->exposure_of_roads && !s->exposure_of_ground;
    struct candidates c = { 0 };
    struct lit_ground g = { 0 };
    bool ok = patch ? add_patch(&c, s, tones, camera, shot)
              : s->exposure_of_roads ? add_roads(&c, stage, tones, sun, camera, shot->world_from_camera, err) : true;
    if (ok && c.n < CANDIDATES_MIN) ok = add_ground(&c, stage, tones, view, sun);
    if (ok && !patch) keep_colored(&c, tones, s->ground_albedo);
    g.looked_at = c.n;
    ok = ok && (!c.n || (find_commonest(g.ln, &c, tones) && settle(&g, &c, tones))) &&
         (!q_px || list_pixels(q_px, n, &g, &c, tones));
    free(c.at);
    if (!ok) return error_set(err, ERR_MEMORY, "no memory for the lit ground of a photograph");
    *ground = g;
    return true;
}

/* Take out those of a colour. */
static void drop(struct candidates *c, const struct lit_ground *g, const struct tones *tones)
{
    size_t kept = 0;
    for (size_t i = 0; i < c->n; i++)
        if (!lit_ground_is(g, tones_at(tones, c->at[i].x, c->at[i].y))) c->at[kept++] = c->at[i];
    c->n = kept;
}

size_t lit_surfaces_find(struct lit_ground *surfaces, size_t most, const struct lit_ground *first, const struct stage *stage,
                         const struct tones *tones, const struct ground_view *view, const struct vec3 *sun)
{
    struct candidates c = { 0 };
    size_t n = 1;
    bool ok = add_ground(&c, stage, tones, view, sun);
    size_t all = c.n;
    surfaces[0] = *first;
    while (ok && n < most) {
        struct lit_ground g = { 0 };
        drop(&c, &surfaces[n - 1], tones);
        if (c.n < all / SURFACES_MAX) break;
        ok = find_commonest(g.ln, &c, tones) && settle(&g, &c, tones);
        if (g.found < all / SURFACES_MAX) break;
        surfaces[n++] = g;
    }
    free(c.at);
    return ok ? n : 0;
}

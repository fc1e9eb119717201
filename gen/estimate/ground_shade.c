#include "gen/estimate/ground_shade.h"

#include "gen/estimate/estimate_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How far a surface differs from itself, in ln: brightness by wear and grain, its colour hardly. */
#define BRIGHT_SIGMA 0.22
#define COLOR_SIGMA 0.07
/* Less of the sky than elsewhere may reach the shade: what is deeper is as likely with so much of the difference. */
#define DEEPER 0.5
/* Sums of squares in these units: it can be, it is. */
#define DISTANCE_MAX 9.0
#define SURE_DISTANCE 3.0
/* Between two readings as likely it is lit. */
#define LIT_PRIOR 1.0
/* The photograph's shadows are the light's: as deep and as blue, give or take the sky that is hidden there, and the camera's curve. */
#define DEPTH_OFF 0.7
#define BLUE_OFF 0.5
/* A share of the sun below is shade, above is light. */
#define SHADE_MAX 0.3
#define SUN_MIN 0.75
/* Shares that may be none, and all. */
#define NO_SUN 0.2
#define ALL_SUN 0.85
/* A piece of shade is twice as wide somewhere, and nowhere thinner than twice this; its ground is in
 * the sun along so much of its border, where it ends neither in
 * other shade nor with the ground in view, and along so much of all of it. */
#define HALF_WIDTH_M 0.15
#define HALF_THIN_M 0.04
#define SUN_BESIDE_MIN 0.35
#define SUN_ROUND_MIN 0.25
#define COARSEST_M 1.0
/* Or a mesh casts so much of it; its own surface, which is rough, casts none. */
#define CAST_MIN 0.5
#define OFF_MESH_M 0.3
#define SUN_FAR_M 1000
enum { PIECE_MIN = 24, BESIDE_PX = 8, BORDER_MIN = 12, REACH_PX = 3, RIM_PX = 4 };

/* --- one colour --- */

/* How far a colour is from a surface with a share of the sun, in standard deviations squared. In: x: ln of it over the surface's */
static double distance(const float light[3], const double x[3], bool deepest)
{
    double bright = x[1] - (double)light[1], red = x[0] - (double)light[0] - bright, blue = x[2] - (double)light[2] - bright;
    if (deepest && bright < 0) bright *= DEEPER;
    return bright * bright / (BRIGHT_SIGMA * BRIGHT_SIGMA) + (red * red + blue * blue) / (COLOR_SIGMA * COLOR_SIGMA);
}

/* What a colour says of the sun, if it is that of one of the surfaces. */
static bool read_light(const struct ground_shade *g, double *sun, const float ln[3])
{
    double least = INFINITY;
    for (size_t i = 0; i < g->surfaces; i++) {
        const double *lit = g->lit[i].ln, x[3] = { (double)ln[0] - lit[0], (double)ln[1] - lit[1], (double)ln[2] - lit[2] };
        for (int k = 0; k < SUN_STEPS; k++) {
            double share = (double)k / (SUN_STEPS - 1), off = distance(g->ln_light[k], x, !k), unlikely = off + LIT_PRIOR * (1 - share);
            if (off > DISTANCE_MAX || unlikely >= least) continue;
            least = unlikely;
            *sun = share;
        }
    }
    return isfinite(least);
}

/* Is it the same surface, in the shade and in the sun? */
static bool is_in_shade(const struct ground_shade *g, const float shade[3], const float sun[3])
{
    const double x[3] = { (double)shade[0] - (double)sun[0], (double)shade[1] - (double)sun[1], (double)shade[2] - (double)sun[2] };
    for (int k = 0; k < SHADE_MAX * (SUN_STEPS - 1); k++)
        if (distance(g->ln_light[k], x, !k) < DISTANCE_MAX) return true;
    return false;
}

static void set_light(struct ground_shade *g, const struct shade *shade)
{
    for (int k = 0; k < SUN_STEPS; k++)
        for (int c = 0; c < 3; c++)
            g->ln_light[k][c] = (float)log(shade->ratio[c] + (1 - shade->ratio[c]) * k / (SUN_STEPS - 1));
}

static bool is_shade_of(const struct ground_shade *g, size_t i, size_t of)
{
    const double *lit = g->lit[i].ln, *other = g->lit[of].ln;
    return distance(g->ln_light[0], (const double[]){ lit[0] - other[0], lit[1] - other[1], lit[2] - other[2] }, true) < SURE_DISTANCE;
}

/* A surface that another one is in its shade is none by itself. The first is what the exposure stands on: it is lit. */
static void drop_shaded_surfaces(struct ground_shade *g)
{
    for (size_t i = 1, k; i < g->surfaces;) {
        for (k = 0; k < g->surfaces && (k == i || !is_shade_of(g, i, k)); k++) continue;
        if (k < g->surfaces) g->lit[i] = g->lit[--g->surfaces];
        else i++;
    }
}

/* --- pieces --- */

struct piece_search {
    const struct ground_shade *shade;
    const struct looked_at *look;
    struct vec3 towards_sun;
    int width, height;
    float *sun;            /* (height,width) share of it; NAN: none of the surfaces; INFINITY: no ground in view */
    int32_t *member;       /* (height,width) 0: of no piece yet */
    int32_t *queue;        /* (height * width) */
    uint8_t *wide;         /* (height,width) in shade, and in the middle of so much of it */
};

static const int neighbour[4][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 } };

static bool is_outside(const struct piece_search *s, int x, int y)
{
    return x < 0 || y < 0 || x >= s->width || y >= s->height;
}

/* A piece of shade, into the queue. Returns its pixels. */
static size_t flood(const struct piece_search *s, int32_t from, int32_t piece)
{
    size_t n = 0;
    s->queue[n++] = from;
    s->member[from] = piece;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 4; k++) {
            int x = s->queue[i] % s->width + neighbour[k][0], y = s->queue[i] / s->width + neighbour[k][1], at = y * s->width + x;
            if (is_outside(s, x, y) || s->member[at] || !(s->sun[at] < (float)SHADE_MAX)) continue;
            s->member[at] = piece;
            s->queue[n++] = at;
        }
    return n;
}

/* Working pixels along a way over the ground. */
static int pixels_along(const struct piece_search *s, double way_m, int x, int y, int right, int down)
{
    struct vec3 here, there;
    if (is_outside(s, x + right, y + down) || !ground_view_at(&here, &s->look->view, x, y) || !ground_view_at(&there, &s->look->view, x + right, y + down))
        return PIECE_MIN;
    return (int)fmax(1, round(way_m * GROUND_STEP_PX / fmax(vec3_norm(vec3_sub(there, here)), 1e-6)));
}

/* Pixels of a circle on the ground. Returns whether all of it is of a piece. Out: wide: set there, unless it is NULL */
static bool circle(uint8_t *wide, const struct piece_search *s, double radius_m, int x, int y, int32_t piece)
{
    int across = pixels_along(s, radius_m, x, y, GROUND_STEP_PX, 0), down = pixels_along(s, radius_m, x, y, 0, GROUND_STEP_PX);
    for (int v = -down; v <= down; v++)
        for (int u = -across; u <= across; u++) {
            if ((double)(u * u) / (across * across) + (double)(v * v) / (down * down) > 1) continue;
            if (wide) wide[(y + v) * s->width + x + u] = 1;
            else if (is_outside(s, x + u, y + v) || s->member[(y + v) * s->width + x + u] != piece) return false;
        }
    return true;
}

/* A piece that is wide somewhere, without its thin parts: tar's seams. In: its pixels in the queue */
static void keep_wide(const struct piece_search *s, size_t n, int32_t piece)
{
    bool wide = false;
    for (size_t i = 0; i < n && !wide; i++) wide = circle(NULL, s, HALF_WIDTH_M, s->queue[i] % s->width, s->queue[i] / s->width, piece);
    for (size_t i = 0; i < n && wide; i++) {
        int x = s->queue[i] % s->width, y = s->queue[i] / s->width;
        if (circle(NULL, s, HALF_THIN_M, x, y, piece)) circle(s->wide, s, HALF_THIN_M, x, y, piece);
    }
}

/* What is beside a pixel, straight away from it: the same piece or the end of the ground in view, other shade, the same surface in the sun? */
enum beside { NOTHING_BESIDE, SHADE_BESIDE, SUN_BESIDE, OTHERS_BESIDE };
static enum beside beside(const struct piece_search *s, int x, int y, const int step[2], int32_t piece)
{
    enum beside found = NOTHING_BESIDE;
    for (int far = 1; far <= BESIDE_PX; far++) {
        int u = x + far * step[0], v = y + far * step[1], at = v * s->width + u;
        if (is_outside(s, u, v) || s->member[at] == piece || isinf(s->sun[at])) break;
        if (s->sun[at] > (float)SUN_MIN && is_in_shade(s->shade, tones_at(&s->look->tones, x, y), tones_at(&s->look->tones, u, v))) return SUN_BESIDE;
        found = s->sun[at] < (float)SHADE_MAX ? SHADE_BESIDE : OTHERS_BESIDE;
    }
    return found;
}

/* Round it is the same ground in the sun. In: the piece's pixels in the queue */
static bool is_shade(const struct piece_search *s, size_t n, int32_t piece)
{
    size_t count[OTHERS_BESIDE + 1] = { 0 };
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 4; k++) count[beside(s, s->queue[i] % s->width, s->queue[i] / s->width, neighbour[k], piece)]++;
    double sun = (double)count[SUN_BESIDE], border = sun + (double)count[OTHERS_BESIDE];
    return border >= BORDER_MIN && sun >= SUN_BESIDE_MIN * border && sun >= SUN_ROUND_MIN * (border + (double)count[SHADE_BESIDE]);
}

/* A mesh keeps the sun from it. In: the piece's pixels in the queue */
static bool is_cast(const struct piece_search *s, size_t n)
{
    const struct static_mesh *mesh = s->look->stage->mesh;
    size_t cast = 0;
    for (size_t i = 0; mesh && i < n; i++) {
        struct vec3 p;
        cast += ground_view_at(&p, &s->look->view, s->queue[i] % s->width, s->queue[i] / s->width) &&
                static_mesh_blocks(mesh, p, s->towards_sun, OFF_MESH_M, SUN_FAR_M);
    }
    return (double)cast > CAST_MIN * (double)n;
}

static void find_pieces(const struct piece_search *s)
{
    int32_t piece = 0;
    for (int32_t i = 0; i < s->width * s->height; i++) {
        if (s->member[i] || !(s->sun[i] < (float)SHADE_MAX)) continue;
        size_t n = flood(s, i, ++piece);
        if (n >= PIECE_MIN && (is_shade(s, n, piece) || is_cast(s, n))) keep_wide(s, n, piece);
    }
}

/* --- the photograph --- */

static bool out_of_memory(struct error *err)
{
    return error_set(err, ERR_MEMORY, "no memory for the shade on the ground");
}

/* Shade is known farther away than its light can be measured, but not through mist. */
static bool look_farther(struct looked_at *l, struct error *err)
{
    if (l->stage->scene->has_mist) return true;
    ground_view_release(&l->view);
    return ground_view_of(&l->view, l->stage, &l->tones, &l->camera, l->shot->world_from_camera, COARSEST_M, err);
}

static bool is_hidden(const struct image *unhidden, const struct tones *t, int x, int y)
{
    struct vec2 q = tones_photograph_px(t, x, y);
    return unhidden && !*image_u8(unhidden, (int)q.x, (int)q.y);
}

static bool is_deep(const struct piece_search *s, int x, int y)
{
    for (int v = y - 1; v <= y + 1; v++)
        for (int u = x - 1; u <= x + 1; u++)
            if (is_outside(s, u, v) || !s->wide[v * s->width + u]) return false;
    return true;
}

/* So near to the picture's edge that ground_view.h, which looks at slopes, has no ground. */
static bool is_rim(const struct piece_search *s, int x, int y)
{
    return is_outside(s, x - RIM_PX, y - RIM_PX) || is_outside(s, x + RIM_PX, y + RIM_PX);
}

/* Of a plane all is lit that is not shaded for sure; a mesh knows better than what is not lit for sure. */
static bool is_unknown(const struct piece_search *s, int x, int y)
{
    float sun = s->sun[y * s->width + x];
    return s->look->stage->mesh ? !(isfinite(sun) && sun > (float)SUN_MIN) : isnan(sun) || (isinf(sun) && is_rim(s, x, y));
}

/* Shade, and what is round it. */
static void mark(struct ground_shade *g, const struct piece_search *s)
{
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            if (!s->wide[y * s->width + x]) continue;
            for (int v = y - REACH_PX; v <= y + REACH_PX; v++)
                for (int u = x - REACH_PX; u <= x + REACH_PX; u++)
                    if (!is_outside(s, u, v) && g->where[v * s->width + u] == GROUND_LIT) g->where[v * s->width + u] = GROUND_AT_EDGE;
            if (is_deep(s, x, y)) g->where[y * s->width + x] = GROUND_IN_SHADE;
        }
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            int i = y * s->width + x;
            if (g->where[i] == GROUND_LIT && is_unknown(s, x, y)) g->where[i] = GROUND_UNKNOWN;
        }
}

/* Returns how many pixels show the ground. */
static size_t read_all(const struct piece_search *s, const struct image *unhidden)
{
    const struct tones *t = &s->look->tones;
    size_t ground = 0;
    for (int y = 0; y < s->height; y++)
        for (int x = 0; x < s->width; x++) {
            struct vec3 p;
            double sun = INFINITY;
            if (ground_view_at(&p, &s->look->view, x, y) && !is_hidden(unhidden, t, x, y)) {
                ground++;
                if (!tones_good(t, x, y) || !read_light(s->shade, &sun, tones_at(t, x, y))) sun = NAN;
            }
            s->sun[y * s->width + x] = (float)sun;
        }
    return ground;
}

static bool find_shaded(struct ground_shade *g, const struct looked_at *l, const struct image *unhidden, struct vec3 towards_sun,
                        struct error *err)
{
    size_t n = (size_t)g->width_px * (size_t)g->height_px, shaded = 0;
    struct piece_search s = { .shade = g, .look = l, .towards_sun = towards_sun, .width = g->width_px, .height = g->height_px,
                              .sun = malloc(n * sizeof *s.sun + 1), .member = calloc(n + 1, sizeof *s.member),
                              .queue = malloc(n * sizeof *s.queue + 1), .wide = calloc(n + 1, 1) };
    g->where = calloc(n + 1, 1);
    bool ok = (s.sun && s.member && s.queue && s.wide && g->where) || out_of_memory(err);
    if (ok) {
        size_t ground = read_all(&s, unhidden);
        find_pieces(&s);
        mark(g, &s);
        for (size_t i = 0; i < n; i++) shaded += s.wide[i];
        g->found = shaded > 0;
        g->share = (double)shaded / fmax(1, (double)ground);
    }
    free(s.sun);
    free(s.member);
    free(s.queue);
    free(s.wide);
    return ok;
}

/* Are the photograph's shadows those of this light? */
static bool agrees(const struct shade *shade, const struct light *light)
{
    double sky[3], light_ratio[3];
    light_sky_irradiance(sky, light, vec3(0, 0, 1));
    for (int c = 0; c < 3; c++) light_ratio[c] = SKY_SEEN * sky[c] / light->irradiance[c];
    return fabs(log(shade->ratio[1] / light_ratio[1])) < DEPTH_OFF &&
           fabs(log(shade->ratio[2] / shade->ratio[0]) - log(light_ratio[2] / light_ratio[0])) < BLUE_OFF;
}

bool ground_shade_find(struct ground_shade *shade, const struct stage *stage, const struct image *photograph,
                       const struct image *unhidden, const struct scene_shot *shot, const struct light *light, struct error *err)
{
    struct ground_shade out = { 0 };
    struct looked_at l;
    struct gathered g = { 0 };
    struct light_estimate e = { 0 };
    bool ok = look_at_image(&l, stage, photograph, shot, 0, &light->sun_direction, err) && gather_edges(&g, &l, err) &&
              find_shade(&e, &g, stage->scene, &light->sun_direction, err);
    if (ok && e.clear && e.shade.places && agrees(&e.shade, light)) {
        out = (struct ground_shade){ .surfaces = l.surfaces, .width_px = l.tones.width_px, .height_px = l.tones.height_px,
                                     .reduction = l.tones.reduction };
        memcpy(out.lit, l.lit, sizeof out.lit);
        set_light(&out, &e.shade);
        drop_shaded_surfaces(&out);
        ok = look_farther(&l, err) && find_shaded(&out, &l, unhidden, light->sun_direction, err);
    }
    gathered_release(&g);
    looked_at_release(&l);
    if (ok) *shade = out;
    else ground_shade_release(&out);
    return ok;
}

void ground_shade_release(struct ground_shade *shade)
{
    free(shade->where);
    *shade = (struct ground_shade){ 0 };
}

bool ground_shade_sun(const struct ground_shade *g, double *sun, struct vec2 q_px, const double linear[3])
{
    *sun = 1;
    if (!g->found) return true;
    int x = (int)q_px.x / g->reduction, y = (int)q_px.y / g->reduction;
    /* What is left over beside the last working pixel is rim, too. */
    enum ground_light where = x < g->width_px && y < g->height_px ? (enum ground_light)g->where[y * g->width_px + x] : GROUND_UNKNOWN;
    *sun = where == GROUND_LIT;
    if (where != GROUND_AT_EDGE) return where != GROUND_UNKNOWN;
    float ln[3];
    for (int c = 0; c < 3; c++) ln[c] = (float)log(fmax(linear[c], 1e-4));
    if (!read_light(g, sun, ln)) return false;
    /* Grain is not light. */
    *sun = fmin(1, fmax(0, (*sun - NO_SUN) / (ALL_SUN - NO_SUN)));
    return true;
}

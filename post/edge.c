#include "post/edge.h"

#include "post/sharpening.h"
#include "post/step.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CELL_PX 12
#define EDGES_MAX 3000
#define BORDER_PX 10
#define NARROW_PX 4.0         /* half the way across that is looked at; other things are near */
#define CONTRAST_MIN 0.07     /* between the two sides, in levels, 1 is white */
#define MISFIT_MAX 0.07       /* root of the mean square, of a step's height */
#define BESIDE_MAX 0.15       /* too: other things are too near */
#define BESIDE_ERROR 2.0      /* of a width, relative, where other things are near by one */
#define LONE_MAX 0.06         /* where sharpening is looked for, which shows there, too */
#define SPREAD 0.04           /* relative standard deviation of sharp edges' widths in one photograph: by place and colour */
#define SAME 0.7              /* a maximum as high is no chance beside a higher one */
#define CROWD_MIN 10          /* edges of a crowd that stands apart */
#define APART 0.35            /* of its density is left before the next */
#define WIDTH_MIN_PX 0.2
#define WIDTH_MAX_PX 4.0
#define WIDTH_STEP 0.01       /* relative */
#define TELLING_ERROR_MAX 0.25 /* of a fit's sharpening, to tell */
#define TELLING_MIN 8         /* edges, to tell how much they were sharpened */
#define SHARPENING_MIN 0.2    /* less is not seen, and JPEG's blocks look like it */
#define PAIR_CELL_PX 6        /* of pictures that are compared, where what lies beside an edge is the same: */
#define PAIR_MISFIT_MAX 0.12
#define PAIR_ERROR_MAX 0.3    /* relative, of the width */

struct candidate { float strength; int x, y; double angle; };
struct candidates { struct candidate *list; size_t count; };

/* A picture's brightness as it is filed, where an edge is strong or weak for the eye, and as light, where a lens blurs. */
struct brightness { struct image levels, light; };

struct found_edge { struct candidate candidate; double sigma_px, error_px; };

/* A value and how much it counts. */
struct weighed { double value, weight; };

static void brightness_release(struct brightness *b)
{
    image_release(&b->levels);
    image_release(&b->light);
}

static bool clips(const struct image *rgb, const struct candidate *c)
{
    const int reach = BORDER_PX - 1;
    for (int dy = -reach; dy <= reach; dy++)
        for (int dx = -reach; dx <= reach; dx++) {
            const uint8_t *px = image_u8(rgb, c->x + dx, c->y + dy);
            if (px[0] == 255 || px[1] == 255 || px[2] == 255) return true;
        }
    return false;
}

static int stronger(const void *a, const void *b)
{
    const struct candidate *p = a, *q = b;
    if (p->strength != q->strength) return p->strength > q->strength ? -1 : 1;
    return p->y != q->y ? (p->y > q->y) - (p->y < q->y) : (p->x > q->x) - (p->x < q->x);
}

/* The strongest change of light of each cell, if it is straight. In: rgb, of which it is; NULL: nothing clips */
static bool find_candidates(struct candidates *to, const struct image *levels, const struct image *rgb, const struct image *only,
                            int cell_px, struct error *err)
{
    size_t cells = ((size_t)(levels->width_px / cell_px) + 1) * ((size_t)(levels->height_px / cell_px) + 1), n = 0, kept = 0;
    struct candidate *found = malloc(cells * sizeof *found);
    if (!found) return error_set(err, ERR_MEMORY, "no memory for the edges of a picture");
    int right = levels->width_px - BORDER_PX, bottom = levels->height_px - BORDER_PX;
    for (int y0 = BORDER_PX; y0 < bottom; y0 += cell_px)
        for (int x0 = BORDER_PX; x0 < right; x0 += cell_px) {
            struct candidate best = { .strength = 0 };
            for (int y = y0; y < y0 + cell_px && y < bottom; y++)
                for (int x = x0; x < x0 + cell_px && x < right; x++) {
                    if (only && !*image_u8(only, x, y)) continue;
                    const float *p = image_f32(levels, x, y);
                    float gx = p[1] - p[-1], gy = p[levels->width_px] - p[-levels->width_px], strength = gx * gx + gy * gy;
                    if (strength > best.strength) best = (struct candidate){ strength, x, y, 0 };
                }
            if (best.strength > 0) found[n++] = best;
        }
    qsort(found, n, sizeof *found, stronger);
    for (size_t i = 0; i < n && kept < EDGES_MAX; i++) {
        struct candidate c = found[i];
        if (step_direction(&c.angle, levels, c.x, c.y) && !(rgb && clips(rgb, &c))) found[kept++] = c;
    }
    *to = (struct candidates){ found, kept };
    return true;
}

/* --- the brightness --- */

static bool brightness_of(struct brightness *b, const struct image *rgb, struct error *err)
{
    *b = (struct brightness){ 0 };
    if (!image_init(&b->levels, rgb->width_px, rgb->height_px, 1, PIXEL_F32, err)) return false;
    size_t n = (size_t)rgb->width_px * (size_t)rgb->height_px;
    const uint8_t *px = rgb->data;
    for (size_t i = 0; i < n; i++, px += 3)
        ((float *)b->levels.data)[i] = (0.2126f * px[0] + 0.7152f * px[1] + 0.0722f * px[2]) / 255;
    return true;
}

static bool light_of(struct brightness *b, struct error *err)
{
    image_release(&b->light);
    if (!image_init(&b->light, b->levels.width_px, b->levels.height_px, 1, PIXEL_F32, err)) return false;
    size_t n = (size_t)b->levels.width_px * (size_t)b->levels.height_px;
    for (size_t i = 0; i < n; i++) ((float *)b->light.data)[i] = linear_from_srgb(fmaxf(((const float *)b->levels.data)[i], 0));
    return true;
}

/* --- statistics --- */

static int by_value(const void *a, const void *b)
{
    double x = ((const struct weighed *)a)->value, y = ((const struct weighed *)b)->value;
    return (x > y) - (x < y);
}

/* A quartile of what is asked of the edges; sorts `v`. */
static double quartile(struct weighed *v, size_t n, size_t which)
{
    double all = 0, sum = 0;
    qsort(v, n, sizeof *v, by_value);
    for (size_t i = 0; i < n; i++) all += v[i].weight;
    for (size_t i = 0; i < n; i++)
        if ((sum += v[i].weight) * 4 > all * (double)which) return v[i].value;
    return 0;
}

static double density(double width_px, const struct found_edge *found, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        double sd = hypot(found[i].error_px, SPREAD * width_px), off = (found[i].sigma_px - width_px) / sd;
        if (fabs(off) < 6) sum += width_px / sd * exp(-off * off / 2);
    }
    return sum;
}

static size_t count_near(double width_px, const struct found_edge *found, size_t n)
{
    size_t near = 0;
    for (size_t i = 0; i < n; i++) near += fabs(found[i].sigma_px - width_px) < 2 * hypot(found[i].error_px, SPREAD * width_px);
    return near;
}

/* Where the edges crowd, each of them being as wide as its fit's error: what is poorly known counts little there. Nothing is
 * sharper than the lens makes it, but much is softer: shadows, what is out of focus. So it is the narrowest crowd: one nearly as
 * dense as the densest, or one of enough edges that stands apart, for the penumbra of trees is most of what a photograph of a
 * park has. */
static double crowd(const struct found_edge *found, size_t n)
{
    double highest = 0, before[2] = { 0 }, apart = 0, apart_density = 0;
    for (double w = WIDTH_MIN_PX; w < WIDTH_MAX_PX; w *= 1 + WIDTH_STEP) highest = fmax(highest, density(w, found, n));
    for (double w = WIDTH_MIN_PX; highest > 0 && w < WIDTH_MAX_PX; w *= 1 + WIDTH_STEP) {
        double now = density(w, found, n), last = w / (1 + WIDTH_STEP);
        if (apart > 0 && now < APART * apart_density) return apart;
        if (before[1] >= before[0] && before[1] > now) {
            if (before[1] >= SAME * highest) return last;
            bool enough = count_near(last, found, n) >= CROWD_MIN && before[1] > apart_density;
            if (enough) {
                apart = last;
                apart_density = before[1];
            }
        }
        before[0] = before[1];
        before[1] = now;
    }
    return 0;
}

/* --- measuring --- */

static bool fit_lone(struct step *s, const struct brightness *b, const struct candidate *c, double across_px)
{
    return step_fit(s, &b->light, c->x, c->y, c->angle, across_px, false) && s->misfit <= MISFIT_MAX && s->beside <= BESIDE_MAX &&
           isfinite(s->sigma_error_px) &&
           step_contrast(&b->levels, c->x, c->y, c->angle, across_px) >= CONTRAST_MIN;
}

static bool fit_edge(struct found_edge *found, const struct brightness *b, const struct candidate *c)
{
    struct step s;
    if (!fit_lone(&s, b, c, NARROW_PX) && !fit_lone(&s, b, c, STEP_WIDE_PX)) return false;
    *found = (struct found_edge){ *c, s.sigma_px, hypot(s.sigma_error_px, BESIDE_ERROR * s.beside * s.sigma_px) };
    return true;
}

static void sum_up(struct edges *e, struct weighed *values, const struct found_edge *found, size_t n)
{
    e->count = n;
    e->sharp_px = crowd(found, n);
    for (size_t i = 0; i < n; i++) values[i] = (struct weighed){ found[i].sigma_px, 1 };
    for (size_t k = 0; k < 3; k++) e->sigma_px[k] = quartile(values, n, k + 1);
}

/* What the sharp edges agree on: alone, an edge's own width and sharpening are easily mistaken for each other. Less than chance
 * would make of as many is nothing. */
static void find_sharpening(struct edges *e, struct weighed *values, const struct brightness *b, const struct found_edge *found, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const struct candidate *c = &found[i].candidate;
        struct step s;
        if (fabs(found[i].sigma_px - e->sharp_px) > 2 * hypot(found[i].error_px, SPREAD * e->sharp_px)) continue;
        if (!step_fit(&s, &b->levels, c->x, c->y, c->angle, NARROW_PX, true) || s.misfit > MISFIT_MAX || s.beside > LONE_MAX) continue;
        if (!(s.sharpening_error < TELLING_ERROR_MAX)) continue;
        values[e->telling++] = (struct weighed){ s.sharpening, 1 / (0.01 + s.sharpening_error * s.sharpening_error) };
    }
    for (size_t k = 0; k < 3; k++) e->sharpening_quartiles[k] = quartile(values, e->telling, k + 1);
    if (e->telling < TELLING_MIN) return;
    double chance = 2 * (e->sharpening_quartiles[2] - e->sharpening_quartiles[0]) / sqrt((double)e->telling);
    if (e->sharpening_quartiles[1] > fmax(chance, SHARPENING_MIN)) e->sharpening = e->sharpening_quartiles[1];
}

/* In: rgb, of which the brightness is; NULL: nothing clips, and nothing was sharpened */
static bool measure(struct edges *edges, struct brightness *b, const struct image *rgb, const struct image *only, struct error *err)
{
    struct candidates candidates = { 0 };
    struct found_edge *found = calloc(EDGES_MAX, sizeof *found);
    struct weighed *values = malloc(EDGES_MAX * sizeof *values);
    bool ok = ((found && values) || error_set(err, ERR_MEMORY, "no memory for the edges of a picture")) &&
              find_candidates(&candidates, &b->levels, rgb, only, CELL_PX, err);
    if (ok) {
        struct edges e = { 0 };
        size_t n = 0, kept = 0;
        for (size_t i = 0; i < candidates.count; i++) n += fit_edge(&found[n], b, &candidates.list[i]);
        sum_up(&e, values, found, n);
        if (rgb) find_sharpening(&e, values, b, found, n);
        if (e.sharpening > 0) {
            ok = sharpening_take_back(&b->levels, e.sharpening, err) && light_of(b, err);
            for (size_t i = 0; ok && i < n; i++) {
                struct candidate c = found[i].candidate;
                kept += fit_edge(&found[kept], b, &c);
            }
            if (ok) sum_up(&e, values, found, kept);
        }
        if (ok) *edges = e;
    }
    free(candidates.list);
    free(found);
    free(values);
    return ok;
}

bool edges_measure(struct edges *edges, const struct image *rgb, const struct image *only, struct error *err)
{
    struct brightness b;
    bool ok = brightness_of(&b, rgb, err) && light_of(&b, err) && measure(edges, &b, rgb, only, err);
    brightness_release(&b);
    return ok;
}

bool edges_of_layer(struct edges *edges, const struct image *object, struct error *err)
{
    struct brightness b = { 0 };
    if (!image_init(&b.light, object->width_px, object->height_px, 1, PIXEL_F32, err)) return false;
    size_t n = (size_t)object->width_px * (size_t)object->height_px;
    for (size_t i = 0; i < n; i++) ((float *)b.light.data)[i] = ((const float *)object->data)[4 * i + 3];
    bool ok = image_init(&b.levels, object->width_px, object->height_px, 1, PIXEL_F32, err);
    if (ok) {
        memcpy(b.levels.data, b.light.data, image_size(&b.light));
        ok = measure(edges, &b, NULL, NULL, err);
    }
    brightness_release(&b);
    return ok;
}

static bool fit_paired(struct step *s, const struct brightness *b, const struct candidate *c)
{
    return step_fit(s, &b->light, c->x, c->y, c->angle, NARROW_PX, false) && s->misfit <= PAIR_MISFIT_MAX;
}

bool edges_compare(double *ratio, size_t *count, const struct image *rgb, const struct image *of, const struct image *only,
                   struct error *err)
{
    struct brightness ours = { 0 }, theirs = { 0 };
    struct candidates candidates = { 0 };
    struct weighed *ratios = malloc(EDGES_MAX * sizeof *ratios);
    bool ok = (ratios || error_set(err, ERR_MEMORY, "no memory for the edges of a picture")) && brightness_of(&ours, rgb, err) &&
              light_of(&ours, err) && brightness_of(&theirs, of, err) && light_of(&theirs, err) &&
              find_candidates(&candidates, &theirs.levels, of, only, PAIR_CELL_PX, err);
    size_t n = 0;
    for (size_t i = 0; ok && i < candidates.count; i++) {
        const struct candidate *c = &candidates.list[i];
        struct step a, b;
        if (clips(rgb, c) || step_contrast(&theirs.levels, c->x, c->y, c->angle, NARROW_PX) < CONTRAST_MIN) continue;
        if (!fit_paired(&a, &ours, c) || !fit_paired(&b, &theirs, c)) continue;
        double error = hypot(a.sigma_error_px / a.sigma_px, b.sigma_error_px / b.sigma_px);
        if (error < PAIR_ERROR_MAX) ratios[n++] = (struct weighed){ a.sigma_px / b.sigma_px, 1 / (SPREAD * SPREAD + error * error) };
    }
    if (ok) {
        *count = n;
        *ratio = n > 0 ? quartile(ratios, n, 2) : NAN;
    }
    free(ratios);
    free(candidates.list);
    brightness_release(&ours);
    brightness_release(&theirs);
    return ok;
}

#include "post/edge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CELL_PX 12
#define EDGES_MAX 3000
#define ALONG_PX 3.0        /* half the length of edge that is looked at */
#define NARROW_PX 4.0       /* half the way across it; other things are near */
#define WIDE_PX 8.0         /* for what is blurred more than that shows */
#define REACH_PX 9
#define CONTRAST_MIN 0.07   /* between the two sides, 1 is white */
#define MISFIT_MAX 0.07     /* root of the mean square, in units of the contrast */
#define STRAIGHT_MIN 0.8    /* 1: light changes in one direction only */
#define TELLING_PX 0.65     /* edges that are wider do not show whether they were sharpened */
#define SHARPENING_SPREAD 0.5 /* what is known of it beforehand: a standard deviation, */
#define NOISE 0.02          /* and that of a pixel, in units of the contrast */
#define TELLING_MIN 12      /* edges, to tell how much they were sharpened */
#define PARAMETERS 6

struct candidate { float strength; int x, y; };

/* A step seen through a Gaussian, and sharpened: with t = x cos + y sin - at,
 * low + step * (Phi(t / sigma) + sharpening * (Phi(t / sigma) - Phi(t / sqrt(sigma^2 + EDGE_SHARPENING_PX^2)))). */
struct step { double low, step, at, angle, sigma, sharpening; };

/* Sums of the normal equations, by Gauss and Newton. */
struct normal { double a[PARAMETERS][PARAMETERS + 1], misfit; int points; };

static bool solve(double x[PARAMETERS], struct normal *n)
{
    for (int i = 0; i < PARAMETERS; i++) {
        int pivot = i;
        for (int k = i + 1; k < PARAMETERS; k++)
            if (fabs(n->a[k][i]) > fabs(n->a[pivot][i])) pivot = k;
        if (!(fabs(n->a[pivot][i]) > 1e-12)) return false;
        for (int j = 0; j <= PARAMETERS; j++) {
            double swap = n->a[i][j];
            n->a[i][j] = n->a[pivot][j];
            n->a[pivot][j] = swap;
        }
        for (int k = i + 1; k < PARAMETERS; k++) {
            double by = n->a[k][i] / n->a[i][i];
            for (int j = i; j <= PARAMETERS; j++) n->a[k][j] -= by * n->a[i][j];
        }
    }
    for (int i = PARAMETERS - 1; i >= 0; i--) {
        x[i] = n->a[i][PARAMETERS];
        for (int j = i + 1; j < PARAMETERS; j++) x[i] -= n->a[i][j] * x[j];
        x[i] /= n->a[i][i];
    }
    return true;
}

static double bell(double q)
{
    return exp(-q * q / 2) / sqrt(2 * M_PI);
}

/* In: find_sharpening: else it is taken as it is */
static void compare_with(struct normal *n, const struct image *light, const struct candidate *c, const struct step *s, double angle,
                         double across_px, bool find_sharpening)
{
    *n = (struct normal){ .points = 0 };
    double across_x = cos(s->angle), across_y = sin(s->angle), wide = hypot(s->sigma, EDGE_SHARPENING_PX);
    double pick_x = cos(angle), pick_y = sin(angle); /* the same points, however the step is turned */
    for (int dy = -REACH_PX; dy <= REACH_PX; dy++)
        for (int dx = -REACH_PX; dx <= REACH_PX; dx++) {
            if (fabs(dx * pick_x + dy * pick_y) > across_px || fabs(dy * pick_x - dx * pick_y) > ALONG_PX) continue;
            double t = dx * across_x + dy * across_y - s->at, u = dy * across_x - dx * across_y, q = t / s->sigma, r = t / wide;
            double phi = erfc(-q * M_SQRT1_2) / 2, more = s->sharpening != 0 || find_sharpening ? phi - erfc(-r * M_SQRT1_2) / 2 : 0;
            double shape = phi + s->sharpening * more, own = s->step * (1 + s->sharpening) * bell(q) / s->sigma;
            double other = s->step * s->sharpening * bell(r) / wide, slope = own - other;
            double d[PARAMETERS] = { 1, shape, -slope, slope * u, -own * q + other * r * s->sigma / wide, find_sharpening ? s->step * more : 0 };
            double off = (double)*image_f32(light, c->x + dx, c->y + dy) - s->low - s->step * shape;
            for (int i = 0; i < PARAMETERS; i++) {
                for (int j = 0; j < PARAMETERS; j++) n->a[i][j] += d[i] * d[j];
                n->a[i][PARAMETERS] += d[i] * off;
            }
            n->misfit += off * off;
            n->points++;
        }
    double known = pow(NOISE * s->step / SHARPENING_SPREAD, 2);
    n->a[5][5] += known;
    if (find_sharpening) n->a[5][PARAMETERS] -= known * s->sharpening;
}

/* Mean of the light on one side of the edge. */
static double side_of(const struct image *light, const struct candidate *c, double angle, double side, double across_px)
{
    double sum = 0;
    int n = 0;
    for (int u = -2; u <= 2; u++)
        for (int k = 0; k < 2; k++, n++) {
            double t = across_px - k, x = side * t * cos(angle) - u * sin(angle), y = side * t * sin(angle) + u * cos(angle);
            sum += (double)*image_f32(light, c->x + (int)lrint(x), c->y + (int)lrint(y));
        }
    return sum / n;
}

/* The direction in which the light changes, from the squares of its differences. Returns false where it has many. */
static bool across(double *angle, const struct image *light, const struct candidate *c)
{
    double xx = 0, xy = 0, yy = 0;
    for (int dy = -3; dy <= 3; dy++)
        for (int dx = -3; dx <= 3; dx++) {
            double gx = (double)(*image_f32(light, c->x + dx + 1, c->y + dy) - *image_f32(light, c->x + dx - 1, c->y + dy));
            double gy = (double)(*image_f32(light, c->x + dx, c->y + dy + 1) - *image_f32(light, c->x + dx, c->y + dy - 1));
            xx += gx * gx;
            xy += gx * gy;
            yy += gy * gy;
        }
    *angle = atan2(2 * xy, xx - yy) / 2;
    return hypot(2 * xy, xx - yy) > STRAIGHT_MIN * (xx + yy);
}

static bool clips(const struct image *rgb, const struct candidate *c)
{
    for (int dy = -REACH_PX; dy <= REACH_PX; dy++)
        for (int dx = -REACH_PX; dx <= REACH_PX; dx++) {
            const uint8_t *px = image_u8(rgb, c->x + dx, c->y + dy);
            if (px[0] == 255 || px[1] == 255 || px[2] == 255) return true;
        }
    return false;
}

struct found_edge { struct candidate candidate; double angle, sigma_px, sharpening, low, high; bool telling; };

/* In: sharpening, by which all edges were; NAN when that is looked for */
static bool fit(struct found_edge *found, const struct image *light, const struct candidate *c, double angle, double across_px,
                double sharpening)
{
    const bool find = isnan(sharpening);
    double low = side_of(light, c, angle, -1, across_px), high = side_of(light, c, angle, 1, across_px);
    struct step s = { low, high - low, 0, angle, 0.8, find ? 0 : sharpening };
    if (fabs(s.step) < CONTRAST_MIN) return false;
    struct normal n;
    for (int k = 0; k < 16; k++) {
        double by[PARAMETERS];
        compare_with(&n, light, c, &s, angle, across_px, find);
        if (!solve(by, &n)) return false;
        s.low += by[0];
        s.step += by[1];
        s.at += fmin(fmax(by[2], -1), 1);
        s.angle += fmin(fmax(by[3], -0.1), 0.1);
        s.sigma = fmin(fmax(s.sigma + by[4], s.sigma / 1.5), s.sigma * 1.5);
        s.sharpening = fmin(fmax(s.sharpening + by[5], -3), 3);
        if (s.sigma < 0.1 || s.sigma > 5 || fabs(s.at) > 3 || fabs(s.angle - angle) > 0.4) return false;
        if (fabs(by[4]) < 1e-4 && fabs(by[2]) < 1e-3) break;
    }
    compare_with(&n, light, c, &s, angle, across_px, find);
    *found = (struct found_edge){ *c, angle, s.sigma, s.sharpening, fmin(s.low, s.low + s.step), fmax(s.low, s.low + s.step),
                                  find && s.sigma < TELLING_PX };
    /* Both sides must be in view for a blur this wide. */
    return fabs(s.step) >= CONTRAST_MIN && sqrt(n.misfit / n.points) <= MISFIT_MAX * fabs(s.step) && 2.2 * s.sigma + fabs(s.at) < across_px;
}

static int stronger(const void *a, const void *b)
{
    const struct candidate *p = a, *q = b;
    if (p->strength != q->strength) return p->strength > q->strength ? -1 : 1;
    return p->y != q->y ? (p->y > q->y) - (p->y < q->y) : (p->x > q->x) - (p->x < q->x);
}

/* The strongest change of light of each cell. */
static size_t find_candidates(struct candidate *found, const struct image *light, const struct image *only)
{
    size_t n = 0;
    int border = REACH_PX + 1;
    for (int y0 = border; y0 < light->height_px - border; y0 += CELL_PX)
        for (int x0 = border; x0 < light->width_px - border; x0 += CELL_PX) {
            struct candidate best = { .strength = 0 };
            for (int y = y0; y < y0 + CELL_PX && y < light->height_px - border; y++)
                for (int x = x0; x < x0 + CELL_PX && x < light->width_px - border; x++) {
                    if (only && !*image_u8(only, x, y)) continue;
                    const float *p = image_f32(light, x, y);
                    float gx = p[1] - p[-1], gy = p[light->width_px] - p[-light->width_px], strength = gx * gx + gy * gy;
                    if (strength > best.strength) best = (struct candidate){ strength, x, y };
                }
            if (best.strength > 0) found[n++] = best;
        }
    qsort(found, n, sizeof *found, stronger);
    return n;
}

static bool brightness_of(struct image *light, const struct image *rgb, struct error *err)
{
    if (!image_init(light, rgb->width_px, rgb->height_px, 1, PIXEL_F32, err)) return false;
    size_t n = (size_t)rgb->width_px * (size_t)rgb->height_px;
    const uint8_t *px = rgb->data;
    for (size_t i = 0; i < n; i++, px += 3)
        ((float *)light->data)[i] = (0.2126f * px[0] + 0.7152f * px[1] + 0.0722f * px[2]) / 255;
    return true;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* A quartile of what is asked of the edges; sorts `values`. */
static double quartile(double *values, size_t n, size_t which)
{
    qsort(values, n, sizeof *values, compare);
    return n > 0 ? values[which * n / 4] : 0;
}

/* What the edges agree on; less than chance would make of as many is nothing. */
static double agreed_sharpening(struct edges *e, double *values, const struct found_edge *found, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (found[i].telling) values[e->telling++] = found[i].sharpening;
    for (size_t k = 0; k < 3; k++) e->sharpening_quartiles[k] = quartile(values, e->telling, k + 1);
    double chance = 2 * (e->sharpening_quartiles[2] - e->sharpening_quartiles[0]) / sqrt((double)e->telling);
    return e->telling >= TELLING_MIN && e->sharpening_quartiles[1] > chance ? e->sharpening_quartiles[1] : 0;
}

static void sum_up(struct edges *e, double *values, const struct found_edge *found, size_t n)
{
    e->count = n;
    for (size_t i = 0; i < n; i++) values[i] = found[i].low;
    e->low = quartile(values, n, 2);
    for (size_t i = 0; i < n; i++) values[i] = found[i].high;
    e->high = quartile(values, n, 2);
    for (size_t i = 0; i < n; i++) values[i] = found[i].sigma_px;
    for (size_t k = 0; k < 3; k++) e->sigma_px[k] = quartile(values, n, k + 1);
}

static bool fit_near_or_wide(struct found_edge *found, const struct image *light, const struct candidate *c, double angle, double sharpening)
{
    return fit(found, light, c, angle, NARROW_PX, sharpening) || fit(found, light, c, angle, WIDE_PX, isnan(sharpening) ? 0 : sharpening);
}

/* In: rgb, of which the light is; NULL: nothing clips, and nothing was sharpened */
static bool measure(struct edges *edges, const struct image *light, const struct image *rgb, const struct image *only, struct error *err)
{
    size_t cells = ((size_t)(light->width_px / CELL_PX) + 1) * ((size_t)(light->height_px / CELL_PX) + 1), n = 0, kept = 0;
    struct candidate *candidates = malloc(cells * sizeof *candidates);
    struct found_edge *found = malloc(EDGES_MAX * sizeof *found);
    double *values = malloc(EDGES_MAX * sizeof *values);
    bool ok = (candidates && found && values) || error_set(err, ERR_MEMORY, "no memory for the edges of a picture");
    if (ok) {
        size_t count = find_candidates(candidates, light, only), fits = 0;
        for (size_t i = 0; i < count && fits < EDGES_MAX; i++) {
            const struct candidate *c = &candidates[i];
            double angle;
            if (!across(&angle, light, c) || (rgb && clips(rgb, c))) continue;
            fits++;
            n += fit_near_or_wide(&found[n], light, c, angle, rgb ? NAN : 0);
        }
        *edges = (struct edges){ 0 };
        if (rgb) edges->sharpening = agreed_sharpening(edges, values, found, n);
        /* Once more, now that this is known: alone, an edge's own width and sharpening are easily mistaken for each other. */
        for (size_t i = 0; rgb && i < n; i++) {
            struct found_edge again = found[i];
            if (fit_near_or_wide(&again, light, &found[i].candidate, found[i].angle, edges->sharpening)) found[kept++] = again;
        }
        sum_up(edges, values, found, rgb ? kept : n);
    }
    free(candidates);
    free(found);
    free(values);
    return ok;
}

bool edges_measure(struct edges *edges, const struct image *rgb, const struct image *only, struct error *err)
{
    struct image light = { 0 };
    bool ok = brightness_of(&light, rgb, err) && measure(edges, &light, rgb, only, err);
    image_release(&light);
    return ok;
}

bool edges_of_layer(struct edges *edges, const struct image *object, double low, double high, struct error *err)
{
    struct image light = { 0 };
    if (!image_init(&light, object->width_px, object->height_px, 1, PIXEL_F32, err)) return false;
    size_t n = (size_t)light.width_px * (size_t)light.height_px;
    const float dark = linear_from_srgb((float)low), bright = linear_from_srgb((float)high);
    const float *px = object->data;
    for (size_t i = 0; i < n; i++) ((float *)light.data)[i] = srgb_from_linear(dark + (bright - dark) * px[4 * i + 3]);
    bool ok = measure(edges, &light, NULL, NULL, err);
    image_release(&light);
    return ok;
}

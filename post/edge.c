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
#define CONTRAST_MIN 0.04   /* between the two sides, linear */
#define MISFIT_MAX 0.07     /* root of the mean square, in units of the contrast */
#define PARAMETERS 5

struct candidate { float strength; int x, y; };

/* A step seen through a Gaussian: low + step * Phi((x cos + y sin - at) / sigma). */
struct step { double low, step, at, angle, sigma; };

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

static void compare_with(struct normal *n, const struct image *light, const struct candidate *c, const struct step *s, double angle, double across_px)
{
    *n = (struct normal){ .points = 0 };
    double across_x = cos(s->angle), across_y = sin(s->angle);
    double pick_x = cos(angle), pick_y = sin(angle); /* the same points, however the step is turned */
    for (int dy = -REACH_PX; dy <= REACH_PX; dy++)
        for (int dx = -REACH_PX; dx <= REACH_PX; dx++) {
            if (fabs(dx * pick_x + dy * pick_y) > across_px || fabs(dy * pick_x - dx * pick_y) > ALONG_PX) continue;
            double t = dx * across_x + dy * across_y - s->at, u = dy * across_x - dx * across_y, q = t / s->sigma;
            double phi = erfc(-q * M_SQRT1_2) / 2, slope = s->step * exp(-q * q / 2) / (s->sigma * sqrt(2 * M_PI));
            double d[PARAMETERS] = { 1, phi, -slope, slope * u, -slope * q };
            double off = (double)*image_f32(light, c->x + dx, c->y + dy) - s->low - s->step * phi;
            for (int i = 0; i < PARAMETERS; i++) {
                for (int j = 0; j < PARAMETERS; j++) n->a[i][j] += d[i] * d[j];
                n->a[i][PARAMETERS] += d[i] * off;
            }
            n->misfit += off * off;
            n->points++;
        }
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

/* The direction in which the light changes, from the squares of its differences. */
static double across(const struct image *light, const struct candidate *c)
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
    return atan2(2 * xy, xx - yy) / 2;
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

/* Out: sigma_px */
static bool fit(double *sigma_px, const struct image *light, const struct candidate *c, double across_px)
{
    const double angle = across(light, c);
    double low = side_of(light, c, angle, -1, across_px), high = side_of(light, c, angle, 1, across_px);
    struct step s = { low, high - low, 0, angle, 0.8 };
    if (fabs(s.step) < CONTRAST_MIN) return false;
    struct normal n;
    for (int k = 0; k < 12; k++) {
        double by[PARAMETERS];
        compare_with(&n, light, c, &s, angle, across_px);
        if (!solve(by, &n)) return false;
        s.low += by[0];
        s.step += by[1];
        s.at += fmin(fmax(by[2], -1), 1);
        s.angle += fmin(fmax(by[3], -0.1), 0.1);
        s.sigma = fmin(fmax(s.sigma + by[4], s.sigma / 2), s.sigma * 2);
        if (s.sigma < 0.1 || s.sigma > 5 || fabs(s.at) > 3 || fabs(s.angle - angle) > 0.4) return false;
        if (fabs(by[4]) < 1e-4 && fabs(by[2]) < 1e-3) break;
    }
    compare_with(&n, light, c, &s, angle, across_px);
    *sigma_px = s.sigma;
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

static bool luminance_of(struct image *light, const struct image *rgb, struct error *err)
{
    if (!image_init(light, rgb->width_px, rgb->height_px, 1, PIXEL_F32, err)) return false;
    float of_level[3][256];
    for (int i = 0; i < 256; i++) {
        float v = linear_from_srgb((float)i / 255);
        of_level[0][i] = 0.2126f * v;
        of_level[1][i] = 0.7152f * v;
        of_level[2][i] = 0.0722f * v;
    }
    size_t n = (size_t)rgb->width_px * (size_t)rgb->height_px;
    const uint8_t *px = rgb->data;
    for (size_t i = 0; i < n; i++, px += 3) ((float *)light->data)[i] = of_level[0][px[0]] + of_level[1][px[1]] + of_level[2][px[2]];
    return true;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* In: rgb, of which the light is; NULL: nothing clips */
static bool measure(struct edges *edges, const struct image *light, const struct image *rgb, const struct image *only, struct error *err)
{
    size_t cells = ((size_t)(light->width_px / CELL_PX) + 1) * ((size_t)(light->height_px / CELL_PX) + 1), n = 0;
    struct candidate *found = malloc(cells * sizeof *found);
    double *sigma = malloc(EDGES_MAX * sizeof *sigma);
    bool ok = (found && sigma) || error_set(err, ERR_MEMORY, "no memory for the edges of a picture");
    if (ok) {
        size_t count = find_candidates(found, light, only), fits = 0;
        for (size_t i = 0; i < count && fits < EDGES_MAX; i++) {
            if (rgb && clips(rgb, &found[i])) continue;
            fits++;
            if (fit(&sigma[n], light, &found[i], NARROW_PX) || fit(&sigma[n], light, &found[i], WIDE_PX)) n++;
        }
        qsort(sigma, n, sizeof *sigma, compare);
        *edges = (struct edges){ .count = n };
        for (size_t k = 0; k < 3 && n > 0; k++) edges->sigma_px[k] = sigma[(k + 1) * n / 4];
    }
    free(found);
    free(sigma);
    return ok;
}

bool edges_measure(struct edges *edges, const struct image *rgb, const struct image *only, struct error *err)
{
    struct image light = { 0 };
    bool ok = luminance_of(&light, rgb, err) && measure(edges, &light, rgb, only, err);
    image_release(&light);
    return ok;
}

bool edges_of_layer(struct edges *edges, const struct image *object, struct error *err)
{
    struct image cover = { 0 };
    if (!image_init(&cover, object->width_px, object->height_px, 1, PIXEL_F32, err)) return false;
    size_t n = (size_t)cover.width_px * (size_t)cover.height_px;
    for (size_t i = 0; i < n; i++) ((float *)cover.data)[i] = ((const float *)object->data)[4 * i + 3];
    bool ok = measure(edges, &cover, NULL, NULL, err);
    image_release(&cover);
    return ok;
}

double edge_softness(double wanted_px, double own_px)
{
    double rest = wanted_px * wanted_px - own_px * own_px;
    return rest > 0 ? sqrt(rest) : 0;
}

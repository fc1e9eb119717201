#include "gen/world/ribbon.h"

#include "gen/world/banded.h"

#include <math.h>
#include <stdlib.h>

/* The heights minimise  sum w_i a_i (h - z_i)^2 + integral of L^4 h_ss^2 + B^4 h_tt^2 + C^6 h_ttt^2:
 * a_i is the area of a piece of the mesh, w_i how much it is believed to be road. Waves shorter than
 * about 2 pi L are smoothed out along, and across what is not a parabola (a crowned road is one).
 *
 * What to believe is found by weighting again and again. First the 0.3 quantile of a stiff ribbon, which
 * what stands on the road cannot lift; from there the weights of Geman and McClure, each time
 * narrower, while the ribbon becomes as supple as it is to be (graduated non-convexity).
 * Src: Eilers & Marx 1996 (penalised splines); Blake & Zisserman 1987; Yang et al. 2020, GNC */
#define QUANTILE 0.3
#define QUANTILE_ROUNDS 12
#define QUANTILE_FLOOR_M 0.1
#define NARROWING_ROUNDS 10
#define STIFF_ALONG_M 10.0
#define STIFF_ACROSS_M 3.0
#define ALONG_M 2.0
#define ACROSS_M 0.4
#define CROWN_M 2.0
#define WIDE_BEND 0.4  /* half width over radius */
#define NARROW_BEND 0.8
#define TIGHTEST 0.5   /* inside a narrow bend, nodes count as at least this part of a step apart */
#define STEEPNESS 6.0    /* power of the cosine that a piece counts with */
#define FLAT 1e-6      /* weight of slopes: settles what neither mesh nor bending tells */
#define WIDEST_M 1.0   /* of the weights, at first */
#define NARROWEST_M 0.12
#define LEAST_COVERED 0.2

struct sample { double row, column, z_m, area_m2; };

struct fit {
    struct ribbon *ribbon;
    double row_m, column_m;   /* steps of the grid */
    struct sample *samples;
    size_t count, room;
    struct vec2 *node_m;      /* (rows, columns) where the heights are */
    bool *seen;               /* (rows) some mesh is there */
    bool no_memory;
    struct banded system;
};

static bool make_room(struct fit *fit)
{
    if (fit->count < fit->room) return true;
    size_t room = fit->room ? 2 * fit->room : 4096;
    struct sample *more = realloc(fit->samples, room * sizeof *more);
    if (more) {
        fit->samples = more;
        fit->room = room;
    }
    fit->no_memory = !more;
    return more;
}

static void take_piece(void *user, const struct vec3 corner_m[3])
{
    struct fit *fit = user;
    struct ribbon *ribbon = fit->ribbon;
    struct vec3 a = corner_m[0], b = corner_m[1], c = corner_m[2];
    struct vec3 p = vec3_scale(vec3_add(a, vec3_add(b, c)), 1.0 / 3);
    struct vec3 normal = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    /* The flanks of what stands on the road come down to its height, and are told by their steepness. */
    double area = fabs(normal.z) / 2 * pow(fabs(normal.z) / vec3_norm(normal), STEEPNESS);
    struct strip_place places[STRIP_PLACES];
    size_t found = area > 0 ? strip_find_all(&ribbon->strip, places, p.x, p.y) : 0;
    /* In a narrow bend both legs are told of it, so that they agree where they meet. */
    for (size_t k = 0; k < found; k++) {
        double row = places[k].s_m / fit->row_m, column = (places[k].offset_m + ribbon->half_width_m) / fit->column_m;
        if (row < 0 || column < 0 || row > (double)(ribbon->rows - 1) || column > (double)(ribbon->columns - 1)) continue;
        if (!make_room(fit)) return;
        fit->samples[fit->count++] = (struct sample){ row, column, p.z, area };
        fit->seen[(size_t)round(row)] = true;
    }
}

/* The four nodes about a sample and its weights on them. */
static void nodes(const struct ribbon *ribbon, const struct sample *sample, size_t index[4], double part[4])
{
    size_t row = (size_t)sample->row, column = (size_t)sample->column;
    if (row + 2 > ribbon->rows) row--;
    if (column + 2 > ribbon->columns) column--;
    double v = sample->row - (double)row, u = sample->column - (double)column;
    index[0] = row * ribbon->columns + column;
    index[1] = index[0] + 1;
    index[2] = index[0] + ribbon->columns;
    index[3] = index[2] + 1;
    part[0] = (1 - v) * (1 - u);
    part[1] = (1 - v) * u;
    part[2] = v * (1 - u);
    part[3] = v * u;
}

static double residual(const struct ribbon *ribbon, const struct sample *sample)
{
    size_t index[4];
    double part[4], z = 0;
    nodes(ribbon, sample, index, part);
    for (int i = 0; i < 4; i++) z += part[i] * ribbon->height_m[index[i]];
    return sample->z_m - z;
}

/* Differences of an order along an axis, everywhere. */
static void add_bending(struct fit *fit, size_t order, bool along, double weight)
{
    static const double binomial[4][4] = { { 1 }, { -1, 1 }, { 1, -2, 1 }, { -1, 3, -3, 1 } };
    size_t rows = fit->ribbon->rows, columns = fit->ribbon->columns, step = along ? columns : 1;
    if ((along ? rows : columns) <= order) return;
    size_t row_end = along ? rows - order : rows, column_end = along ? columns : columns - order;
    for (size_t r = 0; r < row_end; r++)
        for (size_t c = 0; c < column_end; c++) {
            size_t index[4];
            for (size_t k = 0; k <= order; k++) index[k] = r * columns + c + k * step;
            banded_add(&fit->system, index, binomial[order], order + 1, 0, weight);
        }
}

/* How narrow the bend is at a row: 0 up to where roads are laid out by curves, 1 at a corner. */
static double narrowness(const struct fit *fit, size_t row)
{
    double bend = fabs(path_at(&fit->ribbon->way->path, (double)row * fit->row_m, 0).curvature) * fit->ribbon->half_width_m;
    return fmin(fmax((bend - WIDE_BEND) / (NARROW_BEND - WIDE_BEND), 0), 1);
}

/* Bending along the way. In a wide bend a road climbs by the way gone, at all offsets alike. About a corner it lies as
 * ground does: a plane has no bending there, though three nodes in a column are not in a line; what the slope across
 * makes of that is taken off, and outside the corner nodes are farther apart. */
static void add_bending_along(struct fit *fit, double along_m)
{
    size_t rows = fit->ribbon->rows, columns = fit->ribbon->columns;
    for (size_t r = 1; r + 1 < rows; r++) {
        double corner = narrowness(fit, r), least = TIGHTEST * fit->row_m;
        for (size_t c = 0; c < columns; c++) {
            size_t here = r * columns + c, right = here - (c > 0), left = here + (c + 1 < columns);
            const struct vec2 *p = fit->node_m, *q = &p[here];
            struct vec2 a = { p[here - columns].x - q->x, p[here - columns].y - q->y };
            struct vec2 b = { p[here + columns].x - q->x, p[here + columns].y - q->y };
            struct vec2 across = { p[left].x - p[right].x, p[left].y - p[right].y };
            double back = fit->row_m + corner * (fmax(hypot(a.x, a.y), least) - fit->row_m);
            double ahead = fit->row_m + corner * (fmax(hypot(b.x, b.y), least) - fit->row_m);
            double wa = 2 * ahead / (back + ahead), wb = 2 * back / (back + ahead), step = (back + ahead) / 2;
            double aside = corner * ((wa * a.x + wb * b.x) * across.x + (wa * a.y + wb * b.y) * across.y)
                           / (across.x * across.x + across.y * across.y);
            banded_add(&fit->system, (size_t[5]){ here - columns, here, here + columns, left, right },
                       (double[5]){ wa, -2, wb, -aside, aside }, 5, 0, step * fit->column_m * pow(along_m / step, 4));
        }
    }
}

/* weight_of: of a residual, with a width */
static bool solve(struct fit *fit, double along_m, double across_m, double crown_m, double (*weight_of)(double, double),
                  double width_m)
{
    struct ribbon *ribbon = fit->ribbon;
    banded_clear(&fit->system);
    for (size_t i = 0; i < fit->count; i++) {
        const struct sample *sample = &fit->samples[i];
        size_t index[4];
        double part[4];
        nodes(ribbon, sample, index, part);
        banded_add(&fit->system, index, part, 4, sample->z_m, sample->area_m2 * weight_of(residual(ribbon, sample), width_m));
    }
    double cell = fit->row_m * fit->column_m;
    add_bending(fit, 1, true, cell * FLAT);
    add_bending(fit, 1, false, cell * FLAT);
    add_bending_along(fit, along_m);
    add_bending(fit, 2, false, cell * pow(across_m / fit->column_m, 4));
    add_bending(fit, 3, false, cell * pow(crown_m / fit->column_m, 6));
    if (!banded_solve(&fit->system)) return false;
    for (size_t i = 0; i < fit->system.n; i++) ribbon->height_m[i] = fit->system.right[i];
    return true;
}

static double alike(double r_m, double width_m)
{
    (void)r_m;
    (void)width_m;
    return 1;
}

static double quantile(double r_m, double floor_m)
{
    return (r_m > 0 ? QUANTILE : 1 - QUANTILE) * floor_m / fmax(fabs(r_m), floor_m);
}

static double geman_mcclure(double r_m, double width_m)
{
    double q = 1 + r_m / width_m * (r_m / width_m);
    return 1 / (q * q);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Three standard deviations of what is near the ribbon, by the median; < 0 without memory. */
static double noise_width(const struct fit *fit)
{
    double *r = malloc(fit->count * sizeof *r);
    if (!r) return -1;
    size_t n = 0;
    for (size_t i = 0; i < fit->count; i++) {
        double d = fabs(residual(fit->ribbon, &fit->samples[i]));
        if (d < WIDEST_M / 2) r[n++] = d;
    }
    qsort(r, n, sizeof *r, by_value);
    double width = n ? 3 * 1.4826 * r[n / 2] : NARROWEST_M;
    free(r);
    return fmin(fmax(width, NARROWEST_M), WIDEST_M / 2);
}

static bool fit_heights(struct fit *fit, double *width_m)
{
    if (!solve(fit, STIFF_ALONG_M, STIFF_ACROSS_M, 0, alike, 0)) return false;
    for (int k = 0; k < QUANTILE_ROUNDS; k++)
        if (!solve(fit, STIFF_ALONG_M, STIFF_ACROSS_M, 0, quantile, QUANTILE_FLOOR_M)) return false;
    *width_m = WIDEST_M;
    for (int k = 1; k <= NARROWING_ROUNDS; k++) {
        double done = (double)k / NARROWING_ROUNDS, narrowest = noise_width(fit);
        if (narrowest < 0) return false;
        *width_m = WIDEST_M * pow(narrowest / WIDEST_M, done);
        if (!solve(fit, STIFF_ALONG_M * pow(ALONG_M / STIFF_ALONG_M, done),
                   STIFF_ACROSS_M * pow(ACROSS_M / STIFF_ACROSS_M, done), CROWN_M, geman_mcclure, *width_m))
            return false;
    }
    return true;
}

/* How near the mesh comes to the ribbon, and how much of it does. */
static void measure(struct fit *fit, double width_m)
{
    double square = 0, near = 0, all = 0;
    for (size_t i = 0; i < fit->count; i++) {
        double r = residual(fit->ribbon, &fit->samples[i]), area = fit->samples[i].area_m2;
        all += area;
        if (fabs(r) > width_m) continue;
        near += area;
        square += area * r * r;
    }
    fit->ribbon->rms_m = near > 0 ? sqrt(square / near) : 0;
    fit->ribbon->taken = all > 0 ? near / all : 0;
}

bool ribbon_fit(struct ribbon *ribbon, const struct way *way, struct static_mesh *mesh, struct error *err)
{
    double length = path_length(&way->path), half = way->width_m / 2 + way->sidewalk_m;
    struct ribbon new = { .way = way, .half_width_m = half, .rows = (size_t)ceil(length / RIBBON_STEP_M) + 1,
                          .columns = (size_t)ceil(2 * half / RIBBON_STEP_M) + 1 };
    if (new.rows < 2) new.rows = 2;
    if (new.columns < 3) new.columns = 3;
    struct fit fit = { .ribbon = &new, .row_m = length / (double)(new.rows - 1),
                       .column_m = 2 * half / (double)(new.columns - 1) };
    bool good = false;
    if (!strip_create(&new.strip, &way->path, half + RIBBON_MARGIN_M, err)) goto out;
    new.height_m = calloc(new.rows * new.columns, sizeof *new.height_m);
    fit.node_m = malloc(new.rows * new.columns * sizeof *fit.node_m);
    fit.seen = calloc(new.rows, sizeof *fit.seen);
    fit.no_memory = !new.height_m || !fit.seen || !fit.node_m
                    || !banded_create(&fit.system, new.rows * new.columns, 2 * new.columns);
    for (size_t i = 0; !fit.no_memory && i < new.rows * new.columns; i++)
        fit.node_m[i] = path_at(&way->path, (double)(i / new.columns) * fit.row_m,
                                (double)(i % new.columns) * fit.column_m - half).p_m;
    if (!fit.no_memory) strip_visit(&new.strip, mesh, RIBBON_STEP_M, take_piece, &fit);
    if (fit.no_memory) {
        error_set(err, ERR_MEMORY, "no memory for the surface of %s", way->name);
        goto out;
    }
    size_t seen = 0;
    for (size_t r = 0; r < new.rows; r++) seen += fit.seen[r];
    if ((double)seen < LEAST_COVERED * (double)new.rows) {
        error_set(err, ERR_INPUT, "%s: only %.0f of its %.0f m lie over the mesh of the place; a fifth is the least to tell "
                  "its height by", way->name, (double)seen * fit.row_m, length);
        goto out;
    }
    double width_m;
    if (!fit_heights(&fit, &width_m)) {
        error_set(err, ERR_MEMORY, "no memory for the surface of %s", way->name);
        goto out;
    }
    measure(&fit, width_m);
    *ribbon = new;
    new = (struct ribbon){ 0 };
    good = true;
out:
    banded_release(&fit.system);
    free(fit.node_m);
    free(fit.seen);
    free(fit.samples);
    ribbon_release(&new);
    return good;
}

#include "gen/world/ribbon.h"

#include <math.h>
#include <stdlib.h>

#define SLOPE_STEP_M 0.25
#define END_ROWS 4.0

void ribbon_release(struct ribbon *ribbon)
{
    strip_release(&ribbon->strip);
    free(ribbon->height_m);
    *ribbon = (struct ribbon){ 0 };
}

/* Heights within the grid, in rows and columns. */
static double grid_height(const struct ribbon *ribbon, double row, double column)
{
    size_t r = (size_t)row, c = (size_t)column;
    if (r + 2 > ribbon->rows) r = ribbon->rows - 2;
    if (c + 2 > ribbon->columns) c = ribbon->columns - 2;
    double v = row - (double)r, u = column - (double)c;
    const double *z = ribbon->height_m + r * ribbon->columns + c, *next = z + ribbon->columns;
    return (1 - v) * ((1 - u) * z[0] + u * z[1]) + v * ((1 - u) * next[0] + u * next[1]);
}

/* Beside its edges a ribbon goes on with the slope of its whole width, beyond its ends with that of its last
 * rows: the slope of the outermost cell is noise when it is drawn out. */
static double height_at(const struct ribbon *ribbon, struct strip_place place)
{
    double last_row = (double)(ribbon->rows - 1), last_column = (double)(ribbon->columns - 1);
    double v = place.s_m / path_length(&ribbon->way->path) * last_row;
    double u = (place.offset_m / ribbon->half_width_m + 1) / 2 * last_column;
    double row = fmin(fmax(v, 0), last_row), column = fmin(fmax(u, 0), last_column);
    double z = grid_height(ribbon, row, column);
    if (u != column)
        z += (u - column) / last_column * (grid_height(ribbon, row, last_column) - grid_height(ribbon, row, 0));
    if (v != row) {
        double inner = v > row ? fmax(last_row - END_ROWS, 0) : fmin(END_ROWS, last_row);
        z += (v - row) / (row - inner) * (grid_height(ribbon, row, column) - grid_height(ribbon, inner, column));
    }
    return z;
}

/* How far a place is beside the ribbon. */
static double distance_beside(const struct ribbon *ribbon, struct strip_place place)
{
    double beyond = fmax(0, fmax(-place.s_m, place.s_m - path_length(&ribbon->way->path)));
    return hypot(beyond, fmax(0, fabs(place.offset_m) - ribbon->half_width_m));
}

double ribbons_at(const struct ribbon *ribbons, size_t n, double *z_m, double x_m, double y_m)
{
    double sum = 0, weighted = 0, beside = 1;
    for (size_t i = 0; i < n; i++) {
        struct strip_place places[STRIP_PLACES];
        size_t found = strip_find_all(&ribbons[i].strip, places, x_m, y_m);
        /* A ribbon that comes by twice is as two. */
        for (size_t k = 0; k < found; k++) {
            double part = distance_beside(&ribbons[i], places[k]) / RIBBON_MARGIN_M;
            if (part >= 1) continue;
            double share = 1 - part * part * (3 - 2 * part);
            /* The wider has more to say: more of the mesh told its height. Margins have little, gradually. */
            double say = pow(share * ribbons[i].half_width_m, 3);
            sum += say;
            weighted += say * height_at(&ribbons[i], places[k]);
            beside *= 1 - share;
        }
    }
    if (sum > 0) *z_m = weighted / sum;
    return 1 - beside;
}

struct vec3 ribbons_normal(const struct ribbon *ribbons, size_t n, double x_m, double y_m)
{
    double z[4] = { 0 };
    ribbons_at(ribbons, n, &z[0], x_m - SLOPE_STEP_M, y_m);
    ribbons_at(ribbons, n, &z[1], x_m + SLOPE_STEP_M, y_m);
    ribbons_at(ribbons, n, &z[2], x_m, y_m - SLOPE_STEP_M);
    ribbons_at(ribbons, n, &z[3], x_m, y_m + SLOPE_STEP_M);
    return vec3_unit(vec3((z[0] - z[1]) / (2 * SLOPE_STEP_M), (z[2] - z[3]) / (2 * SLOPE_STEP_M), 1));
}

bool ribbon_at(const struct ribbon *ribbon, double *z_m, struct vec3 *normal, double x_m, double y_m)
{
    struct strip_place place;
    if (!strip_find(&ribbon->strip, &place, x_m, y_m) || distance_beside(ribbon, place) > 0) return false;
    ribbons_at(ribbon, 1, z_m, x_m, y_m);
    *normal = ribbons_normal(ribbon, 1, x_m, y_m);
    return true;
}

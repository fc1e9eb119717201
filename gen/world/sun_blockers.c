#include "gen/world/sun_blockers.h"

#include "gen/light/light.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#define CELL_M 0.05
#define CELLS_MAX 1024 /* along a side */
static const double spread = 1.4143 * SUN_RADIUS_RAD; /* of penumbra, by the distance: to the corners of a square round the disc */

struct sun_blockers {
    struct vec3 u, v, up;    /* across the rays, and along them towards the sun */
    double u0_m, v0_m, cell_m;
    double lowest_m;         /* of the ground, along `up` */
    int columns, rows;
    float *height_m;         /* (rows, columns) along `up`, of the highest there; -INFINITY: nothing */
};

/* A box in those coordinates. */
struct span { double u[2], v[2], up[2]; };

static const struct span nowhere = { { INFINITY, -INFINITY }, { INFINITY, -INFINITY }, { INFINITY, -INFINITY } };

static void widen(double stretch[2], double to)
{
    if (to < stretch[0]) stretch[0] = to;
    if (to > stretch[1]) stretch[1] = to;
}

/* In: p  in those coordinates */
static void include(struct span *s, struct vec3 p)
{
    widen(s->u, p.x);
    widen(s->v, p.y);
    widen(s->up, p.z);
}

static struct vec3 across(const struct sun_blockers *b, struct vec3 p_m)
{
    return vec3(vec3_dot(b->u, p_m), vec3_dot(b->v, p_m), vec3_dot(b->up, p_m));
}

static struct span span_of(const struct sun_blockers *b, const struct vec3 *point_m, size_t n)
{
    struct span s = nowhere;
    for (size_t i = 0; i < n; i++) include(&s, across(b, point_m[i]));
    return s;
}

bool sun_blockers_create(struct sun_blockers **blockers, struct vec3 towards_sun, const struct vec3 *point_m, size_t n, struct error *err)
{
    struct sun_blockers *b = calloc(1, sizeof *b);
    if (!b) return error_set(err, ERR_MEMORY, "no memory for what shades the ground");
    b->up = towards_sun;
    b->u = vec3_unit(vec3_cross(towards_sun, fabs(towards_sun.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0)));
    b->v = vec3_cross(towards_sun, b->u);
    struct span s = span_of(b, point_m, n);
    b->u0_m = s.u[0];
    b->v0_m = s.v[0];
    b->lowest_m = s.up[0];
    b->cell_m = fmax(CELL_M, fmax(s.u[1] - s.u[0], s.v[1] - s.v[0]) / (CELLS_MAX - 1));
    b->columns = (int)((s.u[1] - s.u[0]) / b->cell_m) + 1;
    b->rows = (int)((s.v[1] - s.v[0]) / b->cell_m) + 1;
    size_t cells = (size_t)b->columns * (size_t)b->rows;
    b->height_m = malloc(cells * sizeof *b->height_m);
    if (!b->height_m) {
        free(b);
        return error_set(err, ERR_MEMORY, "no memory for what shades the ground");
    }
    for (size_t i = 0; i < cells; i++) b->height_m[i] = -INFINITY;
    *blockers = b;
    return true;
}

void sun_blockers_destroy(struct sun_blockers *blockers)
{
    if (!blockers) return;
    free(blockers->height_m);
    free(blockers);
}

/* Out: cells (first, end) that a stretch of u or v covers, of `count` */
static void cells_of(int cells[2], const double stretch_m[2], double from_m, double cell_m, double margin_m, int count)
{
    double first = floor((stretch_m[0] - margin_m - from_m) / cell_m), end = floor((stretch_m[1] + margin_m - from_m) / cell_m) + 1;
    cells[0] = (int)fmin(fmax(first, 0), count);
    cells[1] = (int)fmin(fmax(end, 0), count);
}

static void mark(struct sun_blockers *b, const struct span *s, double margin_m, float height_m)
{
    int columns[2], rows[2];
    cells_of(columns, s->u, b->u0_m, b->cell_m, margin_m, b->columns);
    cells_of(rows, s->v, b->v0_m, b->cell_m, margin_m, b->rows);
    for (int y = rows[0]; y < rows[1]; y++)
        for (int x = columns[0]; x < columns[1]; x++) {
            float *height = &b->height_m[(size_t)y * (size_t)b->columns + (size_t)x];
            if (height_m > *height) *height = height_m;
        }
}

bool sun_blockers_add(struct sun_blockers *b, struct pose world_from_mesh, const float (*position_m)[3], size_t vertices,
                      const uint32_t (*triangle)[3], size_t triangles, struct error *err)
{
    struct vec3 *p = malloc((vertices + 1) * sizeof *p);
    if (!p) return error_set(err, ERR_MEMORY, "no memory for what shades the ground");
    for (size_t i = 0; i < vertices; i++) {
        const float *at = position_m[i];
        p[i] = across(b, pose_apply(world_from_mesh, vec3((double)at[0], (double)at[1], (double)at[2])));
    }
    for (size_t i = 0; i < triangles; i++) {
        struct span s = nowhere;
        for (int k = 0; k < 3; k++) include(&s, p[triangle[i][k]]);
        double above = s.up[1] - b->lowest_m;
        if (above > 0) mark(b, &s, spread * above, nextafterf((float)s.up[1], INFINITY));
    }
    free(p);
    return true;
}

void sun_blockers_add_above(struct sun_blockers *b, const struct vec3 corner_m[3], double up_m)
{
    struct span s = span_of(b, corner_m, 3);
    mark(b, &s, spread * (s.up[1] + up_m - b->lowest_m), INFINITY);
}

bool sun_blockers_reach(const struct sun_blockers *b, const struct vec3 corner_m[3])
{
    struct span s = span_of(b, corner_m, 3);
    int columns[2], rows[2];
    cells_of(columns, s.u, b->u0_m, b->cell_m, 0, b->columns);
    cells_of(rows, s.v, b->v0_m, b->cell_m, 0, b->rows);
    for (int y = rows[0]; y < rows[1]; y++)
        for (int x = columns[0]; x < columns[1]; x++)
            if ((double)b->height_m[(size_t)y * (size_t)b->columns + (size_t)x] > s.up[0]) return true;
    return false;
}

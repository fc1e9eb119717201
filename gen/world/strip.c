#include "gen/world/strip.h"

#include <math.h>
#include <stdlib.h>

#define APART_M 1.0 /* along the path: places nearer to each other are one */

static size_t cell_of(const struct strip *strip, struct vec2 p)
{
    size_t column = (size_t)((p.x - strip->min_m.x) / strip->cell_m), row = (size_t)((p.y - strip->min_m.y) / strip->cell_m);
    return row * strip->columns + column;
}

bool strip_create(struct strip *strip, const struct path *path, double reach_m, struct error *err)
{
    struct strip new = { .path = path, .reach_m = reach_m, .min_m = path->point_m[0], .max_m = path->point_m[0] };
    for (size_t i = 1; i < path->n; i++) {
        struct vec2 p = path->point_m[i];
        new.min_m = (struct vec2){ fmin(new.min_m.x, p.x), fmin(new.min_m.y, p.y) };
        new.max_m = (struct vec2){ fmax(new.max_m.x, p.x), fmax(new.max_m.y, p.y) };
    }
    new.min_m = (struct vec2){ new.min_m.x - reach_m, new.min_m.y - reach_m };
    new.max_m = (struct vec2){ new.max_m.x + reach_m, new.max_m.y + reach_m };
    double wide = new.max_m.x - new.min_m.x, high = new.max_m.y - new.min_m.y;
    /* No smaller than reach, so that nine cells hold all that is near; about as many as samples. */
    new.cell_m = fmax(reach_m, sqrt(wide * high / (double)path->n));
    new.columns = (size_t)(wide / new.cell_m) + 1;
    new.rows = (size_t)(high / new.cell_m) + 1;
    new.first = calloc(new.rows * new.columns + 1, sizeof *new.first);
    new.sample = malloc(path->n * sizeof *new.sample);
    if (!new.first || !new.sample) {
        strip_release(&new);
        return error_set(err, ERR_MEMORY, "no memory to look a path of %zu points up", path->n);
    }
    for (size_t i = 0; i < path->n; i++) new.first[cell_of(&new, path->point_m[i]) + 1]++;
    for (size_t c = 0; c < new.rows * new.columns; c++) new.first[c + 1] += new.first[c];
    /* Filled from the back, each cell's begin moves to its place. */
    for (size_t i = path->n; i-- > 0;) {
        uint32_t *end = &new.first[cell_of(&new, path->point_m[i]) + 1];
        new.sample[--*end] = (uint32_t)i;
    }
    for (size_t c = 0; c < new.rows * new.columns; c++) new.first[c] = new.first[c + 1];
    new.first[new.rows * new.columns] = (uint32_t)path->n;
    *strip = new;
    return true;
}

void strip_release(struct strip *strip)
{
    free(strip->first);
    free(strip->sample);
    *strip = (struct strip){ 0 };
}

/* From p to the segment that begins at sample i. */
static double segment_distance(const struct path *path, size_t i, struct vec2 p, struct strip_place *place)
{
    struct vec2 a = path->point_m[i], b = path->point_m[i + 1];
    double length = hypot(b.x - a.x, b.y - a.y), x = (b.x - a.x) / length, y = (b.y - a.y) / length;
    double along = (p.x - a.x) * x + (p.y - a.y) * y, aside = (p.y - a.y) * x - (p.x - a.x) * y;
    double held = fmin(fmax(along, 0), length), distance = hypot(along - held, aside);
    /* Where the path bends, a point outside lies beside two segments' common end. */
    bool before = i == 0 && along < 0, after = i + 2 == path->n && along > length;
    place->s_m = path->s_m[i] + (before || after ? along : held * (path->s_m[i + 1] - path->s_m[i]) / length);
    place->offset_m = before || after ? aside : copysign(distance, aside);
    return distance;
}

static double distance2(const struct path *path, size_t i, double x_m, double y_m)
{
    double x = path->point_m[i].x - x_m, y = path->point_m[i].y - y_m;
    return x * x + y * y;
}

/* Keep a sample among the nearest; of two that are neighbours on the path, the nearer. */
static size_t keep(const struct path *path, size_t near[STRIP_PLACES], double near2[STRIP_PLACES], size_t n, size_t i, double d2)
{
    for (size_t k = 0; k < n; k++) {
        if (fabs(path->s_m[near[k]] - path->s_m[i]) > APART_M) continue;
        if (near2[k] <= d2) return n;
        for (n--; k < n; k++) {
            near[k] = near[k + 1];
            near2[k] = near2[k + 1];
        }
    }
    if (n == STRIP_PLACES && near2[n - 1] <= d2) return n;
    size_t k = n < STRIP_PLACES ? n++ : n - 1;
    for (; k > 0 && near2[k - 1] > d2; k--) {
        near[k] = near[k - 1];
        near2[k] = near2[k - 1];
    }
    near[k] = i;
    near2[k] = d2;
    return n;
}

size_t strip_find_all(const struct strip *strip, struct strip_place places[STRIP_PLACES], double x_m, double y_m)
{
    if (!(x_m >= strip->min_m.x && x_m <= strip->max_m.x && y_m >= strip->min_m.y && y_m <= strip->max_m.y)) return 0;
    const struct path *path = strip->path;
    size_t column = (size_t)((x_m - strip->min_m.x) / strip->cell_m), row = (size_t)((y_m - strip->min_m.y) / strip->cell_m);
    size_t column_end = column + 2 < strip->columns ? column + 2 : strip->columns;
    size_t row_end = row + 2 < strip->rows ? row + 2 : strip->rows;
    size_t near[STRIP_PLACES], n = 0;
    double near2[STRIP_PLACES];
    for (size_t r = row ? row - 1 : 0; r < row_end; r++)
        for (size_t c = column ? column - 1 : 0; c < column_end; c++) {
            size_t cell = r * strip->columns + c;
            for (size_t k = strip->first[cell]; k < strip->first[cell + 1]; k++) {
                size_t i = strip->sample[k];
                double d2 = distance2(path, i, x_m, y_m);
                if (d2 > strip->reach_m * strip->reach_m || (i > 0 && distance2(path, i - 1, x_m, y_m) < d2)
                    || (i + 1 < path->n && distance2(path, i + 1, x_m, y_m) < d2))
                    continue;
                n = keep(path, near, near2, n, i, d2);
            }
        }
    for (size_t k = 0; k < n; k++) {
        struct strip_place left = { 0 }, right = { 0 };
        struct vec2 p = { x_m, y_m };
        double before = near[k] > 0 ? segment_distance(path, near[k] - 1, p, &left) : INFINITY;
        double after = near[k] + 1 < path->n ? segment_distance(path, near[k], p, &right) : INFINITY;
        places[k] = before < after ? left : right;
    }
    return n;
}

bool strip_find(const struct strip *strip, struct strip_place *place, double x_m, double y_m)
{
    struct strip_place places[STRIP_PLACES];
    if (strip_find_all(strip, places, x_m, y_m) == 0) return false;
    *place = places[0];
    return true;
}

static double edge2(struct vec3 a, struct vec3 b)
{
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

static bool is_outside(const struct strip *strip, const struct vec3 c[3])
{
    return fmax(c[0].x, fmax(c[1].x, c[2].x)) < strip->min_m.x || fmin(c[0].x, fmin(c[1].x, c[2].x)) > strip->max_m.x
        || fmax(c[0].y, fmax(c[1].y, c[2].y)) < strip->min_m.y || fmin(c[0].y, fmin(c[1].y, c[2].y)) > strip->max_m.y;
}

void strip_visit_triangle(const struct strip *strip, const struct vec3 corner_m[3], double edge_m,
                          strip_visitor *visit, void *user)
{
    if (is_outside(strip, corner_m)) return;
    int longest = 0;
    double length2 = 0;
    for (int i = 0; i < 3; i++) {
        double e2 = edge2(corner_m[i], corner_m[(i + 1) % 3]);
        if (e2 > length2) {
            length2 = e2;
            longest = i;
        }
    }
    if (length2 <= edge_m * edge_m) {
        visit(user, corner_m);
        return;
    }
    struct vec3 a = corner_m[longest], b = corner_m[(longest + 1) % 3], c = corner_m[(longest + 2) % 3];
    struct vec3 middle = vec3_scale(vec3_add(a, b), 0.5);
    double s, offset;
    /* No corner is farther from the middle of the longest edge than that edge is long. */
    if (path_project(strip->path, &s, &offset, (struct vec2){ middle.x, middle.y }) > strip->reach_m + sqrt(length2)) return;
    strip_visit_triangle(strip, (struct vec3[3]){ a, middle, c }, edge_m, visit, user);
    strip_visit_triangle(strip, (struct vec3[3]){ middle, b, c }, edge_m, visit, user);
}

void strip_visit(const struct strip *strip, struct static_mesh *mesh, double edge_m, strip_visitor *visit, void *user)
{
    float (*vertex)[3] = static_mesh_vertices(mesh);
    const uint32_t (*triangle)[3] = static_mesh_triangles(mesh);
    size_t triangles = static_mesh_triangle_count(mesh);
    for (size_t t = 0; t < triangles; t++) {
        struct vec3 corner[3];
        for (int i = 0; i < 3; i++) {
            const float *v = vertex[triangle[t][i]];
            corner[i] = vec3((double)v[0], (double)v[1], (double)v[2]);
        }
        strip_visit_triangle(strip, corner, edge_m, visit, user);
    }
}

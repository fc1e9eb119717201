#include "cast/mesh.h"

#include <stdlib.h>

const char *const material_name[MATERIAL_COUNT] = {
    "Car body paint", "Window glass", "Black trim plastic", "Underside rubber", "Interior", "Headlight plastic",
    "Tail light plastic", "Number plate plastic", "Rear number plate plastic", "Tire rubber", "Rim silver",
    "Skin", "Hair", "Jacket cloth", "Trousers cloth", "Shoes leather"
};

static void add_triangle(struct model *model, enum material material, struct vec3 a, struct vec3 b, struct vec3 c)
{
    if (model->count == model->room) {
        model->room = model->room ? 2 * model->room : 4096;
        model->triangles = realloc(model->triangles, model->room * sizeof *model->triangles);
        if (!model->triangles) abort();
    }
    model->triangles[model->count++] = (struct triangle){ { a, b, c }, material, model->part };
}

void add_quad(struct model *model, enum material material, const struct vec3 q[4])
{
    int k = vec3_norm(vec3_sub(q[0], q[2])) > vec3_norm(vec3_sub(q[1], q[3]));
    add_triangle(model, material, q[k], q[k + 1], q[k + 2]);
    add_triangle(model, material, q[k], q[k + 2], q[(k + 3) % 4]);
}

void add_sheet(struct model *model, int rows, int columns, int side, point_fn *point, material_fn *material,
               const void *shape)
{
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++) {
            struct vec3 q[4] = { point(shape, i, j), point(shape, i + 1, j), point(shape, i + 1, j + 1),
                                 point(shape, i, j + 1) };
            if (side < 0) {
                struct vec3 keep = q[1];
                q[1] = q[3], q[3] = keep;
                for (int k = 0; k < 4; k++) q[k].y = -q[k].y;
            }
            add_quad(model, material(shape, i, j), q);
        }
}

/* Lists of distinct vectors, in steps of 1/scale, sorted. */
struct cell { int v[3]; };
struct index { struct cell *cells; size_t count; double scale; };

static struct cell cell_of(const struct index *index, struct vec3 p)
{
    return (struct cell){ { (int)lround(p.x * index->scale), (int)lround(p.y * index->scale),
                            (int)lround(p.z * index->scale) } };
}

static int compare_cells(const void *a, const void *b)
{
    const struct cell *p = a, *q = b;
    for (int k = 0; k < 3; k++)
        if (p->v[k] != q->v[k]) return p->v[k] < q->v[k] ? -1 : 1;
    return 0;
}

static struct index index_of(const struct vec3 *p, size_t n, double scale)
{
    struct index index = { malloc(n * sizeof *index.cells), 0, scale };
    if (!index.cells) abort();
    for (size_t i = 0; i < n; i++) index.cells[i] = cell_of(&index, p[i]);
    qsort(index.cells, n, sizeof *index.cells, compare_cells);
    for (size_t i = 0; i < n; i++)
        if (!i || compare_cells(&index.cells[i], &index.cells[index.count - 1])) index.cells[index.count++] = index.cells[i];
    return index;
}

static size_t find(const struct index *index, struct vec3 p)
{
    struct cell key = cell_of(index, p);
    const struct cell *found = bsearch(&key, index->cells, index->count, sizeof key, compare_cells);
    return (size_t)(found - index->cells);
}

static struct vec3 face_normal(const struct triangle *t)
{
    return vec3_cross(vec3_sub(t->p[1], t->p[0]), vec3_sub(t->p[2], t->p[0])); /* as long as twice the area */
}

/* A corner's normal is the mean over the faces around its point that bend by less than the crease
 * angle from its own: smooth panels shade smoothly, edges stay edges. */
static void corner_normals(struct vec3 *normal, const struct model *model, const struct index *points)
{
    const double cos_crease = cos(40 * PI / 180);
    size_t corners = 3 * model->count;
    size_t *next = malloc(corners * sizeof *next), *first = malloc(points->count * sizeof *first);
    if (!next || !first) abort();
    for (size_t i = 0; i < points->count; i++) first[i] = corners;
    for (size_t c = corners; c-- > 0;) {
        size_t at = find(points, model->triangles[c / 3].p[c % 3]);
        next[c] = first[at], first[at] = c;
    }
    for (size_t c = 0; c < corners; c++) {
        struct vec3 own = face_normal(&model->triangles[c / 3]), sum = { 0, 0, 0 };
        for (size_t o = first[find(points, model->triangles[c / 3].p[c % 3])]; o < corners; o = next[o]) {
            struct vec3 n = face_normal(&model->triangles[o / 3]);
            if (vec3_dot(n, own) >= cos_crease * vec3_norm(n) * vec3_norm(own)) sum = vec3_add(sum, n);
        }
        normal[c] = vec3_unit(sum);
    }
    free(next);
    free(first);
}

/* Rounding to the grid of points may close a thin triangle up: it is left out. */
static void weld(struct model *model, const struct index *points)
{
    size_t kept = 0;
    for (size_t i = 0; i < model->count; i++) {
        struct triangle *t = &model->triangles[i];
        size_t a = find(points, t->p[0]), b = find(points, t->p[1]), c = find(points, t->p[2]);
        if (a != b && b != c && c != a && vec3_norm(face_normal(t)) > 1e-9) model->triangles[kept++] = *t;
    }
    model->count = kept;
}

/* Out: at  for each corner, where its vector is in the list. Returns the list. */
static struct vec3 *number(size_t (*at)[3], const struct index *index, const struct vec3 *p, size_t triangles)
{
    struct vec3 *list = malloc((index->count + 1) * sizeof *list);
    if (!list) abort();
    for (size_t i = 0; i < index->count; i++) {
        const int *v = index->cells[i].v;
        list[i] = vec3(v[0] / index->scale, v[1] / index->scale, v[2] / index->scale);
    }
    for (size_t c = 0; c < 3 * triangles; c++) at[c / 3][c % 3] = find(index, p[c]);
    return list;
}

struct surface make_surface(struct model *model)
{
    struct surface surface;
    struct vec3 *p = malloc(3 * model->count * sizeof *p), *n = malloc(3 * model->count * sizeof *n);
    if (!p || !n) abort();
    for (size_t c = 0; c < 3 * model->count; c++) p[c] = model->triangles[c / 3].p[c % 3];
    struct index points = index_of(p, 3 * model->count, 1e4);
    weld(model, &points);
    for (size_t c = 0; c < 3 * model->count; c++) p[c] = model->triangles[c / 3].p[c % 3];
    corner_normals(n, model, &points);
    struct index normals = index_of(n, 3 * model->count, 1e3);
    surface.point = malloc(model->count * sizeof *surface.point);
    surface.normal = malloc(model->count * sizeof *surface.normal);
    if (!surface.point || !surface.normal) abort();
    surface.points = number(surface.point, &points, p, model->count);
    surface.normals = number(surface.normal, &normals, n, model->count);
    surface.point_count = points.count;
    surface.normal_count = normals.count;
    free(points.cells), free(normals.cells), free(p), free(n);
    return surface;
}

void surface_release(struct surface *surface)
{
    free(surface->points), free(surface->normals), free(surface->point), free(surface->normal);
    *surface = (struct surface){ 0 };
}

void model_release(struct model *model)
{
    free(model->triangles);
    *model = (struct model){ 0 };
}

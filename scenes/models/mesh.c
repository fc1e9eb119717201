#include "scenes/models/mesh.h"

#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>

static const char *const material_name[MATERIAL_COUNT] = {
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
    model->triangles[model->count++] = (struct triangle){ { a, b, c }, material };
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

static void write_index(FILE *f, const char *word, const struct index *index)
{
    for (size_t i = 0; i < index->count; i++) {
        const int *v = index->cells[i].v;
        fprintf(f, "%s %g %g %g\n", word, v[0] / index->scale, v[1] / index->scale, v[2] / index->scale);
    }
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

static bool write_text(const char *folder, const char *name, const char *end, char *text, size_t size, struct error *err)
{
    char *path = string_format("%s/%s.%s", folder, name, end);
    bool good = path && file_write(path, text, size, err);
    free(path);
    free(text);
    return good;
}

bool write_model(struct model *model, const char *folder, const char *name, const struct palette *palette,
                 struct error *err)
{
    struct vec3 *p = malloc(3 * model->count * sizeof *p), *n = malloc(3 * model->count * sizeof *n);
    if (!p || !n) abort();
    for (size_t c = 0; c < 3 * model->count; c++) p[c] = model->triangles[c / 3].p[c % 3];
    struct index points = index_of(p, 3 * model->count, 1e4);
    weld(model, &points);
    corner_normals(n, model, &points);
    struct index normals = index_of(n, 3 * model->count, 1e3);

    char *text;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    if (!f) abort();
    fprintf(f, "# Made by Staffage's scenes/models/make-models: free for any use. Metres, z up, front +x.\nmtllib %s.mtl\n", name);
    write_index(f, "v", &points);
    write_index(f, "vn", &normals);
    bool used[MATERIAL_COUNT] = { false };
    for (int m = 0; m < MATERIAL_COUNT; m++) {
        for (size_t i = 0; i < model->count; i++) {
            if ((int)model->triangles[i].material != m) continue;
            if (!used[m]) fprintf(f, "usemtl %s\n", material_name[m]);
            used[m] = true;
            fputc('f', f);
            for (size_t k = 0; k < 3; k++)
                fprintf(f, " %zu//%zu", 1 + find(&points, model->triangles[i].p[k]), 1 + find(&normals, n[3 * i + k]));
            fputc('\n', f);
        }
    }
    fclose(f);
    bool good = write_text(folder, name, "obj", text, size, err);

    f = open_memstream(&text, &size);
    if (!f) abort();
    for (int m = 0; m < MATERIAL_COUNT; m++) {
        const double *rgb = palette->rgb[m];
        if (used[m]) fprintf(f, "newmtl %s\nKd %g %g %g\n", material_name[m], rgb[0], rgb[1], rgb[2]);
    }
    fclose(f);
    good = write_text(folder, name, "mtl", text, size, err) && good;
    free(points.cells), free(normals.cells), free(p), free(n);
    free(model->triangles);
    *model = (struct model){ 0 };
    return good;
}

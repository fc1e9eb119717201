/* Surfaces that come to a place, and triangles that go. */
#include "gen/world/static_mesh_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- the nearest vertex --- */

/* Vertices by cells of a grid over x and y. */
struct grid {
    double x0, y0, cell_m;
    long columns, rows;
    uint32_t *first;  /* (cells + 1) */
    uint32_t *vertex; /* (vertices) by cell */
};

static long clamp(double at, long n)
{
    return at > 0 ? at < (double)n ? (long)at : n - 1 : 0;
}

static long cell_of(const struct grid *grid, const float p[3])
{
    return clamp(((double)p[1] - grid->y0) / grid->cell_m, grid->rows) * grid->columns +
           clamp(((double)p[0] - grid->x0) / grid->cell_m, grid->columns);
}

static bool grid_init(struct grid *grid, const struct static_mesh *mesh, struct error *err)
{
    double low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    for (size_t i = 0; i < mesh->vertices; i++)
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], (double)mesh->position_m[i][k]);
            high[k] = fmax(high[k], (double)mesh->position_m[i][k]);
        }
    double width = high[0] - low[0], depth = high[1] - low[1];
    grid->x0 = low[0];
    grid->y0 = low[1];
    grid->cell_m = fmax(1e-6, sqrt(4 * fmax(width * depth, 1e-6 * (width * width + depth * depth)) / (double)mesh->vertices));
    grid->columns = 1 + (long)(width / grid->cell_m);
    grid->rows = 1 + (long)(depth / grid->cell_m);
    size_t cells = (size_t)grid->columns * (size_t)grid->rows;
    grid->first = calloc(cells + 2, sizeof *grid->first);
    grid->vertex = malloc((mesh->vertices + 1) * sizeof *grid->vertex);
    if (!grid->first || !grid->vertex) return error_set(err, ERR_MEMORY, "no memory for a grid of vertices");
    for (size_t i = 0; i < mesh->vertices; i++) grid->first[cell_of(grid, mesh->position_m[i]) + 2]++;
    for (size_t i = 2; i < cells + 2; i++) grid->first[i] += grid->first[i - 1];
    for (size_t i = 0; i < mesh->vertices; i++) grid->vertex[grid->first[cell_of(grid, mesh->position_m[i]) + 1]++] = (uint32_t)i;
    return true;
}

static uint32_t nearest_vertex(const struct grid *grid, const struct static_mesh *mesh, const float p[3])
{
    long cx = clamp(((double)p[0] - grid->x0) / grid->cell_m, grid->columns);
    long cy = clamp(((double)p[1] - grid->y0) / grid->cell_m, grid->rows), farthest = grid->columns + grid->rows;
    double best = INFINITY;
    uint32_t found = 0;
    /* Rings of cells: what lies in ring r is at least r - 1 cells away. */
    for (long r = 0; r <= farthest && ((double)(r - 1) * grid->cell_m < best || r < 2); r++)
        for (long y = cy - r; y <= cy + r; y++)
            for (long x = cx - r; x <= cx + r; x += y == cy - r || y == cy + r || r == 0 ? 1 : 2 * r) {
                if (x < 0 || y < 0 || x >= grid->columns || y >= grid->rows) continue;
                for (uint32_t k = grid->first[y * grid->columns + x]; k < grid->first[y * grid->columns + x + 1]; k++) {
                    const float *q = mesh->position_m[grid->vertex[k]];
                    double away = hypot(hypot((double)(q[0] - p[0]), (double)(q[1] - p[1])), (double)(q[2] - p[2]));
                    if (away >= best) continue;
                    best = away;
                    found = grid->vertex[k];
                }
            }
    return found;
}

/* --- adding and taking --- */

/* Most of three, or the first. */
static int16_t vote(int16_t a, int16_t b, int16_t c)
{
    return b == c ? b : a;
}

/* Colour and label of a triangle whose corners have theirs. */
static void dress(struct static_mesh *mesh, size_t triangle)
{
    const uint32_t *t = mesh->triangle[triangle];
    for (int k = 0; mesh->face_color && k < 3; k++)
        mesh->face_color[triangle][k] = (uint8_t)((mesh->color[t[0]][k] + mesh->color[t[1]][k] + mesh->color[t[2]][k]) / 3);
    if (mesh->label) mesh->label[triangle] = vote(mesh->vertex_label[t[0]], mesh->vertex_label[t[1]], mesh->vertex_label[t[2]]);
    if (mesh->texture) mesh->texture[triangle] = STATIC_NO_TEXTURE;
}

bool static_mesh_add(struct static_mesh *mesh, const float (*position_m)[3], size_t vertices,
                     const uint32_t (*triangle)[3], size_t triangles, struct error *err)
{
    if (mesh->indexed) return error_set(err, ERR_BUG, "a mesh is added to before it is indexed");
    struct grid grid = { 0 };
    size_t first = mesh->vertices;
    bool ok = grid_init(&grid, mesh, err) && static_mesh_reserve_vertices(mesh, first + vertices, mesh->color != NULL, err) &&
              static_mesh_reserve_triangles(mesh, mesh->triangles + triangles, err);
    for (size_t i = 0; ok && i < vertices; i++) {
        uint32_t nearest = nearest_vertex(&grid, mesh, position_m[i]);
        memcpy(mesh->position_m[first + i], position_m[i], sizeof *position_m);
        if (mesh->color) memcpy(mesh->color[first + i], mesh->color[nearest], sizeof *mesh->color);
        if (mesh->vertex_label) mesh->vertex_label[first + i] = mesh->vertex_label[nearest];
    }
    for (size_t i = 0; ok && i < triangles; i++) {
        for (int c = 0; c < 3; c++) mesh->triangle[mesh->triangles + i][c] = (uint32_t)first + triangle[i][c];
        dress(mesh, mesh->triangles + i);
    }
    free(grid.first);
    free(grid.vertex);
    if (!ok) return false;
    mesh->vertices += vertices;
    mesh->triangles += triangles;
    return true;
}

bool static_mesh_keep(struct static_mesh *mesh, const bool *keep, struct error *err)
{
    if (mesh->indexed) return error_set(err, ERR_BUG, "triangles go before a mesh is indexed");
    size_t kept = 0;
    for (size_t i = 0; i < mesh->triangles; i++) kept += keep[i];
    if (kept == 0) return error_set(err, ERR_INPUT, "no triangle of the mesh would be left");
    kept = 0;
    for (size_t i = 0; i < mesh->triangles; i++) {
        if (!keep[i]) continue;
        memmove(mesh->triangle[kept], mesh->triangle[i], sizeof *mesh->triangle);
        if (mesh->label) mesh->label[kept] = mesh->label[i];
        if (mesh->face_color) memmove(mesh->face_color[kept], mesh->face_color[i], sizeof *mesh->face_color);
        if (mesh->texture) mesh->texture[kept] = mesh->texture[i];
        if (mesh->uv) memmove(mesh->uv[kept], mesh->uv[i], sizeof *mesh->uv);
        kept++;
    }
    mesh->triangles = kept;
    return true;
}

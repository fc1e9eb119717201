#include "gen/world/ribbon.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CELL_PARTS 4       /* holes are looked for this much finer than the grid */
#define PIECE_M 0.5
#define COVERS_M 0.1       /* mesh this near in height is the road, where it was laid */
#define SINK_M 0.005       /* the fill lies below: two surfaces in one place would shade each other */
#define NO_VERTEX UINT32_MAX

/* What is to be added, of all ribbons. */
struct fill {
    float (*position_m)[3];
    uint32_t (*triangle)[3];
    size_t vertices, triangles, vertex_room, triangle_room;
};

struct cover {
    const struct ribbon *ribbons;
    size_t count, which;
    size_t rows, columns;      /* of parts, with one more around the ribbon */
    bool *covered;             /* (rows, columns) */
};

static void move_vertices(struct static_mesh *mesh, const struct ribbon *ribbons, size_t n)
{
    float (*vertex)[3] = static_mesh_vertices(mesh);
    size_t vertices = static_mesh_vertex_count(mesh);
    for (size_t i = 0; i < vertices; i++) {
        double road_m, z = (double)vertex[i][2];
        double share = ribbons_at(ribbons, n, &road_m, (double)vertex[i][0], (double)vertex[i][1]);
        if (share <= 0) continue;
        /* Wholly to three quarters of the clearance, then less, so that nothing folds. */
        double over = fmin(fmax(fabs(z - road_m) / RIBBON_CLEAR_M * 4 - 3, 0), 1);
        share *= 1 - over * over * (3 - 2 * over);
        vertex[i][2] = (float)(z + share * (road_m - z));
    }
}

/* Mark the parts of cells that a piece of the mesh covers. */
static void cover_piece(void *user, const struct vec3 corner_m[3])
{
    struct cover *cover = user;
    const struct ribbon *ribbon = &cover->ribbons[cover->which];
    double u[3], v[3], z[3], length = path_length(&ribbon->way->path);
    for (int i = 0; i < 3; i++) {
        struct strip_place place;
        if (!strip_find(&ribbon->strip, &place, corner_m[i].x, corner_m[i].y)) return;
        u[i] = (place.offset_m / ribbon->half_width_m + 1) / 2 * (double)(cover->columns - 2) + 0.5;
        v[i] = place.s_m / length * (double)(cover->rows - 2) + 0.5;
        if (ribbons_at(cover->ribbons, cover->count, &z[i], corner_m[i].x, corner_m[i].y) <= 0) return;
        z[i] = corner_m[i].z - z[i];
    }
    double twice = (u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]);
    double low = fmax(0, ceil(fmin(v[0], fmin(v[1], v[2])))), high = fmin((double)cover->rows - 1, fmax(v[0], fmax(v[1], v[2])));
    double left = fmax(0, ceil(fmin(u[0], fmin(u[1], u[2])))), right = fmin((double)cover->columns - 1, fmax(u[0], fmax(u[1], u[2])));
    /* A piece across the middle of a bend has corners far apart along the way. */
    if (fabs(twice) < 1e-12 || high - low > 8 * CELL_PARTS) return;
    for (double y = low; y <= high; y++)
        for (double x = left; x <= right; x++) {
            double b = ((x - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (y - v[0])) / twice;
            double c = ((u[1] - u[0]) * (y - v[0]) - (x - u[0]) * (v[1] - v[0])) / twice;
            if (b < -1e-9 || c < -1e-9 || b + c > 1 + 1e-9) continue;
            double over = z[0] + b * (z[1] - z[0]) + c * (z[2] - z[0]);
            if (fabs(over) < COVERS_M) cover->covered[(size_t)y * cover->columns + (size_t)x] = true;
        }
}

static void *grown(void *array, size_t wanted, size_t *room, size_t size)
{
    if (wanted <= *room) return array;
    size_t more = wanted > 2 * *room ? wanted + 64 : 2 * *room;
    void *bigger = realloc(array, more * size);
    if (bigger) *room = more;
    return bigger;
}

/* The node's vertex in the fill, made when it is first asked for. NO_VERTEX without memory. */
static uint32_t fill_vertex(struct fill *fill, uint32_t *known, const struct cover *cover, size_t row, size_t column)
{
    const struct ribbon *ribbon = &cover->ribbons[cover->which];
    uint32_t *vertex = &known[row * ribbon->columns + column];
    if (*vertex != NO_VERTEX) return *vertex;
    float (*more)[3] = grown(fill->position_m, fill->vertices + 1, &fill->vertex_room, sizeof *more);
    if (!more) return NO_VERTEX;
    fill->position_m = more;
    struct vec2 p = path_at(&ribbon->way->path, (double)row / (double)(ribbon->rows - 1) * path_length(&ribbon->way->path),
                            ribbon->half_width_m * (2 * (double)column / (double)(ribbon->columns - 1) - 1)).p_m;
    double z = ribbon->height_m[row * ribbon->columns + column];
    ribbons_at(cover->ribbons, cover->count, &z, p.x, p.y);
    more[fill->vertices][0] = (float)p.x;
    more[fill->vertices][1] = (float)p.y;
    more[fill->vertices][2] = (float)(z - SINK_M);
    *vertex = (uint32_t)fill->vertices++;
    return *vertex;
}

/* With one part around it: a hole may end between two parts. */
static bool is_covered(const struct cover *cover, size_t row, size_t column)
{
    size_t top = row * CELL_PARTS, left = column * CELL_PARTS;
    for (size_t y = top; y < top + CELL_PARTS + 2; y++)
        for (size_t x = left; x < left + CELL_PARTS + 2; x++)
            if (!cover->covered[y * cover->columns + x]) return false;
    return true;
}

/* In a bend narrower than the ribbon, cells beyond its centre lie on those of the other leg. */
static bool is_folded(const struct ribbon *ribbon, size_t row, size_t column)
{
    double s = ((double)row + 0.5) / (double)(ribbon->rows - 1) * path_length(&ribbon->way->path);
    double offset = ribbon->half_width_m * ((2 * (double)column + 1) / (double)(ribbon->columns - 1) - 1);
    struct vec2 p = path_at(&ribbon->way->path, s, offset).p_m;
    struct strip_place place;
    return !strip_find(&ribbon->strip, &place, p.x, p.y) || fabs(place.s_m - s) > RIBBON_STEP_M;
}

static bool fill_cell(struct fill *fill, uint32_t *known, const struct cover *cover, size_t row, size_t column)
{
    uint32_t corner[4];
    for (size_t i = 0; i < 4; i++) {
        corner[i] = fill_vertex(fill, known, cover, row + i / 2, column + i % 2);
        if (corner[i] == NO_VERTEX) return false;
    }
    uint32_t (*more)[3] = grown(fill->triangle, fill->triangles + 2, &fill->triangle_room, sizeof *more);
    if (!more) return false;
    fill->triangle = more;
    /* Columns go from right to left: 0 to 1 is to the left, 0 to 2 ahead. Counter-clockwise from above. */
    memcpy(more[fill->triangles++], (uint32_t[3]){ corner[0], corner[2], corner[1] }, sizeof *more);
    memcpy(more[fill->triangles++], (uint32_t[3]){ corner[1], corner[2], corner[3] }, sizeof *more);
    return true;
}

static bool fill_holes(struct fill *fill, struct static_mesh *mesh, struct cover *cover, struct error *err)
{
    const struct ribbon *ribbon = &cover->ribbons[cover->which];
    size_t nodes = ribbon->rows * ribbon->columns;
    cover->rows = (ribbon->rows - 1) * CELL_PARTS + 2;
    cover->columns = (ribbon->columns - 1) * CELL_PARTS + 2;
    cover->covered = calloc(cover->rows * cover->columns, sizeof *cover->covered);
    uint32_t *known = malloc(nodes * sizeof *known);
    bool good = cover->covered && known;
    if (good) {
        memset(known, 0xff, nodes * sizeof *known);
        strip_visit(&ribbon->strip, mesh, PIECE_M, cover_piece, cover);
        for (size_t t = 0; t < fill->triangles; t++) {
            struct vec3 corner[3];
            for (int i = 0; i < 3; i++) {
                const float *p = fill->position_m[fill->triangle[t][i]];
                corner[i] = vec3((double)p[0], (double)p[1], (double)p[2]);
            }
            strip_visit_triangle(&ribbon->strip, corner, PIECE_M, cover_piece, cover);
        }
    }
    for (size_t r = 0; good && r + 1 < ribbon->rows; r++)
        for (size_t c = 0; good && c + 1 < ribbon->columns; c++)
            if (!is_covered(cover, r, c) && !is_folded(ribbon, r, c)) good = fill_cell(fill, known, cover, r, c);
    free(known);
    free(cover->covered);
    return good || error_set(err, ERR_MEMORY, "no memory to fill the holes of %s", ribbon->way->name);
}

bool ribbons_lay(struct static_mesh *mesh, const struct ribbon *ribbons, size_t n, struct error *err)
{
    move_vertices(mesh, ribbons, n);
    struct fill fill = { 0 };
    bool good = true;
    for (size_t i = 0; good && i < n; i++)
        good = fill_holes(&fill, mesh, &(struct cover){ .ribbons = ribbons, .count = n, .which = i }, err);
    if (good && fill.triangles)
        good = static_mesh_add(mesh, (const float (*)[3])fill.position_m, fill.vertices,
                               (const uint32_t (*)[3])fill.triangle, fill.triangles, err);
    free(fill.position_m);
    free(fill.triangle);
    return good;
}

/* Cuts: the coarsened triangles that reach into prisms.
 *
 * The place lies in square tiles of whole cells; a tile's vertices are clustered, those of one cell
 * to their mean, when a cut first needs it, and only where that leaves at most half of them: where
 * the mesh is finer than the cells. A triangle belongs to the tile of its first corner. What a
 * vertex becomes depends on the vertices of its cell alone, so that tiles join without a gap.
 * Src: Rossignac & Borrel 1993, Multi-resolution 3D approximations for rendering complex scenes */
#include "gen/world/prism.h"
#include "gen/world/static_mesh_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TILE_CELLS 16    /* cells along a tile's side, more where there would be too many tiles */
#define TILES_MAX 65536.0
#define NO_CLUSTER UINT32_MAX

struct coarse_tile {
    bool clustered, ready;     /* its vertices, its triangles */
    uint32_t (*triangle)[3];   /* (triangles,3) clusters */
    size_t triangles;
};

struct cluster { float position_m[3], color[3]; };

struct static_tiles {
    double detail_m, side_m;
    struct vec3 origin_m;
    long columns, rows;
    uint32_t *first_vertex, *vertex;     /* (tiles + 2), (vertices in use) by tile */
    uint32_t *first_triangle, *triangle; /* (tiles + 2), (triangles) by tile */
    struct box3 *box;                    /* (tiles) of its triangles */
    struct coarse_tile *coarse;          /* (tiles) */
    uint32_t *cluster_of;                /* (vertices) NO_CLUSTER: not yet, or not in use */
    struct cluster *clusters;            /* grows */
    size_t cluster_count, cluster_capacity;
};

/* --- tiles --- */

static size_t tile_of(const struct static_tiles *tiles, const float p[3])
{
    long x = (long)(((double)p[0] - tiles->origin_m.x) / tiles->side_m), y = (long)(((double)p[1] - tiles->origin_m.y) / tiles->side_m);
    x = x < 0 ? 0 : x < tiles->columns ? x : tiles->columns - 1;
    y = y < 0 ? 0 : y < tiles->rows ? y : tiles->rows - 1;
    return (size_t)(y * tiles->columns + x);
}

static void grow_box(struct box3 *box, const float p[3], double margin)
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = fmin(box->low[k], (double)p[k] - margin);
        box->high[k] = fmax(box->high[k], (double)p[k] + margin);
    }
}

/* Sort the vertices in use and the triangles by tile; first[t] to first[t + 1] are those of tile t. */
static void sort_into_tiles(struct static_tiles *tiles, const struct static_mesh *mesh, size_t n, uint32_t *vertex_tile)
{
    for (size_t i = 0; i < mesh->triangles; i++)
        for (int c = 0; c < 3; c++) {
            uint32_t v = mesh->triangle[i][c];
            if (vertex_tile[v] != UINT32_MAX) continue;
            vertex_tile[v] = (uint32_t)tile_of(tiles, mesh->position_m[v]);
            tiles->first_vertex[vertex_tile[v] + 2]++;
        }
    for (size_t i = 0; i < mesh->triangles; i++) tiles->first_triangle[vertex_tile[mesh->triangle[i][0]] + 2]++;
    for (size_t t = 2; t < n + 2; t++) {
        tiles->first_vertex[t] += tiles->first_vertex[t - 1];
        tiles->first_triangle[t] += tiles->first_triangle[t - 1];
    }
    for (size_t v = 0; v < mesh->vertices; v++)
        if (vertex_tile[v] != UINT32_MAX) tiles->vertex[tiles->first_vertex[vertex_tile[v] + 1]++] = (uint32_t)v;
    for (size_t i = 0; i < mesh->triangles; i++) {
        uint32_t t = vertex_tile[mesh->triangle[i][0]];
        tiles->triangle[tiles->first_triangle[t + 1]++] = (uint32_t)i;
        for (int c = 0; c < 3; c++) grow_box(&tiles->box[t], mesh->position_m[mesh->triangle[i][c]], tiles->detail_m);
    }
}

bool static_tiles_build(struct static_mesh *mesh, double detail_m, struct error *err)
{
    struct static_tiles *tiles = calloc(1, sizeof *tiles);
    if (!tiles) return error_set(err, ERR_MEMORY, "no memory for the tiles of a mesh");
    mesh->tiles = tiles;
    double width = mesh->max_m.x - mesh->min_m.x, depth = mesh->max_m.y - mesh->min_m.y, cells = TILE_CELLS;
    while ((1 + width / (cells * detail_m)) * (1 + depth / (cells * detail_m)) > TILES_MAX) cells *= 2;
    tiles->detail_m = detail_m;
    tiles->side_m = cells * detail_m;
    tiles->origin_m = mesh->min_m;
    tiles->columns = 1 + (long)(width / tiles->side_m);
    tiles->rows = 1 + (long)(depth / tiles->side_m);
    size_t n = (size_t)(tiles->columns * tiles->rows);
    tiles->first_vertex = calloc(n + 2, sizeof *tiles->first_vertex);
    tiles->first_triangle = calloc(n + 2, sizeof *tiles->first_triangle);
    tiles->vertex = malloc((mesh->vertices + 1) * sizeof *tiles->vertex);
    tiles->triangle = malloc((mesh->triangles + 1) * sizeof *tiles->triangle);
    tiles->box = malloc(n * sizeof *tiles->box);
    tiles->coarse = calloc(n, sizeof *tiles->coarse);
    tiles->cluster_of = malloc((mesh->vertices + 1) * sizeof *tiles->cluster_of);
    if (!tiles->first_vertex || !tiles->first_triangle || !tiles->vertex || !tiles->triangle || !tiles->box || !tiles->coarse ||
        !tiles->cluster_of)
        return error_set(err, ERR_MEMORY, "no memory for the tiles of a mesh");
    for (size_t t = 0; t < n; t++)
        tiles->box[t] = (struct box3){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    memset(tiles->cluster_of, 0xff, mesh->vertices * sizeof *tiles->cluster_of);
    sort_into_tiles(tiles, mesh, n, tiles->cluster_of);
    memset(tiles->cluster_of, 0xff, mesh->vertices * sizeof *tiles->cluster_of);
    return true;
}

void static_tiles_destroy(struct static_tiles *tiles)
{
    if (!tiles) return;
    for (long t = 0; tiles->coarse && t < tiles->columns * tiles->rows; t++) free(tiles->coarse[t].triangle);
    free(tiles->first_vertex);
    free(tiles->vertex);
    free(tiles->first_triangle);
    free(tiles->triangle);
    free(tiles->box);
    free(tiles->coarse);
    free(tiles->cluster_of);
    free(tiles->clusters);
    free(tiles);
}

/* --- clusters --- */

struct cell { int32_t x, y, z; uint32_t cluster; };

static struct cell cell_at(const struct static_tiles *tiles, const float p[3])
{
    return (struct cell){ (int32_t)floor(((double)p[0] - tiles->origin_m.x) / tiles->detail_m),
                          (int32_t)floor(((double)p[1] - tiles->origin_m.y) / tiles->detail_m),
                          (int32_t)floor(((double)p[2] - tiles->origin_m.z) / tiles->detail_m), NO_CLUSTER };
}

/* The number of the cell, within the tile, of each of the n vertices. Returns how many cells there are, or 0 without memory. */
static uint32_t number_cells(uint32_t *number, const struct static_tiles *tiles, const struct static_mesh *mesh, const uint32_t *vertex, size_t n)
{
    size_t slots = 16;
    while (slots < 2 * n) slots *= 2;
    struct cell *table = malloc(slots * sizeof *table);
    if (!table) return 0;
    for (size_t i = 0; i < slots; i++) table[i].cluster = NO_CLUSTER;
    uint32_t cells = 0;
    for (size_t i = 0; i < n; i++) {
        struct cell c = cell_at(tiles, mesh->position_m[vertex[i]]);
        size_t at = ((uint32_t)c.x * 73856093u ^ (uint32_t)c.y * 19349663u ^ (uint32_t)c.z * 83492791u) & (slots - 1);
        while (table[at].cluster != NO_CLUSTER && (table[at].x != c.x || table[at].y != c.y || table[at].z != c.z)) at = (at + 1) & (slots - 1);
        if (table[at].cluster == NO_CLUSTER) {
            c.cluster = cells++;
            table[at] = c;
        }
        number[i] = table[at].cluster;
    }
    free(table);
    return cells;
}

static void add_share(struct cluster *cluster, const struct static_mesh *mesh, uint32_t vertex, float share)
{
    for (int k = 0; k < 3; k++) {
        cluster->position_m[k] += share * mesh->position_m[vertex][k];
        cluster->color[k] += share * (mesh->color ? mesh->linear[mesh->color[vertex][k]] : STATIC_GREY);
    }
}

/* Give each vertex of the tile its cluster. */
static bool cluster_tile(struct static_tiles *tiles, const struct static_mesh *mesh, size_t tile, struct error *err)
{
    if (tiles->coarse[tile].clustered) return true;
    const uint32_t *vertex = tiles->vertex + tiles->first_vertex[tile];
    size_t n = tiles->first_vertex[tile + 1] - tiles->first_vertex[tile];
    uint32_t *number = calloc(2 * n + 1, sizeof *number), *members = number + n;
    uint32_t made = number ? number_cells(number, tiles, mesh, vertex, n) : 0;
    bool ok = made > 0 || n == 0;
    if (ok && 2 * (size_t)made > n) /* as coarse as the cells, or nearly */
        for (made = 0; made < n; made++) number[made] = made;
    if (ok && tiles->cluster_count + made > tiles->cluster_capacity) {
        size_t capacity = 2 * (tiles->cluster_count + made);
        struct cluster *grown = realloc(tiles->clusters, capacity * sizeof *grown);
        ok = grown != NULL;
        if (ok) tiles->clusters = grown, tiles->cluster_capacity = capacity;
    }
    if (ok) {
        struct cluster *clusters = tiles->clusters + tiles->cluster_count;
        memset(clusters, 0, made * sizeof *clusters);
        for (size_t i = 0; i < n; i++) members[number[i]]++;
        for (size_t i = 0; i < n; i++) {
            add_share(&clusters[number[i]], mesh, vertex[i], 1 / (float)members[number[i]]);
            tiles->cluster_of[vertex[i]] = (uint32_t)tiles->cluster_count + number[i];
        }
        tiles->cluster_count += made;
        tiles->coarse[tile].clustered = true;
    }
    free(number);
    return ok || error_set(err, ERR_MEMORY, "no memory for a part of the place");
}

static bool coarsen_tile(struct static_tiles *tiles, const struct static_mesh *mesh, size_t tile, struct error *err)
{
    struct coarse_tile *coarse = &tiles->coarse[tile];
    if (coarse->ready) return true;
    size_t n = tiles->first_triangle[tile + 1] - tiles->first_triangle[tile];
    uint32_t (*triangle)[3] = malloc((n + 1) * sizeof *triangle);
    if (!triangle) return error_set(err, ERR_MEMORY, "no memory for a part of the place");
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) {
        const uint32_t *t = mesh->triangle[tiles->triangle[tiles->first_triangle[tile] + i]];
        for (int c = 0; c < 3; c++) {
            if (!cluster_tile(tiles, mesh, tile_of(tiles, mesh->position_m[t[c]]), err)) {
                free(triangle);
                return false;
            }
            triangle[kept][c] = tiles->cluster_of[t[c]];
        }
        kept += triangle[kept][0] != triangle[kept][1] && triangle[kept][1] != triangle[kept][2] && triangle[kept][2] != triangle[kept][0];
    }
    void *fitted = kept ? realloc(triangle, kept * sizeof *triangle) : NULL;
    if (fitted) triangle = fitted;
    *coarse = (struct coarse_tile){ .clustered = coarse->clustered, .ready = true, .triangle = triangle, .triangles = kept };
    return true;
}

/* --- cutting --- */

struct cutter {
    struct static_cut cut;
    size_t triangle_capacity, vertex_capacity;
    uint32_t *renumbered;    /* (renumbered_capacity) by cluster: its vertex in the cut */
    size_t renumbered_capacity;
};

static bool grow(void *array, size_t count, size_t element)
{
    void **at = array, *grown = realloc(*at, count * element);
    if (grown) *at = grown;
    return grown != NULL;
}

/* Room for the clusters that tiles made since. */
static bool fit_clusters(struct cutter *cutter, size_t clusters)
{
    if (clusters <= cutter->renumbered_capacity) return true;
    if (!grow(&cutter->renumbered, 2 * clusters, sizeof *cutter->renumbered)) return false;
    memset(cutter->renumbered + cutter->renumbered_capacity, 0xff, (2 * clusters - cutter->renumbered_capacity) * sizeof *cutter->renumbered);
    cutter->renumbered_capacity = 2 * clusters;
    return true;
}

static bool take(struct cutter *cutter, const struct static_tiles *tiles, const uint32_t triangle[3])
{
    struct static_cut *cut = &cutter->cut;
    if (cut->triangles == cutter->triangle_capacity) {
        cutter->triangle_capacity = 2 * cutter->triangle_capacity + 1024;
        if (!grow(&cut->triangle, cutter->triangle_capacity, sizeof *cut->triangle)) return false;
    }
    if (cut->vertices + 3 > cutter->vertex_capacity) {
        cutter->vertex_capacity = 2 * cutter->vertex_capacity + 1024;
        if (!grow(&cut->position_m, cutter->vertex_capacity, sizeof *cut->position_m)) return false;
        if (!grow(&cut->color, cutter->vertex_capacity, sizeof *cut->color)) return false;
    }
    for (int c = 0; c < 3; c++) {
        uint32_t *at = &cutter->renumbered[triangle[c]];
        if (*at == UINT32_MAX) {
            const struct cluster *cluster = &tiles->clusters[triangle[c]];
            *at = (uint32_t)cut->vertices;
            memcpy(cut->position_m[cut->vertices], cluster->position_m, sizeof *cut->position_m);
            memcpy(cut->color[cut->vertices++], cluster->color, sizeof *cut->color);
        }
        cut->triangle[cut->triangles][c] = *at;
    }
    cut->triangles++;
    return true;
}

static bool reaches(const struct static_tiles *tiles, const uint32_t triangle[3], const struct prism *prisms, const size_t *near, size_t n)
{
    const float *p[3];
    for (int c = 0; c < 3; c++) p[c] = tiles->clusters[triangle[c]].position_m;
    for (size_t i = 0; i < n; i++)
        if (prism_meets_triangle(&prisms[near[i]], p)) return true;
    return false;
}

bool static_mesh_cut(const struct static_mesh *mesh, struct static_cut *cut, const struct prism *prisms, size_t n,
                     struct error *err)
{
    struct static_tiles *tiles = mesh->tiles;
    struct cutter cutter = { 0 };
    size_t *near = malloc((n + 1) * sizeof *near);
    bool ok = near != NULL;
    for (size_t t = 0; ok && t < (size_t)(tiles->columns * tiles->rows); t++) {
        size_t nears = 0;
        if (tiles->first_triangle[t] == tiles->first_triangle[t + 1]) continue;
        for (size_t i = 0; i < n; i++)
            if (prism_may_meet_box(&prisms[i], &tiles->box[t])) near[nears++] = i;
        if (nears == 0) continue;
        ok = coarsen_tile(tiles, mesh, t, err) && fit_clusters(&cutter, tiles->cluster_count);
        const struct coarse_tile *coarse = &tiles->coarse[t];
        for (size_t i = 0; ok && i < coarse->triangles; i++)
            if (reaches(tiles, coarse->triangle[i], prisms, near, nears)) ok = take(&cutter, tiles, coarse->triangle[i]);
    }
    free(near);
    free(cutter.renumbered);
    if (ok) {
        *cut = cutter.cut;
        return true;
    }
    static_cut_release(&cutter.cut);
    return error_set(err, ERR_MEMORY, "no memory for a part of the place"); /* the first error wins */
}

void static_cut_release(struct static_cut *cut)
{
    free(cut->position_m);
    free(cut->color);
    free(cut->triangle);
    *cut = (struct static_cut){ 0 };
}

bool static_cut_pick(struct static_cut *out, const struct static_cut *cut, const bool *taken, bool wanted)
{
    struct static_cut picked = { .position_m = calloc(cut->vertices + 1, sizeof *cut->position_m),
                                 .triangle = calloc(cut->triangles + 1, sizeof *cut->triangle) };
    uint32_t *number = malloc((cut->vertices + 1) * sizeof *number);
    bool ok = picked.position_m && picked.triangle && number;
    *out = (struct static_cut){ 0 };
    if (ok) memset(number, 0xff, (cut->vertices + 1) * sizeof *number);
    for (size_t i = 0; ok && i < cut->triangles; i++) {
        const uint32_t *t = cut->triangle[i];
        if (taken[i] != wanted) continue;
        for (int k = 0; k < 3; k++) {
            if (number[t[k]] == UINT32_MAX) {
                number[t[k]] = (uint32_t)picked.vertices;
                memcpy(picked.position_m[picked.vertices++], cut->position_m[t[k]], sizeof *cut->position_m);
            }
            picked.triangle[picked.triangles][k] = number[t[k]];
        }
        picked.triangles++;
    }
    free(number);
    if (ok) *out = picked;
    else static_cut_release(&picked);
    return ok;
}

bool static_cut_normals(struct vec3 **out, const struct static_cut *cut, struct error *err)
{
    struct vec3 *normal = calloc(cut->vertices + 1, sizeof *normal);
    if (!normal) return error_set(err, ERR_MEMORY, "no memory for the place");
    for (size_t i = 0; i < cut->triangles; i++) {
        const uint32_t *t = cut->triangle[i];
        struct vec3 p[3];
        for (int k = 0; k < 3; k++) {
            const float *corner = cut->position_m[t[k]];
            p[k] = vec3((double)corner[0], (double)corner[1], (double)corner[2]);
        }
        struct vec3 n = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
        for (int k = 0; k < 3; k++) normal[t[k]] = vec3_add(normal[t[k]], n);
    }
    for (size_t i = 0; i < cut->vertices; i++) {
        double norm = vec3_norm(normal[i]);
        normal[i] = norm > 0 ? vec3_scale(normal[i], 1 / norm) : vec3(0, 0, 1);
    }
    *out = normal;
    return true;
}

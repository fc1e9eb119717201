#include "reconstruct.h"

#include "color_place.h"
#include "place_heights.h"
#include "place_mesh.h"
#include "write_pov.h"

#include <stdlib.h>
#include <string.h>

enum { W = PROVING_MESH_COLUMNS, H = PROVING_MESH_ROWS };

static void add_face(struct place_mesh *mesh, int a, int b, int c)
{
    memcpy(mesh->faces[mesh->face_count++], (int[3]){ a, b, c }, sizeof *mesh->faces);
}

/* Two faces to each four cells. */
static void add_ground(struct place_mesh *mesh, const struct place_heights *heights)
{
    for (int i = 0; i < W * H; i++)
        mesh->vertices_m[mesh->vertex_count++] = place_heights_point(i % W, i / W, (double)heights->z_m[HEIGHTS_GROUND][i]);
    for (int row = 0; row + 1 < H; row++)
        for (int column = 0; column + 1 < W; column++) {
            int a = row * W + column, b = a + W;
            add_face(mesh, a, b, b + 1);
            add_face(mesh, a, b + 1, a + 1);
        }
}

/* --- trees --- */

/* Are all four cells a tree's? In: column, row of the north-western */
static bool is_tree(const int *top, int column, int row)
{
    if (column < 0 || row < 0 || column + 1 >= W || row + 1 >= H) return false;
    const int *a = &top[row * W + column];
    return a[0] >= 0 && a[1] >= 0 && a[W] >= 0 && a[W + 1] >= 0;
}

/* A tree's part over four cells: above, below, and to the sides where it ends. In: top (H, W), a vertex; the one below it is the next */
static void add_tree_part(struct place_mesh *mesh, const int *top, int column, int row)
{
    static const int east[4] = { 0, 0, 1, 1 }, south[4] = { 0, 1, 1, 0 };   /* counter-clockwise from the north-western */
    static const int beyond[4][2] = { { -1, 0 }, { 0, 1 }, { 1, 0 }, { 0, -1 } }; /* the side from this one to the next */
    int v[4];
    for (int k = 0; k < 4; k++) v[k] = top[(row + south[k]) * W + column + east[k]];
    add_face(mesh, v[0], v[1], v[2]);
    add_face(mesh, v[0], v[2], v[3]);
    add_face(mesh, v[0] + 1, v[2] + 1, v[1] + 1);
    add_face(mesh, v[0] + 1, v[3] + 1, v[2] + 1);
    for (int k = 0; k < 4; k++) {
        if (is_tree(top, column + beyond[k][0], row + beyond[k][1])) continue;
        int from = v[k], to = v[(k + 1) % 4];
        add_face(mesh, to, from, from + 1);
        add_face(mesh, to, from + 1, to + 1);
    }
}

static bool add_trees(struct place_mesh *mesh, const struct place_heights *heights, struct error *err)
{
    int *top = malloc(sizeof *top * W * H);
    if (!top) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
    for (int i = 0; i < W * H; i++)
        top[i] = isfinite(heights->z_m[HEIGHTS_TOP][i]) && isfinite(heights->z_m[HEIGHTS_BOTTOM][i]) ? 0 : -1;
    for (int i = 0; i < W * H; i++) {
        int x = i % W, y = i / W;
        bool has_part = is_tree(top, x, y) || is_tree(top, x - 1, y) || is_tree(top, x, y - 1) || is_tree(top, x - 1, y - 1);
        top[i] = has_part ? (int)mesh->vertex_count : -1;
        for (int kind = HEIGHTS_TOP; has_part && kind <= HEIGHTS_BOTTOM; kind++)
            mesh->vertices_m[mesh->vertex_count++] = place_heights_point(x, y, (double)heights->z_m[kind][i]);
    }
    for (int row = 0; row + 1 < H; row++)
        for (int column = 0; column + 1 < W; column++)
            if (is_tree(top, column, row)) add_tree_part(mesh, top, column, row);
    free(top);
    return true;
}

/* Room for trees in every cell, with walls on all sides. */
enum { MOST_VERTICES = 3 * W * H, MOST_FACES = (2 + 4 + 8) * W * H };

static bool mesh_of(struct place_mesh *mesh, const struct place_heights *heights, struct error *err)
{
    mesh->vertices_m = malloc(sizeof *mesh->vertices_m * MOST_VERTICES);
    mesh->faces = malloc(sizeof *mesh->faces * MOST_FACES);
    if (!mesh->vertices_m || !mesh->faces) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
    add_ground(mesh, heights);
    return add_trees(mesh, heights, err);
}

bool reconstruct(const char *path, const struct image *heights, const struct image *map, const struct image *photographs,
                 const struct proving_case *c, const struct camera *camera, struct error *err)
{
    struct place_heights z;
    if (!place_heights_create(&z, heights, err)) return false;
    struct place_mesh mesh = { 0 };
    struct place_views views = { &z, map, photographs, c, camera };
    bool ok = mesh_of(&mesh, &z, err) && place_mesh_split(&mesh, PROVING_MESH_EDGE_M, err) && color_place(&mesh, &views, err) &&
              place_mesh_write(path, &mesh, err);
    place_mesh_release(&mesh);
    place_heights_release(&z);
    return ok;
}

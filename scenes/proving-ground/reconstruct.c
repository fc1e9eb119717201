#include "reconstruct.h"

#include "color_place.h"
#include "place_mesh.h"
#include "write_pov.h"

#include <stdlib.h>
#include <string.h>

enum { W = PROVING_MESH_COLUMNS, H = PROVING_MESH_ROWS, WAVES = 48 };

struct waves { double kx[WAVES], ky[WAVES], phase[WAVES]; };

/* A sum of many waves of any direction: smooth, and near to normally distributed. */
static struct waves waves_make(void)
{
    struct waves w;
    uint64_t state = 20220621;
    for (int i = 0; i < WAVES; i++) {
        double u[3];
        for (int k = 0; k < 3; k++) {
            state = state * 6364136223846793005u + 1442695040888963407u;
            u[k] = (double)(state >> 11) / 9007199254740992.0;
        }
        double k = 2 * M_PI / (PROVING_MESH_WAVE_M * (0.7 + 2.5 * u[0]));
        w.kx[i] = k * cos(2 * M_PI * u[1]);
        w.ky[i] = k * sin(2 * M_PI * u[1]);
        w.phase[i] = 2 * M_PI * u[2];
    }
    return w;
}

static double waves_at(const struct waves *w, double x, double y)
{
    double sum = 0;
    for (int i = 0; i < WAVES; i++) sum += cos(w->kx[i] * x + w->ky[i] * y + w->phase[i]);
    return PROVING_MESH_ERROR_M * sum * sqrt(2.0 / WAVES);
}

/* Cells by columns from the west, by rows from the north: the picture's. */
static struct vec3 vertex(const float *z, int column, int row)
{
    return vec3(PROVING_MESH_X0_M + (column + 0.5) * PROVING_MESH_CELL_M, PROVING_MESH_Y0_M + (H - row - 0.5) * PROVING_MESH_CELL_M,
                (double)z[row * W + column]);
}

/* Two faces to each four cells. */
static bool mesh_of(struct place_mesh *mesh, const float *z, struct error *err)
{
    mesh->vertices_m = malloc(sizeof *mesh->vertices_m * W * H);
    mesh->faces = malloc(sizeof *mesh->faces * 2 * (W - 1) * (H - 1));
    if (!mesh->vertices_m || !mesh->faces) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
    for (int i = 0; i < W * H; i++) mesh->vertices_m[mesh->vertex_count++] = vertex(z, i % W, i / W);
    for (int row = 0; row + 1 < H; row++)
        for (int column = 0; column + 1 < W; column++) {
            int a = row * W + column, b = a + W;
            memcpy(mesh->faces[mesh->face_count++], (int[3]){ a, b, b + 1 }, sizeof *mesh->faces);
            memcpy(mesh->faces[mesh->face_count++], (int[3]){ a, b + 1, a + 1 }, sizeof *mesh->faces);
        }
    return true;
}

bool reconstruct(const char *path, const struct image *heights, const struct image *map, const struct image *photographs,
                 const struct proving_case *c, const struct camera *camera, struct error *err)
{
    float *z = malloc(sizeof *z * W * H);
    if (!z) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
    struct waves waves = waves_make();
    for (int row = 0; row < H; row++)
        for (int column = 0; column < W; column++) {
            z[row * W + column] = (float)((double)*image_u16(heights, column, row) / 65535 * PROVING_HEIGHT_M - 1);
            struct vec3 p = vertex(z, column, row);
            z[row * W + column] += (float)waves_at(&waves, p.x, p.y);
        }
    struct place_mesh mesh = { 0 };
    struct place_views views = { z, map, photographs, c, camera };
    bool ok = mesh_of(&mesh, z, err) && place_mesh_split(&mesh, PROVING_MESH_EDGE_M, err) && color_place(&mesh, &views, err) &&
              place_mesh_write(path, &mesh, err);
    place_mesh_release(&mesh);
    free(z);
    return ok;
}

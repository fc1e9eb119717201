#include "place_heights.h"

#include "write_pov.h"

#include <stdlib.h>
#include <string.h>

enum { W = PROVING_MESH_COLUMNS, H = PROVING_MESH_ROWS, WAVES = 48 };
#define SKIN_M 0.05

const char *const place_heights_kinds[HEIGHTS_KINDS] = { "heights", "tree-tops", "tree-bottoms" };

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

struct vec3 place_heights_point(int column, int row, double z_m)
{
    return vec3(PROVING_MESH_X0_M + (column + 0.5) * PROVING_MESH_CELL_M, PROVING_MESH_Y0_M + (H - row - 0.5) * PROVING_MESH_CELL_M, z_m);
}

/* 0 in a picture of trees: there is none. */
static float height_of(const struct image *picture, int kind, int column, int row)
{
    uint16_t value = *image_u16(picture, column, row);
    return kind != HEIGHTS_GROUND && value == 0 ? NAN : (float)((double)value / 65535 * PROVING_HEIGHT_M - 1);
}

bool place_heights_create(struct place_heights *heights, const struct image *pictures, struct error *err)
{
    struct place_heights out = { { 0 } };
    struct waves waves = waves_make();
    bool ok = true;
    for (int kind = 0; kind < HEIGHTS_KINDS; kind++) ok = (out.z_m[kind] = malloc(sizeof(float) * W * H)) && ok;
    for (int i = 0; ok && i < W * H; i++) {
        struct vec3 p = place_heights_point(i % W, i / W, 0);
        float off = (float)waves_at(&waves, p.x, p.y);
        for (int kind = 0; kind < HEIGHTS_KINDS; kind++) out.z_m[kind][i] = height_of(&pictures[kind], kind, i % W, i / W) + off;
    }
    *heights = out;
    if (!ok) place_heights_release(heights);
    return ok || error_set(err, ERR_MEMORY, "no memory for the reconstruction");
}

void place_heights_release(struct place_heights *heights)
{
    for (int kind = 0; kind < HEIGHTS_KINDS; kind++) free(heights->z_m[kind]);
    *heights = (struct place_heights){ { 0 } };
}

bool place_heights_solid(const struct place_heights *heights, struct vec3 p)
{
    int column = (int)floor((p.x - PROVING_MESH_X0_M) / PROVING_MESH_CELL_M);
    int row = H - 1 - (int)floor((p.y - PROVING_MESH_Y0_M) / PROVING_MESH_CELL_M), i = row * W + column;
    if (column < 0 || row < 0 || column >= W || row >= H) return false;
    return (double)heights->z_m[HEIGHTS_GROUND][i] > p.z + SKIN_M ||
           ((double)heights->z_m[HEIGHTS_TOP][i] > p.z + SKIN_M && (double)heights->z_m[HEIGHTS_BOTTOM][i] < p.z - SKIN_M);
}

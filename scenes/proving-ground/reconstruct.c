#include "reconstruct.h"

#include "write_pov.h"

#include <stdio.h>
#include <stdlib.h>

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

static bool sees(const float *z, struct vec3 eye, struct vec3 p)
{
    struct vec3 way = vec3_sub(eye, p);
    double length = vec3_norm(way), step = 0.75 * PROVING_MESH_CELL_M;
    way = vec3_scale(way, step / length);
    for (double done = 3 * step; done < length; done += step) {
        struct vec3 q = vec3_add(p, vec3_scale(way, done / step));
        if (q.z > 15) return true;
        int column = (int)floor((q.x - PROVING_MESH_X0_M) / PROVING_MESH_CELL_M);
        int row = H - 1 - (int)floor((q.y - PROVING_MESH_Y0_M) / PROVING_MESH_CELL_M);
        if (column < 0 || row < 0 || column >= W || row >= H) return true;
        if ((double)z[row * W + column] > q.z + 0.05) return false;
    }
    return true;
}

/* The mean of the photographs that see it; grey where none does. */
static void color_of(int rgb[3], struct vec3 p, const float *z, const struct image *photographs, const struct proving_case *c,
                     const struct camera *camera)
{
    double sum[3] = { 0 }, n = 0;
    for (size_t i = 0; i < c->shot_count; i++) {
        struct error ignored = ERROR_NONE;
        struct vec2 q;
        struct vec3 in_camera = pose_apply(pose_inverse(proving_shot_pose(&c->shots[i])), p);
        if (!camera_project(camera, &q, in_camera, &ignored)) continue;
        if (!(q.x >= 0 && q.y >= 0 && q.x < camera->width_px && q.y < camera->height_px) || !sees(z, c->shots[i].eye_m, p)) continue;
        for (int k = 0; k < 3; k++) sum[k] += image_u8(&photographs[i], (int)q.x, (int)q.y)[k];
        n++;
    }
    for (int k = 0; k < 3; k++) rgb[k] = n > 0 ? (int)(sum[k] / n + 0.5) : 110;
}

static void put_mesh(FILE *f, const float *z, const struct image *photographs, const struct proving_case *c, const struct camera *camera)
{
    fprintf(f, "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
            "property uchar green\nproperty uchar blue\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n",
            W * H, 2 * (W - 1) * (H - 1));
    for (int row = 0; row < H; row++)
        for (int column = 0; column < W; column++) {
            struct vec3 p = vertex(z, column, row);
            int rgb[3];
            color_of(rgb, p, z, photographs, c, camera);
            fprintf(f, "%.4f %.4f %.4f %d %d %d\n", p.x, p.y, p.z, rgb[0], rgb[1], rgb[2]);
        }
    for (int row = 0; row + 1 < H; row++)
        for (int column = 0; column + 1 < W; column++) {
            int a = row * W + column, b = a + W;
            fprintf(f, "3 %d %d %d\n3 %d %d %d\n", a, b, b + 1, a, b + 1, a + 1);
        }
}

bool reconstruct(const char *path, const struct image *heights, const struct image *photographs, const struct proving_case *c,
                 const struct camera *camera, struct error *err)
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
    FILE *f = fopen(path, "w");
    if (f) put_mesh(f, z, photographs, c, camera);
    free(z);
    return (f && fclose(f) == 0) || error_at(err, ERR_INPUT, path, 0, 0, "cannot be written");
}

#include "post/resample.h"

#include <math.h>
#include <string.h>

/* The lens is followed exactly at 3 by 3 nodes of a cell and linearly between its corners,
 * as long as that is off by no more than this at the other five nodes. */
#define MAP_TOLERANCE_PX 0.005
#define CELL_PX 16
#define SAMPLES_MAX 16

struct resampling {
    struct image *out;
    const struct image *in;
    size_t n;
    const struct view *view;
    const struct camera *camera;
};

/* A bilinear map: view position of the cell's position (s, t) in [0, 1]^2. */
struct cell { int x0, y0, x1, y1; struct vec2 v[2][2]; };

static struct vec2 cell_map(const struct cell *cell, double s, double t)
{
    const struct vec2(*v)[2] = cell->v;
    double a = (1 - t) * (1 - s), b = (1 - t) * s, c = t * (1 - s), d = t * s;
    return (struct vec2){ a * v[0][0].x + b * v[0][1].x + c * v[1][0].x + d * v[1][1].x,
                          a * v[0][0].y + b * v[0][1].y + c * v[1][0].y + d * v[1][1].y };
}

/* A view pixel that goes into a photograph pixel. */
struct tap { size_t index; float weight; };

/* The four view pixels around a position. Returns the new count of taps. */
static int add_taps(struct tap *taps, int count, struct vec2 v, float weight, int width, int height)
{
    double left = floor(v.x - 0.5), top = floor(v.y - 0.5);
    if (!(v.x >= -0.5 && v.x < width + 0.5 && v.y >= -0.5 && v.y < height + 0.5)) return count;
    int x0 = (int)left, y0 = (int)top;
    float fx = (float)(v.x - 0.5 - left), fy = (float)(v.y - 0.5 - top);
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            /* The outermost half pixel has no neighbour beyond it: it counts for both. */
            int x = x0 + i < 0 ? 0 : x0 + i < width ? x0 + i : width - 1;
            int y = y0 + j < 0 ? 0 : y0 + j < height ? y0 + j : height - 1;
            float w = weight * (i ? fx : 1 - fx) * (j ? fy : 1 - fy);
            taps[count++] = (struct tap){ ((size_t)y * (size_t)width + (size_t)x) * 4, w };
        }
    return count;
}

/* As many samples across as the pixel's footprint has view pixels: where a lens squeezes the view,
 * several fall into one photograph pixel. Samples further apart than 1.1 weigh view pixels unevenly. */
static int samples_across(double dx, double dy)
{
    double n = ceil(hypot(dx, dy) - 0.1);
    return n < 1 ? 1 : n > SAMPLES_MAX ? SAMPLES_MAX : (int)n;
}

static void fill_cell(const struct resampling *r, const struct cell *cell)
{
    int width = cell->x1 - cell->x0, height = cell->y1 - cell->y0;
    const struct vec2(*v)[2] = cell->v;
    int nx = samples_across((v[0][1].x - v[0][0].x) / width, (v[0][1].y - v[0][0].y) / width);
    int ny = samples_across((v[1][0].x - v[0][0].x) / height, (v[1][0].y - v[0][0].y) / height);
    float weight = 1 / (float)(nx * ny);
    struct tap taps[SAMPLES_MAX * SAMPLES_MAX * 4];
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            int count = 0;
            for (int j = 0; j < ny; j++)
                for (int i = 0; i < nx; i++)
                    count = add_taps(taps, count, cell_map(cell, (x + (i + 0.5) / nx) / width, (y + (j + 0.5) / ny) / height),
                                     weight, r->in->width_px, r->in->height_px);
            for (size_t k = 0; k < r->n; k++) {
                float sum[4] = { 0 };
                for (int t = 0; t < count; t++) {
                    const float *from = (const float *)r->in[k].data + taps[t].index;
                    for (int c = 0; c < 4; c++) sum[c] += taps[t].weight * from[c];
                }
                int column = cell->x0 + x - r->view->window_px.x0, row = cell->y0 + y - r->view->window_px.y0;
                memcpy(image_f32(&r->out[k], column, row), sum, sizeof sum);
            }
        }
}

static void resample_cell(const struct resampling *r, int x0, int y0, int x1, int y1)
{
    struct cell cell = { .x0 = x0, .y0 = y0, .x1 = x1, .y1 = y1 };
    struct vec2 node[3][3];
    bool seen = true;
    for (int j = 0; j < 3 && seen; j++)
        for (int i = 0; i < 3 && seen; i++) {
            struct error none = ERROR_NONE;
            struct vec2 q = { x0 + (x1 - x0) * i / 2.0, y0 + (y1 - y0) * j / 2.0 };
            seen = view_from_photograph(r->view, r->camera, &node[j][i], q, &none);
        }
    bool good = seen, single = x1 - x0 == 1 && y1 - y0 == 1;
    for (int i = 0; i < 4 && good; i++) cell.v[i / 2][i % 2] = node[i / 2 * 2][i % 2 * 2];
    for (int i = 0; i < 9 && good && !single; i++) {
        struct vec2 v = cell_map(&cell, i % 3 / 2.0, i / 3 / 2.0);
        good = hypot(v.x - node[i / 3][i % 3].x, v.y - node[i / 3][i % 3].y) <= MAP_TOLERANCE_PX;
    }
    if (good) {
        fill_cell(r, &cell);
    } else if (!single) {
        int xm = x0 + (x1 - x0 + 1) / 2, ym = y0 + (y1 - y0 + 1) / 2;
        resample_cell(r, x0, y0, xm, ym);
        if (xm < x1) resample_cell(r, xm, y0, x1, ym);
        if (ym < y1) resample_cell(r, x0, ym, xm, y1);
        if (xm < x1 && ym < y1) resample_cell(r, xm, ym, x1, y1);
    }
}

bool resample_view(struct image *out, const struct image *in, size_t n, const struct view *view,
                   const struct camera *camera, struct error *err)
{
    struct rect w = view->window_px;
    for (size_t k = 0; k < n; k++)
        if (!image_init(&out[k], w.x1 - w.x0, w.y1 - w.y0, 4, PIXEL_F32, err)) {
            while (k > 0) image_release(&out[--k]);
            return false;
        }
    if (view->aligned) {
        for (size_t k = 0; k < n; k++) memcpy(out[k].data, in[k].data, image_size(&out[k]));
        return true;
    }
    struct resampling r = { out, in, n, view, camera };
    for (int y = w.y0; y < w.y1; y += CELL_PX)
        for (int x = w.x0; x < w.x1; x += CELL_PX)
            resample_cell(&r, x, y, x + CELL_PX < w.x1 ? x + CELL_PX : w.x1, y + CELL_PX < w.y1 ? y + CELL_PX : w.y1);
    return true;
}

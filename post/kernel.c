#include "post/kernel.h"

#include <math.h>
#include <stdlib.h>

#define STEPS_PER_PX 4
#define STRIPS 128 /* that a pixel of a disc is integrated in */

static bool allocate(struct kernel *kernel, size_t capacity, struct error *err)
{
    *kernel = (struct kernel){ malloc(capacity * sizeof *kernel->taps), 0 };
    return kernel->taps || error_set(err, ERR_MEMORY, "no memory for the weights of a blur");
}

void kernel_release(struct kernel *kernel)
{
    free(kernel->taps);
    *kernel = (struct kernel){ 0 };
}

static void normalize(struct kernel *kernel)
{
    double sum = 0;
    for (size_t i = 0; i < kernel->count; i++) sum += (double)kernel->taps[i].weight;
    for (size_t i = 0; i < kernel->count; i++) kernel->taps[i].weight = (float)((double)kernel->taps[i].weight / sum);
}

/* Area of a disc round the origin within the pixel whose middle is (dx, dy). */
static double disc_in_pixel(double radius, int dx, int dy)
{
    double area = 0;
    for (int i = 0; i < STRIPS; i++) {
        double x = dx - 0.5 + (i + 0.5) / STRIPS, half = radius * radius - x * x;
        if (half <= 0) continue;
        half = sqrt(half);
        double low = fmax(dy - 0.5, -half), high = fmin(dy + 0.5, half);
        if (high > low) area += (high - low) / STRIPS;
    }
    return area;
}

bool kernel_disc(struct kernel *kernel, double diameter_px, struct error *err)
{
    double radius = fmax(diameter_px, 1) / 2;
    int reach = (int)ceil(radius - 0.5);
    if (!allocate(kernel, (size_t)(2 * reach + 1) * (size_t)(2 * reach + 1), err)) return false;
    for (int dy = -reach; dy <= reach; dy++)
        for (int dx = -reach; dx <= reach; dx++) {
            double area = disc_in_pixel(radius, dx, dy);
            if (area > 0) kernel->taps[kernel->count++] = (struct tap){ dx, dy, (float)area };
        }
    normalize(kernel);
    return true;
}

bool kernel_line(struct kernel *kernel, double dx_px, double dy_px, struct error *err)
{
    int steps = (int)fmax(1, ceil(STEPS_PER_PX * hypot(dx_px, dy_px)));
    if (!allocate(kernel, 4 * (size_t)steps, err)) return false;
    for (int i = 0; i < steps; i++) {
        double t = (i + 0.5) / steps - 0.5, x = t * dx_px, y = t * dy_px, left = floor(x), top = floor(y);
        for (int j = 0; j < 4; j++) {
            double w = (j % 2 ? x - left : 1 - (x - left)) * (j / 2 ? y - top : 1 - (y - top));
            if (w > 0) kernel->taps[kernel->count++] = (struct tap){ (int)left + j % 2, (int)top + j / 2, (float)w };
        }
    }
    normalize(kernel);
    return true;
}

void kernel_mean(float *mean, const struct kernel *kernel, const struct image *in, const struct image *share, int x, int y)
{
    float sum[4] = { 0 }, seen = 1;
    for (size_t i = 0; i < kernel->count; i++) {
        int px = x + kernel->taps[i].dx, py = y + kernel->taps[i].dy;
        if (px < 0 || py < 0 || px >= in->width_px || py >= in->height_px) continue;
        float w = kernel->taps[i].weight, part = w;
        if (share) {
            part = w * (float)*image_u8(share, px, py) / 255;
            seen -= w - part;
        }
        const float *from = image_f32(in, px, py);
        for (int c = 0; c < in->channels; c++) sum[c] += part * from[c];
    }
    for (int c = 0; c < in->channels; c++) mean[c] = seen > 1e-4f ? sum[c] / seen : 0;
}

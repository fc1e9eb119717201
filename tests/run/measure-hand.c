/* measure-hand PICTURE [MASK.png | X0,Y0,X1,Y1]...: edges and grain of all of a picture, and of those parts of it: what a mask
 * (instance/NNNNNN.png) has and 2 px round it, or a rectangle. Edges are post/edge.h's. Grain is what no plane makes of 3 x 3
 * pixels where it is flat, as the standard deviation of white noise that makes as much: of 32 levels each, where there
 * are a hundred such pixels. For the whole picture also what vignetting and highlights tell. */
#include "lib/rect.h"
#include "post/edge.h"
#include "post/flat.h"
#include "post/highlights.h"
#include "post/vignette.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NEAR_PX = 2, BANDS = 8, PIXELS_MIN = 100 };
#define FLAT_LEVELS 2.0 /* by how much the mean of 5 x 5 pixels may change in a pixel */

static double luma(const struct image *rgb, int x, int y)
{
    const uint8_t *p = image_u8(rgb, x, y);
    return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
}

static double mean_about(const struct image *rgb, int x, int y)
{
    double sum = 0;
    for (int k = 0; k < 25; k++) sum += luma(rgb, x + k % 5 - 2, y + k / 5 - 2) / 25;
    return sum;
}

static bool clips(const struct image *rgb, int x, int y)
{
    for (int k = 0; k < 9; k++)
        for (int c = 0; c < 3; c++) {
            int v = image_u8(rgb, x + k % 3 - 1, y + k / 3 - 1)[c];
            if (v == 0 || v == 255) return true;
        }
    return false;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_grain(const struct image *rgb, const struct image *only)
{
    static const int weight[3] = { 1, -2, 1 };
    size_t room = (size_t)rgb->width_px * (size_t)rgb->height_px, n[BANDS] = { 0 };
    double *values = malloc(BANDS * room * sizeof *values);
    if (!values) exit(1);
    for (int y = 3; y < rgb->height_px - 3; y++)
        for (int x = 3; x < rgb->width_px - 3; x++) {
            if (!*image_u8(only, x, y) || clips(rgb, x, y)) continue;
            double right = mean_about(rgb, x + 1, y) - mean_about(rgb, x - 1, y), down = mean_about(rgb, x, y + 1) - mean_about(rgb, x, y - 1);
            if (hypot(right, down) / 2 > FLAT_LEVELS) continue;
            double sum = 0;
            for (int k = 0; k < 9; k++) sum += weight[k % 3] * weight[k / 3] * luma(rgb, x + k % 3 - 1, y + k / 3 - 1) / 6;
            int band = (int)(mean_about(rgb, x, y) * BANDS / 256);
            values[(size_t)band * room + n[band]++] = fabs(sum);
        }
    printf("  grain");
    for (int b = 0; b < BANDS; b++) {
        double *at = values + (size_t)b * room;
        qsort(at, n[b], sizeof *at, ascending);
        if (n[b] >= PIXELS_MIN) printf("  %d: %.2f (%zu)", 256 / BANDS * b + 128 / BANDS, 1.4826 * at[n[b] / 2], n[b]);
    }
    printf("\n");
    free(values);
}

static bool take_part(struct image *only, const char *what, struct error *err)
{
    struct image mask;
    struct rect r;
    if (sscanf(what, "%d,%d,%d,%d", &r.x0, &r.y0, &r.x1, &r.y1) == 4) {
        r = rect_intersect(r, (struct rect){ 0, 0, only->width_px, only->height_px });
        for (int y = r.y0; y < r.y1; y++) memset(image_u8(only, r.x0, y), 1, (size_t)(r.x1 - r.x0));
        return true;
    }
    if (!image_read(&mask, what, err)) return false;
    if (mask.type != PIXEL_U16 || mask.channels != 1 || mask.width_px != only->width_px || mask.height_px != only->height_px)
        return error_at(err, ERR_INPUT, what, 0, 0, "is no mask of 16 bit and of the picture's size");
    for (int y = NEAR_PX; y < only->height_px - NEAR_PX; y++)
        for (int x = NEAR_PX; x < only->width_px - NEAR_PX; x++)
            for (int k = 0; k < 25; k++)
                if (*image_u16(&mask, x + k % 5 - NEAR_PX, y + k / 5 - NEAR_PX)) *image_u8(only, x, y) = 1;
    image_release(&mask);
    return true;
}

static bool print_part(const struct image *rgb, const char *what, struct error *err)
{
    struct image only;
    struct edges e;
    if (!image_init(&only, rgb->width_px, rgb->height_px, 1, PIXEL_U8, err)) return false;
    if (!what) memset(only.data, 1, image_size(&only));
    else if (!take_part(&only, what, err)) return false;
    if (!edges_measure(&e, rgb, &only, err)) return false;
    printf("%s\n  edges %zu  sharp %.2f px, quartiles %.2f %.2f %.2f px  sharpened by %.2f (%zu: %.2f %.2f %.2f)\n", what ? what : "all", e.count, e.sharp_px, e.sigma_px[0],
           e.sigma_px[1], e.sigma_px[2], e.sharpening, e.telling, e.sharpening_quartiles[0], e.sharpening_quartiles[1], e.sharpening_quartiles[2]);
    print_grain(rgb, &only);
    image_release(&only);
    return true;
}

static bool print_whole(const struct image *rgb, struct error *err)
{
    struct flat_patches patches;
    struct vignette v;
    struct highlights h;
    if (!print_part(rgb, NULL, err) || !flat_patches_find(&patches, rgb, err)) return false;
    vignette_measure(&v, &patches, rgb->width_px, rgb->height_px);
    highlights_measure(&h, rgb);
    flat_patches_release(&patches);
    printf("  vignetting %.3f %s (quarters %.3f %.3f %.3f %.3f)\n", v.fall_off, v.agree ? "agreed" : "not agreed", v.quarter[0], v.quarter[1],
           v.quarter[2], v.quarter[3]);
    printf("  highlights knee %.2f %s (misfit %.3f)\n", h.knee, h.told ? "told" : "not told", h.misfit);
    return true;
}

int main(int argc, char **argv)
{
    struct error err = ERROR_NONE;
    struct image rgb;
    if (argc < 2) return 2;
    bool ok = image_read(&rgb, argv[1], &err) && print_whole(&rgb, &err);
    for (int i = 2; ok && i < argc; i++) ok = print_part(&rgb, argv[i], &err);
    if (!ok) error_print(&err, "measure-hand");
    else image_release(&rgb);
    return !ok;
}

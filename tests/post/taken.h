/* Photographs made up with a known camera: for checks of what is measured on them. */
#ifndef STAFFAGE_TESTS_POST_TAKEN_H
#define STAFFAGE_TESTS_POST_TAKEN_H

#include "lib/draw.h"
#include "lib/image.h"

#include <math.h>
#include <stdlib.h>

/* An 8-bit picture of one grey; ends the program where there is no memory. */
__attribute__((unused))
static struct image grey(int width, int height, int level)
{
    struct image image;
    struct error err = ERROR_NONE;
    if (!image_init(&image, width, height, 3, PIXEL_U8, &err)) exit(99);
    for (size_t i = 0; i < image_size(&image); i++) ((uint8_t *)image.data)[i] = (uint8_t)level;
    return image;
}

/* Standard normal, by the test's own generator: not the one that is tested. */
__attribute__((unused))
static double noise(void)
{
    double sum = 0;
    for (int i = 0; i < 12; i++) sum += rand() / (RAND_MAX + 1.0);
    return sum - 6;
}

__attribute__((unused))
static uint8_t byte(double level)
{
    return (uint8_t)fmin(fmax(floor(level + 0.5), 0), 255);
}

__attribute__((unused))
static uint8_t srgb_byte(double linear)
{
    return byte(255 * (double)srgb_from_linear((float)fmin(fmax(linear, 0), 1)));
}

/* Adds to a picture (F32, 3 channels) a part of what it differs by from itself blurred by a Gaussian of 1 px. */
__attribute__((unused))
static void camera_sharpens(struct image *levels, double amount)
{
    struct image own = *levels;
    struct error err = ERROR_NONE;
    if (!image_init(levels, own.width_px, own.height_px, 3, PIXEL_F32, &err)) exit(99);
    for (int y = 0; y < own.height_px; y++)
        for (int x = 0; x < own.width_px; x++)
            for (int c = 0; c < 3; c++) {
                double mean = 0, all = 0, here = (double)image_f32(&own, x, y)[c];
                for (int dy = -4; dy <= 4; dy++)
                    for (int dx = -4; dx <= 4; dx++) {
                        if (x + dx < 0 || y + dy < 0 || x + dx >= own.width_px || y + dy >= own.height_px) continue;
                        double w = exp(-(dx * dx + dy * dy) / 2.0);
                        mean += w * (double)image_f32(&own, x + dx, y + dy)[c];
                        all += w;
                    }
                image_f32(levels, x, y)[c] = (float)(here + amount * (here - mean / all));
            }
    image_release(&own);
}

#endif

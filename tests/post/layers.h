/* Layers for checks of what air and lens do: an entity, its light on the ground, and sums over them. */
#ifndef STAFFAGE_TESTS_POST_LAYERS_H
#define STAFFAGE_TESTS_POST_LAYERS_H

#include "lib/image.h"

#include <stdlib.h>
#include <string.h>

/* An image of one value; ends the program where there is no memory. */
__attribute__((unused))
static struct image filled(int width, int height, int channels, float value)
{
    struct image image;
    struct error err = ERROR_NONE;
    if (!image_init(&image, width, height, channels, PIXEL_F32, &err)) exit(99);
    for (size_t i = 0; i < image_size(&image) / sizeof value; i++) ((float *)image.data)[i] = value;
    return image;
}

/* Set every channel in columns x0 to x1 - 1 of all rows from y0 to y1 - 1. */
__attribute__((unused))
static void fill(struct image *image, int x0, int y0, int x1, int y1, const float *values)
{
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++) memcpy(image_f32(image, x, y), values, (size_t)image->channels * sizeof *values);
}

__attribute__((unused))
static double sum_of(const struct image *image, int channel)
{
    double sum = 0;
    for (int y = 0; y < image->height_px; y++)
        for (int x = 0; x < image->width_px; x++) sum += (double)image_f32(image, x, y)[channel];
    return sum;
}

/* Second moment of a channel about column x0, over its sum. */
__attribute__((unused))
static double variance_of(const struct image *image, int channel, int x0)
{
    double moment = 0;
    for (int y = 0; y < image->height_px; y++)
        for (int x = 0; x < image->width_px; x++)
            moment += (double)image_f32(image, x, y)[channel] * (x - x0) * (x - x0);
    return moment / sum_of(image, channel);
}

/* A U8 image of 255, and 0 in columns x0 to x1 - 1. */
__attribute__((unused))
static struct image hidden_between(int width, int height, int x0, int x1)
{
    struct image image;
    struct error err = ERROR_NONE;
    if (!image_init(&image, width, height, 1, PIXEL_U8, &err)) exit(99);
    memset(image.data, 255, image_size(&image));
    for (int y = 0; y < height; y++)
        for (int x = x0; x < x1; x++) *image_u8(&image, x, y) = 0;
    return image;
}

#endif

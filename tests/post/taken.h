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

#endif

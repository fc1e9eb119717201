/* Cameras over ground, and pictures drawn by hand, for the tests of what looks at pictures. */
#ifndef STAFFAGE_TESTS_GEN_VIEW_ABOVE_H
#define STAFFAGE_TESTS_GEN_VIEW_ABOVE_H

#include "lib/camera.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdint.h>

/* A camera that looks from eye at a target, its right side level. */
__attribute__((unused))
static struct pose looking(struct vec3 eye, struct vec3 target)
{
    struct vec3 ahead = vec3_unit(vec3_sub(target, eye)), right = vec3_unit(vec3_cross(ahead, vec3(0, 0, 1)));
    return (struct pose){ mat3_from_columns(right, vec3_cross(ahead, right), ahead), eye };
}

/* Linear colours as the pixels of a rectangle. */
__attribute__((unused))
static void fill_px(struct image *picture, int x0, int y0, int x1, int y1, double r, double g, double b)
{
    uint8_t rgb[3] = { (uint8_t)(srgb_from_linear((float)r) * 255 + 0.5f), (uint8_t)(srgb_from_linear((float)g) * 255 + 0.5f),
                       (uint8_t)(srgb_from_linear((float)b) * 255 + 0.5f) };
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            for (int c = 0; c < 3; c++) image_u8(picture, x, y)[c] = rgb[c];
}

#endif

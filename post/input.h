/* The images that a frame is put together from, each checked as it is read. */
#ifndef STAFFAGE_POST_INPUT_H
#define STAFFAGE_POST_INPUT_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* An image of known size, channels and type.
 * Err: ERR_INPUT at `path`: missing, truncated, or other than wanted */
bool input_image(struct image *image, const char *path, int width_px, int height_px, int channels,
                 enum pixel_type type, struct error *err);

/* A pass of POV-Ray: F32 RGBA, linear, premultiplied. Alpha is held to [0, 1]; what
 * overflowed the file's half floats becomes their largest value.
 * Err: as input_image; ERR_RENDER at `path` for a pixel that is not a number */
bool input_pass(struct image *pass, const char *path, int width_px, int height_px, struct error *err);

/* The photograph as sRGB, 8 bits, 3 channels, at the size of the result. One that has these
 * already keeps every bit; any other is converted, and scaled, in linear light.
 * Err: ERR_INPUT at `path`: missing, truncated, float, or of another aspect ratio */
bool input_photograph(struct image *rgb, const char *path, int width_px, int height_px, struct error *err);

#endif

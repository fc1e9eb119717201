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

/* An image as it is stored, whose values cannot be mixed. One of another size, but in proportion, is
 * brought to the wanted one by taking the pixel under each pixel's centre.
 * Err: ERR_INPUT at `path`: missing, truncated, or of another aspect ratio */
bool input_nearest(struct image *image, const char *path, int width_px, int height_px, struct error *err);

/* A pass of POV-Ray: F32 RGBA, linear, premultiplied. Alpha is held to [0, 1]; what
 * overflowed the file's half floats becomes their largest value.
 * Err: as input_image; ERR_RENDER at `path` for a pixel that is not a number */
bool input_pass(struct image *pass, const char *path, int width_px, int height_px, struct error *err);

#endif

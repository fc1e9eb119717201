/* The photograph of a frame, as everything that works with it sees it. */
#ifndef STAFFAGE_LIB_PHOTOGRAPH_H
#define STAFFAGE_LIB_PHOTOGRAPH_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* The photograph as sRGB, 8 bits, 3 channels, at the size of the result. One that has these
 * already keeps every bit; any other is converted, and scaled, in linear light.
 * Err: ERR_INPUT at `path`: missing, truncated, float, or of another aspect ratio */
bool photograph_read(struct image *rgb, const char *path, int width_px, int height_px, struct error *err);

/* Is an image of the shape that is wanted, its height within a pixel?
 * Err: ERR_INPUT at `path` when it is not */
bool photograph_in_proportion(const struct image *image, const char *path, int width_px, int height_px, struct error *err);

/* Has an image 8 or 16 bits a channel, as photographs have?
 * Err: ERR_INPUT at `path` when it has not */
bool photograph_is_of_integers(const struct image *image, const char *path, struct error *err);

#endif

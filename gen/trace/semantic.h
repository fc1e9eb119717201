/* Semantic images that are given: class colours or ids of a palette. */
#ifndef STAFFAGE_GEN_SEMANTIC_H
#define STAFFAGE_GEN_SEMANTIC_H

#include "lib/class.h"
#include "lib/error.h"
#include "lib/image.h"

#define SEMANTIC_VOID 255 /* in an image of ids: nobody knows */

/* Out: ids  U8 1 of the palette, initialized here
 * Err: ERR_INPUT at path: no 8 bit image of 1, 3 or 4 channels, or a colour or an id that the palette has not */
bool semantic_read(struct image *ids, const char *path, enum palette palette, struct error *err);

#endif

/* What JPEG did to a photograph, done to what is put in. */
#ifndef STAFFAGE_POST_COMPRESSION_H
#define STAFFAGE_POST_COMPRESSION_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/rect.h"

#include <stdbool.h>
#include <stdint.h>

struct compression {
    bool found;                 /* false: no JPEG, or one of other colours than grey and YCbCr */
    int width_px, height_px;    /* of the stored picture */
    int components;             /* 1 or 3 */
    int across[3], down[3];     /* sampling factors */
    uint16_t table[3][64];      /* quantisation tables */
};

/* Out: `found` is false for a file that is no JPEG.
 * Err: ERR_INPUT at `path` when it cannot be read, or its head is damaged */
bool compression_read(struct compression *compression, const char *path, struct error *err);

/* Compress a window by the photograph's own tables, on its own grid of blocks, and decompress it.
 * In/out: rgb (U8, 3 channels), a picture of the stored one's size: within the window only
 * Err: ERR_MEMORY */
bool compression_apply(struct image *rgb, struct rect window_px, const struct compression *compression, struct error *err);

#endif

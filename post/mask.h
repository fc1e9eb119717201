/* Paper A's mask rule: the index image, dilated, where the alpha mask has anything.
 * It widens a mask that knows only pixel centres to the soft edges of the picture. */
#ifndef STAFFAGE_POST_MASK_H
#define STAFFAGE_POST_MASK_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/view.h"

#include <stdbool.h>

/* In/out: ids    (U16, whole picture) changed inside the window only; an id gives way to no other id
 * In:     object (F32 RGBA) and visible (U8, or NULL), of the window
 * Src:    Static Mesh Enrichment with Dynamic Entities, IV.E */
bool mask_dilate(struct image *ids, const struct image *object, const struct image *visible,
                 struct rect window_px, struct error *err);

#endif

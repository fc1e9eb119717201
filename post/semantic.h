/* What each pixel is: from ids of entities to classes, their ids and their colours. */
#ifndef STAFFAGE_POST_SEMANTIC_H
#define STAFFAGE_POST_SEMANTIC_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/manifest.h"

#include <stdbool.h>

/* Out: classes (U8): 0 where no entity is, else 1 + enum entity_class; initialized here
 * In:  instance (U16)
 * Err: ERR_INPUT for an id that the manifest does not name */
bool semantic_classes(struct image *classes, const struct image *instance, const struct manifest *manifest,
                      struct error *err);

/* The dataset's pictures of them: what the frame had before, overwritten where an entity is. Nothing
 * else changes in the form that `before` has; the other form is made from it by the palette, in which a
 * colour that the palette lacks gets id 0, and an id that it lacks black.
 * Out: color (U8; 4 channels when `before` has 4, else 3), ids (U8, 1 channel), initialized here
 * In:  before (U8): 1 channel, ids; 3 or 4, colours; or empty: black and 0 */
bool semantic_color(struct image *color, const struct image *classes, const struct image *before, enum palette palette,
                    struct error *err);
bool semantic_ids(struct image *ids, const struct image *classes, const struct image *before, enum palette palette,
                  struct error *err);

/* The id of a colour: of one of the palette's labels, or of an entity in it; -1 for any other. */
int semantic_id_of_color(enum palette palette, const uint8_t color[3]);

#endif

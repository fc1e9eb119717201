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

/* The dataset's pictures of them; black and 0 where no entity is.
 * Out: color (U8, 3 channels), ids (U8, 1 channel), initialized here */
bool semantic_color(struct image *color, const struct image *classes, struct error *err);
bool semantic_ids(struct image *ids, const struct image *classes, struct error *err);

#endif

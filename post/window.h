/* Windows of an image: the part of the photograph in which anything changes. */
#ifndef STAFFAGE_POST_WINDOW_H
#define STAFFAGE_POST_WINDOW_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/view.h"

#include <stdbool.h>

/* Not empty, and nowhere outside a picture of this size. */
bool window_inside(struct rect window_px, int width_px, int height_px);

/* Copy a window, which must lie inside. Out: initialized here. */
bool window_cut(struct image *out, const struct image *in, struct rect window_px, struct error *err);

#endif

/* From the pinhole view that POV-Ray rendered to the photograph's own pixels. */
#ifndef STAFFAGE_POST_RESAMPLE_H
#define STAFFAGE_POST_RESAMPLE_H

#include "lib/camera.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/view.h"

#include <stdbool.h>
#include <stddef.h>

/* Resample the layers of a view, in linear light, all by the same weights: where two layers
 * are equal they stay equal bit for bit. A pixel is the mean of the view over its footprint
 * there; what the view does not show comes out as 0 in every channel.
 * Out: out (n) F32, 4 channels, of the size of view->window_px, initialized here
 * In:  in (n) F32, 4 channels, of the size of the view
 * Err: ERR_MEMORY; outputs are empty on failure */
bool resample_view(struct image *out, const struct image *in, size_t n, const struct view *view,
                   const struct camera *camera, struct error *err);

#endif

/* A new colour for a body whose old one is painted into its texture. */
#ifndef STAFFAGE_GEN_PAINT_H
#define STAFFAGE_GEN_PAINT_H

#include "gen/model/model.h"
#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

/* Repaint pixels, linear RGB, in place. What is body is told by the texture's alpha channel where
 * an opaque material has one of two values (vehicle models mark their paint so); else it is the
 * colour that covers most of the surface, with its lighter and darker shades. Shading stays: a
 * texel gets paint times its brightness relative to that of lit body.
 * In/out: linear  (F32, 3 channels)
 * In:  texture    what linear was made of (U8, 3 or 4 channels, same size)
 *      paint      linear, 0..1
 * Err: ERR_MEMORY; linear untouched */
bool paint_body(struct image *linear, const struct image *texture, const struct model *model, size_t material,
                const double paint[3], struct error *err);

#endif

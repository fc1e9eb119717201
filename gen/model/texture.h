/* The image files that POV-Ray maps onto materials. Their names come from their
 * content, so that what is the same is written once, and no string of a model's
 * gets into a name. */
#ifndef STAFFAGE_GEN_TEXTURE_H
#define STAFFAGE_GEN_TEXTURE_H

#include "gen/model/model.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

#define TEXTURE_NAME_SIZE 32

/* Write the texture of a material that has one (base_image.data) as an 8 bit sRGB PNG, with
 * the material's base_color, alpha and transmission baked in: the scene multiplies nothing any
 * more. An alpha channel is written only where the material is not opaque, for POV-Ray pays for it
 * with every shadow ray (and for MASK holds 0 or 255 only).
 * Out: name        file name in `folder`: "t" and 16 hex digits and ".png"
 *      has_alpha   the file has 4 channels
 * In:  paint       linear, or NULL: replaces the body colour of a FINISH_PAINT material; shading,
 *                  windows, lights, plates and tyres that are painted into the texture stay
 *      folder      made when it is not there
 *      max_px      larger textures are scaled down to this longest side; 0: as they are
 * Err: ERR_IO */
bool texture_write(char name[TEXTURE_NAME_SIZE], bool *has_alpha, const struct model *model, size_t material,
                   const double paint[3], const char *folder, int max_px, struct error *err);

#endif

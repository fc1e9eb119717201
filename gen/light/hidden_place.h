/* What stands round the entities and is hidden from the point that the panorama is seen from: mirrors elsewhere may meet it. It
 * has the place's own colours, one to a face. Src: layered depth images, Shade and others 1998: what a picture hides is kept
 * behind it. */
#ifndef STAFFAGE_GEN_HIDDEN_PLACE_H
#define STAFFAGE_GEN_HIDDEN_PLACE_H

#include "gen/light/relief.h"
#include "lib/error.h"
#include "lib/image.h"

/* As far from an entity; what stands farther is seen by all round it nearly alike. */
#define HIDDEN_PLACE_REACH_M 20.0

struct hidden_place {
    struct static_cut part;   /* without colours */
    struct image radiance;    /* F32, 3 channels: a texel to each triangle, HIDDEN_PLACE_COLUMNS to a row; at least one */
};
enum { HIDDEN_PLACE_COLUMNS = 256 };

/* In:  in as the relief's; color_gain radiance for a unit of the place's own linear colours
 * Out: *hidden, initialized here; free with hidden_place_release
 * Err: ERR_MEMORY */
bool hidden_place_create(struct hidden_place *hidden, const struct relief_input *in, const double color_gain[3], struct error *err);
void hidden_place_release(struct hidden_place *hidden);

#endif

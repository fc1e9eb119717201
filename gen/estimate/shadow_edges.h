/* Edges on the ground of a photograph with an even surface on either side: shadows, and all else that has edges. */
#ifndef STAFFAGE_GEN_SHADOW_EDGES_H
#define STAFFAGE_GEN_SHADOW_EDGES_H

#include "gen/estimate/ground_view.h"
#include "gen/estimate/tones.h"
#include "lib/error.h"

#include <stddef.h>

struct shadow_edge {
    float ln[3];               /* of the darker side over the brighter one */
    float lit[3];              /* ln of the brighter side */
    int16_t lit_px[2], shade_px[2]; /* working pixels */
};

/* Every working pixel with an edge through it, seen across the direction of most contrast. The sides are taken 5 to 9
 * working pixels away from it, beyond penumbra and blur; where they are not even there, 3 to 5: thin shadows.
 * Out: *edges, the caller's (free)
 * Err: ERR_MEMORY */
bool shadow_edges_find(struct shadow_edge **edges, size_t *n, const struct tones *tones, const struct ground_view *view,
                       struct error *err);

#endif

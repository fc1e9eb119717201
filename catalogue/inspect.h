/* What the surface of a model is like. */
#ifndef STAFFAGE_CATALOGUE_INSPECT_H
#define STAFFAGE_CATALOGUE_INSPECT_H

#include "gen/model/model.h"
#include "lib/error.h"

#include <stddef.h>

struct inspection {
    size_t triangles, edges;
    double open_share;           /* of the edges: they end one face only */
    double inward_share;         /* of the area that is seen from outside: its front looks inward */
    double contact_length, contact_width; /* share of its length and width over which it touches the ground */
    int largest_texture_px;      /* longest side; 0: none */
};

/* In:  model   as loaded: it stands on the ground
 * Err: ERR_MEMORY */
bool inspect_model(struct inspection *out, const struct model *model, struct error *err);

#endif

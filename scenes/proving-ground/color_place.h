/* The colours of the reconstruction's vertices. */
#ifndef STAFFAGE_PROVING_COLOR_PLACE_H
#define STAFFAGE_PROVING_COLOR_PLACE_H

#include "cases.h"
#include "lib/image.h"
#include "place_heights.h"
#include "place_mesh.h"

struct place_views {
    const struct place_heights *heights;
    const struct image *map;        /* (PROVING_MAP_VIEWS) F32 radiance, of the mapping flight */
    const struct image *photographs; /* (c->shot_count) U8 3 where c->flies; else NULL */
    const struct proving_case *c;
    const struct camera *camera;    /* of the photographs */
};

/* The mean of the flight's own photographs that see a vertex; else as the view of the mapping flight that looks at it most
 * squarely, at the case's exposure; what none sees is as what lies next to it.
 * In/out: mesh, gets colors */
bool color_place(struct place_mesh *mesh, const struct place_views *views, struct error *err);

#endif

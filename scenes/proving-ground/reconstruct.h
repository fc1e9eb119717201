/* The place as a reconstruction would have it: the street's heights in cells, off by centimetres in smooth waves, without
 * what is thin, in the colours of a mapping flight (map_flight.h), and of the photographs that were flown. */
#ifndef STAFFAGE_PROVING_RECONSTRUCT_H
#define STAFFAGE_PROVING_RECONSTRUCT_H

#include "cases.h"
#include "lib/image.h"

#define PROVING_MESH_EDGE_M 1.0     /* the longest edge */

/* Write a PLY.
 * In: heights (U16), of write_pov's picture; map (PROVING_MAP_VIEWS) F32, its pictures of the mapping flight; photographs
 *     (c->shot_count) U8 3, of camera, where c->flies, else NULL */
bool reconstruct(const char *path, const struct image *heights, const struct image *map, const struct image *photographs,
                 const struct proving_case *c, const struct camera *camera, struct error *err);

#endif

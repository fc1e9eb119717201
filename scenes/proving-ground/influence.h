/* Where entities change the light that can be told from the noise of radiosity. */
#ifndef STAFFAGE_PROVING_INFLUENCE_H
#define STAFFAGE_PROVING_INFLUENCE_H

#include "cases.h"
#include "lib/image.h"
#include "pinhole.h"

/* Radiosity of two scenes differs by several per cent in foliage, on walls in shade and below parked cars, whatever entities
 * do. So the truth keeps its own light on entities, within REACH of them, and on all open ground; elsewhere it gets the
 * photograph's.
 * In:  truth, photograph radiance (F32, 3 or 4 channels) of the pinhole's pixels; range (U16, PROVING_RANGE_M) of the truth */
bool influence_limit(struct image *truth, const struct image *photograph, const struct image *range, const struct pinhole *pinhole,
                     const struct proving_case *c, size_t shot, struct error *err);

#endif

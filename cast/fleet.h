/* The vehicles of the cast, written and listed. */
#ifndef STAFFAGE_CAST_FLEET_H
#define STAFFAGE_CAST_FLEET_H

#include "cast/listing.h"
#include "cast/vehicle.h"

int fleet_count(void);
const struct vehicle_spec *fleet_vehicle(int i);
/* Three levels of detail of it, into a folder. */
bool write_listed_vehicle(struct listing *listing, const struct vehicle_spec *v, const char *folder, struct error *err);

#endif

/* The vehicles of the cast, written and listed. */
#ifndef STAFFAGE_CAST_FLEET_H
#define STAFFAGE_CAST_FLEET_H

#include "cast/listing.h"

/* Three levels of detail of each, into a folder. */
bool write_fleet(struct listing *listing, const char *folder, struct error *err);

#endif

/* Makes models of the cast, one a core at a time, and the catalogue that lists them. */
#ifndef STAFFAGE_CAST_WORKSHOP_H
#define STAFFAGE_CAST_WORKSHOP_H

#include "lib/error.h"

#include <stdbool.h>

/* In:  name  (names) of the models to make; none: all. The catalogue lists what is made, in the cast's own order.
 * Err: ERR_INPUT for a name that nobody has, ERR_IO, ERR_MEMORY */
bool workshop_run(const char *folder, const char *const *name, int names, struct error *err);

#endif

/* What a user outlines in the photographs because the place that the tool is given lacks it. */
#ifndef STAFFAGE_PROVING_WRITE_OUTLINES_H
#define STAFFAGE_PROVING_WRITE_OUTLINES_H

#include "cases.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stdio.h>

/* Write the scene file's `occluders`: of a fixed camera the lamp post and the parked cars, on a plane the post's
 * trunk alone; of a flight the whole lamp post, in each shot that sees its foot from less than 60 deg above.
 * In: camera at the size of the photographs */
bool write_outlines(FILE *f, const struct proving_case *c, const struct camera *camera, struct error *err);

#endif

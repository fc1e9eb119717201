/* Which end of a vehicle, a person or an animal is its front: by names of materials, by its shape, by its lights. */
#ifndef STAFFAGE_CATALOGUE_FRONT_H
#define STAFFAGE_CATALOGUE_FRONT_H

#include "gen/model/model.h"

#include <stdbool.h>

/* In:  model  in the file's axes, in any unit
 *      along  the axis, 0 to 2, that the front lies on, at either end
 * Out: by     what tells most: "names of lights", "the feet", "the height of its ends", "red lights", "the cabin", "nothing"
 * Returns how many times likelier the positive end is the front. */
double front_odds(const char **by, const struct model *model, enum axis up, int along, bool is_person);

/* Of a person: how many times likelier it looks along that axis, one way or the other, than aside, by its feet. */
double front_line_odds(const struct model *model, enum axis up, int along);

#endif

/* How much more or less light the ground has under the entities: what the plane and shadow passes
 * say together, in a form that can be blurred and faded. */
#ifndef STAFFAGE_POST_GROUND_LIGHT_H
#define STAFFAGE_POST_GROUND_LIGHT_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* Out: light (F32, 3 channels), initialized here: transfer_ground - 1, so -0.4 is 40 % less, 0 no change
 * In:  plane, shadow (F32 RGBA) */
bool ground_light_take(struct image *light, const struct image *plane, const struct image *shadow, struct error *err);

/* Make the passes say this instead. Where there is no change, shadow becomes plane.
 * In/out: plane keeps its radiance; where it does not cover a pixel that has light or shade now, it is extended to
 * In:  photograph (F32, 3 channels, linear) over exposure: the radiance of ground that plane does not cover */
void ground_light_put(struct image *plane, struct image *shadow, const struct image *light, const struct image *photograph,
                      const double exposure[3]);

#endif

/* The parts of the ground where an entity can change the light: what the plane and
 * shadow passes render, and nothing beyond. */
#ifndef STAFFAGE_GEN_RECEIVER_H
#define STAFFAGE_GEN_RECEIVER_H

#include "gen/world/entity.h"
#include "gen/world/ground.h"
#include "gen/light/light.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

/* A convex polygon on the ground, counter-clockwise from above. */
struct receiver {
    struct vec3 *corner_m; /* (corners) world; owned */
    size_t corners;
    double fade_m;         /* towards its edge the shade fades over so much */
};

/* The ground around an entity as far as it takes away more than about a hundredth of the light
 * (3.2 times its height where only the sky lights it), together with its shadow in the sun.
 * In:  shaded: something keeps the sun from part of that ground; eye_m: sees the entity mirrored in it as well; NULL: it is dry
 * Err: ERR_MEMORY */
bool receiver_create(struct receiver *receiver, const struct entity *entity, const struct plane *ground,
                     const struct light *light, bool shaded, const struct vec3 *eye_m, struct error *err);
void receiver_release(struct receiver *receiver);
/* Is a ground point within it, seen from above? */
bool receiver_contains(const struct receiver *receiver, struct vec3 p_m);
/* How far it is, seen from above, from a ground point within it to its edge, along a level direction (unit); 0 from beyond. */
double receiver_reach(const struct receiver *receiver, struct vec3 p_m, struct vec2 direction);
/* How much of the shade counts at a ground point: 0 at the edge and beyond, 1 from fade_m inside, smooth between. */
double receiver_share(const struct receiver *receiver, struct vec3 p_m);

#endif

/* The parts of the static mesh that matter to entities: what can take their shadows, and what can shade them. */
#ifndef STAFFAGE_GEN_SURROUNDINGS_H
#define STAFFAGE_GEN_SURROUNDINGS_H

#include "gen/light/light.h"
#include "gen/world/entity.h"
#include "gen/world/receiver.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

struct surroundings {
    struct prism *receivers;  /* (n) upright, one an entity */
    struct prism *shades;     /* (shade_count) upright and towards the sun */
    size_t n, shade_count;
    struct vec2 *corner_m;    /* of all prisms */
};

/* In:  receivers (n) as receiver_create made them for entities (n); top_m: the highest point of the mesh */
bool surroundings_create(struct surroundings *surroundings, const struct receiver *receivers,
                         const struct entity *entities, size_t n, const struct light *light, double top_m,
                         struct error *err);
void surroundings_release(struct surroundings *surroundings);

#endif

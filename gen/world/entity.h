/* An entity: a model of a class at a place. */
#ifndef STAFFAGE_GEN_ENTITY_H
#define STAFFAGE_GEN_ENTITY_H

#include "gen/world/ground.h"
#include "gen/model/model.h"
#include "lib/class.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stdint.h>

struct entity {
    uint16_t id;                  /* from 1, stable over a sequence */
    const char *name;             /* borrowed from the scene */
    const char *model_name;       /* borrowed from the scene */
    enum entity_class class_;
    const struct model *model;    /* borrowed */
    struct pose world_from_entity;
    bool has_color;
    double color[3];              /* linear; paints the model's FINISH_PAINT materials */
};

/* Stand upright on the ground: z along the plane's normal, x turned to the heading
 * (radians clockwise from north = +y, measured in the horizontal, projected onto the plane).
 * at_m is moved straight up or down onto the plane: its z does not matter. */
struct pose entity_stand(const struct plane *ground, struct vec3 at_m, double heading_rad);

/* Do the oriented boxes of two entities intersect by more than tolerance_m? (Separating axes.)
 * Src: Gottschalk, Lin, Manocha 1996, OBBTree, 15 axes. */
bool entities_intersect(const struct entity *a, const struct entity *b, double tolerance_m);

/* The 8 corners of the box, world, metres: x slowest, then y, then z; each min then max. */
void entity_corners(struct vec3 corners_m[8], const struct entity *entity);

#endif

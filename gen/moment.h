/* Who is on stage at a moment, where and in which pose. */
#ifndef STAFFAGE_GEN_MOMENT_H
#define STAFFAGE_GEN_MOMENT_H

#include "gen/model/model.h"
#include "gen/stage.h"
#include "gen/world/entity.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

#define MOVER_NAME_SIZE 24
struct moment {
    struct entity *entities;     /* (n) those of the scene first, then the traffic, by id */
    size_t *model_index;         /* (n) into scene->models */
    struct vec3 *velocity_m_s;   /* (n) world */
    size_t n;
    struct model *posed;         /* (posed_count) rigged models as they are at this moment */
    size_t posed_count;
    char (*names)[MOVER_NAME_SIZE]; /* of the traffic */
};

/* Who is on stage, and how, at a time of the scene.
 * Out: moment, initialized here; release it before the stage
 * Err: ERR_INPUT at the scene: an entity's path leaves the mesh */
bool moment_at(struct moment *moment, const struct stage *stage, double time_s, struct error *err);
void moment_release(struct moment *moment);

#endif

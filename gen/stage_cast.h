/* Who is on the stage: which model each entity is, and what was loaded of them. Parts of stage_create. */
#ifndef STAFFAGE_GEN_STAGE_CAST_H
#define STAFFAGE_GEN_STAGE_CAST_H

#include "gen/stage.h"

/* Draw who is which model, where the scene leaves a choice. Out: stage->cast, hash */
void stage_cast_entities(struct stage *stage);

/* Load what entities and traffic use, in the detail chosen. Out: stage->models, repertoires, warnings, hash
 * Err: ERR_INPUT, ERR_IO at a model's file; ERR_MEMORY */
bool stage_load_models(struct stage *stage, const struct material_rules *rules, struct error *err);

#endif

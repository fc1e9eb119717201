/* How finely each model of a scene is needed. */
#ifndef STAFFAGE_GEN_DETAIL_H
#define STAFFAGE_GEN_DETAIL_H

#include "gen/model/catalogue.h"
#include "gen/stage.h"

/* What a metre of a model must be in the picture, at least, for it to be shown in this detail: px. */
extern const double detail_least_px_m[DETAIL_COUNT];

/* By how large a metre of any of those who are this model gets in any picture of the scene. The pictures, the
 * labels and the shadows of a scene then all show that one detail, whatever frames are made.
 * In:  stage       its places, courses, roads and cast are known
 * Out: details     (scene->model_count) */
void details_choose(enum detail *details, const struct stage *stage);

/* The file of a model in a detail, or in the next finer one that there is a file for. */
const char *detail_file(const struct scene_model *model, enum detail detail);

#endif

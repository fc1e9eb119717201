/* The stage: what of a scene does not depend on a camera, loaded once. */
#ifndef STAFFAGE_GEN_STAGE_H
#define STAFFAGE_GEN_STAGE_H

#include "gen/model/material.h"
#include "gen/model/model.h"
#include "gen/motion/repertoire.h"
#include "gen/motion/traffic.h"
#include "gen/scene/scene.h"
#include "gen/world/entity.h"
#include "gen/world/ribbon.h"
#include "gen/world/road.h"
#include "gen/world/static_mesh.h"
#include "gen/world/surface.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* To read. */
struct stage {
    const struct scene *scene;
    size_t *cast;                /* (scene->entity_count) which model each is, drawn where the scene leaves a choice */
    enum detail *details;        /* (scene->model_count) */
    struct model **models;       /* (scene->model_count) NULL where nothing uses it */
    struct repertoire *repertoires; /* (scene->model_count) of the models that are rigged */
    struct static_mesh *mesh;    /* NULL: the ground is a plane */
    struct road_network roads;
    struct ribbon *ribbons;      /* (ribbon_count) with a mesh, one for each way over it */
    size_t ribbon_count;
    struct surface surface;
    struct traffic *traffic;     /* NULL: none */
    struct vec2 *stand_m;        /* (scene->entity_count) where those stand that follow no path */
    const struct way **courses;  /* (scene->entity_count) what the others follow */
    char **warnings;
    size_t warning_count;
    uint64_t hash;               /* of all that was loaded */
};

/* In: scene and rules are borrowed for the stage's life
 * Err: ERR_INPUT at the user's file and line */
bool stage_create(struct stage **stage, const struct scene *scene, const struct material_rules *rules, struct error *err);
void stage_destroy(struct stage *stage);

/* Take a text over as something to warn of, also on failure. Err: ERR_MEMORY, also for NULL */
bool stage_warn(struct stage *stage, char *text, struct error *err);

/* The class of an entity of the scene. */
enum entity_class stage_class(const struct stage *stage, size_t entity);
/* The colour, linear, that one of this id is painted in when the scene gives none: drawn from those that its model
 * is seen in. NULL: its model's own */
const double *stage_color(const struct stage *stage, size_t model, uint16_t id);

/* The ground that a shot's pixel shows, in pixels of its camera as the scene gives it.
 * Err: ERR_INPUT without a place: it shows none */
bool stage_ground_at(struct vec3 *p_m, const struct stage *stage, const struct scene_shot *shot, struct vec2 q_px,
                     struct error *err);

/* Record an error at a place in the scene file, unless it has a place. Returns false. */
bool stage_fail(const struct scene *scene, struct source where, struct error *err);

#endif

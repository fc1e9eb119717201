/* The stage: what of a scene does not depend on a camera, loaded once, and who is on it at a moment. */
#ifndef STAFFAGE_GEN_STAGE_H
#define STAFFAGE_GEN_STAGE_H

#include "gen/model/material.h"
#include "gen/model/model.h"
#include "gen/motion/gait.h"
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
    struct model **models;       /* (scene->model_count) NULL where nothing uses it */
    struct gait *gaits;          /* (scene->model_count) of the models that are rigged */
    struct static_mesh *mesh;    /* NULL: the ground is a plane */
    struct road_network roads;
    struct ribbon *ribbons;      /* (ribbon_count) with a mesh, one for each way over it */
    size_t ribbon_count;
    struct surface surface;
    struct traffic *traffic;     /* NULL: none */
    struct vec3 *stand_m;        /* (scene->entity_count) where those stand that follow no path */
    const struct way **courses;  /* (scene->entity_count) what the others follow */
    char **warnings;
    size_t warning_count;
    uint64_t hash;               /* of all that was loaded */
};

/* In: scene and rules are borrowed for the stage's life
 * Err: ERR_INPUT at the user's file and line */
bool stage_create(struct stage **stage, const struct scene *scene, const struct material_rules *rules, struct error *err);
void stage_destroy(struct stage *stage);

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
bool stage_at(struct moment *moment, const struct stage *stage, double time_s, struct error *err);
void moment_release(struct moment *moment);

/* Record an error at a place in the scene file, unless it has a place. Returns false. */
bool stage_fail(const struct scene *scene, struct source where, struct error *err);

#endif

/* One frame of a scene: who is where, exact labels, the passes' scenes, and the manifest last. */
#ifndef STAFFAGE_GEN_FRAME_H
#define STAFFAGE_GEN_FRAME_H

#include "gen/light/light.h"
#include "gen/render/passes.h"
#include "gen/scene/scene.h"
#include "gen/stage.h"
#include "gen/trace/trace.h"
#include "lib/camera.h"
#include "lib/error.h"
#include "lib/view.h"

#include <stdbool.h>

#define FRAME_NAME_SIZE 16

/* What all frames share. Borrowed. */
struct frame_context {
    const struct scene *scene;
    const char *out_folder;
    const struct stage *stage;
    const struct light *light;
    const char *sky_map;        /* relative to out_folder */
    struct tracer *tracer;
    struct include_set *includes; /* of the run */
};

/* One frame as it stands after generating: what the makefile is written from. */
struct frame_result {
    char name[FRAME_NAME_SIZE]; /* "000123" */
    bool empty;                 /* nothing changes: no passes */
    struct view view;           /* of the object pass */
    bool kept;                  /* it was there already, from the same input */
};

/* The number of its shot, six digits. */
void frame_name(char name[FRAME_NAME_SIZE], const struct scene_shot *shot);

/* Hashes of all that a frame depends on, and of what its passes may depend on. */
struct frame_keys { char all[17], passes[17]; };

/* Whether a frame's folder says what its passes were rendered from. */
bool frame_has_passes_key(const char *folder);

/* Write a frame's folder. Its passes.key is left alone where the passes are to stay as they are.
 * In:  result->name; photograph as the manifest is to name it ("" for a new view); camera at the
 *      photograph's size
 * Out: result; its view is empty in an empty frame
 * Err: ERR_INPUT at the scene, ERR_IO, ERR_MEMORY */
bool frame_make(struct frame_result *result, const struct frame_context *context, const struct scene_shot *shot,
                const struct camera *camera, const char *folder, const char *photograph, const struct frame_keys *keys,
                struct error *err);

#endif

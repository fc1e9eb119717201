/* What a scene file may hold, and the names that its choices have. */
#ifndef STAFFAGE_GEN_SCENE_KEYS_H
#define STAFFAGE_GEN_SCENE_KEYS_H

#include "gen/scene/schema.h"

#define FRAME_MAX 999999 /* six digits name a frame */

/* docs/scene.md is this table with a meaning for each key, in the same order. */
extern const struct schema scene_schema;

/* The i-th name, in the order of the enum; NULL from the end on. */
const char *lens_name(int i);           /* enum camera_model */
const char *camera_axes_name(int i);    /* enum camera_axes */
const char *world_direction_name(int i);/* enum world_direction */
const char *class_choice_name(int i);   /* enum entity_class */
const char *model_axis_name(int i);     /* enum axis, then x y z for +x +y +z */
const char *sky_name(int i);            /* enum sky_kind */
const char *shade_name(int i);          /* enum shade_kind */
const char *sun_name(int i);            /* auto, none */
const char *trait_name(int i);          /* of the camera: auto, none */
const char *transfer_name(int i);       /* enum transfer_kind */
const char *overwrite_name(int i);      /* enum overwrite_side */
const char *mask_name(int i);           /* enum mask_rule */
const char *quality_name(int i);        /* enum quality */
const char *driving_side_name(int i);   /* enum driving_side */
const char *road_use_name(int i);       /* enum road_use */

/* Axes of a camera's coordinates in other people's files. */
enum camera_axes { CAMERA_AXES_OPENCV, CAMERA_AXES_OPENGL, CAMERA_AXES_X_LEFT_Y_UP };
enum world_direction { WORLD_EAST, WORLD_WEST, WORLD_NORTH, WORLD_SOUTH, WORLD_UP, WORLD_DOWN };

#endif

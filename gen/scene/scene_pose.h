/* The camera's pose, from the ways in which people write it down. */
#ifndef STAFFAGE_GEN_SCENE_POSE_H
#define STAFFAGE_GEN_SCENE_POSE_H

#include "gen/scene/yaml.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>

/* In:  pose is `camera.pose`, or that of a shot, of a tree that fits the scene schema; file is for errors
 * Err: ERR_INPUT: no rotation, one that mirrors with the stated axes, a view straight up or down without up */
bool scene_pose(struct pose *world_from_camera, const struct yaml_node *pose, const char *file, struct error *err);

#endif

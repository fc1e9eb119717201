/* The ground that entities stand on: a plane (n . p = offset, n unit and upward). */
#ifndef STAFFAGE_GEN_GROUND_H
#define STAFFAGE_GEN_GROUND_H

#include "lib/camera.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

struct plane { struct vec3 normal; double offset_m; };

/* Least-squares plane of n >= 3 points (smallest principal axis), normal upward (z > 0).
 * Out: plane, *rms_m distance of the points
 * Err: ERR_INPUT: fewer than 3 points, points about a line or in a cloud as thick as wide,
 *      or a plane steeper than 60 deg; outputs untouched */
bool plane_fit(struct plane *plane, double *rms_m, const struct vec3 *p_m, size_t n, struct error *err);

/* Where the ray origin + t direction, t > 0, meets the plane. False when it does not. */
bool plane_intersect(const struct plane *plane, struct vec3 *p_m, struct vec3 origin_m, struct vec3 direction);

/* Height of the plane below or above (x, y). */
double plane_height(const struct plane *plane, double x_m, double y_m);

/* The ground point that a photograph's pixel position sees.
 * Err: ERR_INPUT: the pixel looks at or above the horizon, or the camera is below the ground;
 *      ERR_NOT_INVERTIBLE; output untouched */
bool ground_from_pixel(struct vec3 *p_m, const struct plane *ground, const struct camera *camera,
                       struct pose world_from_camera, struct vec2 q_px, struct error *err);

#endif

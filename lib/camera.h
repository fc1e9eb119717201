/* Camera models: COLMAP's ids 0 to 10, in CONVENTIONS pixels and axes
 * (x right, y down, z forward; (0,0) the corner of the top-left pixel).
 * Src: COLMAP 3.8 src/base/camera_models.h documentation of the parameters. */
#ifndef STAFFAGE_LIB_CAMERA_H
#define STAFFAGE_LIB_CAMERA_H

#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>

enum camera_model {
    CAMERA_SIMPLE_PINHOLE = 0, /* f, cx, cy */
    CAMERA_PINHOLE,            /* fx, fy, cx, cy */
    CAMERA_SIMPLE_RADIAL,      /* f, cx, cy, k */
    CAMERA_RADIAL,             /* f, cx, cy, k1, k2 */
    CAMERA_OPENCV,             /* fx, fy, cx, cy, k1, k2, p1, p2 */
    CAMERA_OPENCV_FISHEYE,     /* fx, fy, cx, cy, k1, k2, k3, k4 */
    CAMERA_FULL_OPENCV,        /* fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6 */
    CAMERA_FOV,                /* fx, fy, cx, cy, omega */
    CAMERA_SIMPLE_RADIAL_FISHEYE, /* f, cx, cy, k */
    CAMERA_RADIAL_FISHEYE,     /* f, cx, cy, k1, k2 */
    CAMERA_THIN_PRISM_FISHEYE, /* fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, sx1, sy1 */
    CAMERA_MODEL_COUNT
};

#define CAMERA_PARAMS_MAX 12

struct camera {
    enum camera_model model;
    int width_px, height_px;
    double params[CAMERA_PARAMS_MAX]; /* in the order above; the rest 0 */
};

/* "PINHOLE" and so on. */
const char *camera_model_name(enum camera_model model);
/* Out: *model. Returns false for an unknown name (no error is set). */
bool camera_model_from_name(enum camera_model *model, const char *name);
int camera_model_param_count(enum camera_model model);
/* "fx, fy, cx, cy" and so on. */
const char *camera_model_param_names(enum camera_model model);

/* Focal lengths and principal point, whatever the model. */
struct camera_intrinsics { double fx_px, fy_px, cx_px, cy_px; };
struct camera_intrinsics camera_intrinsics(const struct camera *camera);
/* True when straight lines stay straight: no distortion parameter is other than 0. */
bool camera_is_pinhole(const struct camera *camera);
/* The same lens on a sensor sampled at another size. A model of one focal length
 * becomes its superset of two where the aspect changes (1001x751 to 500x375). */
struct camera camera_scaled(const struct camera *camera, int width_px, int height_px);

/* Project a point in camera coordinates.
 * Out: q_px CONVENTIONS pixels
 * Err: ERR_BEHIND_CAMERA: z <= 0 (perspective models), or the direction lies beyond
 *      the angle up to which the lens is one-to-one; output untouched */
bool camera_project(const struct camera *camera, struct vec2 *q_px, struct vec3 p_camera, struct error *err);

/* The ray through a pixel position.
 * Out: direction, unit length, camera coordinates
 * Err: ERR_NOT_INVERTIBLE: the lens maps no direction there; output untouched */
bool camera_unproject(const struct camera *camera, struct vec3 *direction, struct vec2 q_px, struct error *err);

/* Largest angle from the optical axis, rad, up to which the radial part of the model
 * is strictly increasing; beyond it the model is not invertible. At most pi. */
double camera_invertible_angle_rad(const struct camera *camera);

#endif

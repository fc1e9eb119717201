/* The pinhole view that POV-Ray renders for a part of a photograph.
 *
 * A view shares the camera's centre. For an undistorted camera it is a window
 * of the photograph itself, pixel on pixel; for a lens it is a pinhole image,
 * turned towards the part and so much finer than the photograph there as is
 * wanted, that post resamples into the photograph's pixels: what is sampled
 * twice loses less the finer it was. */
#ifndef STAFFAGE_LIB_VIEW_H
#define STAFFAGE_LIB_VIEW_H

#include "lib/camera.h"
#include "lib/rect.h"

struct view {
    int width_px, height_px;
    double fx_px, fy_px, cx_px, cy_px;  /* principal point may lie far outside */
    struct mat3 view_from_camera;       /* rotation; identity for an undistorted camera */
    struct rect window_px;              /* the part of the photograph that the view covers */
    bool aligned;                       /* pixel (i,j) of the view is photograph pixel (x0+i, y0+j) */
};

/* The view that covers `window_px` of the photograph.
 * In:  fineness: of a lens's view, its pixels across a photograph's where the photograph is finest; 1 or more. Where so
 *      large a view is not possible it is less fine, down to 1
 * Err: ERR_INPUT when the window spans more than 150 deg, or the lens is not invertible in it */
bool view_cover(struct view *view, const struct camera *camera, struct rect window_px, double fineness, struct error *err);

/* Photograph position -> view position (both continuous pixels). For aligned views a shift.
 * Err: ERR_NOT_INVERTIBLE as camera_unproject; ERR_BEHIND_CAMERA when outside the view's half space */
bool view_from_photograph(const struct view *view, const struct camera *camera, struct vec2 *v_px,
                          struct vec2 q_px, struct error *err);

#endif

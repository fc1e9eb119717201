#include "gen/render/camera_sdl.h"

void camera_write(struct sdl *sdl, const struct view *view, struct pose world_from_camera)
{
    struct mat3 world_from_view = mat3_multiply(world_from_camera.rotation, mat3_transpose(view->view_from_camera));
    struct vec3 right = mat3_column(world_from_view, 0), up = vec3_scale(mat3_column(world_from_view, 1), -1);
    struct vec3 middle = vec3_add(vec3_scale(right, (view->width_px / 2.0 - view->cx_px) / view->fx_px),
                                  vec3_scale(up, -(view->height_px / 2.0 - view->cy_px) / view->fy_px));
    sdl_declare_vector(sdl, "View_Location", world_from_camera.translation);
    sdl_declare_vector(sdl, "View_Right", vec3_scale(right, view->width_px / view->fx_px));
    sdl_declare_vector(sdl, "View_Up", vec3_scale(up, view->height_px / view->fy_px));
    sdl_declare_vector(sdl, "View_Direction", vec3_add(mat3_column(world_from_view, 2), middle));
    sdl_include(sdl, "camera.inc");
}

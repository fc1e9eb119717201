/* A view as the camera of a POV-Ray scene. */
#ifndef STAFFAGE_GEN_CAMERA_SDL_H
#define STAFFAGE_GEN_CAMERA_SDL_H

#include "gen/render/sdl.h"
#include "lib/vec.h"
#include "lib/view.h"

/* Declare what camera.inc needs, in world coordinates, and include it: pixels of the picture
 * that POV-Ray then renders at the view's size are the view's. */
void camera_write(struct sdl *sdl, const struct view *view, struct pose world_from_camera);

#endif

/* An occluder as rays meet it: an outline in the photograph, and the upright plane that it stands in. */
#ifndef STAFFAGE_GEN_SCREEN_H
#define STAFFAGE_GEN_SCREEN_H

#include "gen/trace/polygon.h"
#include "gen/trace/rays.h"
#include "gen/trace/trace.h"
#include "lib/camera.h"
#include "lib/error.h"
#include "lib/rect.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A plane in camera coordinates: rays from the camera meet it at range level / (normal . direction). */
struct sight_plane { struct vec3 normal; double level_m; };

/* INFINITY for a ray that does not meet it. */
double sight_range(struct sight_plane plane, struct vec3 direction);
struct sight_plane sight_plane(struct vec3 normal, double offset_m, struct pose world_from_camera);

struct screen {
    const struct occluder *occluder; /* borrowed */
    struct polygon polygon;
    struct rect bounds_px;
    struct sight_plane plane;
    uint64_t *samples;               /* (width of bounds) a row's, for who works on it */
    bool *inside;                    /* the same */
};

/* Err: ERR_MEMORY; ERR_INPUT: it stands right above or below the camera.
 * screen_release may be called after a failure, too. */
bool screen_init(struct screen *screen, const struct camera *camera, struct pose world_from_camera,
                 const struct occluder *occluder, struct error *err);
void screen_release(struct screen *screen);

#endif

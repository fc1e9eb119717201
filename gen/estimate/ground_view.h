/* What of the ground a photograph shows, in working pixels of its tones. */
#ifndef STAFFAGE_GEN_GROUND_VIEW_H
#define STAFFAGE_GEN_GROUND_VIEW_H

#include "gen/estimate/tones.h"
#include "gen/stage.h"
#include "lib/camera.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>

#define GROUND_STEP_PX 2
#define GROUND_NEAR_M (1.0 / 3) /* where its light can be measured */

struct ground_node { float p_m[3], range_m; }; /* NaN: no level ground there, or too far away to be looked at */

struct ground_view {
    int width, height;         /* of nodes, one every GROUND_STEP_PX working pixels */
    struct ground_node *node;  /* (height,width) owned */
};

/* Level ground (up to 30 deg) that is near enough: a working pixel covers at most coarsest_m of it.
 * In:  camera of the photograph at its own size
 * Err: ERR_MEMORY */
bool ground_view_of(struct ground_view *view, const struct stage *stage, const struct tones *tones,
                    const struct camera *camera, struct pose world_from_camera, double coarsest_m, struct error *err);
void ground_view_release(struct ground_view *view);

/* The ground at a working pixel. False where there is none. */
bool ground_view_at(struct vec3 *p_m, const struct ground_view *view, int x, int y);

/* Take the haze between camera and ground out of the tones. Where it hides the ground they are good no more. */
void ground_view_clear(struct tones *tones, const struct ground_view *view, double visibility_m, const double haze[3]);

#endif

/* The ground that a photograph shows most of, where it is lit: what its exposure and its shadows are measured on. */
#ifndef STAFFAGE_GEN_LIT_GROUND_H
#define STAFFAGE_GEN_LIT_GROUND_H

#include "gen/estimate/ground_view.h"
#include "gen/estimate/tones.h"
#include "gen/light/light.h"
#include "gen/stage.h"
#include "lib/camera.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

struct lit_ground {
    double ln[3];              /* its colour, ln of linear light */
    double sigma[3];           /* of ln */
    size_t found;              /* working pixels of that colour; 0: none */
    size_t looked_at;
};

/* Of candidates, which are the scene's exposure patch, or its roads, or all ground that nothing of the place shades: the
 * commonest colour among those as colourful as the scene's ground.albedo, give or take the camera's white balance.
 * In:  sun: unit, or NULL when there is none
 * Out: ground; *q_px unless NULL: photograph pixels of that colour, the caller's (free), at most LIT_GROUND_MAX
 * Err: ERR_MEMORY */
#define LIT_GROUND_MAX 2000
bool lit_ground_find(struct lit_ground *ground, struct vec2 **q_px, size_t *n, const struct stage *stage, const struct tones *tones,
                     const struct ground_view *view, const struct vec3 *sun, const struct camera *camera,
                     const struct scene_shot *shot, struct error *err);

/* The commonest surfaces of all ground in view: 1 of them is the lit ground above, others follow while they cover 2 % of it.
 * Out: surfaces (most); returns how many, 0 when memory ends */
size_t lit_surfaces_find(struct lit_ground *surfaces, size_t most, const struct lit_ground *first, const struct stage *stage,
                         const struct tones *tones, const struct ground_view *view, const struct vec3 *sun);

/* Does a surface of this colour look like it in the light? In: ln (3) */
bool lit_ground_is(const struct lit_ground *ground, const float *ln);

#endif

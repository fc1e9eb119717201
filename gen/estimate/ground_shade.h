/* Ground that lies in the shade of something, whatever it is, by the looks of a photograph. */
#ifndef STAFFAGE_GEN_GROUND_SHADE_H
#define STAFFAGE_GEN_GROUND_SHADE_H

#include "gen/estimate/lit_ground.h"
#include "gen/estimate/shade.h"
#include "gen/light/light.h"
#include "gen/scene/scene.h"
#include "gen/stage.h"
#include "lib/error.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SUN_STEPS = 17 };

enum ground_light { GROUND_LIT, GROUND_UNKNOWN, GROUND_AT_EDGE, GROUND_IN_SHADE };

struct ground_shade {
    bool found;                              /* false: all ground counts as lit */
    double share;                            /* of the ground in view that counts as shaded */
    struct lit_ground lit[SHADE_SURFACES];   /* (surfaces) the ground's commonest surfaces in the sun */
    size_t surfaces;
    float ln_light[SUN_STEPS][3];            /* ln of the light with a share i / (SUN_STEPS - 1) of the sun, over all of it */
    int width_px, height_px, reduction;      /* of working pixels, as tones.h */
    uint8_t *where;                          /* (height,width) enum ground_light; owned */
};

/* Shade is what has the colour of one of the commonest surfaces in the light that the photograph's shadows have, in
 * one piece, deep in its middle, and with that surface in the sun beside it. What could be something else counts as lit; and so does everything
 * where the photograph, looked at as estimate.h does, shows no sun or other shadows than the light makes. Over a mesh, shade is also what the
 * mesh casts the most of; and what is not known to be lit is not known.
 * In:  photograph (U8) of a shot; unhidden (U8, 1 channel, unhidden.h) or NULL; light with a sun
 * Out: shade; free with ground_shade_release
 * Err: ERR_MEMORY */
bool ground_shade_find(struct ground_shade *shade, const struct stage *stage, const struct image *photograph,
                       const struct image *unhidden, const struct scene_shot *shot, const struct light *light, struct error *err);
void ground_shade_release(struct ground_shade *shade);

/* What of the sun reaches the ground at a pixel position, from 0 to 1, by its linear colour there with the haze taken
 * away. False where it is none of the surfaces, lit or shaded. */
bool ground_shade_sun(const struct ground_shade *shade, double *sun, struct vec2 q_px, const double linear[3]);

#endif

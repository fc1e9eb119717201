/* Light from the photograph: is there sun, what of the light stays in the shade, and where the sun stands by
 * the shadows. */
#ifndef STAFFAGE_GEN_ESTIMATE_H
#define STAFFAGE_GEN_ESTIMATE_H

#include "gen/estimate/shade.h"
#include "gen/estimate/sun_check.h"
#include "gen/scene/scene.h"
#include "gen/stage.h"
#include "lib/error.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

/* Photographs are looked at up to this number, evenly over the shots that have one. */
#define ESTIMATE_PHOTOGRAPHS 6

enum shade_from { SHADE_FROM_MARKS, SHADE_FROM_MESH, SHADE_FROM_EDGES };

struct light_estimate {
    bool clear;                /* there is sun */
    enum shade_from from;      /* what told */
    double certainty;          /* of clear or not, 0.5 to 1 */
    struct shade shade;        /* places 0 where no shadow was found */
    double sky_share[3], sky_share_sigma[3]; /* clear: of the light on level ground in the sun, what is not the sun's own */
    double turbidity;          /* clear: whose sky is to the sun as was found */
    double beyond;             /* the share beyond that of any clear sky at this height of the sun: above 0 too much sky, below too little */
    bool mesh;                 /* casts shadows, so that the sun can be checked by them */
    bool has_check;            /* it casts enough of those that were found */
    struct sun_check check;
    size_t photographs;
    double lit[3], lit_sigma[3]; /* linear values of the lit ground in the first of them, haze taken away; 0: none found */
};

struct estimate_photograph { size_t shot; const char *path; };

/* Shots to be looked at. Out: shots (ESTIMATE_PHOTOGRAPHS). Returns how many, 0 when none has a photograph */
size_t estimate_shots(size_t shots[ESTIMATE_PHOTOGRAPHS], const struct scene *scene);

/* In:  scene with SKY_AUTO
 * Err: ERR_INPUT at the scene: there is sun, and place, time and light.sun are missing; marks that cannot be */
bool light_estimate(struct light_estimate *estimate, const struct stage *stage, const struct estimate_photograph *photographs,
                    size_t n, struct error *err);

/* What was found, as if the user had written it. */
void light_estimate_apply(struct scene *scene, const struct light_estimate *estimate);

/* A few lines for people, with a newline each; the caller frees. In: radiance of the lit ground in the model (3), for the exposure */
char *light_estimate_text(const struct light_estimate *estimate, const double ground_radiance[3]);
/* A warning where the ground can hardly be as dark as it is said to be, for an exposure that is fitted to it; "": it can. NULL when memory ends. */
char *light_estimate_doubt(const struct light_estimate *estimate, const double ground_radiance[3]);
/* The same for run.json; NULL when memory ends. */
json_t *light_estimate_json(const struct light_estimate *estimate, const double ground_radiance[3]);

#endif

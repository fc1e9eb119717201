/* From edges to the light of the shade: which of them are alike as shadows are, and what they have in common. */
#ifndef STAFFAGE_GEN_SHADE_H
#define STAFFAGE_GEN_SHADE_H

#include "gen/estimate/daylight_locus.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

#define SHADE_SURFACES 4

/* Light in the shade over light in the open, on level ground. */
struct shade {
    double ratio[3], sigma[3];
    size_t edges;              /* pixels of edges that agree; or pairs that were marked */
    size_t places;             /* apart from each other, in which they lie */
    double share;              /* of all edges that were looked at, these agree */
    double purity;             /* of those as deep: what shadows and other things have edges of */
    double likelihood;         /* of so blue a shade, so deep */
    size_t surface_places[SHADE_SURFACES]; /* places, of the edges on each surface */
};

struct shade_sample {
    float ln[3];               /* ln of shade over lit */
    int place;                 /* neighbours in a photograph have the same */
    int surface;               /* of the brighter side: 0 ... SHADE_SURFACES - 1 */
};

/* Edges that agree in depth and colour: the densest group among those that can be shadows, which are bluer than
 * what is lit, most in blue and least in red.
 * In:  bluer: the least ln(blue ratio / red ratio); locus: what daylight can be; samples are reordered
 * Out: shade->places 0 where none agree
 * Err: ERR_MEMORY */
bool shade_find(struct shade *shade, struct shade_sample *samples, size_t n, double bluer, const struct daylight_locus *locus,
                struct error *err);
/* Does an edge agree with what was found? */
bool shade_is(const struct shade *shade, const struct shade_sample *sample);

/* Are two of them the same light? */
bool shade_agrees(const struct shade *a, const struct shade *b);

/* The same of pairs that are shadows for sure. */
bool shade_of_marks(struct shade *shade, const struct shade_sample *samples, size_t n, struct error *err);

#endif

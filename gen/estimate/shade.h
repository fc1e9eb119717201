/* From edges to the light of the shade: which of them are alike as shadows are, and what they have in common. */
#ifndef STAFFAGE_GEN_SHADE_H
#define STAFFAGE_GEN_SHADE_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Light in the shade over light in the open, on level ground. */
struct shade {
    double ratio[3], sigma[3];
    size_t edges;              /* pixels of edges that agree; or pairs that were marked */
    size_t places;             /* apart from each other, in which they lie */
    double share;              /* of all edges that were looked at, these agree */
    double purity;             /* of those as deep: what shadows and other things have edges of */
};

struct shade_sample {
    float ln[3];               /* ln of shade over lit */
    int place;                 /* neighbours in a photograph have the same */
};

/* Edges that agree in depth and colour: the densest group among those that can be shadows, which are bluer than
 * what is lit, most in blue and least in red.
 * In:  bluer: the least ln(blue ratio / red ratio); samples are reordered
 * Out: shade->places 0 where none agree
 * Err: ERR_MEMORY */
bool shade_find(struct shade *shade, struct shade_sample *samples, size_t n, double bluer, struct error *err);
/* Does an edge agree with what was found? */
bool shade_is(const struct shade *shade, const struct shade_sample *sample);

/* The same of pairs that are shadows for sure. */
bool shade_of_marks(struct shade *shade, const struct shade_sample *samples, size_t n, struct error *err);

#endif

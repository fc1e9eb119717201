/* An estimate while it is made: for its own files. */
#ifndef STAFFAGE_GEN_ESTIMATE_IMPL_H
#define STAFFAGE_GEN_ESTIMATE_IMPL_H

#include "gen/estimate/estimate.h"
#include "gen/estimate/ground_view.h"
#include "gen/estimate/lit_ground.h"
#include "gen/estimate/tones.h"

/* How much of the light that level ground has without the sun reaches it where something keeps the sun away, too. */
#define SKY_SEEN 0.8

/* What all photographs together say. */
struct gathered {
    bool by_place;                /* a mesh casts shadows: sides and told are there */
    struct vec3 sun;              /* then */
    struct shade_sample *samples;
    struct shadow_sides *sides;   /* (n) */
    int8_t *told;                 /* (n) 1: the place casts that shadow, -1: the other way round, 0: neither */
    bool *on_lit;                 /* (n) the brighter side is one of the ground's commonest surfaces in the light */
    size_t n, room;
    struct shade_sample *marks;   /* (scene.mark_count) */
    size_t mark_count;
};

/* A photograph that is being looked at. */
struct looked_at {
    const struct stage *stage;
    const struct scene_shot *shot;
    size_t index;                 /* of the photograph */
    struct camera camera;         /* at its size */
    struct tones tones;
    struct ground_view view;
    struct lit_ground lit[SHADE_SURFACES]; /* (surfaces) the commonest surfaces; the first: what the exposure is fitted to */
    size_t surfaces;
};

/* In: sun: unit, or NULL where it is not known */
bool look_at(struct looked_at *l, const struct stage *stage, const struct estimate_photograph *photograph, size_t index,
             const struct vec3 *sun, struct error *err);
/* The same with the photograph read already. */
bool look_at_image(struct looked_at *l, const struct stage *stage, const struct image *photograph, const struct scene_shot *shot,
                   size_t index, const struct vec3 *sun, struct error *err);
/* Also after a failure. */
void looked_at_release(struct looked_at *l);

/* Add a photograph's edges: those of the ground's commonest surfaces; where a mesh casts shadows, those of any, with what it
 * casts there. */
bool gather_edges(struct gathered *g, const struct looked_at *l, struct error *err);
/* Add the pairs that are marked in a photograph.
 * Err: ERR_INPUT at the mark: clipped, or no shade */
bool gather_marks(struct gathered *g, const struct looked_at *l, size_t shot, struct error *err);
void gathered_release(struct gathered *g);

/* Is there sun, and what stays of the light in the shade: estimate->clear, certainty, shade and from.
 * In:  sun: unit, or NULL where it is not known
 * Err: ERR_MEMORY */
bool find_shade(struct light_estimate *estimate, const struct gathered *gathered, const struct scene *scene, const struct vec3 *sun,
                struct error *err);

#endif

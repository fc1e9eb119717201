/* Random draws that depend on nothing but what they are for: (seed, frame, entity, purpose, index). */
#ifndef STAFFAGE_LIB_DRAW_H
#define STAFFAGE_LIB_DRAW_H

#include <stddef.h>
#include <stdint.h>

enum draw_purpose {
    DRAW_LANE, DRAW_POSITION, DRAW_KIND, DRAW_COLOR, DRAW_SPEED, DRAW_PHASE, DRAW_OFFSET, DRAW_TIME, DRAW_GRAIN, DRAW_CAST, DRAW_PAINT
};

struct draw_key { uint64_t seed; int64_t frame; uint32_t entity; enum draw_purpose purpose; };

/* The next number of a sequence. */
uint64_t splitmix64(uint64_t *state);

/* Uniform in [0, 1). The same key and index give the same number, everywhere and always.
 * Src: splitmix64 over the key (Steele, Lea, Flood 2014) */
double draw_uniform(struct draw_key key, uint32_t index);
/* An index below n, each as likely as its weight says. */
size_t draw_weighted(struct draw_key key, const double *weights, size_t n);
/* Standard normal, by the inverse of the distribution. */
double draw_normal(struct draw_key key, uint32_t index);

#endif

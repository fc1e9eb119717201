/* "Did you mean": the known name nearest to a mistyped one. */
#ifndef STAFFAGE_GEN_NEAREST_H
#define STAFFAGE_GEN_NEAREST_H

#include <stddef.h>

/* Start with { NULL, 0 }, offer every candidate, read name: NULL when none is near. */
struct nearest { const char *name; size_t distance; };

/* The candidate is borrowed. */
void nearest_offer(struct nearest *nearest, const char *text, const char *candidate);

#endif

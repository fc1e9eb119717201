/* The similarity that takes one set of points to another. */
#ifndef STAFFAGE_IMPORT_SIMILARITY_H
#define STAFFAGE_IMPORT_SIMILARITY_H

#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

/* A position in both frames. */
struct tie { const char *name; struct vec3 p_reconstruction, p_enu_m; };

/* Least squares of the distances in metres over ties[chosen[0]] to ties[chosen[n - 1]]. On points of one
 * line the turn about it is any.
 * Returns false, with the output untouched, where no scale above 0 fits best or fewer than 2 points differ.
 * Src: Umeyama 1991, Least-squares estimation of transformation parameters between two point patterns */
bool similarity_fit(struct similarity *enu_from_reconstruction, const struct tie *ties, const size_t *chosen, size_t n);

#endif

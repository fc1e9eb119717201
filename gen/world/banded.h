/* Symmetric positive definite systems whose entries lie near the diagonal. */
#ifndef STAFFAGE_GEN_BANDED_H
#define STAFFAGE_GEN_BANDED_H

#include <stdbool.h>
#include <stddef.h>

struct banded {
    size_t n, band;  /* unknowns; farthest entry from the diagonal */
    double *matrix;  /* (n, band + 1) column i: entries (i, i) to (i + band, i) */
    double *right;   /* (n) */
};

/* False without memory. */
bool banded_create(struct banded *system, size_t n, size_t band);
void banded_release(struct banded *system);
void banded_clear(struct banded *system);
/* Add the square weight (coefficient . x[index] - value)^2 to what is to be least; indices lie within
 * band of each other. */
void banded_add(struct banded *system, const size_t *index, const double *coefficient, size_t count, double value,
                double weight);
/* The solution replaces the right side; the matrix is used up. False when it is not definite. */
bool banded_solve(struct banded *system);

#endif

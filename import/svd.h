/* Singular values of a 3x3 matrix. */
#ifndef STAFFAGE_IMPORT_SVD_H
#define STAFFAGE_IMPORT_SVD_H

#include "lib/vec.h"

/* a = u diag(d) v^T. u and v are rotations; |d[0]| >= |d[1]| >= |d[2]|, and only d[2] can be negative:
 * it has the sign of det a. For a symmetric matrix without negative eigenvalues u's columns are its axes.
 * Src: one-sided Jacobi: Hestenes 1958, Inversion of Matrices by Biorthogonalization */
void svd3(struct mat3 *u, double d[3], struct mat3 *v, struct mat3 a);

#endif

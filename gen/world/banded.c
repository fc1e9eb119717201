#include "gen/world/banded.h"

#include <stdlib.h>
#include <string.h>

bool banded_create(struct banded *system, size_t n, size_t band)
{
    *system = (struct banded){ .n = n, .band = band, .matrix = calloc(n * (band + 1), sizeof(double)),
                               .right = calloc(n, sizeof(double)) };
    if (system->matrix && system->right) return true;
    banded_release(system);
    return false;
}

void banded_release(struct banded *system)
{
    free(system->matrix);
    free(system->right);
    *system = (struct banded){ 0 };
}

void banded_clear(struct banded *system)
{
    memset(system->matrix, 0, system->n * (system->band + 1) * sizeof *system->matrix);
    memset(system->right, 0, system->n * sizeof *system->right);
}

void banded_add(struct banded *system, const size_t *index, const double *coefficient, size_t count, double value,
                double weight)
{
    for (size_t a = 0; a < count; a++) {
        system->right[index[a]] += weight * coefficient[a] * value;
        for (size_t b = 0; b < count; b++)
            if (index[b] >= index[a])
                system->matrix[index[a] * (system->band + 1) + index[b] - index[a]] += weight * coefficient[a] * coefficient[b];
    }
}

/* Square-root free Cholesky: columns of L below the diagonal, D on it. */
bool banded_solve(struct banded *system)
{
    size_t n = system->n, stride = system->band + 1;
    double *x = system->right;
    for (size_t j = 0; j < n; j++) {
        double *column = system->matrix + j * stride;
        size_t below = n - 1 - j < system->band ? n - 1 - j : system->band;
        if (!(column[0] > 0)) return false;
        for (size_t k = 1; k <= below; k++) {
            double factor = column[k] / column[0];
            if (factor == 0) continue;
            double *other = system->matrix + (j + k) * stride;
            for (size_t m = k; m <= below; m++) other[m - k] -= factor * column[m];
            x[j + k] -= factor * x[j];
        }
    }
    for (size_t j = n; j-- > 0;) {
        const double *column = system->matrix + j * stride;
        size_t below = n - 1 - j < system->band ? n - 1 - j : system->band;
        double sum = x[j];
        for (size_t k = 1; k <= below; k++) sum -= column[k] * x[j + k];
        x[j] = sum / column[0];
    }
    return true;
}

#include "import/svd.h"

#include <float.h>
#include <stdbool.h>

static void swap(struct vec3 *a, struct vec3 *b)
{
    struct vec3 t = *a;
    *a = *b;
    *b = t;
}

/* A unit vector across a. */
static struct vec3 across(struct vec3 a)
{
    struct vec3 axis = fabs(a.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return vec3_unit(vec3_cross(a, axis));
}

void svd3(struct mat3 *u, double d[3], struct mat3 *v, struct mat3 a)
{
    struct vec3 b[3], w[3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    for (int k = 0; k < 3; k++) b[k] = mat3_column(a, k);

    /* Columns of a v are turned in pairs until all stand upright on each other: then they are u d. */
    bool turned = true;
    for (int sweep = 0; turned && sweep < 60; sweep++) {
        turned = false;
        for (int i = 0; i < 2; i++)
            for (int j = i + 1; j < 3; j++) {
                double ii = vec3_dot(b[i], b[i]), jj = vec3_dot(b[j], b[j]), ij = vec3_dot(b[i], b[j]);
                if (fabs(ij) <= DBL_EPSILON * sqrt(ii * jj)) continue;
                double zeta = (jj - ii) / (2 * ij);
                double t = copysign(1, zeta) / (fabs(zeta) + sqrt(1 + zeta * zeta));
                double c = 1 / sqrt(1 + t * t), s = c * t;
                struct vec3 *pairs[2] = { b, w };
                for (int k = 0; k < 2; k++) {
                    struct vec3 p = pairs[k][i], q = pairs[k][j];
                    pairs[k][i] = vec3_sub(vec3_scale(p, c), vec3_scale(q, s));
                    pairs[k][j] = vec3_add(vec3_scale(p, s), vec3_scale(q, c));
                }
                turned = true;
            }
    }
    for (int i = 0; i < 2; i++)
        for (int j = 2; j > i; j--)
            if (vec3_norm(b[j]) > vec3_norm(b[j - 1])) {
                swap(&b[j], &b[j - 1]);
                swap(&w[j], &w[j - 1]);
            }

    double tiny = DBL_EPSILON * vec3_norm(b[0]);
    struct vec3 x = vec3_norm(b[0]) > 0 ? vec3_unit(b[0]) : vec3(1, 0, 0);
    struct vec3 y = vec3_norm(b[1]) > tiny ? vec3_unit(b[1]) : across(x);
    struct vec3 z = vec3_cross(x, y), w2 = vec3_cross(w[0], w[1]);
    d[0] = vec3_norm(b[0]);
    d[1] = vec3_norm(b[1]);
    d[2] = vec3_dot(z, b[2]) * vec3_dot(w2, w[2]);
    *u = mat3_from_columns(x, y, z);
    *v = mat3_from_columns(w[0], w[1], w2);
}

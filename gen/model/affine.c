#include "gen/model/affine.h"

#include <math.h>

const struct affine affine_identity = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } };

struct affine affine_multiply(const struct affine *m, const struct affine *n)
{
    struct affine p;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            p.a[i][j] = m->a[i][0] * n->a[0][j] + m->a[i][1] * n->a[1][j] + m->a[i][2] * n->a[2][j] + (j == 3 ? m->a[i][3] : 0);
    return p;
}

struct affine affine_from_columns(const double m[16])
{
    struct affine p;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) p.a[i][j] = m[4 * j + i];
    return p;
}

struct affine affine_from_trs(const double t[3], const double r[4], const double s[3])
{
    double n = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    double x = r[0] / n, y = r[1] / n, z = r[2] / n, w = r[3] / n;
    double m[3][3] = { { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y) },
                       { 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x) },
                       { 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y) } };
    struct affine p;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) p.a[i][j] = j < 3 ? m[i][j] * s[j] : t[i];
    return p;
}

double affine_determinant(const struct affine *m)
{
    return m->a[0][0] * (m->a[1][1] * m->a[2][2] - m->a[1][2] * m->a[2][1]) -
           m->a[0][1] * (m->a[1][0] * m->a[2][2] - m->a[1][2] * m->a[2][0]) +
           m->a[0][2] * (m->a[1][0] * m->a[2][1] - m->a[1][1] * m->a[2][0]);
}

void affine_move_point(float out[3], const struct affine *m, const float p[3])
{
    double q[3];
    for (int i = 0; i < 3; i++)
        q[i] = m->a[i][0] * (double)p[0] + m->a[i][1] * (double)p[1] + m->a[i][2] * (double)p[2] + m->a[i][3];
    for (int i = 0; i < 3; i++) out[i] = (float)q[i];
}

/* Normals go by the inverse transpose: the matrix of cofactors, but for a positive factor. */
void affine_move_normal(float out[3], const struct affine *m, const float n[3])
{
    double q[3], sign = affine_determinant(m) < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++) {
        const double *b = m->a[(i + 1) % 3], *c = m->a[(i + 2) % 3];
        q[i] = sign * ((b[1] * c[2] - b[2] * c[1]) * (double)n[0] + (b[2] * c[0] - b[0] * c[2]) * (double)n[1] +
                       (b[0] * c[1] - b[1] * c[0]) * (double)n[2]);
    }
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    for (int i = 0; i < 3; i++) out[i] = length > 0 ? (float)(q[i] / length) : 0;
}

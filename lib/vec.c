#include "lib/vec.h"

struct mat3 mat3_identity(void)
{
    return (struct mat3){ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
}

struct mat3 mat3_multiply(struct mat3 a, struct mat3 b)
{
    struct mat3 c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
    return c;
}

struct mat3 mat3_transpose(struct mat3 a)
{
    struct mat3 t;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) t.m[i][j] = a.m[j][i];
    return t;
}

double mat3_determinant(struct mat3 a)
{
    return vec3_dot(mat3_column(a, 0), vec3_cross(mat3_column(a, 1), mat3_column(a, 2)));
}

struct mat3 mat3_from_columns(struct vec3 x, struct vec3 y, struct vec3 z)
{
    return (struct mat3){ { { x.x, y.x, z.x }, { x.y, y.y, z.y }, { x.z, y.z, z.z } } };
}

struct vec3 mat3_column(struct mat3 a, int column)
{
    return vec3(a.m[0][column], a.m[1][column], a.m[2][column]);
}

double mat3_orthonormality(struct mat3 a)
{
    struct mat3 p = mat3_multiply(a, mat3_transpose(a));
    double worst = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) worst = fmax(worst, fabs(p.m[i][j] - (i == j)));
    return worst;
}

struct mat3 mat3_orthonormalize(struct mat3 a)
{
    struct vec3 x = vec3_unit(mat3_column(a, 0));
    struct vec3 y = mat3_column(a, 1);
    y = vec3_unit(vec3_sub(y, vec3_scale(x, vec3_dot(x, y))));
    return mat3_from_columns(x, y, vec3_cross(x, y));
}

struct mat3 mat3_from_quat(struct quat q)
{
    double n = 1.0 / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    double w = q.w * n, x = q.x * n, y = q.y * n, z = q.z * n;
    return (struct mat3){ { { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y) },
                            { 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x) },
                            { 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y) } } };
}

struct quat quat_from_mat3(struct mat3 a)
{
    /* The largest of the four squared components is found first, so that no
     * division is by a small number (Shepperd 1978). */
    double t[4] = { a.m[0][0] + a.m[1][1] + a.m[2][2], a.m[0][0] - a.m[1][1] - a.m[2][2],
                    a.m[1][1] - a.m[0][0] - a.m[2][2], a.m[2][2] - a.m[0][0] - a.m[1][1] };
    int k = 0;
    for (int i = 1; i < 4; i++)
        if (t[i] > t[k]) k = i;
    double s = 2 * sqrt(1 + t[k]);
    struct quat q;
    switch (k) {
    case 0:
        q = (struct quat){ s / 4, (a.m[2][1] - a.m[1][2]) / s, (a.m[0][2] - a.m[2][0]) / s,
                           (a.m[1][0] - a.m[0][1]) / s };
        break;
    case 1:
        q = (struct quat){ (a.m[2][1] - a.m[1][2]) / s, s / 4, (a.m[0][1] + a.m[1][0]) / s,
                           (a.m[0][2] + a.m[2][0]) / s };
        break;
    case 2:
        q = (struct quat){ (a.m[0][2] - a.m[2][0]) / s, (a.m[0][1] + a.m[1][0]) / s, s / 4,
                           (a.m[1][2] + a.m[2][1]) / s };
        break;
    default:
        q = (struct quat){ (a.m[1][0] - a.m[0][1]) / s, (a.m[0][2] + a.m[2][0]) / s,
                           (a.m[1][2] + a.m[2][1]) / s, s / 4 };
    }
    return q.w < 0 ? (struct quat){ -q.w, -q.x, -q.y, -q.z } : q;
}

struct pose pose_identity(void)
{
    return (struct pose){ mat3_identity(), { 0, 0, 0 } };
}

struct pose pose_inverse(struct pose b_from_a)
{
    struct mat3 r = mat3_transpose(b_from_a.rotation);
    return (struct pose){ r, vec3_scale(mat3_apply(r, b_from_a.translation), -1) };
}

struct pose pose_compose(struct pose a_from_b, struct pose b_from_c)
{
    return (struct pose){ mat3_multiply(a_from_b.rotation, b_from_c.rotation),
                          pose_apply(a_from_b, b_from_c.translation) };
}

struct vec3 pose_apply(struct pose a_from_b, struct vec3 p_b)
{
    return vec3_add(mat3_apply(a_from_b.rotation, p_b), a_from_b.translation);
}

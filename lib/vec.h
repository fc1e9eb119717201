/* Vectors, rotations and rigid poses. Small structs by value.
 *
 * Matrices are row-major and act on columns. `a_from_b` maps b coordinates
 * to a: p_a = pose_apply(a_from_b, p_b). */
#ifndef STAFFAGE_LIB_VEC_H
#define STAFFAGE_LIB_VEC_H

#include <math.h>

struct vec2 { double x, y; };
struct vec3 { double x, y, z; };
struct mat3 { double m[3][3]; };
struct quat { double w, x, y, z; };
struct pose { struct mat3 rotation; struct vec3 translation; }; /* rotation is orthonormal, det +1 */

static inline struct vec3 vec3(double x, double y, double z) { return (struct vec3){ x, y, z }; }
static inline struct vec3 vec3_add(struct vec3 a, struct vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline struct vec3 vec3_sub(struct vec3 a, struct vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline struct vec3 vec3_scale(struct vec3 a, double s) { return vec3(a.x * s, a.y * s, a.z * s); }
static inline double vec3_dot(struct vec3 a, struct vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline struct vec3 vec3_cross(struct vec3 a, struct vec3 b)
{
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
static inline double vec3_norm(struct vec3 a) { return sqrt(vec3_dot(a, a)); }
static inline struct vec3 vec3_unit(struct vec3 a) { return vec3_scale(a, 1.0 / vec3_norm(a)); }

static inline struct vec3 mat3_apply(struct mat3 a, struct vec3 v)
{
    return vec3(a.m[0][0] * v.x + a.m[0][1] * v.y + a.m[0][2] * v.z,
                a.m[1][0] * v.x + a.m[1][1] * v.y + a.m[1][2] * v.z,
                a.m[2][0] * v.x + a.m[2][1] * v.y + a.m[2][2] * v.z);
}
struct mat3 mat3_identity(void);
struct mat3 mat3_multiply(struct mat3 a, struct mat3 b);
struct mat3 mat3_transpose(struct mat3 a);
double mat3_determinant(struct mat3 a);
/* The columns of the result are x, y and z. */
struct mat3 mat3_from_columns(struct vec3 x, struct vec3 y, struct vec3 z);
struct vec3 mat3_column(struct mat3 a, int column);
/* Largest |(A A^T - I)_ij|: 0 for an orthonormal matrix. */
double mat3_orthonormality(struct mat3 a);
/* The rotation nearest to a near-rotation (Gram-Schmidt over the columns x, y). */
struct mat3 mat3_orthonormalize(struct mat3 a);

/* q need not have unit norm; its norm must not be 0. */
struct mat3 mat3_from_quat(struct quat q);
/* Unit norm, w >= 0. */
struct quat quat_from_mat3(struct mat3 a);

struct pose pose_identity(void);
struct pose pose_inverse(struct pose b_from_a);
struct pose pose_compose(struct pose a_from_b, struct pose b_from_c);
struct vec3 pose_apply(struct pose a_from_b, struct vec3 p_b);

/* p_a = rotation * (scale * p_b) + translation; scale > 0 */
struct similarity { double scale; struct mat3 rotation; struct vec3 translation; };
static inline struct vec3 similarity_apply(struct similarity a_from_b, struct vec3 p_b)
{
    return vec3_add(mat3_apply(a_from_b.rotation, vec3_scale(p_b, a_from_b.scale)), a_from_b.translation);
}

#endif

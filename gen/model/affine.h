/* Affine maps as files have them: scale, shear and mirroring included. */
#ifndef STAFFAGE_GEN_AFFINE_H
#define STAFFAGE_GEN_AFFINE_H

/* p -> the first three columns times p, plus the fourth. Row-major; small enough to pass by pointer. */
struct affine { double a[3][4]; };

extern const struct affine affine_identity;

struct affine affine_multiply(const struct affine *a_from_b, const struct affine *b_from_c);
/* A 4x4 matrix, column by column. */
struct affine affine_from_columns(const double m[16]);
/* Translation, rotation (x, y, z, w; any norm but 0) and scale, applied from the last to the first. */
struct affine affine_from_trs(const double t[3], const double r[4], const double s[3]);
double affine_determinant(const struct affine *m);
/* out may be p. */
void affine_move_point(float out[3], const struct affine *m, const float p[3]);
/* A unit normal of the moved surface, on the same side of it; 0 where the map leaves none. out may be n. */
void affine_move_normal(float out[3], const struct affine *m, const float n[3]);

#endif

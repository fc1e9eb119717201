#include "lib/vec.h"

#include "tests/tap.h"

int main(void)
{
    struct quat q = { 0.3, -0.5, 0.7, 0.2 };
    struct mat3 r = mat3_from_quat(q);
    NEAR(mat3_orthonormality(r), 0, 1e-15, "a quaternion of any norm gives an orthonormal matrix");
    NEAR(mat3_determinant(r), 1, 1e-15, "and one that does not mirror");
    struct quat back = quat_from_mat3(r);
    double n = sqrt(0.3 * 0.3 + 0.5 * 0.5 + 0.7 * 0.7 + 0.2 * 0.2);
    NEAR(back.w, 0.3 / n, 1e-15, "quat_from_mat3 undoes mat3_from_quat, w");
    NEAR(back.x, -0.5 / n, 1e-15, "x");
    NEAR(back.y, 0.7 / n, 1e-15, "y");
    NEAR(back.z, 0.2 / n, 1e-15, "z");
    struct mat3 turn = mat3_from_quat((struct quat){ cos(M_PI / 4), 0, 0, sin(M_PI / 4) });
    struct vec3 y = mat3_apply(turn, vec3(1, 0, 0));
    NEAR(y.y, 1, 1e-15, "90 degrees about z takes x to y");
    struct pose a = { r, { 1, 2, 3 } };
    struct pose identity = pose_compose(a, pose_inverse(a));
    NEAR(vec3_norm(identity.translation), 0, 1e-14, "a_from_b * b_from_a moves nothing");
    NEAR(mat3_orthonormality(identity.rotation), 0, 1e-14, "a_from_b * b_from_a turns nothing");
    NEAR(identity.rotation.m[0][0] + identity.rotation.m[1][1] + identity.rotation.m[2][2], 3, 1e-14, "its trace is 3");
    return tap_done();
}

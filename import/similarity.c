#include "import/similarity.h"

#include "import/svd.h"

bool similarity_fit(struct similarity *enu_from_reconstruction, const struct tie *ties, const size_t *chosen, size_t n)
{
    if (n < 2) return false;
    struct vec3 from = { 0 }, to = { 0 };
    for (size_t i = 0; i < n; i++) {
        from = vec3_add(from, ties[chosen[i]].p_reconstruction);
        to = vec3_add(to, ties[chosen[i]].p_enu_m);
    }
    from = vec3_scale(from, 1.0 / (double)n);
    to = vec3_scale(to, 1.0 / (double)n);

    struct mat3 covariance = { { { 0 } } }, u, v;
    double variance = 0, d[3];
    for (size_t i = 0; i < n; i++) {
        struct vec3 p = vec3_sub(ties[chosen[i]].p_reconstruction, from), q = vec3_sub(ties[chosen[i]].p_enu_m, to);
        double a[3] = { p.x, p.y, p.z }, b[3] = { q.x, q.y, q.z };
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) covariance.m[r][c] += b[r] * a[c];
        variance += vec3_dot(p, p);
    }
    /* u and v are rotations and the third value has the sign: the paper's S is in them already. */
    svd3(&u, d, &v, covariance);
    double scale = (d[0] + d[1] + d[2]) / variance;
    if (!(scale > 0) || !isfinite(scale)) return false;
    struct mat3 rotation = mat3_multiply(u, mat3_transpose(v));
    *enu_from_reconstruction = (struct similarity){
        .scale = scale,
        .rotation = rotation,
        .translation = vec3_sub(to, mat3_apply(rotation, vec3_scale(from, scale))),
    };
    return true;
}

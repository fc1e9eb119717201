#include "gen/world/ground.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/* Principal axes of a symmetric matrix by Jacobi's rotations: a becomes diagonal,
 * the columns of axes are the eigenvectors. It converges quadratically: a handful of
 * sweeps reaches the last digit. */
static void principal_axes(struct mat3 *a, struct mat3 *axes)
{
    *axes = mat3_identity();
    for (int sweep = 0; sweep < 10; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++) {
                if (fabs(a->m[p][q]) <= DBL_MIN) continue;
                double angle = 0.5 * atan(2 * a->m[p][q] / (a->m[q][q] - a->m[p][p]));
                struct mat3 turn = mat3_identity();
                turn.m[p][p] = turn.m[q][q] = cos(angle);
                turn.m[p][q] = sin(angle);
                turn.m[q][p] = -sin(angle);
                *a = mat3_multiply(mat3_transpose(turn), mat3_multiply(*a, turn));
                *axes = mat3_multiply(*axes, turn);
            }
}

bool plane_fit(struct plane *plane, double *rms_m, const struct vec3 *p_m, size_t n, struct error *err)
{
    if (n < 3) return error_set(err, ERR_INPUT, "a plane needs 3 points or more, here are %zu", n);

    struct vec3 centre = { 0, 0, 0 };
    for (size_t i = 0; i < n; i++) centre = vec3_add(centre, vec3_scale(p_m[i], 1.0 / (double)n));
    struct mat3 spread = { 0 };
    for (size_t i = 0; i < n; i++) {
        struct vec3 d = vec3_sub(p_m[i], centre);
        double c[3] = { d.x, d.y, d.z };
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) spread.m[j][k] += c[j] * c[k] / (double)n;
    }
    if (!isfinite(spread.m[0][0] + spread.m[1][1] + spread.m[2][2]))
        return error_set(err, ERR_INPUT, "a point of the plane is not finite");
    struct mat3 axes;
    principal_axes(&spread, &axes);

    int least = 0, most = 0;
    for (int i = 1; i < 3; i++) {
        if (spread.m[i][i] < spread.m[least][least]) least = i;
        if (spread.m[i][i] >= spread.m[most][most]) most = i;
    }
    int middle = 3 - least - most;
    double length = sqrt(fmax(0, spread.m[most][most]));
    double width = sqrt(fmax(0, spread.m[middle][middle]));
    double thickness = sqrt(fmax(0, spread.m[least][least]));
    /* About a line, or in a cloud as thick as wide, the normal is noise. */
    if (width <= 1e-3 * length || thickness >= 0.5 * width)
        return error_set(err, ERR_INPUT,
                         "the points do not tell a plane: they spread over %.3g x %.3g x %.3g m; "
                         "take points well apart in two directions on the ground", length, width, thickness);

    struct vec3 normal = vec3_unit(mat3_column(axes, least));
    if (normal.z < 0) normal = vec3_scale(normal, -1);
    if (normal.z < 0.5)
        return error_set(err, ERR_INPUT,
                         "the plane through the points is %.0f deg steep; a ground is at most 60 deg steep (z is up)",
                         acos(normal.z) * 180 / M_PI);
    *plane = (struct plane){ normal, vec3_dot(normal, centre) };
    *rms_m = thickness;
    return true;
}

bool plane_intersect(const struct plane *plane, struct vec3 *p_m, struct vec3 origin_m, struct vec3 direction)
{
    double t = (plane->offset_m - vec3_dot(plane->normal, origin_m)) / vec3_dot(plane->normal, direction);
    if (!(t > 0 && isfinite(t))) return false;
    *p_m = vec3_add(origin_m, vec3_scale(direction, t));
    return true;
}

double plane_height(const struct plane *plane, double x_m, double y_m)
{
    return (plane->offset_m - plane->normal.x * x_m - plane->normal.y * y_m) / plane->normal.z;
}

bool ground_from_pixel(struct vec3 *p_m, const struct plane *ground, const struct camera *camera,
                       struct pose world_from_camera, struct vec2 q_px, struct error *err)
{
    struct vec3 centre = world_from_camera.translation;
    if (vec3_dot(ground->normal, centre) <= ground->offset_m)
        return error_set(err, ERR_INPUT, "the camera stands %.3g m below the ground",
                         ground->offset_m - vec3_dot(ground->normal, centre));
    struct vec3 ray_camera;
    if (!camera_unproject(camera, &ray_camera, q_px, err)) return false;
    if (!plane_intersect(ground, p_m, centre, mat3_apply(world_from_camera.rotation, ray_camera)))
        return error_set(err, ERR_INPUT, "pixel (%.6g, %.6g) looks at or above the horizon; take one that sees the ground",
                         q_px.x, q_px.y);
    return true;
}

#include "import/georeference.h"

#include "import/svd.h"

#include <stdlib.h>

#define DEG (3.14159265358979323846 / 180)

/* A camera's axes in the reconstruction's frame: rows of the rotation. */
static struct mat3 axes_of(const struct recon_shot *shot)
{
    return mat3_transpose(mat3_from_quat(shot->camera_from_world_q));
}

static void add_square(struct mat3 *sum, struct vec3 p, double weight)
{
    double a[3] = { p.x, p.y, p.z };
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) sum->m[r][c] += weight * a[r] * a[c];
}

/* Up is towards the tops of pictures that look level, and back along those that look down. */
static struct vec3 towards_sky(struct vec3 normal, const struct reconstruction *reconstruction)
{
    double sum = 0;
    for (size_t i = 0; i < reconstruction->shot_count; i++) {
        struct mat3 axes = axes_of(&reconstruction->shots[i]);
        sum -= vec3_dot(normal, mat3_column(axes, 1)) + vec3_dot(normal, mat3_column(axes, 2));
    }
    return sum < 0 ? vec3_scale(normal, -1) : normal;
}

/* Cameras are held level: their right axes lie in the level plane, and span it when they look about. */
static bool up_by_cameras(struct vec3 *up, double *spread_rad, const struct reconstruction *reconstruction)
{
    if (reconstruction->shot_count < 3) return false;
    struct mat3 sum = { { { 0 } } }, u, v;
    double d[3];
    for (size_t i = 0; i < reconstruction->shot_count; i++)
        add_square(&sum, mat3_column(axes_of(&reconstruction->shots[i]), 0), 1.0 / (double)reconstruction->shot_count);
    svd3(&u, d, &v, sum);
    double rolled = sqrt(fmax(d[2], 0)), about = sqrt(d[1]);
    if (rolled > sin(10 * DEG) || about < sin(20 * DEG) || about < 3 * rolled) return false;
    *up = towards_sky(mat3_column(u, 2), reconstruction);
    *spread_rad = asin(rolled);
    return true;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The plane near which most points lie: weights fall with the distance from the last one (Cauchy's). */
static bool up_by_points(struct vec3 *up, double *spread_rad, const struct reconstruction *reconstruction)
{
    size_t n = reconstruction->point_count;
    const struct vec3 *p = reconstruction->points;
    double *away = n >= 3 ? malloc(2 * n * sizeof *away) : NULL, *sorted = away ? away + n : NULL;
    if (!away) return false;
    struct vec3 mean = { 0 }, normal = { 0 };
    double d[3] = { 0 }, scale = INFINITY;
    for (size_t i = 0; i < n; i++) away[i] = 0;
    for (int round = 0; round < 30; round++) {
        double total = 0;
        mean = vec3(0, 0, 0);
        for (size_t i = 0; i < n; i++) {
            double weight = 1 / (1 + away[i] * away[i] / (scale * scale));
            mean = vec3_add(mean, vec3_scale(p[i], weight));
            total += weight;
        }
        mean = vec3_scale(mean, 1 / total);
        struct mat3 sum = { { { 0 } } }, u, v;
        for (size_t i = 0; i < n; i++)
            add_square(&sum, vec3_sub(p[i], mean), 1 / (1 + away[i] * away[i] / (scale * scale)) / total);
        svd3(&u, d, &v, sum);
        normal = mat3_column(u, 2);
        for (size_t i = 0; i < n; i++) sorted[i] = away[i] = fabs(vec3_dot(normal, vec3_sub(p[i], mean)));
        qsort(sorted, n, sizeof *sorted, by_value);
        scale = 2 * 1.4826 * sorted[n / 2];
        if (!(scale > 1e-9 * sqrt(d[0]))) break; /* half of them lie in it exactly */
    }
    free(away);
    double thick = scale / 2, wide = sqrt(d[1]);
    if (!(wide > 1e-6 * sqrt(d[0])) || !(thick < 0.3 * wide)) return false;
    *up = towards_sky(normal, reconstruction);
    *spread_rad = atan(thick / wide);
    return true;
}

bool georeference_distance(struct similarity *world_from_reconstruction, struct upright *upright,
                           const struct reconstruction *reconstruction, const struct vec3 p[2], double distance_m,
                           struct error *err)
{
    double distance = vec3_norm(vec3_sub(p[1], p[0]));
    if (!(distance_m > 0) || !isfinite(distance_m))
        return error_set(err, ERR_INPUT, "the known distance is %.9g m; it must be above 0", distance_m);
    if (!(distance > 0) || !isfinite(distance))
        return error_set(err, ERR_INPUT, "the two points of the known distance are one, or not finite");
    if (!reconstruction->shot_count) return error_set(err, ERR_INPUT, "the reconstruction has no images");

    struct upright found = { 0 };
    struct vec3 up;
    if (!up_by_cameras(&up, &found.spread_rad, reconstruction)) {
        found.by_points = true;
        if (!up_by_points(&up, &found.spread_rad, reconstruction))
            return error_set(err, ERR_INPUT,
                             "nothing tells where up is: the cameras look one way or are rolled, and the %zu sparse "
                             "points lie near no plane. Control points or GPS would tell",
                             reconstruction->point_count);
    }
    struct mat3 axes = axes_of(&reconstruction->shots[0]);
    struct vec3 forward = mat3_column(axes, 2), top = vec3_scale(mat3_column(axes, 1), -1);
    struct vec3 ahead = fabs(vec3_dot(forward, up)) < fabs(vec3_dot(top, up)) ? forward : top;
    struct vec3 east = vec3_unit(vec3_cross(ahead, up)), north = vec3_cross(up, east);
    struct similarity s = {
        .scale = distance_m / distance,
        .rotation = mat3_transpose(mat3_from_columns(east, north, up)),
    };
    s.translation = vec3_scale(similarity_apply(s, p[0]), -1);
    *world_from_reconstruction = s;
    *upright = found;
    return true;
}

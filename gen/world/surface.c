#include "gen/world/surface.h"

#include <math.h>

#define NORMAL_REACH_M 0.5 /* on the bare mesh */
#define NORMAL_STEPS 2     /* of the grid of heights to each side */
#define OVERHANG_M 0.5     /* beside a point of the mesh, what is this much higher does not belong to its surface */

/* The road wherever it reaches, its margin too: there the mesh was drawn to it. below_m: of the mesh. */
static bool height(const struct surface *surface, double *z_m, double x_m, double y_m, double below_m)
{
    if (!surface->has_mesh) {
        *z_m = plane_height(&surface->plane, x_m, y_m);
        return isfinite(*z_m);
    }
    double z;
    if (ribbons_at(surface->ribbons, surface->ribbon_count, &z, x_m, y_m) >= 1) {
        *z_m = z;
        return true;
    }
    return static_mesh_height(surface->mesh, z_m, x_m, y_m, below_m);
}

/* Of the plane through the heights about (x, y). */
static struct vec3 mesh_normal(const struct surface *surface, double x_m, double y_m, double z_m)
{
    double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, xs = 0, ys = 0, zs = 0, n = 0;
    for (int i = -NORMAL_STEPS; i <= NORMAL_STEPS; i++)
        for (int j = -NORMAL_STEPS; j <= NORMAL_STEPS; j++) {
            double x = i * NORMAL_REACH_M / NORMAL_STEPS, y = j * NORMAL_REACH_M / NORMAL_STEPS, z;
            if (hypot(x, y) > NORMAL_REACH_M || !height(surface, &z, x_m + x, y_m + y, z_m + OVERHANG_M)) continue;
            z -= z_m;
            xx += x * x; xy += x * y; yy += y * y; xz += x * z; yz += y * z;
            xs += x; ys += y; zs += z; n++;
        }
    xx -= xs * xs / n; xy -= xs * ys / n; yy -= ys * ys / n; xz -= xs * zs / n; yz -= ys * zs / n;
    double determinant = xx * yy - xy * xy;
    if (!(determinant > 1e-9)) return vec3(0, 0, 1);
    return vec3_unit(vec3(-(xz * yy - yz * xy) / determinant, -(yz * xx - xz * xy) / determinant, 1));
}

bool surface_at(const struct surface *surface, double *z_m, struct vec3 *normal, double x_m, double y_m)
{
    double z;
    if (!height(surface, &z, x_m, y_m, INFINITY)) return false;
    *z_m = z;
    if (!surface->has_mesh) *normal = surface->plane.normal;
    else if (ribbons_at(surface->ribbons, surface->ribbon_count, &z, x_m, y_m) >= 1)
        *normal = ribbons_normal(surface->ribbons, surface->ribbon_count, x_m, y_m);
    else *normal = mesh_normal(surface, x_m, y_m, *z_m);
    return true;
}

bool surface_stand(const struct surface *surface, struct pose *world_from_body, double x_m, double y_m,
                   double heading_rad, double length_m, double width_m)
{
    double z, fx = sin(heading_rad), fy = cos(heading_rad);
    if (!height(surface, &z, x_m, y_m, INFINITY)) return false;
    double ahead = 0, aside = 0, mean = z;
    if (length_m > 0 && width_m > 0) {
        mean = 0;
        for (int i = 0; i < 4; i++) {
            double l = i & 1 ? 0.5 : -0.5, w = i & 2 ? 0.5 : -0.5, wheel;
            if (!height(surface, &wheel, x_m + l * length_m * fx - w * width_m * fy, y_m + l * length_m * fy + w * width_m * fx,
                        z + OVERHANG_M))
                return false;
            mean += wheel / 4;
            ahead += l * wheel / length_m;
            aside += w * wheel / width_m;
        }
    }
    struct vec3 forward = vec3_unit(vec3(fx, fy, ahead));
    struct vec3 up = vec3_unit(vec3(-ahead * fx + aside * fy, -ahead * fy - aside * fx, 1));
    *world_from_body = (struct pose){ mat3_from_columns(forward, vec3_cross(up, forward), up), vec3(x_m, y_m, mean) };
    return true;
}

bool surface_intersect(const struct surface *surface, struct vec3 *p_m, struct vec3 origin_m, struct vec3 direction)
{
    if (!surface->has_mesh) return plane_intersect(&surface->plane, p_m, origin_m, direction);
    struct vec3 unit = vec3_unit(direction);
    struct static_hit hit;
    static_mesh_hits(surface->mesh, &hit, origin_m, &unit, 1);
    if (!isfinite(hit.range_m)) return false;
    *p_m = vec3_add(origin_m, vec3_scale(unit, hit.range_m));
    return true;
}

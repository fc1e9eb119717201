#include "gen/light/seen.h"

#include "lib/air.h"

#include <math.h>

#define EDGE_SHARE 0.02 /* of the picture's width */
#define SATURATED 250
#define PIXEL_OF_GROUND_M 0.5
#define OUTLINE_M 0.15  /* how far off a reconstruction's outlines may be */
#define NEARER 0.92     /* as a share of the depth: what is nearer by less hides little */

void seen_init(struct seen *seen)
{
    struct camera_intrinsics lens = camera_intrinsics(seen->camera);
    seen->camera_from_world = pose_inverse(seen->world_from_camera);
    seen->pixel_rad = 1 / lens.fx_px;
    for (int i = 0; i < 256; i++) seen->linear[i] = (double)linear_from_srgb((float)i / 255);
}

bool seen_project(const struct seen *seen, struct vec2 *q_px, struct vec3 p_m)
{
    struct error ignored;
    struct vec3 p = pose_apply(seen->camera_from_world, p_m);
    ignored.code = ERR_OK;
    return camera_project(seen->camera, q_px, p, &ignored) && q_px->x >= 0 && q_px->y >= 0 &&
           q_px->x < seen->camera->width_px && q_px->y < seen->camera->height_px;
}

double seen_ground_reach(const struct seen *seen, double height_m)
{
    return sqrt(PIXEL_OF_GROUND_M * fmax(height_m, 1) / seen->pixel_rad);
}

double seen_within(const struct seen *seen, struct vec2 q)
{
    double width = seen->camera->width_px, height = seen->camera->height_px;
    double inside = fmin(fmin(q.x, width - q.x), fmin(q.y, height - q.y)) / (EDGE_SHARE * width);
    return inside <= 0 ? 0 : inside >= 1 ? 1 : inside * inside * (3 - 2 * inside);
}

bool seen_hidden(const struct seen *seen, struct vec2 q)
{
    return seen->unhidden && !*image_u8(seen->unhidden, (int)q.x, (int)q.y);
}

double seen_trust(const struct seen *seen, struct vec2 q)
{
    double trust = seen_within(seen, q);
    return trust > 0 && seen_hidden(seen, q) ? 0 : trust;
}

bool seen_beside_nearer(const struct seen *seen, const struct image *place_depth, struct vec2 q, struct vec3 p, struct vec3 normal)
{
    enum { ROUND = 8 };
    double z_m = pose_apply(seen->camera_from_world, p).z, reach = 2 + OUTLINE_M / (z_m * seen->pixel_rad);
    /* A surface that is seen along it comes nearer by itself within that reach. */
    double slant = fabs(vec3_dot(normal, vec3_unit(vec3_sub(p, seen->world_from_camera.translation))));
    double limit = z_m * fmin(NEARER, slant / (slant + 2 * reach * seen->pixel_rad));
    for (int i = 0; i < 2 * ROUND; i++) {
        double r = i < ROUND ? reach : reach / 2, turn = 2 * M_PI * i / ROUND;
        double x = q.x + r * cos(turn), y = q.y + r * sin(turn);
        if (!(x >= 0 && y >= 0 && x < place_depth->width_px && y < place_depth->height_px)) continue;
        if ((double)*image_f32(place_depth, (int)x, (int)y) < limit) return true;
    }
    return false;
}

bool seen_radiance(const struct seen *seen, double rgb[3], struct vec2 q)
{
    int width = seen->camera->width_px, height = seen->camera->height_px;
    double fx = fmin(fmax(q.x - 0.5, 0), width - 1), fy = fmin(fmax(q.y - 0.5, 0), height - 1);
    int x = (int)fx, y = (int)fy, right = x + 1 < width, down = y + 1 < height;
    const uint8_t *px[4] = { image_u8(seen->picture, x, y), image_u8(seen->picture, x + right, y),
                             image_u8(seen->picture, x, y + down), image_u8(seen->picture, x + right, y + down) };
    double u = fx - x, v = fy - y, weight[4] = { (1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v };
    bool saturated = false;
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int i = 0; i < 4; i++) {
        for (int c = 0; c < 3; c++) rgb[c] += weight[i] * seen->linear[px[i][c]] / seen->k[c];
        saturated = saturated || px[i][0] >= SATURATED || px[i][1] >= SATURATED || px[i][2] >= SATURATED;
    }
    return saturated;
}

void seen_clear_air(const struct seen *seen, double rgb[3], double distance_m)
{
    if (!(seen->visibility_m > 0)) return;
    double t = air_transmission(seen->visibility_m, distance_m);
    for (int c = 0; c < 3; c++) rgb[c] = fmax(0, (rgb[c] - seen->haze[c] / seen->k[c] * (1 - t)) / t);
}

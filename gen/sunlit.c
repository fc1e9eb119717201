#include "gen/sunlit.h"

#include <math.h>
#include <stdlib.h>

static const double step_m = 0.5;
static const double off_ground_m = 0.1; /* the mesh is rough: what lies this close does not shade or hide */

/* Does the camera see a point of the road, and the sun reach it? */
static bool in_full_light(struct vec2 *q_px, const struct stage *stage, const struct light *light,
                          const struct camera *camera, struct pose world_from_camera, struct vec2 at)
{
    double z;
    struct vec3 normal;
    struct error ignored = ERROR_NONE;
    if (!surface_at(&stage->surface, &z, &normal, at.x, at.y)) return false;
    struct vec3 p = vec3(at.x, at.y, z), eye = world_from_camera.translation;
    if (!camera_project(camera, q_px, pose_apply(pose_inverse(world_from_camera), p), &ignored)) return false;
    if (q_px->x < 0 || q_px->y < 0 || q_px->x >= camera->width_px || q_px->y >= camera->height_px) return false;
    if (!stage->mesh) return true;
    struct vec3 to_eye = vec3_sub(eye, p);
    double range = vec3_norm(to_eye);
    if (static_mesh_blocks(stage->mesh, p, vec3_scale(to_eye, 1 / range), off_ground_m * 3, range)) return false;
    return !light->has_sun || !static_mesh_blocks(stage->mesh, p, light->sun_direction, off_ground_m * 3, 1000);
}

bool sunlit_pixels(struct vec2 **out, size_t *count, const struct stage *stage, const struct light *light,
                   const struct camera *camera, struct pose world_from_camera, struct error *err)
{
    static const double across[] = { -0.3, 0.1, 0.3 };
    const struct road_network *roads = &stage->roads;
    bool vehicles = false;
    size_t candidates = 0, seen = 0;
    for (size_t i = 0; i < roads->way_count; i++) vehicles = vehicles || roads->ways[i].use == ROAD_VEHICLES;
    for (size_t i = 0; i < roads->way_count; i++)
        candidates += 3 * (size_t)(path_length(&roads->ways[i].path) / step_m + 1);
    struct vec2 *q = calloc(candidates + 1, sizeof *q);
    if (!q) return error_set(err, ERR_MEMORY, "no memory for the pixels of the roads");
    for (size_t i = 0; i < roads->way_count; i++) {
        const struct way *way = &roads->ways[i];
        if ((way->use == ROAD_VEHICLES) != vehicles) continue;
        for (double s = 0; s < path_length(&way->path); s += step_m)
            for (int k = 0; k < 3; k++)
                if (in_full_light(&q[seen], stage, light, camera, world_from_camera,
                                  path_at(&way->path, s, across[k] * way->width_m).p_m))
                    seen++;
    }
    size_t kept = seen < SUNLIT_MAX ? seen : SUNLIT_MAX;
    for (size_t i = 0; i < kept; i++) q[i] = q[i * seen / kept];
    *out = q;
    *count = kept;
    return true;
}

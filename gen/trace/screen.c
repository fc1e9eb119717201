#include "gen/trace/screen.h"

#include <math.h>
#include <stdlib.h>

double sight_range(struct sight_plane plane, struct vec3 direction)
{
    double range = plane.level_m / vec3_dot(plane.normal, direction);
    return range > 0 ? range : INFINITY;
}

struct sight_plane sight_plane(struct vec3 normal, double offset_m, struct pose world_from_camera)
{
    return (struct sight_plane){ mat3_apply(mat3_transpose(world_from_camera.rotation), normal),
                                 offset_m - vec3_dot(normal, world_from_camera.translation) };
}

bool screen_init(struct screen *screen, const struct camera *camera, struct pose world_from_camera,
                 const struct occluder *occluder, struct error *err)
{
    *screen = (struct screen){ .occluder = occluder };
    if (!polygon_init(&screen->polygon, occluder->polygon_px, occluder->polygon_count)) goto no_memory;
    screen->bounds_px = polygon_bounds(&screen->polygon, camera->width_px, camera->height_px);
    size_t width = (size_t)(screen->bounds_px.x1 - screen->bounds_px.x0) + 1;
    screen->samples = malloc(width * sizeof *screen->samples);
    screen->inside = malloc(width * sizeof *screen->inside);
    if (!screen->samples || !screen->inside) goto no_memory;
    struct vec3 towards = vec3_sub(occluder->foot_m, world_from_camera.translation);
    towards.z = 0;
    if (vec3_norm(towards) < 1e-6)
        return error_set(err, ERR_INPUT,
                         "occluder %s: stands right above or below the camera, so that no upright plane "
                         "faces it",
                         occluder->name);
    struct vec3 normal = vec3_unit(towards);
    screen->plane = sight_plane(normal, vec3_dot(normal, occluder->foot_m), world_from_camera);
    return true;
no_memory:
    return error_set(err, ERR_MEMORY, "no memory for the outline of %s", occluder->name);
}

void screen_release(struct screen *screen)
{
    polygon_release(&screen->polygon);
    free(screen->samples);
    free(screen->inside);
    *screen = (struct screen){ 0 };
}

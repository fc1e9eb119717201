#include "gen/trace/screen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EDGE_PX 2 /* an entity's soft edge in a rendered picture lies within so many pixels */

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

/* Range of the nearest entity whose edge can reach a pixel. */
static double reach_m(const struct image *ahead, int x, int y)
{
    float near = *image_f32(ahead, x, y);
    if (isfinite(near)) return (double)near;
    for (int v = y > EDGE_PX ? y - EDGE_PX : 0; v <= y + EDGE_PX && v < ahead->height_px; v++)
        for (int u = x > EDGE_PX ? x - EDGE_PX : 0; u <= x + EDGE_PX && u < ahead->width_px; u++)
            near = fminf(near, *image_f32(ahead, u, v));
    return (double)near;
}

static uint8_t share(uint64_t hidden_samples)
{
    return (uint8_t)lround(255.0 * (64 - __builtin_popcountll(hidden_samples)) / 64);
}

/* Add the samples of a row at which a screen hides entities, and at which it hides the ground. */
static void hide_row(uint64_t *of_entities, uint64_t *of_ground, struct screen *screen, struct rays *rays,
                     const struct image *ahead, struct sight_plane ground, int y)
{
    struct rect r = screen->bounds_px;
    if (y < r.y0 || y >= r.y1) return;
    polygon_row_samples(&screen->polygon, screen->samples, y, r.x0, r.x1);
    for (int x = r.x0; x < r.x1; x++) {
        uint64_t samples = screen->samples[x - r.x0];
        struct vec3 direction;
        if (!samples || !rays_get(rays, &direction, x)) continue;
        double range = sight_range(screen->plane, direction), entity = reach_m(ahead, x, y);
        double floor_m = sight_range(ground, direction);
        if (isfinite(entity) && range < entity) of_entities[x] |= samples;
        if (isfinite(floor_m) && range < floor_m) of_ground[x] |= samples;
    }
}

bool screens_share(struct image *visible, struct image *receiver, struct screen *screens, size_t n, struct rays *rays,
                   const struct image *ahead, struct sight_plane ground, struct error *err)
{
    size_t width = (size_t)ahead->width_px;
    if (!image_init(visible, ahead->width_px, ahead->height_px, 1, PIXEL_U8, err) ||
        !image_init(receiver, ahead->width_px, ahead->height_px, 1, PIXEL_U8, err))
        return false;
    uint64_t *of_entities = malloc(2 * width * sizeof *of_entities), *of_ground = of_entities + width;
    if (!of_entities) return error_set(err, ERR_MEMORY, "no memory for a row of samples");
    for (int y = 0; y < ahead->height_px; y++) {
        memset(of_entities, 0, 2 * width * sizeof *of_entities);
        rays_begin_row(rays, y);
        for (size_t k = 0; k < n; k++) hide_row(of_entities, of_ground, &screens[k], rays, ahead, ground, y);
        for (int x = 0; x < ahead->width_px; x++) {
            *image_u8(visible, x, y) = share(of_entities[x]);
            *image_u8(receiver, x, y) = share(of_ground[x]);
        }
    }
    free(of_entities);
    return true;
}

#include "gen/trace/backdrop.h"

#include <math.h>
#include <stdlib.h>

/* Along a ray, what an entity stands on is not farther from where the ray meets the entity; a ray grazing a road by
 * two degrees goes so far within BACKDROP_CONTACT_M of it. */
#define CONTACT_REACH_M 1.0
/* Of a face seen at less than this sine a ray beside the entity says little. */
#define GRAZING 0.01

bool backdrop_init(struct backdrop *backdrop, const struct static_mesh *place, const struct camera *camera,
                   struct pose world_from_camera, struct error *err)
{
    size_t width = (size_t)camera->width_px, height = (size_t)camera->height_px;
    struct camera_intrinsics in = camera_intrinsics(camera);
    *backdrop = (struct backdrop){ .place = place, .world_from_camera = world_from_camera,
                                   .pixel_rad = 1 / fmin(in.fx_px, in.fy_px), .width_px = camera->width_px };
    if (!image_init(&backdrop->range, camera->width_px, camera->height_px, 1, PIXEL_F32, err) ||
        !image_init(&backdrop->depth, camera->width_px, camera->height_px, 1, PIXEL_F32, err) ||
        (static_mesh_has_labels(place) && !image_init(&backdrop->label, camera->width_px, camera->height_px, 1, PIXEL_U8, err)))
        return false;
    backdrop->triangle = malloc(width * height * sizeof *backdrop->triangle);
    backdrop->direction = malloc(width * sizeof *backdrop->direction);
    backdrop->hit = malloc(width * sizeof *backdrop->hit);
    backdrop->cosine = malloc(width * sizeof *backdrop->cosine);
    backdrop->x = malloc(width * sizeof *backdrop->x);
    return (backdrop->triangle && backdrop->direction && backdrop->hit && backdrop->cosine && backdrop->x) ||
           error_set(err, ERR_MEMORY, "no memory for what a picture sees of the place");
}

void backdrop_release(struct backdrop *backdrop)
{
    image_release(&backdrop->range);
    image_release(&backdrop->depth);
    image_release(&backdrop->label);
    free(backdrop->triangle);
    free(backdrop->direction);
    free(backdrop->hit);
    free(backdrop->cosine);
    free(backdrop->x);
    *backdrop = (struct backdrop){ 0 };
}

struct vec3 backdrop_direction(const struct backdrop *backdrop, struct vec3 camera_direction)
{
    return mat3_apply(backdrop->world_from_camera.rotation, camera_direction);
}

void backdrop_row(struct backdrop *backdrop, struct rays *rays)
{
    int y = rays->y;
    uint32_t *triangle = backdrop->triangle + (size_t)y * (size_t)backdrop->width_px;
    size_t n = 0;
    for (int x = 0; x < backdrop->width_px; x++) {
        struct vec3 direction;
        *image_f32(&backdrop->range, x, y) = INFINITY;
        *image_f32(&backdrop->depth, x, y) = NAN;
        triangle[x] = STATIC_NO_TRIANGLE;
        if (!rays_get(rays, &direction, x)) continue;
        backdrop->x[n] = x;
        backdrop->cosine[n] = direction.z;
        backdrop->direction[n++] = backdrop_direction(backdrop, direction);
    }
    static_mesh_hits(backdrop->place, backdrop->hit, backdrop->world_from_camera.translation, backdrop->direction, n);
    for (size_t i = 0; i < n; i++) {
        const struct static_hit *hit = &backdrop->hit[i];
        int x = backdrop->x[i];
        if (hit->triangle == STATIC_NO_TRIANGLE) continue;
        triangle[x] = hit->triangle;
        *image_f32(&backdrop->range, x, y) = (float)hit->range_m;
        *image_f32(&backdrop->depth, x, y) = (float)(hit->range_m * backdrop->cosine[i]);
        if (!backdrop->label.data) continue;
        int label = static_mesh_label(backdrop->place, hit->triangle);
        *image_u8(&backdrop->label, x, y) = (uint8_t)(label > 0 ? label : 0);
    }
}

bool backdrop_point(const struct backdrop *backdrop, struct vec3 *p_m, struct vec3 camera_direction, int x, int y)
{
    double range = (double)*image_f32(&backdrop->range, x, y);
    if (!isfinite(range)) return false;
    *p_m = vec3_add(backdrop->world_from_camera.translation,
                    vec3_scale(backdrop_direction(backdrop, camera_direction), range));
    return true;
}

bool backdrop_hides(const struct backdrop *backdrop, struct vec3 direction, double range_m, uint32_t triangle,
                    const struct sighted *point)
{
    double gap = point->range_m - range_m;
    if (!(gap > BACKDROP_CONTACT_M)) return false;
    struct vec3 normal = static_mesh_normal(backdrop->place, triangle);
    double sine = -vec3_dot(normal, direction);
    if (sine < 0) {
        normal = vec3_scale(normal, -1);
        sine = -sine;
    }
    struct vec3 hit = vec3_add(backdrop->world_from_camera.translation, vec3_scale(direction, range_m));
    double below = vec3_dot(vec3_sub(hit, point->point_m), normal);
    double beside = point->beside_px * backdrop->pixel_rad * point->range_m;
    return below > BACKDROP_CONTACT_M || gap > CONTACT_REACH_M + beside / fmax(sine, GRAZING);
}

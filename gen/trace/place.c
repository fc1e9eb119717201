#include "gen/trace/place.h"

#include "gen/trace/rays.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EDGE_DEPTH 0.02f     /* two neighbours whose depths differ by this share lie on two sides of an edge */
#define EDGE_COLOR (8 / 255.f) /* or whose colours (sRGB) do by this */

struct render {
    const struct static_mesh *mesh;
    const struct camera *camera;
    struct pose world_from_camera;
    struct place_view *view;
    struct rays rays;
    struct image linear;       /* F32 3 of the rays through the centres */
    double pixel_rad;
    struct vec3 *direction;    /* (width) world */
    double *z;                 /* (width) of those directions in the camera */
    int *x;                    /* (width) their pixels */
    struct static_hit *hits;   /* (width) */
};

static float hole_linear(void)
{
    return linear_from_srgb(PLACE_HOLE_SRGB / 255.f);
}

/* The colour that a ray meets, over what one of n x n rays of a pixel covers there. */
static void ray_color(const struct render *r, float rgb[3], const struct static_hit *hit, int n)
{
    static_mesh_color(r->mesh, rgb, hit, hit->range_m * r->pixel_rad / n);
}

static void centre_row(struct render *r, int y)
{
    size_t n = 0;
    rays_begin_row(&r->rays, y);
    for (int x = 0; x < r->camera->width_px; x++) {
        struct vec3 d;
        *image_f32(&r->view->depth, x, y) = NAN;
        for (int k = 0; k < 3; k++) image_f32(&r->linear, x, y)[k] = hole_linear();
        if (!rays_get(&r->rays, &d, x)) continue;
        r->x[n] = x;
        r->z[n] = d.z;
        r->direction[n++] = mat3_apply(r->world_from_camera.rotation, d);
    }
    static_mesh_hits(r->mesh, r->hits, r->world_from_camera.translation, r->direction, n);
    for (size_t i = 0; i < n; i++) {
        const struct static_hit *hit = &r->hits[i];
        if (hit->triangle == STATIC_NO_TRIANGLE) continue;
        *image_f32(&r->view->depth, r->x[i], y) = (float)(hit->range_m * r->z[i]);
        *image_u8(&r->view->cover, r->x[i], y) = 255;
        ray_color(r, image_f32(&r->linear, r->x[i], y), hit, 1);
        int label = static_mesh_label(r->mesh, hit->triangle);
        if (r->view->label.data && label >= 0) *image_u8(&r->view->label, r->x[i], y) = (uint8_t)label;
    }
}

/* --- edges --- */

static bool differ(const struct render *r, int x0, int y0, int x1, int y1)
{
    float a = *image_f32(&r->view->depth, x0, y0), b = *image_f32(&r->view->depth, x1, y1);
    if (isnan(a) || isnan(b)) return isnan(a) != isnan(b);
    if (fabsf(a - b) > EDGE_DEPTH * fminf(a, b)) return true;
    const uint8_t *p = image_u8(&r->view->rgb, x0, y0), *q = image_u8(&r->view->rgb, x1, y1);
    for (int k = 0; k < 3; k++)
        if (fabsf((float)p[k] - (float)q[k]) > EDGE_COLOR * 255) return true;
    return false;
}

static bool at_edge(const struct render *r, int x, int y)
{
    return (x > 0 && differ(r, x, y, x - 1, y)) || (x + 1 < r->camera->width_px && differ(r, x, y, x + 1, y)) ||
           (y > 0 && differ(r, x, y, x, y - 1)) || (y + 1 < r->camera->height_px && differ(r, x, y, x, y + 1));
}

/* Rays within a pixel: from its neighbours' by a linear step, which is off by some thousandths of a pixel. */
static bool sub_rays(struct rays *here, struct rays *below, struct vec3 out[PLACE_SAMPLES * PLACE_SAMPLES], int x)
{
    struct vec3 centre, right, down;
    if (!rays_get(here, &centre, x) || !rays_get(here, &right, x + 1) || !rays_get(below, &down, x)) return false;
    right = vec3_sub(right, centre);
    down = vec3_sub(down, centre);
    for (int j = 0; j < PLACE_SAMPLES; j++)
        for (int i = 0; i < PLACE_SAMPLES; i++) {
            double u = (i + 0.5) / PLACE_SAMPLES - 0.5, v = (j + 0.5) / PLACE_SAMPLES - 0.5;
            out[j * PLACE_SAMPLES + i] = vec3_unit(vec3_add(centre, vec3_add(vec3_scale(right, u), vec3_scale(down, v))));
        }
    return true;
}

static void resample(struct render *r, struct rays *below, int x, int y)
{
    enum { N = PLACE_SAMPLES * PLACE_SAMPLES };
    struct vec3 direction[N];
    struct static_hit hits[N];
    if (!sub_rays(&r->rays, below, direction, x)) return; /* at the end of what the lens maps */
    for (int i = 0; i < N; i++) direction[i] = mat3_apply(r->world_from_camera.rotation, direction[i]);
    static_mesh_hits(r->mesh, hits, r->world_from_camera.translation, direction, N);
    float sum[3] = { 0, 0, 0 };
    int met = 0;
    for (int i = 0; i < N; i++) {
        float rgb[3] = { hole_linear(), hole_linear(), hole_linear() };
        if (hits[i].triangle != STATIC_NO_TRIANGLE) {
            met++;
            ray_color(r, rgb, &hits[i], PLACE_SAMPLES);
        }
        for (int k = 0; k < 3; k++) sum[k] += rgb[k] / N;
    }
    memcpy(image_f32(&r->linear, x, y), sum, sizeof sum);
    *image_u8(&r->view->cover, x, y) = (uint8_t)((255 * met + N / 2) / N);
}

static bool smooth_edges(struct render *r, struct error *err)
{
    struct rays below;
    bool ok = rays_init(&below, r->camera, err);
    for (int y = 0; ok && y < r->camera->height_px; y++) {
        rays_begin_row(&r->rays, y);
        rays_begin_row(&below, y + 1);
        for (int x = 0; x < r->camera->width_px; x++)
            if (at_edge(r, x, y)) resample(r, &below, x, y);
    }
    rays_release(&below);
    return ok;
}

/* --- all of it --- */

static bool prepare(struct render *r, struct error *err)
{
    int w = r->camera->width_px, h = r->camera->height_px;
    size_t width = (size_t)w;
    struct camera_intrinsics in = camera_intrinsics(r->camera);
    r->pixel_rad = 1 / sqrt(in.fx_px * in.fy_px);
    if (!rays_init(&r->rays, r->camera, err)) return false;
    r->direction = malloc(width * sizeof *r->direction);
    r->z = malloc(width * sizeof *r->z);
    r->x = malloc(width * sizeof *r->x);
    r->hits = malloc(width * sizeof *r->hits);
    if (!r->direction || !r->z || !r->x || !r->hits) return error_set(err, ERR_MEMORY, "no memory for a view of the place");
    return image_init(&r->linear, w, h, 3, PIXEL_F32, err) && image_init(&r->view->depth, w, h, 1, PIXEL_F32, err) &&
           image_init(&r->view->cover, w, h, 1, PIXEL_U8, err) &&
           (!static_mesh_has_labels(r->mesh) || image_init(&r->view->label, w, h, 1, PIXEL_U8, err));
}

bool place_render(struct place_view *view, const struct static_mesh *mesh, const struct camera *camera,
                  struct pose world_from_camera, struct error *err)
{
    struct place_view made = { 0 };
    struct render r = { .mesh = mesh, .camera = camera, .world_from_camera = world_from_camera, .view = &made };
    if (!static_mesh_has_colors(mesh)) return error_set(err, ERR_INPUT, "the mesh of the place has no colours, so that a new view of it would show nothing");
    bool ok = prepare(&r, err);
    for (int y = 0; ok && y < camera->height_px; y++) centre_row(&r, y);
    ok = ok && image_srgb_from_linear(&made.rgb, &r.linear, err) && smooth_edges(&r, err);
    if (ok) {
        image_release(&made.rgb);
        ok = image_srgb_from_linear(&made.rgb, &r.linear, err);
    }
    rays_release(&r.rays);
    image_release(&r.linear);
    free(r.direction);
    free(r.z);
    free(r.x);
    free(r.hits);
    if (ok) *view = made;
    else place_view_release(&made);
    return ok;
}

void place_view_release(struct place_view *view)
{
    image_release(&view->rgb);
    image_release(&view->cover);
    image_release(&view->depth);
    image_release(&view->label);
}

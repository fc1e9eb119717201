#include "gen/trace/footprint.h"

#include "gen/world/prism.h"

#include <math.h>
#include <stdbool.h>

#define ARC_STEPS 64  /* a box edge is seen under less than pi: less than 3 deg a step */
#define GRID_STEPS 64 /* across one photograph */
#define MARGIN_PX 2   /* what a curved edge can bulge between two samples of it, and rounding */

struct span {
    double x0, y0, x1, y1;
};

static void span_add(struct span *span, struct vec2 q, double margin)
{
    span->x0 = fmin(span->x0, q.x - margin);
    span->y0 = fmin(span->y0, q.y - margin);
    span->x1 = fmax(span->x1, q.x + margin);
    span->y1 = fmax(span->y1, q.y + margin);
}

static bool ray_meets_box(struct vec3 origin, struct vec3 direction, struct vec3 min, struct vec3 max)
{
    const double o[3] = { origin.x, origin.y, origin.z }, d[3] = { direction.x, direction.y, direction.z };
    const double lo[3] = { min.x, min.y, min.z }, hi[3] = { max.x, max.y, max.z };
    double near = 0, far = INFINITY;
    for (int i = 0; i < 3; i++) {
        if (d[i] == 0) {
            if (o[i] < lo[i] || o[i] > hi[i]) return false;
            continue;
        }
        double a = (lo[i] - o[i]) / d[i], b = (hi[i] - o[i]) / d[i];
        near = fmax(near, fmin(a, b));
        far = fmin(far, fmax(a, b));
    }
    return near <= far;
}

/* The image of a box is bounded by the images of its edges, as long as the lens sees all of
 * each. An edge is sampled evenly in angle. False when part of an edge has no image. */
static bool add_edges(struct span *span, const struct camera *camera, const struct vec3 corners[8])
{
    bool all = true;
    for (int a = 0; a < 8; a++)
        for (int bit = 1; bit < 8; bit <<= 1) {
            if (a & bit) continue;
            struct vec3 u = vec3_unit(corners[a]), v = vec3_unit(corners[a | bit]);
            double angle = atan2(vec3_norm(vec3_cross(u, v)), vec3_dot(u, v)), sine = sin(angle);
            for (int k = 0; k <= ARC_STEPS; k++) {
                double t = (double)k / ARC_STEPS;
                struct vec3 d = sine < 1e-9 ? vec3_add(vec3_scale(u, 1 - t), vec3_scale(v, t))
                                            : vec3_add(vec3_scale(u, sin((1 - t) * angle) / sine),
                                                       vec3_scale(v, sin(t * angle) / sine));
                struct error ignored = ERROR_NONE;
                struct vec2 q;
                if (camera_project(camera, &q, d, &ignored))
                    span_add(span, q, MARGIN_PX);
                else
                    all = false;
            }
        }
    return all;
}

/* Where the edges do not tell: rays on a grid, each standing for the cells around it. */
static void add_grid(struct span *span, const struct camera *camera, struct pose box_from_camera, struct vec3 min_m,
                     struct vec3 max_m, struct rect limits_px)
{
    double step = fmax(camera->width_px, camera->height_px) / GRID_STEPS;
    for (double y = limits_px.y0; y < limits_px.y1 + step; y += step)
        for (double x = limits_px.x0; x < limits_px.x1 + step; x += step) {
            struct vec2 q = { fmin(x, limits_px.x1), fmin(y, limits_px.y1) };
            if (q.x >= span->x0 + step && q.x <= span->x1 - step && q.y >= span->y0 + step && q.y <= span->y1 - step)
                continue; /* it would add nothing */
            struct error ignored = ERROR_NONE;
            struct vec3 d;
            if (camera_unproject(camera, &d, q, &ignored) &&
                ray_meets_box(box_from_camera.translation, mat3_apply(box_from_camera.rotation, d), min_m, max_m))
                span_add(span, q, step + MARGIN_PX);
        }
}

static int clamp_px(double x, int low, int high)
{
    return x <= low ? low : x >= high ? high : (int)x;
}

struct rect footprint(const struct camera *camera, struct pose camera_from_box, struct vec3 min_m, struct vec3 max_m,
                      struct rect limits_px)
{
    struct vec3 corners[8];
    bool behind = true;
    for (int i = 0; i < 8; i++) {
        corners[i] = pose_apply(camera_from_box,
                                vec3(i & 4 ? max_m.x : min_m.x, i & 2 ? max_m.y : min_m.y, i & 1 ? max_m.z : min_m.z));
        behind = behind && corners[i].z <= 0;
    }
    if (behind && camera_invertible_angle_rad(camera) <= M_PI / 2) return (struct rect){ 0, 0, 0, 0 };

    struct pose box_from_camera = pose_inverse(camera_from_box);
    struct vec3 backward = vec3_scale(mat3_column(box_from_camera.rotation, 2), -1);
    struct span span = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    bool all = add_edges(&span, camera, corners);
    /* Around a camera within the box, or behind which it reaches, edges bound the wrong side. */
    if (!all || ray_meets_box(box_from_camera.translation, backward, min_m, max_m))
        add_grid(&span, camera, box_from_camera, min_m, max_m, limits_px);
    struct rect r = { clamp_px(floor(span.x0), limits_px.x0, limits_px.x1),
                      clamp_px(floor(span.y0), limits_px.y0, limits_px.y1),
                      clamp_px(ceil(span.x1), limits_px.x0, limits_px.x1),
                      clamp_px(ceil(span.y1), limits_px.y0, limits_px.y1) };
    return r.x0 < r.x1 && r.y0 < r.y1 ? r : (struct rect){ 0, 0, 0, 0 };
}

struct rect footprint_prism(const struct camera *camera, struct pose camera_from_world, const struct prism *prism)
{
    struct box3 box = prism_bounds(prism);
    return footprint(camera, camera_from_world, vec3(box.low[0], box.low[1], box.low[2]),
                     vec3(box.high[0], box.high[1], box.high[2]), (struct rect){ 0, 0, camera->width_px, camera->height_px });
}

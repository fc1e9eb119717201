#include "lib/view.h"

#include <assert.h>

#define GRID 48                   /* samples an axis, from edge to edge of the window */
#define OWN_AXIS_RAD (60 * M_PI / 180)
#define SPAN_RAD (150 * M_PI / 180)
#define MARGIN_PX 2               /* for what the samples miss between them, and for filters */
#define FINER 1.001               /* the same for density */
#define SIDE_MAX_PX 32767

static struct vec2 sample_at(struct rect window, int i, int j)
{
    return (struct vec2){ window.x0 + (double)(window.x1 - window.x0) * i / GRID,
                          window.y0 + (double)(window.y1 - window.y0) * j / GRID };
}

/* Largest angle between the axis and a ray; *farthest is its index. */
static double widest(struct vec3 axis, const struct vec3 *rays, int n, int *farthest)
{
    double least = INFINITY;
    for (int i = 0; i < n; i++) {
        double cosine = vec3_dot(axis, rays[i]);
        if (cosine < least) {
            least = cosine;
            *farthest = i;
        }
    }
    return acos(fmax(-1, fmin(1, least)));
}

/* The axis of the narrowest cone around the rays.
 * Src: Badoiu & Clarkson, Smaller core-sets for balls, 2003: step towards the farthest, ever less. */
static struct vec3 cone_axis(const struct vec3 *rays, int n)
{
    struct vec3 axis = rays[n / 2];
    for (int i = 3, far = 0; i < 200; i++) {
        widest(axis, rays, n, &far);
        axis = vec3_unit(vec3_add(axis, vec3_scale(vec3_sub(rays[far], axis), 1.0 / i)));
    }
    return axis;
}

/* The smallest turn that takes the axis to z. */
static struct mat3 turn_to(struct vec3 axis)
{
    double w = 1 + axis.z;
    if (w < 1e-12) return mat3_from_quat((struct quat){ 0, 1, 0, 0 });
    return mat3_from_quat((struct quat){ w, axis.y, -axis.x, 0 });
}

/* Where a ray crosses the plane one unit ahead of the view. */
static struct vec2 on_plane(struct mat3 view_from_camera, struct vec3 ray)
{
    struct vec3 p = mat3_apply(view_from_camera, ray);
    return (struct vec2){ p.x / p.z, p.y / p.z };
}

/* How many units of the view's plane a photograph pixel takes at q where it takes least. */
static bool least_stretch(double *stretch, const struct camera *camera, struct mat3 view_from_camera,
                          struct vec2 q, struct error *err)
{
    struct vec3 left, right, above, below;
    if (!camera_unproject(camera, &left, (struct vec2){ q.x - 0.5, q.y }, err) ||
        !camera_unproject(camera, &right, (struct vec2){ q.x + 0.5, q.y }, err) ||
        !camera_unproject(camera, &above, (struct vec2){ q.x, q.y - 0.5 }, err) ||
        !camera_unproject(camera, &below, (struct vec2){ q.x, q.y + 0.5 }, err))
        return false;
    struct vec2 l = on_plane(view_from_camera, left), r = on_plane(view_from_camera, right);
    struct vec2 a = on_plane(view_from_camera, above), b = on_plane(view_from_camera, below);
    double xx = r.x - l.x, xy = r.y - l.y, yx = b.x - a.x, yy = b.y - a.y;
    /* The smaller singular value of a 2x2 matrix. */
    *stretch = (hypot(xx + yy, xy - yx) - hypot(xx - yy, xy + yx)) / 2;
    return true;
}

static bool no_ray(const struct camera *camera, struct vec2 q, struct error *err)
{
    return error_set(err, ERR_INPUT,
                     "the lens (%s) maps no direction to pixel (%.1f, %.1f): it is one-to-one up to %.1f deg from its "
                     "axis; things must stay within that circle",
                     camera_model_name(camera->model), q.x, q.y, camera_invertible_angle_rad(camera) * 180 / M_PI);
}

static bool cover_lens(struct view *view, const struct camera *camera, struct rect window, double fineness, struct error *err)
{
    struct vec3 rays[(GRID + 1) * (GRID + 1)];
    int n = 0;
    for (int j = 0; j <= GRID; j++)
        for (int i = 0; i <= GRID; i++) {
            struct error none = ERROR_NONE;
            if (!camera_unproject(camera, &rays[n++], sample_at(window, i, j), &none))
                return no_ray(camera, sample_at(window, i, j), err);
        }

    int far;
    struct vec3 axis = vec3(0, 0, 1);
    if (widest(axis, rays, n, &far) > OWN_AXIS_RAD) axis = cone_axis(rays, n);
    double half = widest(axis, rays, n, &far);
    if (!(2 * half <= SPAN_RAD))
        return error_set(err, ERR_INPUT,
                         "the part of the photograph to render, x %d to %d, y %d to %d, spans %.0f deg; one view covers "
                         "150 deg at most: put fewer or nearer things into one scene",
                         window.x0, window.x1, window.y0, window.y1, 2 * half * 180 / M_PI);
    struct mat3 view_from_camera = turn_to(axis);

    double least = INFINITY;
    struct vec2 low = { INFINITY, INFINITY }, high = { -INFINITY, -INFINITY };
    for (int j = 0; j <= GRID; j++)
        for (int i = 0; i <= GRID; i++) {
            /* half a pixel inside: the outermost pixels' own centres and edges */
            struct vec2 q = sample_at(window, i, j);
            q.x = fmin(fmax(q.x, window.x0 + 0.5), window.x1 - 0.5);
            q.y = fmin(fmax(q.y, window.y0 + 0.5), window.y1 - 0.5);
            double stretch;
            struct error none = ERROR_NONE;
            if (!least_stretch(&stretch, camera, view_from_camera, q, &none)) return no_ray(camera, q, err);
            least = fmin(least, stretch);
            struct vec2 p = on_plane(view_from_camera, rays[j * (GRID + 1) + i]);
            low = (struct vec2){ fmin(low.x, p.x), fmin(low.y, p.y) };
            high = (struct vec2){ fmax(high.x, p.x), fmax(high.y, p.y) };
        }
    /* As fine as the photograph it must be; finer, as far as there is room. */
    double room_px = (SIDE_MAX_PX - 2 * MARGIN_PX - 1) / fmax(high.x - low.x, high.y - low.y);
    double focal_px = fmax(FINER / least, fmin(fineness * FINER / least, room_px));
    double width = ceil((high.x - low.x) * focal_px) + 2 * MARGIN_PX;
    double height = ceil((high.y - low.y) * focal_px) + 2 * MARGIN_PX;
    if (!(width <= SIDE_MAX_PX && height <= SIDE_MAX_PX))
        return error_set(err, ERR_INPUT,
                         "the lens (%s) is so uneven that a view of x %d to %d, y %d to %d takes %.0f x %.0f pixels; "
                         "%d a side are possible",
                         camera_model_name(camera->model), window.x0, window.x1, window.y0, window.y1, width, height,
                         SIDE_MAX_PX);
    *view = (struct view){ (int)width, (int)height, focal_px, focal_px, MARGIN_PX - low.x * focal_px,
                           MARGIN_PX - low.y * focal_px, view_from_camera, window, false };
    return true;
}

bool view_cover(struct view *view, const struct camera *camera, struct rect window_px, double fineness, struct error *err)
{
    assert(fineness >= 1 && window_px.x1 > window_px.x0 && window_px.y1 > window_px.y0);
    if (!camera_is_pinhole(camera)) return cover_lens(view, camera, window_px, fineness, err);
    struct camera_intrinsics in = camera_intrinsics(camera);
    *view = (struct view){ window_px.x1 - window_px.x0, window_px.y1 - window_px.y0, in.fx_px, in.fy_px,
                           in.cx_px - window_px.x0, in.cy_px - window_px.y0, mat3_identity(), window_px, true };
    return true;
}

bool view_from_photograph(const struct view *view, const struct camera *camera, struct vec2 *v_px,
                          struct vec2 q_px, struct error *err)
{
    if (view->aligned) {
        *v_px = (struct vec2){ q_px.x - view->window_px.x0, q_px.y - view->window_px.y0 };
        return true;
    }
    struct vec3 ray;
    if (!camera_unproject(camera, &ray, q_px, err)) return false;
    ray = mat3_apply(view->view_from_camera, ray);
    if (!(ray.z > 0)) return error_set(err, ERR_BEHIND_CAMERA, "the pixel lies behind the view");
    *v_px = (struct vec2){ view->fx_px * ray.x / ray.z + view->cx_px, view->fy_px * ray.y / ray.z + view->cy_px };
    return true;
}

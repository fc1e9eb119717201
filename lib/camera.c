#include "lib/camera.h"

#include <string.h>

static const struct { const char *name; int focals, params; const char *param_names; } models[CAMERA_MODEL_COUNT] = {
    [CAMERA_SIMPLE_PINHOLE] = { "SIMPLE_PINHOLE", 1, 3, "f, cx, cy" },
    [CAMERA_PINHOLE] = { "PINHOLE", 2, 4, "fx, fy, cx, cy" },
    [CAMERA_SIMPLE_RADIAL] = { "SIMPLE_RADIAL", 1, 4, "f, cx, cy, k" },
    [CAMERA_RADIAL] = { "RADIAL", 1, 5, "f, cx, cy, k1, k2" },
    [CAMERA_OPENCV] = { "OPENCV", 2, 8, "fx, fy, cx, cy, k1, k2, p1, p2" },
    [CAMERA_OPENCV_FISHEYE] = { "OPENCV_FISHEYE", 2, 8, "fx, fy, cx, cy, k1, k2, k3, k4" },
    [CAMERA_FULL_OPENCV] = { "FULL_OPENCV", 2, 12, "fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6" },
    [CAMERA_FOV] = { "FOV", 2, 5, "fx, fy, cx, cy, omega" },
    [CAMERA_SIMPLE_RADIAL_FISHEYE] = { "SIMPLE_RADIAL_FISHEYE", 1, 4, "f, cx, cy, k" },
    [CAMERA_RADIAL_FISHEYE] = { "RADIAL_FISHEYE", 1, 5, "f, cx, cy, k1, k2" },
    [CAMERA_THIN_PRISM_FISHEYE] = { "THIN_PRISM_FISHEYE", 2, 12, "fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, sx1, sy1" },
};

const char *camera_model_name(enum camera_model model) { return models[model].name; }

bool camera_model_from_name(enum camera_model *model, const char *name)
{
    for (int i = 0; i < CAMERA_MODEL_COUNT; i++)
        if (!strcmp(models[i].name, name)) {
            *model = (enum camera_model)i;
            return true;
        }
    return false;
}

int camera_model_param_count(enum camera_model model) { return models[model].params; }
const char *camera_model_param_names(enum camera_model model) { return models[model].param_names; }

struct camera_intrinsics camera_intrinsics(const struct camera *camera)
{
    int n = models[camera->model].focals;
    const double *p = camera->params;
    return (struct camera_intrinsics){ p[0], p[n - 1], p[n], p[n + 1] };
}

static bool is_fisheye(enum camera_model model)
{
    return model == CAMERA_OPENCV_FISHEYE || model == CAMERA_SIMPLE_RADIAL_FISHEYE ||
           model == CAMERA_RADIAL_FISHEYE || model == CAMERA_THIN_PRISM_FISHEYE;
}

bool camera_is_pinhole(const struct camera *camera)
{
    if (is_fisheye(camera->model)) return false;
    for (int i = models[camera->model].focals + 2; i < models[camera->model].params; i++)
        if (camera->params[i] != 0) return false;
    return true;
}

struct camera camera_scaled(const struct camera *camera, int width_px, int height_px)
{
    double sx = (double)width_px / camera->width_px, sy = (double)height_px / camera->height_px;
    struct camera scaled = { .model = camera->model, .width_px = width_px, .height_px = height_px };
    struct camera_intrinsics in = camera_intrinsics(camera);
    int focals = models[camera->model].focals, params = models[camera->model].params;
    const double *extra = camera->params + focals + 2;
    int extras = params - focals - 2;
    if (focals == 1 && sx != sy) {
        /* Each model of one focal length has a wider one of two, with its own
         * coefficients in the same places. */
        focals = 2;
        scaled.model = is_fisheye(camera->model) ? CAMERA_OPENCV_FISHEYE
                       : extras > 0              ? CAMERA_OPENCV
                                                 : CAMERA_PINHOLE;
    }
    double *p = scaled.params;
    p[0] = in.fx_px * sx;
    p[focals - 1] = in.fy_px * sy;
    p[focals] = in.cx_px * sx;
    p[focals + 1] = in.cy_px * sy;
    memcpy(p + focals + 2, extra, (size_t)extras * sizeof *extra);
    return scaled;
}

/* Every model but FOV as one: w is (x/z, y/z), or, for a fisheye, the same
 * direction with the length theta; s = |w|^2, and
 *   distorted w = w N(s) / D(s) + tangential and thin prism terms. */
#define N_DEGREE 4
#define D_DEGREE 3
#define SLOPE_DEGREE 6 /* rational lenses have N of degree 3 */

struct lens {
    struct camera_intrinsics in;
    bool fisheye, rational, tangential, fov, plain;
    double n[N_DEGREE + 1], d[D_DEGREE + 1];
    double p1, p2, sx1, sy1;
    double omega, stretch; /* FOV: stretch = 2 tan(omega / 2) */
};

static struct lens lens_of(const struct camera *camera)
{
    struct lens lens = { .in = camera_intrinsics(camera), .n[0] = 1, .d[0] = 1 };
    const double *k = camera->params + models[camera->model].focals + 2;
    lens.fisheye = is_fisheye(camera->model);
    switch (camera->model) {
    case CAMERA_SIMPLE_PINHOLE:
    case CAMERA_PINHOLE: lens.plain = true; return lens;
    case CAMERA_FOV:
        lens.omega = k[0];
        lens.stretch = 2 * tan(k[0] / 2);
        lens.fov = k[0] != 0;
        lens.plain = !lens.fov;
        return lens;
    case CAMERA_OPENCV_FISHEYE:
        lens.n[4] = k[3];
        lens.n[3] = k[2];
        /* fallthrough */
    case CAMERA_RADIAL:
    case CAMERA_RADIAL_FISHEYE:
        lens.n[2] = k[1];
        /* fallthrough */
    case CAMERA_SIMPLE_RADIAL:
    case CAMERA_SIMPLE_RADIAL_FISHEYE: lens.n[1] = k[0]; break;
    case CAMERA_THIN_PRISM_FISHEYE:
        lens.n[3] = k[4];
        lens.n[4] = k[5];
        lens.sx1 = k[6];
        lens.sy1 = k[7];
        break;
    case CAMERA_FULL_OPENCV:
        lens.n[3] = k[4];
        memcpy(lens.d + 1, k + 5, D_DEGREE * sizeof *k);
        lens.rational = lens.d[1] != 0 || lens.d[2] != 0 || lens.d[3] != 0;
        break;
    default: break;
    }
    if (camera->model == CAMERA_OPENCV || camera->model == CAMERA_FULL_OPENCV ||
        camera->model == CAMERA_THIN_PRISM_FISHEYE) {
        lens.n[1] = k[0];
        lens.n[2] = k[1];
        lens.p1 = k[2];
        lens.p2 = k[3];
        lens.tangential = lens.p1 != 0 || lens.p2 != 0 || lens.sx1 != 0 || lens.sy1 != 0;
    }
    return lens;
}

/* Whether the polynomial with the Bernstein coefficients b stays positive: its
 * graph lies in their hull, and halving closes the gap quadratically. */
static bool bernstein_positive(const double *b, int degree, int depth)
{
    if (!(b[0] > 0 && b[degree] > 0)) return false;
    bool hull = true;
    for (int i = 1; i < degree; i++) hull = hull && b[i] > 0;
    if (hull) return true;
    if (depth == 0) return false; /* it touches 0 */
    double left[SLOPE_DEGREE + 1], right[SLOPE_DEGREE + 1];
    memcpy(right, b, (size_t)(degree + 1) * sizeof *b);
    for (int i = 0; i <= degree; i++) { /* de Casteljau at the middle */
        left[i] = right[0];
        for (int j = 0; j < degree - i; j++) right[j] = (right[j] + right[j + 1]) / 2;
    }
    return bernstein_positive(left, degree, depth - 1) && bernstein_positive(right, degree, depth - 1);
}

/* Whether a polynomial with a[0] = 1 is positive over [0, h]. */
static bool positive_until(const double *a, int degree, double h)
{
    double power = h, scaled[SLOPE_DEGREE + 1] = { a[0] }, least = a[0];
    for (int j = 1; j <= degree; j++, power *= h) {
        scaled[j] = a[j] * power;
        least += fmin(scaled[j], 0);
    }
    if (least > 0) return true; /* what nearly every lens passes in its own image */
    double b[SLOPE_DEGREE + 1];
    for (int i = 0; i <= degree; i++) {
        double ratio = 1; /* C(i,j) / C(degree,j) */
        b[i] = 0;
        for (int j = 0; j <= i; j++) {
            b[i] += ratio * scaled[j];
            ratio *= (double)(i - j) / (degree - j);
        }
    }
    return bernstein_positive(b, degree, 48);
}

/* Whether the radial part is strictly increasing from the axis to rho = |w|. */
static bool increasing_until(const struct lens *lens, double rho)
{
    if (lens->plain) return true;
    if (lens->fov) return lens->stretch * lens->omega > 0;
    double slope[SLOPE_DEGREE + 1] = { 0 }, s = rho * rho;
    if (!lens->rational) {
        for (int i = 0; i <= N_DEGREE; i++) slope[i] = (1 + 2 * i) * lens->n[i];
        return positive_until(slope, N_DEGREE, s);
    }
    /* d/drho (rho N/D) has the sign of N D + 2s (N' D - N D') as long as D > 0. */
    for (int i = 0; i < N_DEGREE; i++)
        for (int j = 0; j <= D_DEGREE; j++) slope[i + j] += (1 + 2 * (i - j)) * lens->n[i] * lens->d[j];
    return positive_until(lens->d, D_DEGREE, s) && positive_until(slope, SLOPE_DEGREE, s);
}

/* R = N/D at s, and dR/ds. */
static double radial_factor(const struct lens *lens, double s, double *slope)
{
    const double *n = lens->n, *d = lens->d;
    double r = n[0] + s * (n[1] + s * (n[2] + s * (n[3] + s * n[4])));
    *slope = n[1] + s * (2 * n[2] + s * (3 * n[3] + s * 4 * n[4]));
    if (lens->rational) {
        double below = d[0] + s * (d[1] + s * (d[2] + s * d[3]));
        r /= below;
        *slope = (*slope - r * (d[1] + s * (2 * d[2] + s * 3 * d[3]))) / below;
    }
    return r;
}

/* Out: the distorted w, jacobian its derivative by w. */
static struct vec2 distort(const struct lens *lens, struct vec2 w, double jacobian[2][2])
{
    double u = w.x, v = w.y, uu = u * u, uv = u * v, vv = v * v, s = uu + vv, slope;
    double r = radial_factor(lens, s, &slope);
    double p1 = lens->p1, p2 = lens->p2, sx1 = lens->sx1, sy1 = lens->sy1;
    jacobian[0][0] = r + 2 * uu * slope + 2 * p1 * v + 6 * p2 * u + 2 * sx1 * u;
    jacobian[0][1] = 2 * uv * slope + 2 * p1 * u + 2 * p2 * v + 2 * sx1 * v;
    jacobian[1][0] = 2 * uv * slope + 2 * p1 * u + 2 * p2 * v + 2 * sy1 * u;
    jacobian[1][1] = r + 2 * vv * slope + 2 * p2 * u + 6 * p1 * v + 2 * sy1 * v;
    return (struct vec2){ u * r + 2 * p1 * uv + p2 * (s + 2 * uu) + sx1 * s,
                          v * r + 2 * p2 * uv + p1 * (s + 2 * vv) + sy1 * s };
}

static double determinant(double a[2][2]) { return a[0][0] * a[1][1] - a[0][1] * a[1][0]; }

static bool beyond(struct error *err)
{
    return error_set(err, ERR_BEHIND_CAMERA, "the point lies beyond the angle up to which the lens is one-to-one");
}

bool camera_project(const struct camera *camera, struct vec2 *q_px, struct vec3 p_camera, struct error *err)
{
    struct lens lens = lens_of(camera);
    struct vec2 w = { p_camera.x, p_camera.y };
    double off_axis = sqrt(w.x * w.x + w.y * w.y), scale;
    if (lens.fisheye) {
        double theta = atan2(off_axis, p_camera.z);
        scale = off_axis > 0 ? theta / off_axis : 0;
        if (off_axis == 0 && !(p_camera.z > 0))
            return error_set(err, ERR_BEHIND_CAMERA, "the point lies straight behind the camera");
    } else {
        if (!(p_camera.z > 0)) return error_set(err, ERR_BEHIND_CAMERA, "the point lies behind the camera");
        scale = 1 / p_camera.z;
    }
    w.x *= scale;
    w.y *= scale;
    if (!increasing_until(&lens, off_axis * scale)) return beyond(err);
    if (lens.fov) {
        double rho = off_axis * scale;
        double factor = rho > 0 ? atan(rho * lens.stretch) / (rho * lens.omega) : lens.stretch / lens.omega;
        w.x *= factor;
        w.y *= factor;
    } else if (!lens.plain) {
        double jacobian[2][2];
        w = distort(&lens, w, jacobian);
        if (lens.tangential && !(determinant(jacobian) > 0)) return beyond(err);
    }
    *q_px = (struct vec2){ lens.in.fx_px * w.x + lens.in.cx_px, lens.in.fy_px * w.y + lens.in.cy_px };
    return true;
}

/* Largest |w| that stands for a direction. Perspective models have no last one:
 * this is the angle of pi/2 to 1e-9 rad. */
static double rho_end(const struct lens *lens) { return lens->fisheye ? M_PI : 1e9; }

/* Solve rho N/D = target over the increasing part. When there is no solution,
 * *rho is where the increasing part ends. */
static bool undistort_radius(const struct lens *lens, double *rho, double target)
{
    double x = target, slope, r;
    for (int i = 0; i < 12 && x >= 0; i++) {
        r = radial_factor(lens, x * x, &slope);
        double step = (x * r - target) / (r + 2 * x * x * slope);
        x -= step;
        if (fabs(step) <= 1e-15 * x) {
            if (!(x <= rho_end(lens)) || !increasing_until(lens, x)) break;
            *rho = x;
            return true;
        }
    }
    /* Newton left the increasing part, or is slow near its end: halve. */
    double low = 0, high = fmin(fmax(target, 1), rho_end(lens));
    while (high < rho_end(lens) && increasing_until(lens, high) &&
           high * radial_factor(lens, high * high, &slope) < target) {
        low = high;
        high = fmin(2 * high, rho_end(lens));
    }
    for (int i = 0; i < 100 && high - low > 1e-16 * high; i++) {
        x = low + (high - low) / 2;
        if (increasing_until(lens, x) && x * radial_factor(lens, x * x, &slope) <= target)
            low = x;
        else
            high = x;
    }
    *rho = low;
    return fabs(low * radial_factor(lens, low * low, &slope) - target) <= 1e-13 * (1 + target);
}

/* Solve distort(w) = target near w, by Newton steps that are halved until the
 * residual falls. */
static bool undistort_tangential(const struct lens *lens, struct vec2 *w, struct vec2 target)
{
    double jacobian[2][2];
    struct vec2 at = *w, d = distort(lens, at, jacobian);
    double ex = d.x - target.x, ey = d.y - target.y, residual = ex * ex + ey * ey;
    for (int i = 0; i < 50 && residual > 0; i++) {
        double det = determinant(jacobian);
        if (!(fabs(det) > 0)) return false;
        double dx = (jacobian[1][1] * ex - jacobian[0][1] * ey) / det;
        double dy = (jacobian[0][0] * ey - jacobian[1][0] * ex) / det;
        double t = 1, next_residual = INFINITY;
        struct vec2 next = at;
        for (; t > 1e-6; t /= 2) {
            next = (struct vec2){ at.x - t * dx, at.y - t * dy };
            d = distort(lens, next, jacobian);
            ex = d.x - target.x;
            ey = d.y - target.y;
            next_residual = ex * ex + ey * ey;
            if (next_residual < residual) break;
        }
        if (!(next_residual < residual)) break; /* as near as doubles come, or stuck */
        at = next;
        residual = next_residual;
        if (dx * dx + dy * dy <= 1e-30 * (at.x * at.x + at.y * at.y)) break;
    }
    distort(lens, at, jacobian);
    double rho = sqrt(at.x * at.x + at.y * at.y);
    if (!(residual <= 1e-26 * (1 + target.x * target.x + target.y * target.y)) ||
        !(determinant(jacobian) > 0) || !(rho <= rho_end(lens)) || !increasing_until(lens, rho))
        return false;
    *w = at;
    return true;
}

bool camera_unproject(const struct camera *camera, struct vec3 *direction, struct vec2 q_px, struct error *err)
{
    struct lens lens = lens_of(camera);
    struct vec2 target = { (q_px.x - lens.in.cx_px) / lens.in.fx_px, (q_px.y - lens.in.cy_px) / lens.in.fy_px };
    double length = sqrt(target.x * target.x + target.y * target.y), rho = length;
    struct vec2 w = target;
    bool found = isfinite(length);
    if (lens.fov) {
        double angle = length * lens.omega;
        found = found && increasing_until(&lens, 0) && fabs(angle) < M_PI / 2;
        rho = tan(angle) / lens.stretch;
    } else if (found && !lens.plain && length > 0) {
        found = undistort_radius(&lens, &rho, length);
    }
    if (length > 0) {
        w.x *= rho / length;
        w.y *= rho / length;
    } else if (lens.fov) {
        rho = 0;
    }
    if (lens.tangential && isfinite(length)) {
        found = undistort_tangential(&lens, &w, target);
        rho = sqrt(w.x * w.x + w.y * w.y);
    }
    if (!found) return error_set(err, ERR_NOT_INVERTIBLE, "the lens maps no direction to this pixel");
    if (lens.fisheye) {
        double scale = rho > 0 ? sin(rho) / rho : 1;
        *direction = vec3(w.x * scale, w.y * scale, cos(rho));
    } else {
        double scale = 1 / sqrt(1 + rho * rho);
        *direction = vec3(w.x * scale, w.y * scale, scale);
    }
    return true;
}

double camera_invertible_angle_rad(const struct camera *camera)
{
    struct lens lens = lens_of(camera);
    double low = 0, high = lens.fisheye ? M_PI : M_PI / 2;
    if (increasing_until(&lens, rho_end(&lens))) return high;
    for (int i = 0; i < 60; i++) {
        double middle = low + (high - low) / 2;
        if (increasing_until(&lens, lens.fisheye ? middle : tan(middle)))
            low = middle;
        else
            high = middle;
    }
    return low;
}

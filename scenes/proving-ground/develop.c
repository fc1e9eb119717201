#include "develop.h"

#include "write_pov.h"

#include <stdlib.h>
#include <string.h>

/* Koschmieder: of the light, 5 % is left at the visibility. */
static void through_air(float rgb[3], double range_m, const struct proving_case *c)
{
    double t = c->visibility_m > 0 ? pow(0.05, range_m / c->visibility_m) : 1;
    for (int i = 0; i < 3; i++) rgb[i] = (float)((double)rgb[i] * c->k[i] * t + c->haze[i] * (1 - t));
}

static bool expose(struct image *out, const struct image *radiance, const struct image *range, const struct proving_case *c, struct error *err)
{
    if (!image_init(out, radiance->width_px, radiance->height_px, 3, PIXEL_F32, err)) return false;
    for (int y = 0; y < out->height_px; y++)
        for (int x = 0; x < out->width_px; x++) {
            float *to = image_f32(out, x, y);
            memcpy(to, image_f32(radiance, x, y), 3 * sizeof *to);
            through_air(to, (double)*image_u16(range, x, y) / 65535 * PROVING_RANGE_M, c);
        }
    return true;
}

static void bilinear(float rgb[3], const struct image *in, double x, double y)
{
    double fx = fmin(fmax(x - 0.5, 0), in->width_px - 1.001), fy = fmin(fmax(y - 0.5, 0), in->height_px - 1.001);
    int x0 = (int)fx, y0 = (int)fy;
    float ax = (float)(fx - x0), ay = (float)(fy - y0);
    const float *p = image_f32(in, x0, y0), *q = image_f32(in, x0, y0 + 1);
    for (int c = 0; c < 3; c++)
        rgb[c] = (1 - ay) * ((1 - ax) * p[c] + ax * p[c + 3]) + ay * ((1 - ax) * q[c] + ax * q[c + 3]);
}

/* Two samples a pixel each way, in the photograph's own distorted plane, with GUARD pixels around. */
enum { GUARD = 4 };
static bool distort(struct image *out, const struct image *in, const struct pinhole *pinhole, const struct camera *camera, struct error *err)
{
    if (!image_init(out, 2 * (camera->width_px + 2 * GUARD), 2 * (camera->height_px + 2 * GUARD), 3, PIXEL_F32, err)) return false;
    for (int y = 0; y < out->height_px; y++)
        for (int x = 0; x < out->width_px; x++) {
            struct vec3 d;
            struct vec2 q = { (x + 0.5) / 2 - GUARD, (y + 0.5) / 2 - GUARD };
            if (!camera_unproject(camera, &d, q, err)) return false;
            bilinear(image_f32(out, x, y), in, pinhole->cx_px + pinhole->f_px * d.x / d.z, pinhole->cy_px + pinhole->f_px * d.y / d.z);
        }
    return true;
}

/* The lens's softness and the area of a pixel, as one Gaussian; what the area of the pinhole's pixels (1/12) and sampling
 * between them (1/6) have softened already is left out. */
enum { TAPS = 12 };
static void softness_kernel(float weight[TAPS], double fineness)
{
    double variance = PROVING_SOFTNESS_PX * PROVING_SOFTNESS_PX + 1.0 / 12 - 0.25 / (fineness * fineness), sum = 0, w[TAPS];
    for (int i = 0; i < TAPS; i++) {
        double at = (i + 0.5 - TAPS / 2.0) / 2;
        w[i] = exp(-at * at / (2 * variance));
        sum += w[i];
    }
    for (int i = 0; i < TAPS; i++) weight[i] = (float)(w[i] / sum);
}

static bool soften(struct image *out, const struct image *fine, const struct camera *camera, double fineness, struct error *err)
{
    struct image rows;
    if (!image_init(&rows, camera->width_px, fine->height_px, 3, PIXEL_F32, err)) return false;
    bool ok = image_init(out, camera->width_px, camera->height_px, 3, PIXEL_F32, err);
    float weight[TAPS];
    softness_kernel(weight, fineness);
    for (int y = 0; ok && y < rows.height_px; y++)
        for (int x = 0; x < rows.width_px; x++)
            for (int i = 0; i < TAPS; i++)
                for (int c = 0; c < 3; c++)
                    image_f32(&rows, x, y)[c] += weight[i] * image_f32(fine, 2 * (x + GUARD) + 1 - TAPS / 2 + i, y)[c];
    for (int y = 0; ok && y < out->height_px; y++)
        for (int x = 0; x < out->width_px; x++)
            for (int i = 0; i < TAPS; i++)
                for (int c = 0; c < 3; c++)
                    image_f32(out, x, y)[c] += weight[i] * image_f32(&rows, x, 2 * (y + GUARD) + 1 - TAPS / 2 + i)[c];
    image_release(&rows);
    return ok;
}

static void vignette(struct image *linear)
{
    double cx = linear->width_px / 2.0, cy = linear->height_px / 2.0;
    for (int y = 0; y < linear->height_px; y++)
        for (int x = 0; x < linear->width_px; x++) {
            double dx = x + 0.5 - cx, dy = y + 0.5 - cy;
            double left = 1 - PROVING_VIGNETTING * (dx * dx + dy * dy) / (cx * cx + cy * cy);
            for (int c = 0; c < 3; c++) image_f32(linear, x, y)[c] *= (float)left;
        }
}

bool develop_light(struct image *linear, const struct image *radiance, const struct image *range, const struct pinhole *pinhole,
                   const struct camera *camera, const struct proving_case *c, struct error *err)
{
    struct image exposed = { 0 }, fine = { 0 };
    double fineness = pinhole->f_px / camera_intrinsics(camera).fx_px;
    bool ok = expose(&exposed, radiance, range, c, err) && distort(&fine, &exposed, pinhole, camera, err) &&
              soften(linear, &fine, camera, fineness, err);
    if (ok) vignette(linear);
    image_release(&exposed);
    image_release(&fine);
    return ok;
}

/* --- the sensor --- */

static uint64_t mix(uint64_t x) /* splitmix64's finish */
{
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

static double normal(uint64_t key)
{
    uint64_t a = mix(key + 0x9e3779b97f4a7c15u), b = mix(a + 0x9e3779b97f4a7c15u);
    double u = ((double)(a >> 11) + 0.5) / 9007199254740992.0, v = (double)(b >> 11) / 9007199254740992.0;
    return sqrt(-2 * log(u)) * cos(2 * M_PI * v);
}

bool develop_sensor(struct image *photograph, const struct image *linear, uint64_t key, struct error *err)
{
    struct image noisy;
    if (!image_init(&noisy, linear->width_px, linear->height_px, 3, PIXEL_F32, err)) return false;
    size_t n = (size_t)3 * (size_t)linear->width_px * (size_t)linear->height_px;
    const float *from = linear->data;
    float *to = noisy.data;
    for (size_t i = 0; i < n; i++) {
        double v = (double)from[i], sd = sqrt(PROVING_SHOT_NOISE * fmax(0, v) + PROVING_READ_NOISE * PROVING_READ_NOISE);
        to[i] = (float)(v + sd * normal(mix(key) + i));
    }
    bool ok = image_srgb_from_linear(photograph, &noisy, err);
    image_release(&noisy);
    return ok;
}

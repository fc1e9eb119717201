#include "compare_picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CHANGED_LEVELS 2.0
#define SHADED_SHARE 0.015
enum { EDGE_PX = 3, SSIM_REACH = 5, ENTITIES_MAX = 64 };

static double srgb_level(float linear)
{
    return 255 * (double)srgb_from_linear(linear < 0 ? 0 : linear > 1 ? 1 : linear);
}
static double luminance(const double v[3]) { return 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]; }
static double light_luminance(const struct image *light, int x, int y)
{
    const float *p = image_f32(light, x, y);
    return luminance((double[3]){ (double)p[0], (double)p[1], (double)p[2] });
}
static double pixel_luminance(const struct image *srgb, int x, int y)
{
    const uint8_t *p = image_u8(srgb, x, y);
    double v[3];
    for (int c = 0; c < 3; c++) v[c] = (double)linear_from_srgb((float)p[c] / 255);
    return luminance(v);
}

static bool changes(const struct picture_input *in, int x, int y)
{
    for (int c = 0; c < 3; c++) {
        double truth = srgb_level(image_f32(&in->truth_light, x, y)[c]) - srgb_level(image_f32(&in->photograph_light, x, y)[c]);
        int ours = image_u8(&in->result, x, y)[c] - image_u8(&in->photograph, x, y)[c];
        if (fabs(truth) > CHANGED_LEVELS || abs(ours) > CHANGED_LEVELS) return true;
    }
    return false;
}

static bool owned_within(const struct image *owner, int x, int y, int reach)
{
    for (int v = y - reach; v <= y + reach; v++)
        for (int u = x - reach; u <= x + reach; u++)
            if (u >= 0 && v >= 0 && u < owner->width_px && v < owner->height_px && *image_u8(owner, u, v)) return true;
    return false;
}
static bool wholly_owned(const struct image *owner, int x, int y)
{
    uint8_t id = *image_u8(owner, x, y);
    for (int v = y - 1; v <= y + 1; v++)
        for (int u = x - 1; u <= x + 1; u++)
            if (u < 0 || v < 0 || u >= owner->width_px || v >= owner->height_px || *image_u8(owner, u, v) != id) return false;
    return id != 0;
}

/* --- structural similarity: Wang et al. 2004, 11 x 11 Gaussian of 1.5 px, over luma --- */

static double luma(const struct image *srgb, int x, int y)
{
    x = x < 0 ? 0 : x >= srgb->width_px ? srgb->width_px - 1 : x;
    y = y < 0 ? 0 : y >= srgb->height_px ? srgb->height_px - 1 : y;
    const uint8_t *p = image_u8(srgb, x, y);
    return 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
}

static double ssim_at(const struct image *a, const struct image *b, int x, int y)
{
    double sum = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
    for (int v = -SSIM_REACH; v <= SSIM_REACH; v++)
        for (int u = -SSIM_REACH; u <= SSIM_REACH; u++) {
            double w = exp(-(u * u + v * v) / (2 * 1.5 * 1.5)), p = luma(a, x + u, y + v), q = luma(b, x + u, y + v);
            sum += w;
            ma += w * p;
            mb += w * q;
            aa += w * p * p;
            bb += w * q * q;
            ab += w * p * q;
        }
    ma /= sum;
    mb /= sum;
    double va = aa / sum - ma * ma, vb = bb / sum - mb * mb, cov = ab / sum - ma * mb;
    double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
    return (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
}

/* --- CIE 1976 L*a*b*, D65 --- */

static double lab_curve(double t) { return t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116; }

static void lab_of(double lab[3], const uint8_t *p)
{
    double v[3];
    for (int c = 0; c < 3; c++) v[c] = (double)linear_from_srgb((float)p[c] / 255);
    double x = lab_curve((0.4124564 * v[0] + 0.3575761 * v[1] + 0.1804375 * v[2]) / 0.95047);
    double y = lab_curve(luminance(v));
    double z = lab_curve((0.0193339 * v[0] + 0.1191920 * v[1] + 0.9503041 * v[2]) / 1.08883);
    lab[0] = 116 * y - 16;
    lab[1] = 500 * (x - y);
    lab[2] = 200 * (y - z);
}

static double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static void compare_colors(struct comparison *to, const struct picture_input *in)
{
    double truth[ENTITIES_MAX][3] = { { 0 } }, ours[ENTITIES_MAX][3] = { { 0 } }, n[ENTITIES_MAX] = { 0 }, sum = 0, count = 0;
    for (int y = 0; y < in->truth.height_px; y++)
        for (int x = 0; x < in->truth.width_px; x++) {
            if (!wholly_owned(&in->owner, x, y)) continue;
            double a[3], b[3];
            uint8_t id = *image_u8(&in->owner, x, y);
            lab_of(a, image_u8(&in->truth, x, y));
            lab_of(b, image_u8(&in->result, x, y));
            sum += distance(a, b);
            count++;
            if (id >= ENTITIES_MAX) continue;
            for (int c = 0; c < 3; c++) {
                truth[id][c] += a[c];
                ours[id][c] += b[c];
            }
            n[id]++;
        }
    to->color_error = sum / fmax(1, count);
    double means = 0, entities = 0;
    for (int id = 0; id < ENTITIES_MAX; id++) {
        if (n[id] < 1) continue;
        for (int c = 0; c < 3; c++) {
            truth[id][c] /= n[id];
            ours[id][c] /= n[id];
        }
        means += distance(truth[id], ours[id]);
        entities++;
    }
    to->mean_color_error = means / fmax(1, entities);
}

/* What is left of the ground's light, of 3 x 3 pixels. */
static double left_of_light(const struct image *with, const struct image *without, int x, int y,
                            double (*of)(const struct image *, int, int))
{
    double a = 0, b = 0;
    for (int v = y - 1; v <= y + 1; v++)
        for (int u = x - 1; u <= x + 1; u++) {
            a += of(with, u, v);
            b += of(without, u, v);
        }
    return a / fmax(b, 1e-4);
}

static void compare_shade(struct comparison *to, const struct picture_input *in)
{
    double error = 0, bias = 0, n = 0;
    for (int y = 1; y + 1 < in->truth.height_px; y++)
        for (int x = 1; x + 1 < in->truth.width_px; x++) {
            double truth = left_of_light(&in->truth_light, &in->photograph_light, x, y, light_luminance);
            double ours = left_of_light(&in->result, &in->photograph, x, y, pixel_luminance);
            if (fabs(truth - 1) <= SHADED_SHARE && fabs(ours - 1) <= SHADED_SHARE) continue;
            if (owned_within(&in->owner, x, y, EDGE_PX)) continue;
            error += fabs(ours - truth);
            bias += ours - truth;
            n++;
        }
    to->shade_px = n;
    to->shade_error = error / fmax(1, n);
    to->shade_bias = bias / fmax(1, n);
}

bool compare_picture(struct comparison *to, const struct picture_input *in, struct error *err)
{
    const struct image *all[] = { &in->photograph, &in->truth, &in->result, &in->photograph_light, &in->truth_light, &in->owner };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i]->width_px != in->truth.width_px || all[i]->height_px != in->truth.height_px ||
            all[i]->channels != (i == 5 ? 1 : 3))
            return error_set(err, ERR_INPUT, "pictures of different sizes are compared");
    double square = 0, similar = 0, n = 0;
    for (int y = 0; y < in->truth.height_px; y++)
        for (int x = 0; x < in->truth.width_px; x++) {
            if (!changes(in, x, y)) continue;
            for (int c = 0; c < 3; c++) {
                double d = image_u8(&in->truth, x, y)[c] - image_u8(&in->result, x, y)[c];
                square += d * d / 3;
            }
            similar += ssim_at(&in->truth, &in->result, x, y);
            n++;
        }
    if (n < 1) return error_set(err, ERR_INPUT, "neither truth nor result changes anything");
    to->changed_px = n;
    to->psnr_db = 10 * log10(255 * 255 / fmax(square / n, 1e-6));
    to->ssim = similar / n;
    compare_shade(to, in);
    compare_colors(to, in);
    return true;
}

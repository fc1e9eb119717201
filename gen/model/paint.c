#include "gen/model/paint.h"

#include "lib/luminance.h"
#include "lib/vec.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* CIE 1976 L*a*b*, D65: distances in it are about those that people see. */
struct lab { double l, a, b; };

static double lab_curve(double t)
{
    return t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116;
}

static struct lab lab_from_linear(const float rgb[3])
{
    double r = (double)rgb[0], g = (double)rgb[1], b = (double)rgb[2];
    double x = lab_curve((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
    double y = lab_curve(luminance_of_f32(rgb));
    double z = lab_curve((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
    return (struct lab){ 116 * y - 16, 500 * (x - y), 200 * (y - z) };
}

static double ramp(double from, double to, double x)
{
    double t = (x - from) / (to - from);
    t = t > 0 ? t < 1 ? t : 1 : 0;
    return t * t * (3 - 2 * t);
}

/* A point of the surface: its texel, and how much surface it stands for. */
struct sample { size_t pixel; double area; };

/* Area, but none of what looks down: the underbody is large, dark and never painted. */
static double seen_area(const struct mesh *mesh, const uint32_t t[3])
{
    struct vec3 p[3];
    for (int k = 0; k < 3; k++) {
        const float *v = mesh->position_m[t[k]];
        p[k] = vec3((double)v[0], (double)v[1], (double)v[2]);
    }
    struct vec3 twice = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    return twice.z < -0.5 * vec3_norm(twice) ? 0 : vec3_norm(twice) / 2;
}

/* SAMPLES points evenly over each triangle that shows the material. */
enum { SAMPLES = 36 };

static bool sample_surface(struct sample **samples, size_t *count, const struct image *image, const struct model *model, size_t material, struct error *err)
{
    size_t triangles = 0, n = 0;
    for (size_t i = 0; i < model->mesh_count; i++)
        if (model->meshes[i].material == material && model->meshes[i].uv) triangles += model->meshes[i].triangles;
    struct sample *out = malloc((triangles * SAMPLES + 1) * sizeof *out);
    if (!out) return error_set(err, ERR_MEMORY, "no memory for a texture's colours");
    for (size_t i = 0; i < model->mesh_count; i++) {
        const struct mesh *mesh = &model->meshes[i];
        for (size_t j = 0; mesh->material == material && mesh->uv && j < mesh->triangles; j++) {
            const uint32_t *t = mesh->triangle[j];
            double share = seen_area(mesh, t) / SAMPLES;
            for (int k = 0; k < SAMPLES; k++) {
                /* 8 rows of a triangular grid hold 36 points; each lies inside its cell */
                int row = (int)((sqrt(8.0 * k + 1) - 1) / 2), column = k - row * (row + 1) / 2;
                double b = (column + 1.0 / 3) / 8, c = (7 - row + 1.0 / 3) / 8, a = 1 - b - c;
                double u = a * (double)mesh->uv[t[0]][0] + b * (double)mesh->uv[t[1]][0] + c * (double)mesh->uv[t[2]][0];
                double v = a * (double)mesh->uv[t[0]][1] + b * (double)mesh->uv[t[1]][1] + c * (double)mesh->uv[t[2]][1];
                size_t x = (size_t)((u - floor(u)) * image->width_px), y = (size_t)((1 - v - floor(1 - v)) * image->height_px);
                if (x >= (size_t)image->width_px) x = (size_t)image->width_px - 1;
                if (y >= (size_t)image->height_px) y = (size_t)image->height_px - 1;
                out[n++] = (struct sample){ y * (size_t)image->width_px + x, share };
            }
        }
    }
    *samples = out;
    *count = n;
    return true;
}

/* Does the alpha channel of an opaque material mark something: two values, both used? */
static bool alpha_marks_paint(const struct image *texture, const struct material *material)
{
    if (texture->channels < 4 || material->alpha_mode != ALPHA_OPAQUE) return false;
    size_t n = (size_t)texture->width_px * (size_t)texture->height_px, low = 0, high = 0;
    const uint8_t *p = texture->data;
    for (size_t i = 0; i < n; i++) {
        low += p[4 * i + 3] < 16;
        high += p[4 * i + 3] > 239;
    }
    return low + high > n * 95 / 100 && low > n / 50 && high > n / 50;
}

/* The colour that covers most of the surface: the fullest cell of a histogram whose cells overlap.
 * What is nearly black counts less, being glass, grille, wheel house and load bed on most vehicles. */
static struct lab dominant_color(const float *linear, const struct sample *samples, size_t count)
{
    enum { LEVELS = 12, CHROMAS = 24 };
    static const double l_step = 100.0 / LEVELS, c_step = 10;
    static const double black_l = 30, black_weight = 0.25;
    double weight[LEVELS][CHROMAS][CHROMAS] = { { { 0 } } };
    for (size_t i = 0; i < count; i++) {
        struct lab c = lab_from_linear(linear + 3 * samples[i].pixel);
        double at[3] = { c.l / l_step, c.a / c_step + CHROMAS / 2.0, c.b / c_step + CHROMAS / 2.0 };
        int cell[3], limit[3] = { LEVELS, CHROMAS, CHROMAS };
        for (int k = 0; k < 3; k++) cell[k] = at[k] < 0 ? 0 : at[k] >= limit[k] ? limit[k] - 1 : (int)at[k];
        weight[cell[0]][cell[1]][cell[2]] += samples[i].area * (c.l < black_l ? black_weight : 1);
    }
    double best = -1;
    int peak[3] = { 0, 0, 0 };
    for (int l = 0; l < LEVELS - 1; l++)
        for (int a = 0; a < CHROMAS - 1; a++)
            for (int b = 0; b < CHROMAS - 1; b++) {
                double sum = 0;
                for (int k = 0; k < 8; k++) sum += weight[l + (k & 1)][a + (k >> 1 & 1)][b + (k >> 2)];
                if (sum > best) best = sum, peak[0] = l, peak[1] = a, peak[2] = b;
            }
    struct lab mean = { 0, 0, 0 };
    double total = 0;
    for (size_t i = 0; i < count; i++) {
        struct lab c = lab_from_linear(linear + 3 * samples[i].pixel);
        bool inside = fabs(c.l / l_step - (peak[0] + 1)) <= 1 && fabs(c.a / c_step + CHROMAS / 2.0 - (peak[1] + 1)) <= 1 &&
                      fabs(c.b / c_step + CHROMAS / 2.0 - (peak[2] + 1)) <= 1;
        if (!inside) continue;
        double w = samples[i].area;
        mean = (struct lab){ mean.l + w * c.l, mean.a + w * c.a, mean.b + w * c.b };
        total += w;
    }
    return total > 0 ? (struct lab){ mean.l / total, mean.a / total, mean.b / total } : mean;
}

static double luminance_from_l(double l)
{
    double f = (l + 16) / 116;
    return l > 8 ? f * f * f : l * 27 / 24389;
}

/* How much of a texel is body, judged by its colour: of the body's hue, and neither so dark that it
 * is glass or a tyre, nor many times as light. */
static double body_share(const float rgb[3], struct lab body, double body_luminance)
{
    double ratio = luminance_of_f32(rgb) / body_luminance, light = ramp(0.12, 0.3, ratio) * ramp(8, 4, ratio);
    if (light == 0) return 0;
    struct lab c = lab_from_linear(rgb);
    double shade = c.l > 1 && body.l > 1 ? fmin(c.l / body.l, 1) : 1; /* chroma fades with light */
    double distance = hypot(c.a - body.a * shade, c.b - body.b * shade);
    return light * ramp(24, 12, distance);
}

struct level { double luminance, area; };

static int by_luminance(const void *a, const void *b)
{
    double d = ((const struct level *)a)->luminance - ((const struct level *)b)->luminance;
    return (d > 0) - (d < 0);
}

/* The brightness of lit body: what a quarter of it is lighter than. 0 when there is none. */
static double lit_luminance(const float *linear, const float *share, const struct sample *samples, size_t count, struct level *levels)
{
    double total = 0, sum = 0;
    for (size_t i = 0; i < count; i++) {
        levels[i] = (struct level){ luminance_of_f32(linear + 3 * samples[i].pixel), samples[i].area * (double)share[samples[i].pixel] };
        total += levels[i].area;
    }
    qsort(levels, count, sizeof *levels, by_luminance);
    for (size_t i = 0; i < count; i++)
        if (levels[i].area > 0 && (sum += levels[i].area) >= 0.75 * total) return levels[i].luminance;
    return 0;
}

bool paint_body(struct image *linear, const struct image *texture, const struct model *model, size_t material,
                const double paint[3], struct error *err)
{
    size_t pixels = (size_t)texture->width_px * (size_t)texture->height_px, count = 0;
    struct sample *samples = NULL;
    struct level *levels = NULL;
    float *rgb = linear->data, *share = calloc(pixels, sizeof *share);
    if (!share) return error_set(err, ERR_MEMORY, "no memory for a texture's colours");
    if (!sample_surface(&samples, &count, texture, model, material, err)) goto out;
    if (!(levels = malloc((count + 1) * sizeof *levels))) {
        error_set(err, ERR_MEMORY, "no memory for a texture's colours");
        goto out;
    }
    if (alpha_marks_paint(texture, &model->materials[material])) {
        const uint8_t *p = texture->data;
        for (size_t i = 0; i < pixels; i++) share[i] = (float)p[4 * i + 3] / 255;
    } else {
        struct lab body = dominant_color(rgb, samples, count);
        double body_luminance = fmax(luminance_from_l(body.l), 1e-3);
        for (size_t i = 0; i < pixels; i++) share[i] = (float)body_share(rgb + 3 * i, body, body_luminance);
    }
    double lit = lit_luminance(rgb, share, samples, count, levels);
    double lightest = fmax(paint[0], fmax(paint[1], paint[2]));
    for (size_t i = 0; lit > 0 && i < pixels; i++) {
        double s = fmin(luminance_of_f32(rgb + 3 * i) / lit, lightest > 0 ? 1 / lightest : 1);
        for (int c = 0; c < 3; c++) rgb[3 * i + (size_t)c] += share[i] * ((float)(paint[c] * s) - rgb[3 * i + (size_t)c]);
    }
out:
    free(samples);
    free(levels);
    free(share);
    return err->code == ERR_OK;
}

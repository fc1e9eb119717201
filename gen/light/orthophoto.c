#include "gen/light/orthophoto.h"

#include "gen/light/push_pull.h"
#include "gen/light/sky_image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TEXEL_M 0.0625       /* finer than what a moving body's paint shows of the ground */
#define TEXELS_MAX (1 << 20) /* beyond, texels grow */
#define FADE_M 4.0           /* at the end of the reach */
#define FINEST 3             /* samples along a texel's side, at most */
#define GRID 64              /* samples of the picture along its width, for its median */
#define SAMPLES_MIN 20
#define HEADROOM_M 2.5       /* ground lies at most so high above the foot of an entity beside it */
#define OFF_GROUND_M 0.3     /* the mesh is rough: what lies this close does not hide or shade */

struct texel {
    float weight;            /* 0 beyond the reach of all entities */
    float trust;             /* in what the picture shows of it */
    float rgb[3];            /* radiance in the picture times trust; in the end the albedo */
    float own[3];            /* linear colour of the place */
    uint16_t owner;          /* the entity that it is nearest to */
    bool known, shaded;      /* the place is there; keeps the sun from it */
};

struct sheet {
    const struct orthophoto_input *in;
    double texel_m, open[3], sky[3]; /* irradiance / pi of the ground, and the sky's part */
    struct vec2 low_m;
    int width, height;               /* whole texels of `bouncing` */
    struct texel *texels;
};

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, size_t n)
{
    qsort(values, n, sizeof *values, ascending);
    return values[n / 2];
}

/* --- light of the ground --- */

enum { RAYS = 8 }; /* for a texel each */

/* What a wet ground only mirrors is taken away from its radiance. */
static void take_mirrored(double rgb[3], const struct orthophoto_input *in, struct vec3 p)
{
    double sky[3];
    if (in->wet.reflection <= 0 || !in->ground) return;
    wet_sky(sky, &in->wet, in->light, in->ground->normal, vec3_unit(vec3_sub(in->seen->world_from_camera.translation, p)), RAYS);
    for (int c = 0; c < 3; c++) rgb[c] = fmax(0, rgb[c] - sky[c]);
}

static void ground_radiance(const struct orthophoto_input *in, double rgb[3], struct vec2 q_px, struct vec3 p)
{
    seen_radiance(in->seen, rgb, q_px);
    seen_clear_air(in->seen, rgb, vec3_norm(vec3_sub(p, in->seen->world_from_camera.translation)));
    take_mirrored(rgb, in, p);
}

/* The ground that a pixel position shows, unless it is too far away to be told from what stands there. */
static bool ground_at(const struct orthophoto_input *in, struct vec3 *p, struct vec2 q_px)
{
    const struct seen *seen = in->seen;
    struct error ignored = ERROR_NONE;
    struct vec3 ray, eye = seen->world_from_camera.translation;
    if (!camera_unproject(seen->camera, &ray, q_px, &ignored)) return false;
    if (in->place) {
        double z = (double)*image_f32(in->place_depth, (int)q_px.x, (int)q_px.y);
        if (!isfinite(z)) return false;
        *p = pose_apply(seen->world_from_camera, vec3_scale(ray, z / ray.z));
        return true;
    }
    return plane_intersect(in->ground, p, eye, mat3_apply(seen->world_from_camera.rotation, ray)) &&
           hypot(p->x - eye.x, p->y - eye.y) < seen_ground_reach(seen, eye.z - plane_height(in->ground, eye.x, eye.y));
}

/* The median over the picture: it stays the same while somebody passes. */
static void find_elsewhere(struct orthophoto *out, const struct sheet *sheet, double *scratch)
{
    const struct orthophoto_input *in = sheet->in;
    const struct camera *camera = in->seen->camera;
    size_t n = 0;
    double step = fmax(1, (double)camera->width_px / GRID);
    memcpy(out->elsewhere, in->ground_albedo, sizeof out->elsewhere);
    for (double y = step / 2; y < camera->height_px && n < (size_t)GRID * GRID; y += step)
        for (double x = step / 2; x < camera->width_px && n < (size_t)GRID * GRID; x += step) {
            struct vec3 p;
            struct vec2 q = { x, y };
            double rgb[3];
            if (seen_trust(in->seen, q) < 0.5 || !ground_at(in, &p, q)) continue;
            ground_radiance(in, rgb, q, p);
            for (size_t c = 0; c < 3; c++) scratch[c * GRID * GRID + n] = rgb[c] / sheet->open[c];
            n++;
        }
    for (size_t c = 0; c < 3 && n >= SAMPLES_MIN; c++) out->elsewhere[c] = fmin(1, median(scratch + c * GRID * GRID, n));
}

/* How the place's own colours become the light that the picture shows there. */
static void find_gain(struct orthophoto *out, const struct sheet *sheet, double *scratch)
{
    size_t texels = (size_t)sheet->width * (size_t)sheet->height, n = 0, stride = 1 + texels / (GRID * GRID);
    for (size_t i = 0; i < texels; i += stride) {
        const struct texel *t = &sheet->texels[i];
        if (!t->known || t->trust < 0.99f) continue;
        for (size_t c = 0; c < 3; c++) scratch[c * GRID * GRID + n] = (double)t->rgb[c] / fmax((double)t->own[c], 1e-3);
        n++;
    }
    for (size_t c = 0; c < 3; c++)
        out->color_gain[c] = n >= SAMPLES_MIN ? median(scratch + c * GRID * GRID, n) : 1 / sheet->in->seen->k[c];
}

/* --- texels --- */

static double reach_of(const struct entity *e)
{
    struct vec3 size = vec3_sub(e->model->max_m, e->model->min_m);
    return hypot(size.x, size.y) / 2 + ORTHOPHOTO_REACH_M;
}

double orthophoto_whole(const struct entity *entity) { return reach_of(entity) - FADE_M; }

/* A window round the entities, at places that do not move with them. */
static void lay_window(struct sheet *sheet)
{
    const struct orthophoto_input *in = sheet->in;
    struct vec2 low = { INFINITY, INFINITY }, high = { -INFINITY, -INFINITY };
    for (size_t i = 0; i < in->n; i++) {
        struct vec3 p = in->entities[i].world_from_entity.translation;
        double reach = reach_of(&in->entities[i]);
        low = (struct vec2){ fmin(low.x, p.x - reach), fmin(low.y, p.y - reach) };
        high = (struct vec2){ fmax(high.x, p.x + reach), fmax(high.y, p.y + reach) };
    }
    sheet->texel_m = TEXEL_M;
    while ((high.x - low.x) * (high.y - low.y) > TEXELS_MAX * sheet->texel_m * sheet->texel_m) sheet->texel_m *= 2;
    /* A border of one coarse texel belongs to no entity. */
    double block = ORTHOPHOTO_COARSE * sheet->texel_m;
    sheet->low_m = (struct vec2){ (floor(low.x / block) - 1) * block, (floor(low.y / block) - 1) * block };
    sheet->width = ORTHOPHOTO_COARSE * (int)lround(ceil(high.x / block) + 1 - sheet->low_m.x / block);
    sheet->height = ORTHOPHOTO_COARSE * (int)lround(ceil(high.y / block) + 1 - sheet->low_m.y / block);
}

/* Row 0 is the northmost. */
static struct vec2 texel_middle(const struct sheet *sheet, int x, int y)
{
    return (struct vec2){ sheet->low_m.x + (x + 0.5) * sheet->texel_m, sheet->low_m.y + (sheet->height - y - 0.5) * sheet->texel_m };
}

/* The texels in reach of an entity, and how far they fade into what is elsewhere. */
static void weigh(struct sheet *sheet, uint16_t entity)
{
    const struct entity *e = &sheet->in->entities[entity];
    struct vec3 p = e->world_from_entity.translation;
    double reach = reach_of(e), m = sheet->texel_m;
    int x0 = (int)((p.x - reach - sheet->low_m.x) / m), x1 = (int)((p.x + reach - sheet->low_m.x) / m);
    int y0 = sheet->height - 1 - (int)((p.y + reach - sheet->low_m.y) / m), y1 = sheet->height - 1 - (int)((p.y - reach - sheet->low_m.y) / m);
    for (int y = y0; y <= y1; y++)
        for (int x = x0; x <= x1; x++) {
            struct vec2 at = texel_middle(sheet, x, y);
            float weight = (float)fmin(1, (reach - hypot(at.x - p.x, at.y - p.y)) / FADE_M);
            struct texel *t = &sheet->texels[(size_t)y * (size_t)sheet->width + (size_t)x];
            if (weight > t->weight) {
                t->weight = weight;
                t->owner = entity;
            }
        }
}

/* Height of the ground at a texel, and what of the picture's light it can have. False where the place has a hole. */
static bool stand(struct texel *t, double *z_m, bool *visible, const struct sheet *sheet, struct vec2 at)
{
    const struct orthophoto_input *in = sheet->in;
    *visible = true;
    if (!in->place) {
        *z_m = plane_height(in->ground, at.x, at.y);
        return true;
    }
    struct static_hit hit;
    struct vec3 down = vec3(0, 0, -1), eye = in->seen->world_from_camera.translation;
    struct vec3 from = vec3(at.x, at.y, in->entities[t->owner].world_from_entity.translation.z + HEADROOM_M);
    static_mesh_hits(in->place, &hit, from, &down, 1);
    if (!isfinite(hit.range_m)) return false;
    t->known = true;
    static_mesh_color(in->place, t->own, &hit, sheet->texel_m);
    struct vec3 p = vec3(at.x, at.y, from.z - hit.range_m), to_eye = vec3_sub(eye, p);
    double range = vec3_norm(to_eye);
    *z_m = p.z;
    struct vec2 q;
    *visible = seen_project(in->seen, &q, p) &&
               !seen_beside_nearer(in->seen, in->place_depth, q, p, static_mesh_normal(in->place, hit.triangle)) &&
               !static_mesh_blocks(in->place, p, vec3_scale(to_eye, 1 / range), OFF_GROUND_M, range);
    t->shaded = in->light->has_sun && static_mesh_blocks(in->place, p, in->light->sun_direction, OFF_GROUND_M, 1000);
    return true;
}

static void look(struct texel *t, const struct sheet *sheet, int x, int y)
{
    const struct orthophoto_input *in = sheet->in;
    struct vec2 at = texel_middle(sheet, x, y), q;
    double z;
    bool visible;
    if (!stand(t, &z, &visible, sheet, at) || !visible) return;
    double range = vec3_norm(vec3_sub(vec3(at.x, at.y, z), in->seen->world_from_camera.translation));
    int n = (int)fmin(fmax(ceil(sheet->texel_m / range / in->seen->pixel_rad / 3), 1), FINEST);
    double step = sheet->texel_m / n, first = -(n - 1) / 2.0 * step, sum[3] = { 0, 0, 0 }, trust = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            struct vec2 s = { at.x + first + i * step, at.y + first + j * step };
            struct vec3 p = vec3(s.x, s.y, in->place ? z : plane_height(in->ground, s.x, s.y));
            double rgb[3], trusted = seen_project(in->seen, &q, p) ? seen_trust(in->seen, q) : 0;
            if (trusted <= 0) continue;
            ground_radiance(in, rgb, q, p);
            for (int c = 0; c < 3; c++) sum[c] += trusted * rgb[c];
            trust += trusted;
        }
    for (int c = 0; c < 3; c++) t->rgb[c] = (float)(sum[c] / (n * n));
    t->trust = (float)(trust / (n * n));
}

/* The place keeps the sun away, and the radiance is that of usual ground without it rather than with it: the shade of a
 * rough mesh does not end where the real one does. */
static bool in_shade(const struct texel *t, const struct sheet *sheet, const double radiance[3], const double usual[3])
{
    double bright = luminance_of(radiance) / luminance_of(usual);
    return t->shaded && bright * bright < luminance_of(sheet->sky) * luminance_of(sheet->open);
}

/* From radiance to albedo times the trust in it, its place's own colours beside what the picture shows. */
static void weigh_albedo(float rgbw[4], size_t i, const struct sheet *sheet, const struct orthophoto *out)
{
    const struct texel *t = &sheet->texels[i];
    struct vec2 at = texel_middle(sheet, (int)(i % (size_t)sheet->width), (int)(i / (size_t)sheet->width));
    double light[3], sun = sheet->in->sun ? sun_share_at(sheet->in->sun, at) : 1;
    double trust = t->known ? 1 : (double)t->trust, radiance[3];
    if (trust <= 0) return;
    for (int c = 0; c < 3; c++) {
        radiance[c] = (double)t->rgb[c];
        if (t->known) radiance[c] += (1 - (double)t->trust) * (double)t->own[c] * out->color_gain[c];
        radiance[c] /= trust;
    }
    if (in_shade(t, sheet, radiance, out->elsewhere)) sun = 0;
    for (int c = 0; c < 3; c++) light[c] = sheet->sky[c] + sun * (sheet->open[c] - sheet->sky[c]);
    for (int c = 0; c < 3; c++) rgbw[c] = (float)(trust * fmin(1, radiance[c] / light[c]));
    rgbw[3] = (float)trust;
}

/* Every texel's albedo: what is not seen as what is round it, and all of it fading into what is elsewhere. */
static bool settle(const struct sheet *sheet, const struct orthophoto *out, struct error *err)
{
    size_t n = (size_t)sheet->width * (size_t)sheet->height;
    float (*rgbw)[4] = calloc(n, sizeof *rgbw);
    if (!rgbw) return error_set(err, ERR_MEMORY, "no memory for the ground round the entities");
    for (size_t i = 0; i < n; i++)
        if (sheet->texels[i].weight > 0) weigh_albedo(rgbw[i], i, sheet, out);
    bool ok = push_pull(rgbw, sheet->width, sheet->height, err);
    for (size_t i = 0; ok && i < n; i++) {
        double weight = (double)(sheet->texels[i].weight * rgbw[i][3]);
        for (int c = 0; c < 3; c++)
            sheet->texels[i].rgb[c] = (float)((double)(sheet->texels[i].weight * rgbw[i][c]) + (1 - weight) * out->elsewhere[c]);
    }
    free(rgbw);
    return ok;
}

/* --- images --- */

/* Means over squares of texels. */
static void draw(struct image *image, const struct sheet *sheet, int square)
{
    for (int y = 0; y < image->height_px; y++)
        for (int x = 0; x < image->width_px; x++) {
            double sum[3] = { 0, 0, 0 };
            for (int j = 0; j < square; j++)
                for (int i = 0; i < square; i++)
                    for (int c = 0; c < 3; c++)
                        sum[c] += (double)sheet->texels[(size_t)(y * square + j) * (size_t)sheet->width + (size_t)(x * square + i)].rgb[c];
            for (int c = 0; c < 3; c++)
                image_u8(image, x, y)[c] = (uint8_t)(srgb_from_linear((float)(sum[c] / (square * square))) * 255 + 0.5f);
        }
}

bool orthophoto_create(struct orthophoto *orthophoto, const struct orthophoto_input *in, struct error *err)
{
    struct orthophoto out = { 0 };
    struct sheet sheet = { .in = in };
    struct vec3 normal = in->place ? vec3(0, 0, 1) : in->ground->normal;
    light_irradiance(sheet.open, in->light, normal);
    light_sky_irradiance(sheet.sky, in->light, normal);
    lay_window(&sheet);
    size_t n = (size_t)sheet.width * (size_t)sheet.height;
    double *scratch = malloc(3 * GRID * GRID * sizeof *scratch);
    sheet.texels = calloc(n, sizeof *sheet.texels);
    bool ok = (scratch && sheet.texels) || error_set(err, ERR_MEMORY, "no memory for the ground round the entities");
    if (ok) {
        for (size_t i = 0; i < in->n; i++) weigh(&sheet, (uint16_t)i);
        for (size_t i = 0; i < n; i++)
            if (sheet.texels[i].weight > 0) look(&sheet.texels[i], &sheet, (int)(i % (size_t)sheet.width), (int)(i / (size_t)sheet.width));
        find_elsewhere(&out, &sheet, scratch);
        find_gain(&out, &sheet, scratch);
        ok = settle(&sheet, &out, err);
    }
    ok = ok && image_init(&out.mirrored, sheet.width, sheet.height, 3, PIXEL_U8, err) &&
         image_init(&out.bouncing, sheet.width / ORTHOPHOTO_COARSE, sheet.height / ORTHOPHOTO_COARSE, 3, PIXEL_U8, err);
    if (ok) {
        draw(&out.mirrored, &sheet, 1);
        draw(&out.bouncing, &sheet, ORTHOPHOTO_COARSE);
        out.low_m = sheet.low_m;
        out.high_m = (struct vec2){ sheet.low_m.x + sheet.width * sheet.texel_m, sheet.low_m.y + sheet.height * sheet.texel_m };
        *orthophoto = out;
    } else
        orthophoto_release(&out);
    free(sheet.texels);
    free(scratch);
    return ok;
}

void orthophoto_release(struct orthophoto *orthophoto)
{
    image_release(&orthophoto->mirrored);
    image_release(&orthophoto->bouncing);
}

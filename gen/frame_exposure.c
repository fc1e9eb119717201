#include "gen/frame_impl.h"

#include "gen/estimate/lit_ground.h"
#include "gen/light/enclosed.h"
#include "gen/sunlit.h"
#include "lib/air.h"
#include "lib/file.h"
#include "lib/photograph.h"

#include <math.h>
#include <stdlib.h>

/* Over a place, of the ground at these pixels as the place leaves it the sky; else of a plane in the open. */
static bool ground_irradiance(double rgb[3], const struct frame *f, const struct vec2 *q_px, size_t n, struct error *err)
{
    struct vec3 *points_m = calloc(n + 1, sizeof *points_m);
    size_t known = 0;
    if (!points_m) return error_set(err, ERR_MEMORY, "no memory for an exposure");
    for (size_t i = 0; f->stage->mesh && i < n; i++)
        if (frame_ground_at(&points_m[known], f, q_px[i])) known++;
    if (known) enclosed_irradiance(rgb, f->context->light, f->stage->mesh, points_m, known);
    else light_irradiance(rgb, f->context->light, f->scene->ground.normal);
    free(points_m);
    return true;
}

/* Of the ground at pixels (q_px, n) in the sun. In: at_px where it mirrors, when it is wet */
static bool ground_radiance(double rgb[3], const struct frame *f, const struct vec2 *q_px, size_t n, struct vec2 at_px, struct error *err)
{
    const struct scene *s = f->scene;
    if (!ground_irradiance(rgb, f, q_px, n, err)) return false;
    for (int c = 0; c < 3; c++) rgb[c] *= s->ground_albedo[c];
    if (s->wet.reflection <= 0 || s->exposure_of_roads) return true;
    /* A wet ground mirrors the sky as well. */
    struct error ignored = ERROR_NONE;
    struct vec3 p;
    if (!ground_from_pixel(&p, &s->ground, f->camera, f->shot->world_from_camera, at_px, &ignored)) return true;
    double sky[3];
    wet_sky(sky, &s->wet, f->context->light, s->ground.normal, vec3_unit(vec3_sub(f->shot->world_from_camera.translation, p)), WET_RAYS_MAX);
    for (int c = 0; c < 3; c++) rgb[c] += sky[c];
    return true;
}

static struct rect patch_px(const struct frame *f)
{
    struct vec2 a = frame_scaled_px(f, f->scene->exposure_patch_px[0]), b = frame_scaled_px(f, f->scene->exposure_patch_px[1]);
    return (struct rect){ (int)floor(a.x), (int)floor(a.y), (int)ceil(b.x), (int)ceil(b.y) };
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* How far away the ground is that pixels show: the median, 0 where none is known. */
static bool ground_distance(double *distance_m, const struct frame *f, const struct vec2 *q_px, size_t n, struct error *err)
{
    size_t known = 0;
    double *range = calloc(n + 1, sizeof *range);
    if (!range) return error_set(err, ERR_MEMORY, "no memory for an exposure");
    for (size_t i = 0; i < n; i++) {
        struct vec3 p;
        if (frame_ground_at(&p, f, q_px[i])) range[known++] = vec3_norm(vec3_sub(p, f->shot->world_from_camera.translation));
    }
    qsort(range, known, sizeof *range, ascending);
    *distance_m = known ? range[known / 2] : 0;
    free(range);
    return true;
}

/* Without the air between the camera and the pixels that were fitted to. A new view has none yet. */
static bool clear(struct frame *f, const struct vec2 *q_px, size_t n, const double radiance[3], struct error *err)
{
    const struct scene *s = f->scene;
    double distance = 0;
    if (!s->has_mist || !f->photograph[0]) return true;
    return ground_distance(&distance, f, q_px, n, err) &&
           exposure_clear(&f->exposure, air_transmission(s->visibility_m, distance), s->haze, radiance, s->white_balance, err);
}

static bool fit_to_patch(struct frame *f, struct error *err)
{
    struct rect patch = patch_px(f);
    struct vec2 middle = { (patch.x0 + patch.x1) / 2.0, (patch.y0 + patch.y1) / 2.0 };
    double radiance[3];
    return ground_radiance(radiance, f, &middle, 1, middle, err) &&
           exposure_fit(&f->exposure, &f->picture, patch, radiance, f->scene->white_balance, err) && clear(f, &middle, 1, radiance, err);
}

static bool fit_to_roads(struct frame *f, struct error *err)
{
    double radiance[3];
    struct vec2 *sample_px = NULL;
    size_t n = 0;
    if (!sunlit_pixels(&sample_px, &n, f->stage, f->context->light, f->camera, f->shot->world_from_camera, err)) return false;
    bool ok = n > 0 || error_set(err, ERR_INPUT, "exposure.roads: frame %s shows no road in full light to be fitted to: give "
                                 "exposure.value, or leave the shot in line %d out", f->name, f->shot->source.line);
    ok = ok && ground_radiance(radiance, f, sample_px, n, (struct vec2){ 0, 0 }, err) &&
         exposure_fit_samples(&f->exposure, &f->picture, sample_px, n, radiance, f->scene->white_balance, err) &&
         clear(f, sample_px, n, radiance, err);
    free(sample_px);
    return ok;
}

/* To the ground that the picture shows most of, in the light. */
static bool fit_to_ground(struct frame *f, struct error *err)
{
    const struct light *light = f->context->light;
    struct tones tones = { 0 };
    struct ground_view view = { 0 };
    struct lit_ground lit;
    struct vec2 *sample_px = NULL, middle = { 0, 0 };
    size_t n = 0;
    double radiance[3];
    bool ok = tones_of(&tones, &f->picture, err) &&
              ground_view_of(&view, f->stage, &tones, f->camera, f->shot->world_from_camera, GROUND_NEAR_M, err);
    if (ok && f->scene->has_mist && f->photograph[0]) ground_view_clear(&tones, &view, f->scene->visibility_m, f->scene->haze);
    ok = ok && lit_ground_find(&lit, &sample_px, &n, f->stage, &tones, &view, light->has_sun ? &light->sun_direction : NULL, f->camera,
                              f->shot, err);
    tones_release(&tones);
    ground_view_release(&view);
    if (!ok) return false;
    for (size_t i = 0; i < n; i++) middle = (struct vec2){ middle.x + sample_px[i].x / (double)n, middle.y + sample_px[i].y / (double)n };
    ok = ground_radiance(radiance, f, sample_px, n, middle, err) &&
         exposure_fit_samples(&f->exposure, &f->picture, sample_px, n, radiance, f->scene->white_balance, err) &&
         clear(f, sample_px, n, radiance, err);
    free(sample_px);
    return ok;
}

bool frame_read_picture(struct frame *f, struct error *err)
{
    if (f->picture.data) return true; /* a new view's was rendered */
    char *path = path_from_folder(f->context->out_folder, f->photograph);
    bool ok = (path || error_set(err, ERR_MEMORY, "no memory for a path")) &&
              photograph_read(&f->picture, path, f->camera->width_px, f->camera->height_px, err);
    free(path);
    return ok;
}

bool frame_expose(struct frame *f, struct error *err)
{
    const struct scene *s = f->scene;
    if (s->exposure_given) {
        f->exposure = exposure_given(s->exposure, f->camera->width_px, f->camera->height_px);
        return true;
    }
    if (!frame_read_picture(f, err)) return false;
    if (s->exposure_of_roads ? fit_to_roads(f, err) : s->exposure_of_ground ? fit_to_ground(f, err) : fit_to_patch(f, err)) return true;
    stage_fail(s, s->exposure_source, err);
    return error_prefix(err, "%s: ", f->photograph[0] ? f->photograph : "a new view");
}

#include "gen/frame_impl.h"

#include "gen/sunlit.h"
#include "lib/file.h"
#include "lib/manifest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void ground_radiance(double rgb[3], const struct frame *f)
{
    const struct scene *s = f->scene;
    light_irradiance(rgb, f->context->light, s->ground.normal);
    for (int c = 0; c < 3; c++) rgb[c] *= s->ground_albedo[c];
    if (s->ground_reflection <= 0 || s->exposure_given || s->exposure_of_roads) return;
    /* A wet ground mirrors the sky as well: as seen in the middle of the exposure patch. */
    struct vec2 middle = { (s->exposure_patch_px[0].x + s->exposure_patch_px[1].x) / 2,
                           (s->exposure_patch_px[0].y + s->exposure_patch_px[1].y) / 2 };
    struct error ignored = ERROR_NONE;
    struct vec3 p;
    if (!ground_from_pixel(&p, &s->ground, f->camera, f->shot->world_from_camera, frame_scaled_px(f, middle), &ignored)) return;
    struct vec3 d = vec3_unit(vec3_sub(p, f->shot->world_from_camera.translation));
    double cosine = -vec3_dot(d, s->ground.normal), sky[3];
    double share = s->ground_reflection + (1 - s->ground_reflection) * pow(1 - cosine, 5);
    light_sky_radiance(sky, f->context->light, vec3_add(d, vec3_scale(s->ground.normal, 2 * cosine)));
    for (int c = 0; c < 3; c++) rgb[c] += share * sky[c];
}

static struct rect patch_px(const struct frame *f)
{
    struct vec2 a = frame_scaled_px(f, f->scene->exposure_patch_px[0]), b = frame_scaled_px(f, f->scene->exposure_patch_px[1]);
    return (struct rect){ (int)floor(a.x), (int)floor(a.y), (int)ceil(b.x), (int)ceil(b.y) };
}

/* Out: to (1024), empty for no path */
static bool absolute(char to[1024], const char *path, struct error *err)
{
    to[0] = 0;
    if (!path) return true;
    char *real = realpath(path, NULL);
    bool ok = real && strlen(real) < 1024;
    if (ok) snprintf(to, 1024, "%s", real);
    else error_at(err, ERR_INPUT, path, 0, 0, real ? "the path is too long: 1023 bytes are possible" : "does not exist");
    free(real);
    return ok;
}

static bool sample_roads(struct manifest *m, const struct frame *f, struct error *err)
{
    const struct scene *s = f->scene;
    return sunlit_pixels(&m->exposure_sample_px, &m->exposure_samples, f->stage, f->context->light, f->camera,
                         f->shot->world_from_camera, err) &&
           (m->exposure_samples > 0 ||
            error_at(err, ERR_INPUT, s->path, s->exposure_source.line, s->exposure_source.column,
                     "exposure.roads: frame %s shows no road in full light to be fitted to: give exposure.value, or leave "
                     "the shot in line %d out", f->name, f->shot->source.line));
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Through how much air the ground is seen that the exposure is fitted to: the median of its pixels. */
static bool measure_exposure_distance(struct manifest *m, const struct frame *f, struct error *err)
{
    struct vec2 middle = { (m->exposure_patch_px.x0 + m->exposure_patch_px.x1) / 2.0,
                           (m->exposure_patch_px.y0 + m->exposure_patch_px.y1) / 2.0 };
    size_t n = m->exposure_samples ? m->exposure_samples : 1, known = 0;
    double *range = calloc(n, sizeof *range);
    if (!range) return error_set(err, ERR_MEMORY, "no memory for a manifest");
    for (size_t i = 0; i < n; i++) {
        struct vec3 p;
        if (frame_ground_at(&p, f, m->exposure_samples ? m->exposure_sample_px[i] : middle))
            range[known++] = vec3_norm(vec3_sub(p, f->shot->world_from_camera.translation));
    }
    qsort(range, known, sizeof *range, ascending);
    if (known) m->exposure_distance_m = range[known / 2];
    free(range);
    return true;
}

bool frame_write_manifest(const struct frame *f, const struct frame_result *result, struct error *err)
{
    static const char *const transfers[] = { "layers", "ratio", "threshold", "alpha" };
    const struct scene *s = f->scene;
    struct manifest m = {
        .width_px = f->camera->width_px, .height_px = f->camera->height_px,
        .camera = *f->camera, .world_from_camera = f->shot->world_from_camera,
        .empty = result->empty, .view = result->view, .receiver_reduction = result->receiver_reduction,
        .exposure_given = s->exposure_given, .exposure = s->exposure, .white_balance = s->white_balance,
        .t1 = s->t1, .t2 = s->t2, .t3 = s->t3,
        .overwrite_below = s->overwrite == OVERWRITE_BELOW, .mask_dilated = s->mask == MASK_DILATED,
        .has_shares = s->occluder_count > 0 || f->stage->mesh, .has_place = f->labels.place_depth.data != NULL,
        .has_place_labels = f->labels.place_label.data != NULL, .palette = s->palette, .new_view = !f->photograph[0],
        .has_mist = s->has_mist, .visibility_m = s->visibility_m, .haze = { s->haze[0], s->haze[1], s->haze[2] },
        .has_motion = f->motion.data != NULL, .defocus_px = s->defocus_px, .focus_m = s->focus_m,
        .softness_auto = s->softness_auto, .grain_auto = s->grain_auto, .vignetting_auto = s->vignetting_auto,
        .highlights_auto = s->highlights_auto, .compression_auto = s->compression_auto,
        .softness_px = s->softness_px, .grain = s->grain, .vignetting = s->vignetting, .highlights = s->highlights,
        .seed = s->seed, .entity_count = f->moment.n,
    };
    snprintf(m.frame, sizeof m.frame, "%s", result->name);
    snprintf(m.photograph, sizeof m.photograph, "%s", f->photograph);
    snprintf(m.key, sizeof m.key, "%s", f->key);
    if (!absolute(m.semantic, f->shot->semantic, err) || !absolute(m.depth, f->shot->depth, err)) return false;
    snprintf(m.transfer, sizeof m.transfer, "%s", transfers[s->transfer]);
    ground_radiance(m.ground_radiance, f);
    if (s->exposure_of_roads && !m.empty && !sample_roads(&m, f, err)) {
        free(m.exposure_sample_px);
        return false;
    }
    if (!s->exposure_given && !s->exposure_of_roads) m.exposure_patch_px = patch_px(f);
    if (s->has_mist && !s->exposure_given && !measure_exposure_distance(&m, f, err)) {
        free(m.exposure_sample_px);
        return false;
    }
    m.entities = calloc(f->moment.n + 1, sizeof *m.entities);
    if (!m.entities) {
        free(m.exposure_sample_px);
        return error_set(err, ERR_MEMORY, "no memory for a manifest");
    }
    for (size_t i = 0; i < f->moment.n; i++) {
        m.entities[i].id = f->moment.entities[i].id;
        m.entities[i].class_ = f->moment.entities[i].class_;
        snprintf(m.entities[i].name, sizeof m.entities[i].name, "%s", f->moment.entities[i].name);
    }
    char *path = string_format("%s/frame.json", f->folder);
    bool ok = path ? manifest_write(path, &m, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    free(m.entities);
    free(m.exposure_sample_px);
    return ok;
}

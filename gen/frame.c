#include "gen/frame.h"

#include "gen/trace/label.h"
#include "gen/light/light.h"
#include "gen/render/passes.h"
#include "lib/place.h"
#include "gen/world/receiver.h"
#include "gen/trace/trace.h"
#include "lib/file.h"
#include "lib/manifest.h"
#include "lib/view.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define DEG (180 / M_PI)

/* Boxes may touch: two cars of a real queue stand bumper to bumper. */
static const double overlap_tolerance_m = 0.02;

struct generator {
    const struct scene *scene;
    const char *out_folder;
    struct material_rules *rules;
    struct model **models;          /* (scene->model_count) NULL where no entity uses it */
    struct camera camera;           /* at the size of the result */
    struct light light;
    char sky_map[SKY_MAP_SIZE];     /* the light's sky, relative to out_folder */
    uint64_t video_hash;            /* names the video as it is now: another one's pictures are not taken for its own */
    struct entity *entities;        /* (scene->entity_count) */
    size_t *model_index;
    bool *included;                 /* (scene->entity_count) the include file of its model is written */
    struct receiver *receivers;     /* (scene->entity_count) */
    struct occluder *occluders;     /* (scene->occluder_count) polygons at the size of the result; owned */
    struct tracer *tracer;
    char **warnings;
    size_t warning_count;
    uint64_t input_hash;            /* of all that every frame depends on */
};

static bool fail_at(const struct generator *g, struct source where, struct error *err)
{
    if (!err->file[0]) {
        snprintf(err->file, sizeof err->file, "%s", g->scene->path);
        err->line = where.line;
        err->column = where.column;
    }
    return false;
}

/* --- what is loaded once --- */

static bool size_result(struct generator *g, struct error *err)
{
    const struct scene *s = g->scene;
    int width, height, frames = 0;
    for (size_t i = 0; i < s->photograph_count; i++) {
        if (s->is_video ? !video_info(&width, &height, &frames, s->photographs[i], err)
                        : !image_read_size(&width, &height, s->photographs[i], err))
            return false;
        if (s->is_video && frames > 0 && s->video_frames[s->video_frame_count - 1] >= frames) /* some do not say */
            return error_at(err, ERR_INPUT, s->photographs[i], 0, 0,
                            "has %d frames, from 0 to %d: frame %d is not there", frames, frames - 1,
                            s->video_frames[s->video_frame_count - 1]);
        double across = (double)width / s->camera.width_px, down = (double)height / s->camera.height_px;
        if (fabs(across - down) > 0.005 * across)
            return error_at(err, ERR_INPUT, s->path, s->camera_source.line, s->camera_source.column,
                            "camera: the calibration is for %d x %d pixels, but %s has %d x %d: another shape; "
                            "size_px must be the size that params were calibrated at",
                            s->camera.width_px, s->camera.height_px, s->photographs[i], width, height);
        struct camera camera = camera_scaled(&s->camera, (int)lround(width * s->scale), (int)lround(height * s->scale));
        if (i > 0 && (camera.width_px != g->camera.width_px || camera.height_px != g->camera.height_px))
            return error_at(err, ERR_INPUT, s->photographs[i], 0, 0,
                            "has %d x %d pixels, and the photographs before it have %d x %d: one camera takes one size",
                            width, height, (int)lround(g->camera.width_px / s->scale), (int)lround(g->camera.height_px / s->scale));
        g->camera = camera;
    }
    return true;
}

/* Size and time of a file, and a name for it, into a hash. */
static bool hash_file_state(uint64_t *hash, const char *path, const char *name, struct error *err)
{
    struct stat st;
    if (stat(path, &st) != 0) return error_at(err, ERR_INPUT, path, 0, 0, "does not exist");
    int64_t seen[3] = { st.st_size, st.st_mtim.tv_sec, st.st_mtim.tv_nsec };
    *hash = hash_bytes(hash_bytes(*hash, name, strlen(name)), seen, sizeof seen);
    return true;
}

static bool hash_video(struct generator *g, struct error *err)
{
    if (!g->scene->is_video) return true;
    char *absolute = realpath(g->scene->photographs[0], NULL);
    g->video_hash = FILE_HASH_SEED;
    bool ok = absolute ? hash_file_state(&g->video_hash, absolute, absolute, err)
                       : error_at(err, ERR_INPUT, g->scene->photographs[0], 0, 0, "does not exist");
    free(absolute);
    return ok;
}

static struct vec2 scaled_px(const struct generator *g, struct vec2 q)
{
    return (struct vec2){ q.x * g->camera.width_px / g->scene->camera.width_px,
                          q.y * g->camera.height_px / g->scene->camera.height_px };
}

static bool warn(struct generator *g, const char *model, const char *texture, struct error *err)
{
    char **grown = realloc(g->warnings, (g->warning_count + 1) * sizeof *grown);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for a message");
    g->warnings = grown;
    g->warnings[g->warning_count] = string_format("%s: texture \"%s\" not found beside it or in the folders around it; "
                                                  "its material has its plain colour", model, texture);
    return g->warnings[g->warning_count++] || error_set(err, ERR_MEMORY, "no memory for a message");
}

/* Of what was loaded: a model can lie in several files (.bin, .mtl, textures). */
static uint64_t hash_model(uint64_t hash, const struct model *model)
{
    for (size_t i = 0; i < model->mesh_count; i++) {
        const struct mesh *m = &model->meshes[i];
        const size_t counts[] = { m->vertices, m->triangles, m->material, m->uv != NULL };
        hash = hash_bytes(hash, counts, sizeof counts);
        hash = hash_bytes(hash, m->position_m, m->vertices * sizeof *m->position_m);
        hash = hash_bytes(hash, m->normal, m->vertices * sizeof *m->normal);
        if (m->uv) hash = hash_bytes(hash, m->uv, m->vertices * sizeof *m->uv);
        hash = hash_bytes(hash, m->triangle, m->triangles * sizeof *m->triangle);
    }
    for (size_t i = 0; i < model->material_count; i++) {
        const struct material *m = &model->materials[i];
        const double figures[] = { m->kind, m->base_color[0], m->base_color[1], m->base_color[2], m->alpha, m->alpha_mode,
                                   m->alpha_cutoff, m->metallic, m->roughness, m->emissive[0], m->emissive[1],
                                   m->emissive[2], m->clearcoat, m->clearcoat_roughness, m->transmission, m->ior,
                                   m->base_image.width_px, m->base_image.height_px, m->base_image.channels };
        hash = hash_bytes(hash, figures, sizeof figures);
        if (m->base_image.data) hash = hash_bytes(hash, m->base_image.data, image_size(&m->base_image));
    }
    return hash;
}

static bool load_models(struct generator *g, struct error *err)
{
    const struct scene *s = g->scene;
    for (size_t i = 0; i < s->entity_count; i++) {
        size_t m = s->entities[i].model_index;
        if (g->models[m]) continue;
        struct model_options options = s->models[m].options;
        options.rules = g->rules;
        if (!options.has_class) { /* a model that says nothing is what its first entity is */
            options.has_class = true;
            options.class_ = s->entities[i].class_;
        }
        if (!model_load(&g->models[m], s->models[m].file, &options, err)) return false;
        struct model *model = g->models[m];
        for (size_t k = 0; k < model->missing_texture_count; k++)
            if (!warn(g, s->models[m].file, model->missing_textures[k], err)) return false;
        g->input_hash = hash_model(g->input_hash, model);
    }
    return true;
}

static bool place_entity(struct vec3 *at, const struct generator *g, const struct scene_entity *e, struct error *err)
{
    const struct scene *s = g->scene;
    switch (e->place) {
    case PLACE_WORLD:
        *at = vec3(e->at[0], e->at[1], 0);
        return true;
    case PLACE_GEODETIC: {
        double origin[3] = { s->place.latitude_rad * DEG, s->place.longitude_rad * DEG, s->place.height_m };
        double enu[3], there[3] = { e->at[0], e->at[1], s->place.height_m };
        if (!place_enu_from_geodetic(enu, origin, there, err)) return fail_at(g, e->at_source, err);
        /* The world's +y may point elsewhere than true north. */
        double c = cos(s->north_rad), n = sin(s->north_rad);
        *at = vec3(c * enu[0] - n * enu[1], n * enu[0] + c * enu[1], 0);
        return true;
    }
    case PLACE_PIXEL:
    default:
        return ground_from_pixel(at, &s->ground, &s->camera, s->world_from_camera,
                                 (struct vec2){ e->at[0], e->at[1] }, err) || fail_at(g, e->at_source, err);
    }
}

static bool place_entities(struct generator *g, struct error *err)
{
    const struct scene *s = g->scene;
    for (size_t i = 0; i < s->entity_count; i++) {
        const struct scene_entity *e = &s->entities[i];
        struct vec3 at;
        if (!place_entity(&at, g, e, err)) return error_prefix(err, "entity \"%s\": ", e->name);
        g->model_index[i] = e->model_index;
        g->entities[i] = (struct entity){
            .id = (uint16_t)(i + 1),
            .name = e->name,
            .model_name = e->model,
            .class_ = e->class_,
            .model = g->models[e->model_index],
            .world_from_entity = entity_stand(&s->ground, at, e->heading_rad),
            .has_color = e->has_color,
            .color = { e->color[0], e->color[1], e->color[2] },
        };
        for (size_t k = 0; k < i; k++)
            if (entities_intersect(&g->entities[i], &g->entities[k], overlap_tolerance_m))
                return error_at(err, ERR_INPUT, s->path, e->source.line, e->source.column,
                                "entity \"%s\" runs into entity \"%s\" (line %d): their boxes intersect; "
                                "move or turn one of them", e->name, s->entities[k].name, s->entities[k].source.line);
    }
    return true;
}

static bool place_occluders(struct generator *g, struct error *err)
{
    const struct scene *s = g->scene;
    for (size_t i = 0; i < s->occluder_count; i++) {
        const struct scene_occluder *o = &s->occluders[i];
        struct vec2 *polygon = calloc(o->polygon_count, sizeof *polygon);
        if (!polygon) return error_set(err, ERR_MEMORY, "no memory for an occluder");
        for (size_t k = 0; k < o->polygon_count; k++) polygon[k] = scaled_px(g, o->polygon_px[k]);
        g->occluders[i] = (struct occluder){ .name = o->name, .polygon_px = polygon, .polygon_count = o->polygon_count };
        if (!ground_from_pixel(&g->occluders[i].foot_m, &s->ground, &s->camera, s->world_from_camera, o->ground_px,
                               err)) {
            fail_at(g, o->source, err);
            return error_prefix(err, "occluder \"%s\": ", o->name);
        }
    }
    return true;
}

static bool trace_models(struct generator *g, struct error *err)
{
    size_t n = 0;
    const struct model **used = calloc(g->scene->model_count + 1, sizeof *used);
    if (!used) return error_set(err, ERR_MEMORY, "no memory for the models");
    for (size_t i = 0; i < g->scene->model_count; i++)
        if (g->models[i]) used[n++] = g->models[i];
    bool ok = tracer_create(&g->tracer, used, n, err);
    free(used);
    return ok;
}

bool generator_create(struct generator **generator, const struct scene *scene, const char *out_folder,
                      const char *rules_path, struct error *err)
{
    struct generator *g = calloc(1, sizeof *g);
    if (!g) return error_set(err, ERR_MEMORY, "no memory for the generator");
    const char *rules = scene->material_rules ? scene->material_rules : rules_path;
    *g = (struct generator){ .scene = scene, .out_folder = out_folder, .input_hash = FILE_HASH_SEED };
    g->input_hash = hash_bytes(g->input_hash, PACKAGE_VERSION, sizeof PACKAGE_VERSION);
    g->input_hash = hash_bytes(g->input_hash, &scene->hash, sizeof scene->hash);
    g->input_hash = hash_bytes(g->input_hash, &scene->quality, sizeof scene->quality);
    g->input_hash = hash_bytes(g->input_hash, &scene->seed, sizeof scene->seed);
    /* What a quality means may change from version to version. */
    struct pass_settings settings = pass_settings(scene->quality, scene->sky);
    g->input_hash = hash_bytes(g->input_hash, &settings.sky_lights, sizeof settings.sky_lights);
    g->input_hash = hash_bytes(g->input_hash, &settings.radiosity_count, sizeof settings.radiosity_count);
    g->input_hash = hash_bytes(g->input_hash, &settings.receiver_reduction, sizeof settings.receiver_reduction);
    g->input_hash = hash_bytes(g->input_hash, settings.object_antialias, strlen(settings.object_antialias));
    g->input_hash = hash_bytes(g->input_hash, settings.receiver_antialias, strlen(settings.receiver_antialias));
    g->models = calloc(scene->model_count + 1, sizeof *g->models);
    g->entities = calloc(scene->entity_count + 1, sizeof *g->entities);
    g->model_index = calloc(scene->entity_count + 1, sizeof *g->model_index);
    g->included = calloc(scene->entity_count + 1, sizeof *g->included);
    g->receivers = calloc(scene->entity_count + 1, sizeof *g->receivers);
    g->occluders = calloc(scene->occluder_count + 1, sizeof *g->occluders);
    if (!g->models || !g->entities || !g->model_index || !g->included || !g->receivers || !g->occluders) {
        error_set(err, ERR_MEMORY, "no memory for the scene");
        goto out;
    }
    if (!material_rules_read(&g->rules, rules, err) || !file_hash(&g->input_hash, rules, err) ||
        !size_result(g, err) || !hash_video(g, err) || !light_create(&g->light, scene, err) ||
        !sky_map_write(g->sky_map, out_folder, &g->light, err) || !load_models(g, err) ||
        !place_entities(g, err) || !place_occluders(g, err))
        goto out;
    for (size_t i = 0; i < scene->entity_count; i++)
        if (!receiver_create(&g->receivers[i], &g->entities[i], &scene->ground, &g->light, err)) goto out;
    if (!trace_models(g, err)) goto out;
    *generator = g;
    return true;
out:
    generator_destroy(g);
    return false;
}

void generator_destroy(struct generator *g)
{
    if (!g) return;
    tracer_destroy(g->tracer);
    for (size_t i = 0; g->models && i < g->scene->model_count; i++) model_destroy(g->models[i]);
    for (size_t i = 0; g->receivers && i < g->scene->entity_count; i++) receiver_release(&g->receivers[i]);
    for (size_t i = 0; g->occluders && i < g->scene->occluder_count; i++) free((void *)g->occluders[i].polygon_px);
    for (size_t i = 0; i < g->warning_count; i++) free(g->warnings[i]);
    free(g->warnings);
    free(g->models);
    free(g->entities);
    free(g->model_index);
    free(g->included);
    free(g->receivers);
    free(g->occluders);
    light_release(&g->light);
    material_rules_destroy(g->rules);
    free(g);
}

size_t generator_frame_count(const struct generator *g)
{
    return g->scene->is_video ? g->scene->video_frame_count : g->scene->photograph_count;
}

void generator_frame_name(char name[FRAME_NAME_SIZE], const struct generator *g, size_t frame)
{
    snprintf(name, FRAME_NAME_SIZE, "%06d", g->scene->is_video ? g->scene->video_frames[frame] : (int)frame);
}

size_t generator_warning_count(const struct generator *g)
{
    return g->warning_count;
}

const char *generator_warning(const struct generator *g, size_t i)
{
    return g->warnings[i];
}

/* --- frames --- */

static char *frame_folder(const struct generator *g, size_t frame)
{
    char name[FRAME_NAME_SIZE];
    generator_frame_name(name, g, frame);
    return string_format("%s/frames/%s", g->out_folder, name);
}

/* The path of a frame's photograph as the manifest names it; the caller frees. */
static char *photograph_path(const struct generator *g, size_t frame, struct error *err)
{
    char name[FRAME_NAME_SIZE], *path;
    generator_frame_name(name, g, frame);
    if (g->scene->is_video) {
        path = string_format("frames/video_%016llx/%s.png", (unsigned long long)g->video_hash, name);
        if (!path) error_set(err, ERR_MEMORY, "no memory for a path");
    } else {
        path = realpath(g->scene->photographs[frame], NULL);
        if (!path) error_at(err, ERR_INPUT, g->scene->photographs[frame], 0, 0, "does not exist");
    }
    if (path && strlen(path) >= sizeof ((struct manifest *)0)->photograph) {
        error_at(err, ERR_INPUT, path, 0, 0, "the path is too long: %zu bytes are possible",
                 sizeof ((struct manifest *)0)->photograph - 1);
        free(path);
        path = NULL;
    }
    return path;
}

static char *opened_path(const struct generator *g, const char *path)
{
    return path[0] == '/' ? strdup(path) : string_format("%s/%s", g->out_folder, path);
}

bool generator_prepare(struct generator *g, const size_t *frames, size_t n, struct error *err)
{
    if (!g->scene->is_video) return true;
    int *numbers = calloc(n + 1, sizeof *numbers);
    char **paths = calloc(n + 1, sizeof *paths);
    size_t missing = 0;
    bool ok = numbers && paths;
    for (size_t i = 0; ok && i < n; i++) {
        char *named = photograph_path(g, frames[i], err), *path = named ? opened_path(g, named) : NULL;
        char *folder = path ? path_folder(path) : NULL;
        ok = folder && folder_make(folder, err);
        if (ok && !file_exists(path)) {
            numbers[missing] = g->scene->video_frames[frames[i]];
            paths[missing++] = path;
        } else
            free(path);
        free(folder);
        free(named);
    }
    if (!ok) error_set(err, ERR_MEMORY, "no memory for the photographs of a video");
    if (ok && missing) ok = video_extract(g->scene->photographs[0], numbers, (const char *const *)paths, missing, err);
    for (size_t i = 0; i < missing; i++) free(paths[i]);
    free(paths);
    free(numbers);
    return ok;
}

/* The part of the photograph that can change: entities as traced, and receivers found by
 * rays on a coarse grid, which works whatever lies behind the camera or beyond the lens.
 * Out: matters (entities): seen, or shading what is seen */
static struct rect changed_window(bool *matters, const struct generator *g, const struct frame_labels *labels)
{
    enum { STEP = 8 };
    struct rect window = { 0 };
    int width = g->camera.width_px, height = g->camera.height_px;
    for (size_t i = 0; i < labels->entity_count; i++) {
        window = rect_unite(window, labels->entities[i].mask_px);
        matters[i] = labels->entities[i].in_frame;
    }
    for (int y = 0; y < height + STEP; y += STEP)
        for (int x = 0; x < width + STEP; x += STEP) {
            struct error ignored = ERROR_NONE;
            struct vec3 p;
            struct vec2 q = { fmin(x, width), fmin(y, height) };
            if (!ground_from_pixel(&p, &g->scene->ground, &g->camera, g->scene->world_from_camera, q, &ignored)) continue;
            for (size_t i = 0; i < g->scene->entity_count; i++)
                if (receiver_contains(&g->receivers[i], p)) {
                    matters[i] = true;
                    window = rect_unite(window, (struct rect){ x - STEP, y - STEP, x + STEP, y + STEP });
                }
        }
    if (window.x1 <= window.x0) return window;
    /* Anti-aliased edges reach a pixel beyond the traced ones. */
    window = (struct rect){ window.x0 - 2, window.y0 - 2, window.x1 + 2, window.y1 + 2 };
    return (struct rect){ window.x0 > 0 ? window.x0 : 0, window.y0 > 0 ? window.y0 : 0,
                          window.x1 < width ? window.x1 : width, window.y1 < height ? window.y1 : height };
}

static void ground_radiance(double rgb[3], const struct generator *g)
{
    const struct scene *s = g->scene;
    for (int c = 0; c < 3; c++) rgb[c] = s->ground_albedo[c] * g->light.irradiance[c];
    if (s->ground_reflection <= 0 || s->exposure_given) return;
    /* A wet ground mirrors the sky as well: as seen in the middle of the exposure patch. */
    struct vec2 middle = { (s->exposure_patch_px[0].x + s->exposure_patch_px[1].x) / 2,
                           (s->exposure_patch_px[0].y + s->exposure_patch_px[1].y) / 2 };
    struct error ignored = ERROR_NONE;
    struct vec3 p;
    if (!ground_from_pixel(&p, &s->ground, &g->camera, s->world_from_camera, scaled_px(g, middle), &ignored)) return;
    struct vec3 d = vec3_unit(vec3_sub(p, s->world_from_camera.translation));
    double cosine = -vec3_dot(d, s->ground.normal), sky[3];
    double share = s->ground_reflection + (1 - s->ground_reflection) * pow(1 - cosine, 5);
    light_sky_radiance(sky, &g->light, vec3_add(d, vec3_scale(s->ground.normal, 2 * cosine)));
    for (int c = 0; c < 3; c++) rgb[c] += share * sky[c];
}

static struct rect patch_px(const struct generator *g)
{
    struct vec2 a = scaled_px(g, g->scene->exposure_patch_px[0]), b = scaled_px(g, g->scene->exposure_patch_px[1]);
    return (struct rect){ (int)floor(a.x), (int)floor(a.y), (int)ceil(b.x), (int)ceil(b.y) };
}

/* Everything that a frame's files depend on, as 16 hex digits. */
static bool frame_key(char key[17], const struct generator *g, const char *photograph, struct error *err)
{
    uint64_t hash = g->input_hash;
    char *path = opened_path(g, photograph);
    bool ok = path ? hash_file_state(&hash, path, photograph, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    if (ok) snprintf(key, 17, "%016llx", (unsigned long long)hash);
    return ok;
}

static bool already_there(struct frame_result *result, const char *manifest_path, const char *key)
{
    struct manifest old;
    struct error ignored = ERROR_NONE;
    if (!file_exists(manifest_path) || !manifest_read(&old, manifest_path, &ignored)) return false;
    bool same = !strcmp(old.key, key);
    if (same) {
        result->kept = true;
        result->empty = old.empty;
        result->view = old.view;
        result->receiver_reduction = old.receiver_reduction;
    }
    manifest_release(&old);
    return same;
}

static bool write_manifest(const struct generator *g, const char *path, const struct frame_result *result,
                           const char *photograph, const char *key, struct error *err)
{
    static const char *const transfers[] = { "layers", "ratio", "threshold", "alpha" };
    const struct scene *s = g->scene;
    struct manifest m = {
        .width_px = g->camera.width_px, .height_px = g->camera.height_px,
        .camera = g->camera, .world_from_camera = s->world_from_camera,
        .empty = result->empty, .view = result->view, .receiver_reduction = result->receiver_reduction,
        .exposure_given = s->exposure_given, .exposure = s->exposure, .white_balance = s->white_balance,
        .t1 = s->t1, .t2 = s->t2, .t3 = s->t3,
        .overwrite_below = s->overwrite == OVERWRITE_BELOW, .mask_dilated = s->mask == MASK_DILATED,
        .has_shares = s->occluder_count > 0, .entity_count = s->entity_count,
    };
    snprintf(m.frame, sizeof m.frame, "%s", result->name);
    snprintf(m.photograph, sizeof m.photograph, "%s", photograph);
    snprintf(m.key, sizeof m.key, "%s", key);
    snprintf(m.transfer, sizeof m.transfer, "%s", transfers[s->transfer]);
    ground_radiance(m.ground_radiance, g);
    if (!s->exposure_given) m.exposure_patch_px = patch_px(g);
    m.entities = calloc(s->entity_count + 1, sizeof *m.entities);
    if (!m.entities) return error_set(err, ERR_MEMORY, "no memory for a manifest");
    for (size_t i = 0; i < s->entity_count; i++) {
        m.entities[i].id = g->entities[i].id;
        m.entities[i].class_ = g->entities[i].class_;
        snprintf(m.entities[i].name, sizeof m.entities[i].name, "%s", g->entities[i].name);
    }
    bool ok = manifest_write(path, &m, err);
    free(m.entities);
    return ok;
}

static bool write_passes(struct generator *g, const char *folder, const bool *matters, const struct view *view,
                         struct error *err)
{
    const struct scene *s = g->scene;
    struct entity *entities = calloc(s->entity_count + 1, sizeof *entities);
    struct receiver *receivers = calloc(s->entity_count + 1, sizeof *receivers);
    size_t *model_index = calloc(s->entity_count + 1, sizeof *model_index), n = 0;
    bool ok = (entities && receivers && model_index) || error_set(err, ERR_MEMORY, "no memory for a frame");
    for (size_t i = 0; ok && i < s->entity_count; i++) {
        if (!matters[i]) continue;
        entities[n] = g->entities[i];
        model_index[n] = g->model_index[i];
        receivers[n++] = g->receivers[i];
        /* Written once a run, whatever an earlier one left: entities do not change between frames. */
        if (!g->included[i]) ok = model_include_write(g->out_folder, g->model_index[i], &g->entities[i], err);
        g->included[i] = true;
    }
    struct passes passes = { s, g->sky_map, &g->light, *view, s->world_from_camera, entities, model_index, n, receivers, n };
    ok = ok && passes_write(folder, &passes, err);
    free(entities);
    free(receivers);
    free(model_index);
    return ok;
}

static bool make_frame(struct frame_result *result, struct generator *g, const char *folder,
                       const char *photograph, const char *key, struct error *err)
{
    const struct scene *s = g->scene;
    struct frame_labels labels;
    struct view view = { 0 };
    char *path = string_format("%s/frame.json", folder);
    bool *matters = calloc(s->entity_count + 1, sizeof *matters);
    bool ok = false;
    if (!path || !matters) {
        error_set(err, ERR_MEMORY, "no memory for a frame");
        goto out;
    }
    if (!trace_frame(&labels, g->tracer, &(struct trace_input){ .camera = &g->camera, .world_from_camera = s->world_from_camera,
                                                                .ground = &s->ground, .entities = g->entities,
                                                                .entity_count = s->entity_count, .occluders = g->occluders,
                                                                .occluder_count = s->occluder_count }, err))
        goto out;
    struct rect window = changed_window(matters, g, &labels);
    result->empty = window.x1 <= window.x0 || window.y1 <= window.y0;
    struct label_context context = {
        .frame = result->name, .photograph = photograph, .camera = &g->camera,
        .world_from_camera = s->world_from_camera,
        .has_sun = g->light.has_sun, .sun_direction = g->light.sun_direction,
        .entities = g->entities, .entity_count = s->entity_count,
    };
    ok = labels_write(folder, &labels, &context, err);
    if (ok && !result->empty)
        ok = (view_cover(&view, &g->camera, window, err) || fail_at(g, s->camera_source, err)) &&
             write_passes(g, folder, matters, &view, err);
    result->view = view;
    result->receiver_reduction = pass_settings(s->quality, s->sky).receiver_reduction;
    ok = ok && write_manifest(g, path, result, photograph, key, err);
    frame_labels_release(&labels);
out:
    free(matters);
    free(path);
    return ok;
}

bool generator_frame(struct frame_result *result, struct generator *g, size_t frame, struct error *err)
{
    struct frame_result made = { 0 };
    char *folder = frame_folder(g, frame), *manifest = folder ? string_format("%s/frame.json", folder) : NULL;
    char *photograph = photograph_path(g, frame, err), key[17];
    bool ok = false;
    if (!folder || !manifest || !photograph) {
        error_set(err, ERR_MEMORY, "no memory for a path");
        goto out;
    }
    generator_frame_name(made.name, g, frame);
    if (!folder_make(folder, err) || !frame_key(key, g, photograph, err)) goto out;
    ok = already_there(&made, manifest, key);
    if (!ok) {
        /* Stopped halfway, the files are of two inputs: no manifest may then speak for them. */
        unlink(manifest);
        ok = make_frame(&made, g, folder, photograph, key, err);
    }
    if (ok) *result = made;
out:
    free(photograph);
    free(manifest);
    free(folder);
    return ok;
}

bool generator_write_run(const struct generator *g, const struct frame_result *frames, size_t n, struct error *err)
{
    static const char *const qualities[] = { "draft", "standard", "high" };
    const struct scene *s = g->scene;
    char hash[17], *path = string_format("%s/run.json", g->out_folder);
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)s->hash);
    json_t *names = json_array();
    for (size_t i = 0; i < n; i++) json_array_append_new(names, json_string(frames[i].name));
    json_t *run = json_pack("{s:s, s:s, s:s, s:s, s:i, s:[fff], s:o}", "version", PACKAGE_VERSION, "scene", s->path,
                            "scene_hash", hash, "quality", qualities[s->quality], "seed", s->seed,
                            "ground_irradiance_over_pi", g->light.irradiance[0], g->light.irradiance[1],
                            g->light.irradiance[2], "frames", names);
    if (run && g->light.has_sun) {
        struct vec3 d = g->light.sun_direction;
        json_object_set_new(run, "sun_direction", json_pack("[fff]", d.x, d.y, d.z));
        json_object_set_new(run, "sun_elevation_deg", json_real(asin(d.z) * DEG));
        json_object_set_new(run, "sun_azimuth_deg", json_real(fmod((atan2(d.x, d.y) + s->north_rad) * DEG + 720, 360)));
    }
    char *text = run ? json_dumps(run, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) : NULL;
    bool ok = path && text ? file_write_if_changed(path, text, strlen(text), err)
                           : error_set(err, ERR_MEMORY, "no memory for run.json");
    free(text);
    json_decref(run);
    free(path);
    return ok;
}

#include "gen/generator.h"

#include "gen/estimate/estimate.h"
#include "gen/light/map_sun.h"
#include "gen/light/skyline.h"
#include "gen/render/passes.h"
#include "gen/run_json.h"
#include "gen/sighting.h"
#include "lib/file.h"
#include "lib/image.h"
#include "lib/manifest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define DEG (180 / M_PI)

struct generator {
    struct scene own;               /* the scene with its light as it was found; what it points to is borrowed */
    const struct scene *scene;      /* &own */
    bool estimated;
    struct light_estimate estimate;
    const char *out_folder;
    struct material_rules *rules;
    struct stage *stage;
    struct light light;
    char sky_map[SKY_MAP_SIZE];     /* the light's sky, relative to out_folder */
    uint64_t video_hash;            /* names the video as it is now: another one's pictures are not taken for its own */
    int video_width_px, video_height_px;
    struct tracer *tracer;
    struct include_set includes;
    uint64_t input_hash;            /* of all that every frame depends on */
    uint64_t rendered_hash;         /* the same without what matters in merging alone */
};

static char *photograph_path(const struct generator *g, size_t frame, struct error *err);
static bool frame_camera(struct camera *camera, const struct generator *g, const struct scene_shot *shot, struct error *err);

/* --- what is loaded once --- */

/* Size and time of a file, and a name for it, into a hash. */
static bool hash_file_state(uint64_t *hash, const char *path, const char *name, struct error *err)
{
    struct stat st;
    if (stat(path, &st) != 0) return error_at(err, ERR_INPUT, path, 0, 0, "does not exist");
    int64_t seen[3] = { st.st_size, st.st_mtim.tv_sec, st.st_mtim.tv_nsec };
    *hash = hash_bytes(hash_bytes(*hash, name, strlen(name)), seen, sizeof seen);
    return true;
}

static bool open_video(struct generator *g, struct error *err)
{
    const struct scene *s = g->scene;
    int frames = 0, last = s->shots[s->shot_count - 1].number;
    if (!s->video) return true;
    if (!video_info(&g->video_width_px, &g->video_height_px, &frames, s->video, err)) return false;
    if (frames > 0 && last >= frames) /* some do not say */
        return error_at(err, ERR_INPUT, s->video, 0, 0, "has %d frames, from 0 to %d: frame %d is not there", frames,
                        frames - 1, last);
    char *absolute = realpath(s->video, NULL);
    g->video_hash = FILE_HASH_SEED;
    bool ok = absolute ? hash_file_state(&g->video_hash, absolute, absolute, err)
                       : error_at(err, ERR_INPUT, s->video, 0, 0, "does not exist");
    free(absolute);
    return ok;
}

static bool trace_models(struct generator *g, struct error *err)
{
    size_t n = 0;
    const struct model **used = calloc(g->scene->model_count + 1, sizeof *used);
    if (!used) return error_set(err, ERR_MEMORY, "no memory for the models");
    for (size_t i = 0; i < g->scene->model_count; i++)
        if (g->stage->models[i]) used[n++] = g->stage->models[i];
    bool ok = tracer_create(&g->tracer, used, n, err);
    free(used);
    return ok;
}

struct pass_settings generator_pass_settings(const struct generator *g)
{
    return pass_settings(g->scene->quality);
}

/* What a quality means may change from version to version. */
static uint64_t hash_settings(uint64_t hash, const struct generator *g)
{
    const struct scene *scene = g->scene;
    struct pass_settings settings = generator_pass_settings(g);
    hash = hash_bytes(hash, PACKAGE_VERSION, sizeof PACKAGE_VERSION);
    hash = hash_bytes(hash, &scene->rendered_hash, sizeof scene->rendered_hash);
    hash = hash_bytes(hash, &scene->quality, sizeof scene->quality);
    hash = hash_bytes(hash, &scene->seed, sizeof scene->seed);
    hash = hash_bytes(hash, g->sky_map, strlen(g->sky_map)); /* named after what is in it */
    hash = hash_bytes(hash, g->light.sun_color, sizeof g->light.sun_color);
    hash = hash_bytes(hash, &g->light.sun_direction, sizeof g->light.sun_direction);
    hash = hash_bytes(hash, &settings.sky_directions, sizeof settings.sky_directions);
    hash = hash_bytes(hash, &settings.fine_px, sizeof settings.fine_px);
    hash = hash_bytes(hash, &settings.radiosity_count, sizeof settings.radiosity_count);
    hash = hash_bytes(hash, &settings.radiosity_error, sizeof settings.radiosity_error);
    hash = hash_bytes(hash, &settings.fineness, sizeof settings.fineness);
    hash = hash_bytes(hash, settings.object_antialias, strlen(settings.object_antialias));
    return hash_bytes(hash, settings.receiver_antialias, strlen(settings.receiver_antialias));
}

/* A scene whose light is to be found from its photographs. */
static bool estimate_light(struct generator *g, struct error *err)
{
    size_t shots[ESTIMATE_PHOTOGRAPHS], n = estimate_shots(shots, g->scene);
    struct estimate_photograph photographs[ESTIMATE_PHOTOGRAPHS] = { 0 };
    char *paths[ESTIMATE_PHOTOGRAPHS] = { 0 };
    struct camera camera;
    if (n == 0)
        return error_at(err, ERR_INPUT, g->scene->path, g->scene->light_source.line, g->scene->light_source.column,
                        "light: is to be told by a photograph, and all shots are new views");
    bool ok = generator_prepare(g, shots, n, err);
    for (size_t i = 0; ok && i < n; i++) {
        char *named = photograph_path(g, shots[i], err);
        paths[i] = named ? path_from_folder(g->out_folder, named) : NULL;
        /* With another camera than the photograph's, what is measured would be wrong. */
        ok = (paths[i] || error_set(err, ERR_MEMORY, "no memory for a path")) && frame_camera(&camera, g, &g->scene->shots[shots[i]], err);
        photographs[i] = (struct estimate_photograph){ shots[i], paths[i] };
        free(named);
    }
    ok = ok && light_estimate(&g->estimate, g->stage, photographs, n, err);
    for (size_t i = 0; i < n; i++) free(paths[i]);
    if (!ok) return false;
    light_estimate_apply(&g->own, &g->estimate);
    g->estimated = true;
    return true;
}

/* Where the real road glitters. */
static bool warn_of_glint(struct generator *g, struct error *err)
{
    return g->scene->wet.reflection <= 0 || !g->light.has_sun ||
           stage_warn(g->stage, string_format("ground.reflection: the sun's own glint on wet ground is left out: against the light the road is too dark, "
                                              "and nothing shades its glitter"), err);
}

static bool warn_of_sun(struct generator *g, struct error *err)
{
    char *text;
    return warn_of_glint(g, err) && map_sun_doubt(&text, &g->light, g->scene, err) && (!text || stage_warn(g->stage, text, err)) &&
           skyline_doubt(&text, &g->light, g->scene, err) && (!text || stage_warn(g->stage, text, err));
}

bool generator_create(struct generator **generator, const struct scene *scene, const char *out_folder,
                      const char *rules_path, struct error *err)
{
    struct generator *g = calloc(1, sizeof *g);
    if (!g) return error_set(err, ERR_MEMORY, "no memory for the generator");
    const char *rules = scene->material_rules ? scene->material_rules : rules_path;
    *g = (struct generator){ .own = *scene, .out_folder = out_folder };
    g->scene = &g->own;
    bool ok = material_rules_read(&g->rules, rules, err) && open_video(g, err);
    if (ok && scene->sky == SKY_AUTO) ok = stage_create(&g->stage, g->scene, g->rules, err) && estimate_light(g, err);
    ok = ok && light_create(&g->light, g->scene, err) && sky_map_write(g->sky_map, out_folder, &g->light, err);
    if (ok) g->rendered_hash = hash_settings(FILE_HASH_SEED, g);
    ok = ok && file_hash(&g->rendered_hash, rules, err) && (g->stage || stage_create(&g->stage, g->scene, g->rules, err)) &&
         warn_of_sun(g, err) && trace_models(g, err);
    if (!ok) {
        generator_destroy(g);
        return false;
    }
    g->rendered_hash = hash_bytes(g->rendered_hash, &g->stage->hash, sizeof g->stage->hash);
    g->input_hash = hash_bytes(g->rendered_hash, &g->scene->hash, sizeof g->scene->hash);
    *generator = g;
    return true;
}

void generator_destroy(struct generator *g)
{
    if (!g) return;
    tracer_destroy(g->tracer);
    include_set_release(&g->includes);
    stage_destroy(g->stage);
    light_release(&g->light);
    material_rules_destroy(g->rules);
    free(g);
}

size_t generator_frame_count(const struct generator *g)
{
    return g->scene->shot_count;
}

void generator_frame_name(char name[FRAME_NAME_SIZE], const struct generator *g, size_t frame)
{
    frame_name(name, &g->scene->shots[frame]);
}

size_t generator_warning_count(const struct generator *g)
{
    return g->stage->warning_count;
}

const char *generator_warning(const struct generator *g, size_t i)
{
    return g->stage->warnings[i];
}

static struct run_facts run_facts(const struct generator *g)
{
    return (struct run_facts){ g->scene, &g->light, g->estimated ? &g->estimate : NULL, g->input_hash };
}

/* The height tells whether foot and tip are those of one shadow. */
static char *north_text(const struct scene *s)
{
    if (!(s->north_shadow_m > 0)) return string_format("%s", "");
    return string_format("north: north_deg %.1f, by a shadow of %.2f m: what casts it is %.2f m high (or else height or tilt of the "
                         "camera are off)\n", fmod(s->north_rad * DEG + 720, 360), s->north_shadow_m, s->north_height_m);
}

/* What was found is told all the same, to compare. */
static char *given_text(const struct generator *g)
{
    const double *k = g->scene->exposure;
    if (!g->estimated || !g->scene->exposure_given) return string_format("%s", "");
    return string_format("light: exposure R %.3f G %.3f B %.3f is given, and taken\n", k[0], k[1], k[2]);
}

/* Is the exposure that of the estimate's ground? Wet ground mirrors light that the estimate does not count. */
static bool fits_to_ground(const struct generator *g)
{
    return g->estimated && !g->scene->exposure_given && g->scene->wet.reflection <= 0;
}

char *generator_light_text(const struct generator *g)
{
    struct run_facts facts = run_facts(g);
    double radiance[3];
    run_ground_radiance(radiance, &facts);
    char *north = north_text(g->scene), *light = g->estimated ? light_estimate_text(&g->estimate, radiance) : string_format("%s", "");
    char *given = given_text(g), *doubt = fits_to_ground(g) ? light_estimate_doubt(&g->estimate, radiance) : string_format("%s", "");
    char *text = north && light && given && doubt ? string_format("%s%s%s%s", north, light, given, doubt) : NULL;
    free(doubt);
    free(north);
    free(light);
    free(given);
    return text;
}

/* --- photographs --- */

/* The path of a frame's photograph as the manifest names it; the caller frees. */
static char *photograph_path(const struct generator *g, size_t frame, struct error *err)
{
    const char *file = g->scene->shots[frame].photograph;
    char name[FRAME_NAME_SIZE], *path;
    generator_frame_name(name, g, frame);
    if (g->scene->video) path = string_format("frames/video_%016llx/%s.png", (unsigned long long)g->video_hash, name);
    else path = file ? realpath(file, NULL) : strdup("");
    if (!path && file) error_at(err, ERR_INPUT, file, 0, 0, "does not exist");
    else if (!path) error_set(err, ERR_MEMORY, "no memory for a path");
    if (path && strlen(path) >= sizeof ((struct manifest *)0)->photograph) {
        error_at(err, ERR_INPUT, path, 0, 0, "the path is too long: %zu bytes are possible",
                 sizeof ((struct manifest *)0)->photograph - 1);
        free(path);
        path = NULL;
    }
    return path;
}

bool generator_prepare(struct generator *g, const size_t *frames, size_t n, struct error *err)
{
    if (!g->scene->video) return true;
    int *numbers = calloc(n + 1, sizeof *numbers);
    char **paths = calloc(n + 1, sizeof *paths);
    size_t missing = 0;
    bool ok = numbers && paths;
    for (size_t i = 0; ok && i < n; i++) {
        char *named = photograph_path(g, frames[i], err), *path = named ? path_from_folder(g->out_folder, named) : NULL;
        char *folder = path ? path_folder(path) : NULL;
        ok = folder && folder_make(folder, err);
        if (ok && !file_exists(path)) {
            numbers[missing] = g->scene->shots[frames[i]].number;
            paths[missing++] = path;
        } else
            free(path);
        free(folder);
        free(named);
    }
    if (!ok) error_set(err, ERR_MEMORY, "no memory for the photographs of a video");
    if (ok && missing) ok = video_extract(g->scene->video, numbers, (const char *const *)paths, missing, err);
    for (size_t i = 0; i < missing; i++) free(paths[i]);
    free(paths);
    free(numbers);
    return ok;
}

/* The lens at the size of the photograph, reduced as the scene says. */
static bool frame_camera(struct camera *camera, const struct generator *g, const struct scene_shot *shot, struct error *err)
{
    const struct scene *s = g->scene;
    const struct scene_camera *given = &s->cameras[shot->camera];
    int width = given->camera.width_px, height = given->camera.height_px;
    if (s->video) {
        width = g->video_width_px;
        height = g->video_height_px;
    } else if (shot->photograph && !image_read_size(&width, &height, shot->photograph, err))
        return false;
    if (!scene_check_shape(s, shot, width, height, err)) return false;
    *camera = camera_scaled(&given->camera, (int)lround(width * s->scale), (int)lround(height * s->scale));
    return true;
}

/* --- frames --- */

static bool frame_keys(struct frame_keys *keys, const struct generator *g, const struct scene_shot *shot, const char *photograph,
                       struct error *err)
{
    uint64_t hash = hash_bytes(g->rendered_hash, &shot->number, sizeof shot->number);
    char *path = path_from_folder(g->out_folder, photograph);
    bool ok = path ? !photograph[0] || hash_file_state(&hash, path, photograph, err)
                   : error_set(err, ERR_MEMORY, "no memory for a path");
    ok = ok && (!shot->semantic || hash_file_state(&hash, shot->semantic, shot->semantic, err)) &&
         (!shot->depth || hash_file_state(&hash, shot->depth, shot->depth, err));
    free(path);
    snprintf(keys->passes, sizeof keys->passes, "%016llx", (unsigned long long)hash);
    hash = hash_bytes(hash, &g->input_hash, sizeof g->input_hash);
    snprintf(keys->all, sizeof keys->all, "%016llx", (unsigned long long)hash);
    return ok;
}

static bool already_there(struct frame_result *result, const char *folder, const char *manifest_path, const char *key)
{
    struct manifest old;
    struct error ignored = ERROR_NONE;
    if (!file_exists(manifest_path) || !manifest_read(&old, manifest_path, &ignored)) return false;
    bool same = !strcmp(old.key, key) && (old.empty || frame_has_passes_key(folder));
    if (same) {
        result->kept = true;
        result->empty = old.empty;
        result->view = old.view;
    }
    manifest_release(&old);
    return same;
}

bool generator_frame(struct frame_result *result, struct generator *g, size_t frame, struct error *err)
{
    const struct scene_shot *shot = &g->scene->shots[frame];
    struct frame_context context = { g->scene, g->out_folder, g->stage, &g->light, g->sky_map, g->tracer, &g->includes };
    struct frame_result made = { 0 };
    struct camera camera;
    generator_frame_name(made.name, g, frame);
    char *folder = string_format("%s/frames/%s", g->out_folder, made.name);
    char *manifest = folder ? string_format("%s/frame.json", folder) : NULL;
    char *photograph = photograph_path(g, frame, err);
    struct frame_keys keys;
    bool ok = false;
    if (!folder || !manifest || !photograph) {
        error_set(err, ERR_MEMORY, "no memory for a path");
        goto out;
    }
    if (!folder_make(folder, err) || !frame_keys(&keys, g, shot, photograph, err)) goto out;
    ok = already_there(&made, folder, manifest, keys.all);
    if (!ok) {
        /* Stopped halfway, the files are of two inputs: no manifest may then speak for them. */
        unlink(manifest);
        ok = frame_camera(&camera, g, shot, err) &&
             frame_make(&made, &context, shot, &camera, folder, photograph, &keys, err);
    }
    if (ok) *result = made;
out:
    free(photograph);
    free(manifest);
    free(folder);
    return ok;
}

bool generator_warn_of_unseen(struct generator *g, const struct frame_result *frames, size_t n, struct error *err)
{
    return n < g->scene->shot_count || sighting_warn(g->stage, g->out_folder, frames, n, err);
}

bool generator_write_run(const struct generator *g, const struct frame_result *frames, size_t n,
                         size_t *others, struct error *err)
{
    struct run_facts facts = run_facts(g);
    char *path = string_format("%s/run.json", g->out_folder);
    bool ok = path ? run_json_write(others, path, &facts, frames, n, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

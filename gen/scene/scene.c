#include "gen/scene/scene.h"

#include "gen/scene/nearest.h"
#include "gen/scene/scene_keys.h"
#include "gen/scene/scene_pose.h"
#include "lib/file.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define SCENE_VERSION 1
#define ENTITIES_MAX 65535 /* instance ids have 16 bits, 0 is none */
#define STEEPEST_COS 0.5   /* ground of more than 60 deg is a mistake; plane_fit's rule */

struct reading { struct scene *scene; const char *path; struct error *err; };

#define FAIL(r, node, ...) \
    error_at((r)->err, ERR_INPUT, (r)->path, (node)->line, (node)->column, __VA_ARGS__)

static double rad_from_deg(double deg) { return deg * M_PI / 180; }
static struct source source_of(const struct yaml_node *node) { return (struct source){ node->line, node->column }; }
static bool out_of_memory(const struct reading *r) { return error_set(r->err, ERR_MEMORY, "no memory for a scene"); }

static double number_at(const struct yaml_node *mapping, const char *key)
{
    return schema_number(yaml_get(mapping, key));
}

static bool copy_text(const struct reading *r, char **text, const struct yaml_node *node)
{
    *text = strdup(node->text);
    return *text || out_of_memory(r);
}

static bool copy_path(const struct reading *r, char **path, const struct yaml_node *node)
{
    *path = path_beside(r->path, node->text);
    return *path || out_of_memory(r);
}

/* "#rrggbb", three linear numbers, or one for all. */
static void read_color(double linear[3], const struct yaml_node *node)
{
    if (node->kind == YAML_SEQUENCE)
        schema_numbers(linear, 3, node);
    else if (!schema_color(linear, node))
        linear[0] = linear[1] = linear[2] = schema_number(node);
}

static bool read_frames(const struct reading *r, const struct yaml_node *frames)
{
    struct scene *scene = r->scene;
    int first = 0, end, step = 1;
    if (frames->kind == YAML_SCALAR) {
        schema_range(&first, &end, &step, frames);
        if (end > FRAME_MAX + 1) return FAIL(r, frames, "photographs.frames: ends after frame %d", FRAME_MAX);
        scene->video_frame_count = (size_t)((end - first - 1) / step + 1);
    } else {
        scene->video_frame_count = frames->count;
    }
    scene->video_frames = calloc(scene->video_frame_count, sizeof *scene->video_frames);
    if (!scene->video_frames) return out_of_memory(r);
    for (size_t i = 0; i < scene->video_frame_count; i++) {
        int frame = first + (int)i * step;
        if (frames->kind == YAML_SEQUENCE) yaml_integer(&frame, frames->items[i]);
        scene->video_frames[i] = frame;
        if (i && scene->video_frames[i - 1] >= frame)
            return FAIL(r, frames->items[i],
                        "photographs.frames[%zu]: frames must ascend, %d comes after %d",
                        i, frame, scene->video_frames[i - 1]);
    }
    return true;
}

static bool read_photographs(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    const struct yaml_node *files = yaml_get(node, "files"), *video = yaml_get(node, "video");
    const struct yaml_node *frames = yaml_get(node, "frames");
    scene->is_video = video != NULL;
    scene->scale = number_at(node, "scale");
    if (frames && !video) return FAIL(r, frames, "photographs.frames: goes with video, not with files");
    if (video && !frames)
        return FAIL(r, video,
                    "photographs: key \"frames\" is missing (\"first:end:step\" or a list of frame numbers from 0)");
    size_t count = video ? 1 : files->count;
    scene->photographs = calloc(count, sizeof *scene->photographs);
    if (!scene->photographs) return out_of_memory(r);
    scene->photograph_count = count;
    for (size_t i = 0; i < count; i++)
        if (!copy_path(r, &scene->photographs[i], video ? video : files->items[i])) return false;
    return !video || read_frames(r, frames);
}

static bool read_lens(const struct reading *r, struct camera *camera, const struct yaml_node *node)
{
    const struct yaml_node *params = yaml_get(node, "params"), *fov = yaml_get(node, "horizontal_fov_deg");
    double size[2];
    schema_numbers(size, 2, yaml_get(node, "size_px"));
    enum camera_model model = (enum camera_model)schema_choice(lens_name, yaml_get(node, "model"));
    const char *name = camera_model_name(model);
    *camera = (struct camera){ .model = model, .width_px = (int)size[0], .height_px = (int)size[1] };
    if (fov) {
        double f = size[0] / 2 / tan(rad_from_deg(schema_number(fov)) / 2);
        if (model == CAMERA_SIMPLE_PINHOLE)
            memcpy(camera->params, (double[]){ f, size[0] / 2, size[1] / 2 }, 3 * sizeof f);
        else if (model == CAMERA_PINHOLE)
            memcpy(camera->params, (double[]){ f, f, size[0] / 2, size[1] / 2 }, 4 * sizeof f);
        else
            return FAIL(r, fov,
                        "camera.horizontal_fov_deg: goes with PINHOLE and SIMPLE_PINHOLE; %s needs params", name);
        return true;
    }
    int count = camera_model_param_count(model);
    if (params->count != (size_t)count)
        return FAIL(r, params, "camera.params: %s takes %d numbers (%s), found %zu", name, count,
                    camera_model_param_names(model), params->count);
    schema_numbers(camera->params, (size_t)count, params);
    struct camera_intrinsics k = camera_intrinsics(camera);
    if (!(k.fx_px > 0 && k.fy_px > 0))
        return FAIL(r, params->items[k.fx_px > 0], "camera.params: the focal length must be above 0");
    return true;
}

static bool read_camera(const struct reading *r, const struct yaml_node *node)
{
    r->scene->camera_source = source_of(node);
    return read_lens(r, &r->scene->camera, node) &&
           scene_pose(&r->scene->world_from_camera, yaml_get(node, "pose"), r->path, r->err);
}

static void read_place(const struct reading *r, const struct yaml_node *root)
{
    struct scene *scene = r->scene;
    const struct yaml_node *place = yaml_get(root, "place"), *time = yaml_get(root, "time");
    scene->north_rad = rad_from_deg(number_at(root, "north_deg"));
    scene->has_place = place != NULL;
    if (place)
        scene->place = (struct geodetic){ rad_from_deg(number_at(place, "latitude_deg")),
                                          rad_from_deg(number_at(place, "longitude_deg")),
                                          number_at(place, "height_m") };
    scene->has_time = time && !utc_time_parse(&scene->time_utc, time->text);
}

/* A key that the user gave and that nothing would come of is a misunderstanding. */
static bool refuse_given(const struct reading *r, const struct yaml_node *mapping, const char *const *keys,
                         const char *section, const char *why)
{
    for (; *keys; keys++) {
        const struct yaml_node *value = yaml_get(mapping, *keys);
        if (!value->is_default) return FAIL(r, value, "%s.%s: %s", section, *keys, why);
    }
    return true;
}

static bool read_overcast(const struct reading *r, const struct yaml_node *node)
{
    static const char *const of_clear[] = { "turbidity", "sun_scale", NULL };
    const struct yaml_node *sun = yaml_get(node, "sun");
    r->scene->sun = SUN_NONE;
    if (sun->kind == YAML_MAPPING)
        return FAIL(r, sun, "light.sun: an overcast sky shows no sun: remove it, or use \"sky: clear\"");
    return refuse_given(r, node, of_clear, "light",
                        "has no meaning under an overcast sky: remove it, or use \"sky: clear\"");
}

static bool read_clear(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    const struct yaml_node *sun = yaml_get(node, "sun");
    if (sun->kind == YAML_MAPPING) {
        scene->sun = SUN_GIVEN;
        scene->sun_azimuth_rad = rad_from_deg(number_at(sun, "azimuth_deg"));
        scene->sun_elevation_rad = rad_from_deg(number_at(sun, "elevation_deg"));
        return true;
    }
    /* How bright a clear sky is, and where, follows from the sun. */
    if (!strcmp(sun->text, "none"))
        return FAIL(r, sun,
                    "light.sun: a clear sky has its light from the sun: \"sun_scale: 0\" takes the sun itself away, "
                    "\"sky: overcast\" needs none");
    if (!scene->has_place || !scene->has_time)
        return FAIL(r, yaml_get(node, "sky"),
                    "light: a clear sky needs its sun, and %s missing: give place and time, or light.sun as "
                    "{azimuth_deg, elevation_deg}",
                    scene->has_place ? "time is" : scene->has_time ? "place is" : "place and time are");
    scene->sun = SUN_BY_TIME;
    return true;
}

static bool read_light(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    scene->sky = (enum sky_kind)schema_choice(sky_name, yaml_get(node, "sky"));
    scene->turbidity = number_at(node, "turbidity");
    scene->sun_scale = number_at(node, "sun_scale");
    scene->sun_source = source_of(yaml_get(node, "sun"));
    return scene->sky == SKY_CLEAR ? read_clear(r, node) : read_overcast(r, node);
}

static bool read_points(const struct reading *r, const struct yaml_node *node)
{
    struct vec3 *points = calloc(node->count, sizeof *points);
    if (!points) return out_of_memory(r);
    for (size_t i = 0; i < node->count; i++) {
        double p[3];
        schema_numbers(p, 3, node->items[i]);
        points[i] = vec3(p[0], p[1], p[2]);
    }
    double rms_m;
    struct error why = ERROR_NONE;
    bool fits = plane_fit(&r->scene->ground, &rms_m, points, node->count, &why);
    free(points);
    return fits || FAIL(r, node, "ground.points_m: %s", why.text);
}

static bool read_ground(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    const struct yaml_node *plane = yaml_get(node, "plane"), *points = yaml_get(node, "points_m");
    read_color(scene->ground_albedo, yaml_get(node, "albedo"));
    scene->ground_reflection = number_at(node, "reflection");
    if (points) return read_points(r, points);
    double p[4] = { 0, 0, 1, 0 };
    if (plane)
        schema_numbers(p, 4, plane);
    else
        p[3] = number_at(node, "height_m");
    struct vec3 normal = vec3(p[0], p[1], p[2]);
    double norm = vec3_norm(normal);
    if (!(norm > 0)) return FAIL(r, plane, "ground.plane: the normal [nx, ny, nz] has no direction");
    if (normal.z < 0) norm = -norm; /* the same plane, its normal upward */
    if (normal.z / norm < STEEPEST_COS)
        return FAIL(r, plane, "ground.plane: steeper than 60 degrees; z is up, level ground is [0, 0, 1, height]");
    scene->ground = (struct plane){ vec3_scale(normal, 1 / norm), p[3] / norm };
    return true;
}

static bool read_exposure(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    const struct yaml_node *value = yaml_get(node, "value"), *patch = yaml_get(node, "patch_px");
    const struct yaml_node *balance = yaml_get(node, "white_balance");
    scene->exposure_source = source_of(patch ? patch : value);
    yaml_boolean(&scene->white_balance, balance);
    scene->exposure_given = value != NULL;
    if (value) {
        if (!balance->is_default)
            return FAIL(r, balance, "exposure.white_balance: is fitted to a patch: it has no meaning with value");
        scene->exposure = schema_number(value);
        scene->white_balance = false;
        return true;
    }
    double p[4];
    schema_numbers(p, 4, patch);
    if (!(p[0] < p[2] && p[1] < p[3]))
        return FAIL(r, patch, "exposure.patch_px: empty: the order is [left, top, right, bottom]");
    if (p[2] > scene->camera.width_px || p[3] > scene->camera.height_px)
        return FAIL(r, patch, "exposure.patch_px: reaches out of the picture of %dx%d px (camera.size_px)",
                    scene->camera.width_px, scene->camera.height_px);
    scene->exposure_patch_px[0] = (struct vec2){ p[0], p[1] };
    scene->exposure_patch_px[1] = (struct vec2){ p[2], p[3] };
    return true;
}

/* glTF states unit and axes; the other formats leave them open. */
static bool format_has_units(const char *file)
{
    const char *dot = strrchr(file, '.');
    return dot && (!strcasecmp(dot, ".gltf") || !strcasecmp(dot, ".glb"));
}

static enum axis read_axis(const struct yaml_node *node)
{
    int i = schema_choice(model_axis_name, node);
    return i <= AXIS_NEG_Z ? (enum axis)i : (enum axis)(2 * (i - AXIS_NEG_Z - 1));
}

static bool read_model(const struct reading *r, struct scene_model *model, const char *name,
                       const struct yaml_node *node)
{
    const struct yaml_node *file = yaml_get(node, "file"), *class_ = yaml_get(node, "class");
    const struct yaml_node *up = yaml_get(node, "up"), *front = yaml_get(node, "front");
    const struct yaml_node *unit = yaml_get(node, "unit_m"), *length = yaml_get(node, "length_m");
    const struct yaml_node *height = yaml_get(node, "height_m");
    struct model_options *options = &model->options;
    model->source = source_of(node);
    model->name = strdup(name);
    if (!model->name) return out_of_memory(r);
    if (!copy_path(r, &model->file, file)) return false;
    bool stated = format_has_units(file->text);
    if (!stated && !unit && !length && !height)
        return FAIL(r, node,
                    "models.%.60s: how large is it? A file of this format does not say: give one of unit_m, "
                    "length_m, height_m", name);
    if (unit) options->unit_m = schema_number(unit);
    if (length) options->length_m = schema_number(length);
    if (height) options->height_m = schema_number(height);
    if (!up != !front || (!stated && !up))
        return FAIL(r, node, "models.%.60s: both \"up\" and \"front\" are needed%s", name,
                    stated ? " where one is given" : ": a file of this format does not state its axes");
    options->axes_given = up != NULL;
    if (up) {
        options->up = read_axis(up);
        options->front = read_axis(front);
        if (options->up / 2 == options->front / 2)
            return FAIL(r, front,
                        "models.%.60s: up (%s) and front (%s) lie on one axis", name, up->text, front->text);
    }
    model->has_class = class_ != NULL;
    if (class_) model->class_ = (enum entity_class)schema_choice(class_choice_name, class_);
    options->has_class = model->has_class;
    options->class_ = model->class_;
    return true;
}

static bool read_models(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    if (!node->count) return true;
    scene->models = calloc(node->count, sizeof *scene->models);
    if (!scene->models) return out_of_memory(r);
    scene->model_count = node->count;
    for (size_t i = 0; i < node->count; i++)
        if (!read_model(r, &scene->models[i], node->keys[i].text, node->items[i])) return false;
    return true;
}

static bool find_model(const struct reading *r, struct scene_entity *entity, const struct yaml_node *name)
{
    const struct scene *scene = r->scene;
    struct nearest nearest = { NULL, 0 };
    for (size_t i = 0; i < scene->model_count; i++) {
        if (!strcmp(scene->models[i].name, name->text)) {
            entity->model_index = i;
            return true;
        }
        nearest_offer(&nearest, name->text, scene->models[i].name);
    }
    if (nearest.name)
        return FAIL(r, name,
                    "entity \"%s\": unknown model \"%.80s\" (did you mean \"%s\"?)",
                    entity->name, name->text, nearest.name);
    return FAIL(r, name,
                "entity \"%s\": unknown model \"%.80s\" (it must be one of the names under models)",
                entity->name, name->text);
}

static bool read_at(const struct reading *r, struct scene_entity *entity, const struct yaml_node *at)
{
    const struct scene *scene = r->scene;
    const struct yaml_node *world = yaml_get(at, "world_m"), *pixel = yaml_get(at, "pixel");
    const struct yaml_node *latitude = yaml_get(at, "latitude_deg"), *longitude = yaml_get(at, "longitude_deg");
    entity->at_source = source_of(world ? world : pixel ? pixel : latitude);
    if (!latitude != !longitude)
        return FAIL(r, latitude ? latitude : longitude,
                    "entity \"%s\": latitude_deg and longitude_deg go together", entity->name);
    if (latitude && !scene->has_place)
        return FAIL(r, latitude, "entity \"%s\": a latitude needs the scene's place", entity->name);
    if (world || pixel) {
        entity->place = world ? PLACE_WORLD : PLACE_PIXEL;
        schema_numbers(entity->at, 2, world ? world : pixel);
    } else {
        entity->place = PLACE_GEODETIC;
        entity->at[0] = schema_number(latitude);
        entity->at[1] = schema_number(longitude);
    }
    if (pixel && (entity->at[0] > scene->camera.width_px || entity->at[1] > scene->camera.height_px))
        return FAIL(r, pixel, "entity \"%s\": the pixel lies outside the picture of %dx%d px (camera.size_px)",
                    entity->name, scene->camera.width_px, scene->camera.height_px);
    return true;
}

static bool read_entity(const struct reading *r, struct scene_entity *entity, const struct yaml_node *node)
{
    const struct yaml_node *name = yaml_get(node, "name"), *model = yaml_get(node, "model");
    const struct yaml_node *class_ = yaml_get(node, "class"), *color = yaml_get(node, "color");
    const struct scene *scene = r->scene;
    entity->source = source_of(node);
    if (!copy_text(r, &entity->name, name) || !copy_text(r, &entity->model, model) || !find_model(r, entity, model))
        return false;
    const struct scene_model *of = &scene->models[entity->model_index];
    if (class_)
        entity->class_ = (enum entity_class)schema_choice(class_choice_name, class_);
    else if (of->has_class)
        entity->class_ = of->class_;
    else
        return FAIL(r, node,
                    "entity \"%s\": class is missing, and its model \"%.80s\" has none", entity->name, of->name);
    entity->heading_rad = rad_from_deg(number_at(node, "heading_deg"));
    entity->has_color = color != NULL;
    if (color) read_color(entity->color, color);
    return read_at(r, entity, yaml_get(node, "at"));
}

static int by_name(const void *a, const void *b)
{
    const struct scene_entity *const *ea = a, *const *eb = b;
    int order = strcmp((*ea)->name, (*eb)->name);
    return order ? order : *ea < *eb ? -1 : *ea > *eb;
}

static bool check_names(const struct reading *r, const struct yaml_node *node)
{
    const struct scene *scene = r->scene;
    const struct scene_entity **sorted = calloc(scene->entity_count, sizeof *sorted);
    if (!sorted) return out_of_memory(r);
    for (size_t i = 0; i < scene->entity_count; i++) sorted[i] = &scene->entities[i];
    qsort(sorted, scene->entity_count, sizeof *sorted, by_name);
    for (size_t i = 1; i < scene->entity_count; i++) {
        if (strcmp(sorted[i - 1]->name, sorted[i]->name)) continue;
        FAIL(r, yaml_get(node->items[sorted[i] - scene->entities], "name"),
             "the name \"%s\" is taken by the entity in line %d", sorted[i]->name, sorted[i - 1]->source.line);
        break;
    }
    free(sorted);
    return r->err->code == ERR_OK;
}

static bool read_entities(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    if (!node->count) return true;
    if (node->count > ENTITIES_MAX) return FAIL(r, node, "entities: more than %d", ENTITIES_MAX);
    scene->entities = calloc(node->count, sizeof *scene->entities);
    if (!scene->entities) return out_of_memory(r);
    scene->entity_count = node->count;
    for (size_t i = 0; i < node->count; i++)
        if (!read_entity(r, &scene->entities[i], node->items[i])) return false;
    return check_names(r, node);
}

static double polygon_area(const struct vec2 *p, size_t n)
{
    double twice = 0;
    for (size_t i = 0, j = n - 1; i < n; j = i++) twice += p[j].x * p[i].y - p[i].x * p[j].y;
    return fabs(twice) / 2;
}

static bool read_occluder(const struct reading *r, struct scene_occluder *occluder, const struct yaml_node *node)
{
    const struct yaml_node *polygon = yaml_get(node, "polygon_px");
    double p[2];
    occluder->source = source_of(node);
    if (!copy_text(r, &occluder->name, yaml_get(node, "name"))) return false;
    occluder->polygon_px = calloc(polygon->count, sizeof *occluder->polygon_px);
    if (!occluder->polygon_px) return out_of_memory(r);
    occluder->polygon_count = polygon->count;
    for (size_t i = 0; i < polygon->count; i++) {
        schema_numbers(p, 2, polygon->items[i]);
        occluder->polygon_px[i] = (struct vec2){ p[0], p[1] };
    }
    if (!(polygon_area(occluder->polygon_px, polygon->count) > 0))
        return FAIL(r, polygon, "occluder \"%s\": the polygon encloses nothing", occluder->name);
    schema_numbers(p, 2, yaml_get(node, "ground_px"));
    occluder->ground_px = (struct vec2){ p[0], p[1] };
    return true;
}

static bool read_occluders(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    if (!node->count) return true;
    scene->occluders = calloc(node->count, sizeof *scene->occluders);
    if (!scene->occluders) return out_of_memory(r);
    scene->occluder_count = node->count;
    for (size_t i = 0; i < node->count; i++)
        if (!read_occluder(r, &scene->occluders[i], node->items[i])) return false;
    return true;
}

static bool read_transfer(const struct reading *r, const struct yaml_node *node)
{
    static const char *const of_threshold[] = { "t1", "t2", "t3", "overwrite", NULL };
    struct scene *scene = r->scene;
    scene->transfer = (enum transfer_kind)schema_choice(transfer_name, yaml_get(node, "method"));
    scene->t1 = number_at(node, "t1");
    scene->t2 = number_at(node, "t2");
    scene->t3 = number_at(node, "t3");
    scene->overwrite = (enum overwrite_side)schema_choice(overwrite_name, yaml_get(node, "overwrite"));
    return scene->transfer == TRANSFER_THRESHOLD ||
           refuse_given(r, node, of_threshold, "transfer", "has a meaning with \"method: threshold\" only");
}

static bool read_settings(const struct reading *r, const struct yaml_node *root)
{
    struct scene *scene = r->scene;
    const struct yaml_node *rules = yaml_get(yaml_get(root, "materials"), "rules");
    scene->mask = (enum mask_rule)schema_choice(mask_name, yaml_get(yaml_get(root, "labels"), "mask"));
    scene->quality = (enum quality)schema_choice(quality_name, yaml_get(root, "quality"));
    yaml_integer(&scene->seed, yaml_get(root, "seed"));
    return !rules || copy_path(r, &scene->material_rules, rules);
}

/* First, so that a file of another version is told so and not that its keys are unknown. */
static bool check_version(const struct reading *r, const struct yaml_node *root)
{
    const struct yaml_node *node = yaml_get(root, "staffage");
    int version;
    if (!node || !yaml_integer(&version, node) || version < 1 || version == SCENE_VERSION) return true;
    return FAIL(r, node,
                "staffage: version %d of the scene format; this program reads version %d", version, SCENE_VERSION);
}

bool scene_read(struct scene **out, const char *path, struct error *err)
{
    char *data = NULL;
    size_t size;
    struct yaml_node *root = NULL;
    struct scene *scene = calloc(1, sizeof *scene);
    struct reading r = { scene, path, err };
    if (!scene) return out_of_memory(&r);
    if (!file_read(&data, &size, path, err)) goto out;
    scene->hash = hash_bytes(FILE_HASH_SEED, data, size);
    scene->path = strdup(path);
    if (!scene->path) {
        out_of_memory(&r);
        goto out;
    }
    if (!yaml_parse(&root, data, size, path, err) || !check_version(&r, root) ||
        !schema_check(&scene_schema, root, path, err) || !schema_fill(&scene_schema, root, err))
        goto out;
    read_place(&r, root);
    if (!read_photographs(&r, yaml_get(root, "photographs")) || !read_camera(&r, yaml_get(root, "camera")) ||
        !read_light(&r, yaml_get(root, "light")) || !read_ground(&r, yaml_get(root, "ground")) ||
        !read_exposure(&r, yaml_get(root, "exposure")) || !read_models(&r, yaml_get(root, "models")) ||
        !read_entities(&r, yaml_get(root, "entities")) || !read_occluders(&r, yaml_get(root, "occluders")) ||
        !read_transfer(&r, yaml_get(root, "transfer")) || !read_settings(&r, root))
        goto out;
    *out = scene;
    scene = NULL;
out:
    yaml_destroy(root);
    free(data);
    scene_destroy(scene);
    return err->code == ERR_OK;
}

void scene_destroy(struct scene *scene)
{
    if (!scene) return;
    for (size_t i = 0; i < scene->photograph_count; i++) free(scene->photographs[i]);
    for (size_t i = 0; i < scene->model_count; i++) {
        free(scene->models[i].name);
        free(scene->models[i].file);
    }
    for (size_t i = 0; i < scene->entity_count; i++) {
        free(scene->entities[i].name);
        free(scene->entities[i].model);
    }
    for (size_t i = 0; i < scene->occluder_count; i++) {
        free(scene->occluders[i].name);
        free(scene->occluders[i].polygon_px);
    }
    free(scene->photographs);
    free(scene->video_frames);
    free(scene->models);
    free(scene->entities);
    free(scene->occluders);
    free(scene->material_rules);
    free(scene->path);
    free(scene);
}

char *scene_schema_text(void)
{
    return schema_text(&scene_schema);
}

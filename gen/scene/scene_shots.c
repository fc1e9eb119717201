#include "gen/scene/nearest.h"
#include "gen/scene/scene_keys.h"
#include "gen/scene/scene_pose.h"
#include "gen/scene/scene_read.h"
#include "lib/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

static bool make_shots(const struct reading *r, size_t count)
{
    r->scene->shots = calloc(count, sizeof *r->scene->shots);
    if (!r->scene->shots) return out_of_memory(r);
    r->scene->shot_count = count;
    return true;
}

static bool make_cameras(const struct reading *r, size_t count)
{
    r->scene->cameras = calloc(count, sizeof *r->scene->cameras);
    if (!r->scene->cameras) return out_of_memory(r);
    r->scene->camera_count = count;
    return true;
}

/* --- one camera that stays where it is --- */

static bool read_frames(const struct reading *r, const struct yaml_node *frames)
{
    struct scene *scene = r->scene;
    int first = 0, end, step = 1;
    size_t count = frames->count;
    if (frames->kind == YAML_SCALAR) {
        schema_range(&first, &end, &step, frames);
        if (end > FRAME_MAX + 1) return FAIL(r, frames, "photographs.frames: ends after frame %d", FRAME_MAX);
        count = (size_t)((end - first - 1) / step + 1);
    }
    if (!make_shots(r, count)) return false;
    for (size_t i = 0; i < count; i++) {
        struct scene_shot *shot = &scene->shots[i];
        shot->number = first + (int)i * step;
        if (frames->kind == YAML_SEQUENCE) yaml_integer(&shot->number, frames->items[i]);
        if (i && shot[-1].number >= shot->number)
            return FAIL(r, frames->items[i],
                        "photographs.frames[%zu]: frames must ascend, %d comes after %d",
                        i, shot->number, shot[-1].number);
    }
    return true;
}

static bool read_photographs(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    const struct yaml_node *files = yaml_get(node, "files"), *video = yaml_get(node, "video");
    const struct yaml_node *frames = yaml_get(node, "frames"), *rate = yaml_get(node, "rate_hz");
    scene->scale = number_at(node, "scale");
    if (frames && !video) return FAIL(r, frames, "photographs.frames: goes with video, not with files");
    if (video && !frames)
        return FAIL(r, video,
                    "photographs: key \"frames\" is missing (\"first:end:step\" or a list of frame numbers from 0)");
    if (video) {
        scene->video_source = source_of(video);
        if (!scene_copy_path(r, &scene->video, video) || !read_frames(r, frames)) return false;
    } else {
        if (!make_shots(r, files->count)) return false;
        for (size_t i = 0; i < files->count; i++) {
            scene->shots[i].number = (int)i;
            if (!scene_copy_path(r, &scene->shots[i].photograph, files->items[i])) return false;
        }
    }
    scene->has_times = rate != NULL;
    for (size_t i = 0; rate && i < scene->shot_count; i++)
        scene->shots[i].time_s = (scene->shots[i].number - scene->shots[0].number) / schema_number(rate);
    return true;
}

static bool read_fixed_camera(const struct reading *r, const struct yaml_node *photographs, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    struct pose world_from_camera;
    if (!node) return FAIL(r, photographs, "photographs: key \"camera\" is missing (mapping): the lens and pose that took them");
    scene->fixed_camera = true;
    if (!read_photographs(r, photographs) || !make_cameras(r, 1)) return false;
    scene->cameras[0].source = source_of(node);
    if (!read_lens(r, &scene->cameras[0].camera, node) ||
        !scene_pose(&world_from_camera, yaml_get(node, "pose"), r->path, r->err))
        return false;
    for (size_t i = 0; i < scene->shot_count; i++) {
        scene->shots[i].world_from_camera = world_from_camera;
        scene->shots[i].source = scene->cameras[0].source;
    }
    return true;
}

/* --- a flight --- */

static bool read_cameras(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    if (!make_cameras(r, node->count)) return false;
    for (size_t i = 0; i < node->count; i++) {
        scene->cameras[i].source = source_of(node->items[i]);
        scene->cameras[i].name = strdup(node->keys[i].text);
        if (!scene->cameras[i].name) return out_of_memory(r);
        if (!read_lens(r, &scene->cameras[i].camera, node->items[i])) return false;
    }
    return true;
}

static bool find_camera(const struct reading *r, size_t *index, const struct yaml_node *name)
{
    const struct scene *scene = r->scene;
    struct nearest nearest = { NULL, 0 };
    for (size_t i = 0; i < scene->camera_count; i++) {
        if (!strcmp(scene->cameras[i].name, name->text)) {
            *index = i;
            return true;
        }
        nearest_offer(&nearest, name->text, scene->cameras[i].name);
    }
    if (nearest.name)
        return FAIL(r, name, "unknown camera \"%.80s\" (did you mean \"%s\"?)", name->text, nearest.name);
    return FAIL(r, name, "unknown camera \"%.80s\" (it must be one of the names under cameras)", name->text);
}

/* The first shot's time is the scene's, where the scene has none of its own. */
static bool read_time(const struct reading *r, struct scene_shot *shot, const struct yaml_node *time, size_t i)
{
    struct scene *scene = r->scene;
    struct utc_time utc;
    if (i > 0 && scene->has_times != (time != NULL))
        return FAIL(r, time ? time : yaml_get(yaml_get(r->root, "shots")->items[i], "camera"),
                    "shots[%zu].time: either all shots have a time or none", i);
    scene->has_times = time != NULL;
    if (!time) return true;
    utc_time_parse(&utc, time->text);
    if (!scene->has_time) scene->time_utc = utc;
    scene->has_time = true;
    shot->time_s = utc_time_since(utc, scene->time_utc);
    return true;
}

static bool read_shot(const struct reading *r, struct scene_shot *shot, const struct yaml_node *node, size_t i)
{
    const struct yaml_node *photograph = yaml_get(node, "photograph"), *semantic = yaml_get(node, "semantic");
    const struct yaml_node *depth = yaml_get(node, "depth");
    shot->number = (int)i;
    shot->source = source_of(node);
    if (!photograph && yaml_get(r->root, "static") == NULL)
        return FAIL(r, node, "shots[%zu]: without a photograph it is a new view, and that needs a static mesh to show", i);
    if (!photograph && (semantic || depth))
        return FAIL(r, semantic ? semantic : depth, "shots[%zu]: a new view has no %s image of its own: remove it", i,
                    semantic ? "semantic" : "depth");
    return (!photograph || scene_copy_path(r, &shot->photograph, photograph)) &&
           (!semantic || scene_copy_path(r, &shot->semantic, semantic)) &&
           (!depth || scene_copy_path(r, &shot->depth, depth)) &&
           find_camera(r, &shot->camera, yaml_get(node, "camera")) && read_time(r, shot, yaml_get(node, "time"), i) &&
           scene_pose(&shot->world_from_camera, yaml_get(node, "pose"), r->path, r->err);
}

static bool read_flight(const struct reading *r, const struct yaml_node *shots, const struct yaml_node *cameras)
{
    struct scene *scene = r->scene;
    scene->scale = 1;
    if (!cameras->count) return FAIL(r, shots, "shots: key \"cameras\" is missing (names with a mapping each)");
    if (!read_cameras(r, cameras) || !make_shots(r, shots->count)) return false;
    for (size_t i = 0; i < shots->count; i++)
        if (!read_shot(r, &scene->shots[i], shots->items[i], i)) return false;
    return true;
}

bool scene_read_shots(const struct reading *r, const struct yaml_node *root)
{
    const struct yaml_node *photographs = yaml_get(root, "photographs"), *camera = yaml_get(root, "camera");
    const struct yaml_node *shots = yaml_get(root, "shots"), *cameras = yaml_get(root, "cameras");
    if (shots && camera) return FAIL(r, camera, "camera: goes with photographs; shots name one of cameras");
    if (photographs && cameras->count) return FAIL(r, cameras, "cameras: goes with shots; photographs have one camera");
    return shots ? read_flight(r, shots, cameras) : read_fixed_camera(r, photographs, camera);
}

bool scene_check_shape(const struct scene *s, const struct scene_shot *shot, int width, int height, struct error *err)
{
    const struct scene_camera *given = &s->cameras[shot->camera];
    double across = (double)width / given->camera.width_px, down = (double)height / given->camera.height_px;
    return fabs(across - down) <= 0.005 * across ||
           error_at(err, ERR_INPUT, s->path, given->source.line, given->source.column,
                    "camera: the calibration is for %d x %d pixels, but %s has %d x %d: another shape; "
                    "size_px must be the size that params were calibrated at", given->camera.width_px,
                    given->camera.height_px, s->video ? s->video : shot->photograph, width, height);
}

bool scene_shape_fits(const struct reading *r, size_t index)
{
    const struct scene_shot *shot = &r->scene->shots[index];
    struct error unread = ERROR_NONE;
    int width, height;
    return !shot->photograph || !image_read_size(&width, &height, shot->photograph, &unread) ||
           scene_check_shape(r->scene, shot, width, height, r->err);
}

bool scene_check_pixel(const struct reading *r, struct vec2 q, size_t shot, const struct yaml_node *node, const char *who)
{
    const struct scene *scene = r->scene;
    if (shot >= scene->shot_count)
        return FAIL(r, node, "%s: there is no shot %zu: they run from 0 to %zu", who, shot, scene->shot_count - 1);
    const struct camera *camera = &scene->cameras[scene->shots[shot].camera].camera;
    return (q.x <= camera->width_px && q.y <= camera->height_px) ||
           (scene_shape_fits(r, shot) &&
            FAIL(r, node, "%s: the pixel lies outside the picture of %dx%d px (camera.size_px)", who, camera->width_px,
                 camera->height_px));
}

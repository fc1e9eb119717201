#include "gen/trace/label.h"
#include "lib/file.h"
#include "lib/rle.h"

#include "tests/gen/solid.h"
#include "tests/tap.h"

#include <jansson.h>
#include <sys/stat.h>
#include <unistd.h>

static const struct pose camera_pose = { { { { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } } }, { 0, 0, 1 } };
static const struct plane flat = { { 0, 0, 1 }, 0 };
static const struct camera camera = { CAMERA_OPENCV, 320, 240, { 400, 400, 160, 120, 0, 0, 0, 0 } };

static char folder[256];

static const char *in_folder(const char *name)
{
    static char path[2][512];
    static int which;
    which = !which;
    snprintf(path[which], sizeof path[which], "%s/%s", folder, name);
    return path[which];
}

static json_t *load(const char *name)
{
    return json_load_file(in_folder(name), 0, NULL);
}

static double number(const json_t *list, size_t i)
{
    return json_number_value(json_array_get(list, i));
}

static bool is_list(const json_t *list, size_t n, const double *want, double tolerance)
{
    if (json_array_size(list) != n) return false;
    for (size_t i = 0; i < n; i++)
        if (!(fabs(number(list, i) - want[i]) <= tolerance)) return false;
    return true;
}
#define IS_LIST(list, tolerance, ...) \
    is_list(list, sizeof(double[]){ __VA_ARGS__ } / sizeof(double), (double[]){ __VA_ARGS__ }, tolerance)

static double real(const json_t *object, const char *key)
{
    return json_number_value(json_object_get(object, key));
}
static long whole(const json_t *object, const char *key)
{
    return (long)json_integer_value(json_object_get(object, key));
}
static bool is_text(const json_t *object, const char *key, const char *want)
{
    const char *got = json_string_value(json_object_get(object, key));
    return got && !strcmp(got, want);
}

/* Every key at any depth is on the manual's page, in back quotes. */
static size_t undocumented(const json_t *json, const char *page)
{
    size_t n = 0, i;
    const char *key;
    json_t *value;
    if (json_is_object(json)) json_object_foreach((json_t *)(size_t)json, key, value)
        {
            char quoted[80];
            snprintf(quoted, sizeof quoted, "`%s`", key);
            if (!strstr(page, quoted)) {
                printf("# no %s\n", quoted);
                n++;
            }
            n += undocumented(value, page);
        }
    else
        json_array_foreach(json, i, value) n += undocumented(value, page);
    return n;
}

static void check_labels(json_t *root)
{
    OK(whole(root, "version") == 1 && is_text(root, "frame", "000042") && is_text(root, "photograph", "street.jpg"),
       "labels: what they are of");
    OK(IS_LIST(json_object_get(root, "sun_direction"), 1e-12, 0, 0.6, 0.8), "the sun's direction");
    json_t *c = json_object_get(root, "camera"), *rows = json_object_get(c, "world_from_camera"),
           *k = json_object_get(c, "K");
    OK(is_text(c, "model", "OPENCV") && IS_LIST(json_object_get(c, "size_px"), 0, 320, 240) &&
           IS_LIST(json_object_get(c, "params"), 0, 400, 400, 160, 120, 0, 0, 0, 0),
       "the camera with all its parameters");
    OK(IS_LIST(json_array_get(k, 0), 0, 400, 0, 160) && IS_LIST(json_array_get(k, 1), 0, 0, 400, 120) &&
           IS_LIST(json_array_get(k, 2), 0, 0, 0, 1),
       "K");
    OK(IS_LIST(json_array_get(rows, 0), 0, 1, 0, 0, 0) && IS_LIST(json_array_get(rows, 1), 0, 0, 0, 1, 0) &&
           IS_LIST(json_array_get(rows, 2), 0, 0, -1, 0, 1),
       "3 x 4 of the camera");

    json_t *list = json_object_get(root, "entities"), *near = json_array_get(list, 0), *far_ = json_array_get(list, 1),
           *gone = json_array_get(list, 2);
    OK(json_array_size(list) == 3, "entities that are not seen are listed as well");
    OK(whole(near, "id") == 9 && is_text(near, "name", "the near one") && is_text(near, "class", "person") &&
           whole(near, "semantic_id") == 24 && is_text(near, "model", "plate"),
       "an entity's names");
    OK(IS_LIST(json_object_get(near, "box_visible_px"), 0, 120, 80, 80, 80), "a box is x, y, width, height");
    OK(IS_LIST(json_object_get(far_, "box_amodal_px"), 0, 160, 100, 80, 80), "and of the whole, whatever hides it");
    OK(whole(far_, "pixels_visible") == 3200 && whole(far_, "pixels_amodal") == 6400 &&
           whole(far_, "pixels_total") == 6400,
       "pixels");
    NEAR(real(far_, "visible_fraction"), 0.5, 1e-12, "visible fraction");
    NEAR(real(near, "truncation"), 0, 0, "truncation");
    OK(json_is_true(json_object_get(near, "in_frame")) && json_is_false(json_object_get(gone, "in_frame")) &&
           real(gone, "truncation") == 1,
       "what is behind the camera is not in the frame");
    json_t *by = json_object_get(far_, "hidden_by"), *first = json_array_get(by, 0), *second = json_array_get(by, 1);
    OK(json_array_size(by) == 2 && is_text(first, "kind", "entity") && is_text(first, "name", "the near one") &&
           whole(first, "id") == 9 && whole(first, "pixels") == 2400,
       "hidden by an entity");
    OK(is_text(second, "kind", "occluder") && is_text(second, "name", "post") && whole(second, "id") == 0 &&
           whole(second, "pixels") == 800,
       "and by an occluder");

    /* The far one faces south: its x axis is the world's -y, its y axis the world's x. */
    json_t *pose = json_object_get(far_, "world_from_entity"), *seen = json_object_get(far_, "camera_from_entity");
    double h = sqrt(0.5);
    OK(IS_LIST(json_object_get(pose, "quaternion_wxyz"), 1e-12, h, 0, 0, -h) &&
           IS_LIST(json_object_get(pose, "translation_m"), 1e-12, 2, 20, -2),
       "its pose in the world");
    /* x goes to -z of the camera, y to x, z to -y: half a unit in w, x, y and -z */
    OK(IS_LIST(json_object_get(seen, "translation_m"), 1e-12, 2, 3, 20) &&
           IS_LIST(json_object_get(seen, "quaternion_wxyz"), 1e-12, 0.5, 0.5, 0.5, -0.5),
       "its pose in the camera");
    OK(IS_LIST(json_object_get(far_, "size_m"), 1e-6, 0, 4, 4), "its size");
    json_t *world = json_object_get(far_, "box_3d_world_m"), *box = json_object_get(far_, "box_3d_camera_m");
    OK(json_array_size(world) == 8 && IS_LIST(json_array_get(world, 1), 1e-6, 0, 20, 2) &&
           IS_LIST(json_array_get(world, 2), 1e-6, 4, 20, -2),
       "corners: right before left, bottom before top");
    bool inside = true;
    for (size_t i = 0; i < 8; i++) {
        struct error err = ERROR_NONE;
        struct vec2 q;
        json_t *p = json_array_get(box, i);
        inside = inside && camera_project(&camera, &q, vec3(number(p, 0), number(p, 1), number(p, 2)), &err) &&
                 (fabs(q.x - 160) < 1e-4 || fabs(q.x - 240) < 1e-4) &&
                 (fabs(q.y - 100) < 1e-4 || fabs(q.y - 180) < 1e-4);
    }
    OK(inside, "the camera's corners project to those of the box in the picture");
}

static void check_amodal(json_t *root)
{
    json_t *list = json_object_get(root, "entities"), *e = json_array_get(list, 1),
           *s = json_object_get(e, "segmentation");
    OK(whole(root, "version") == 1 && is_text(root, "frame", "000042") && json_array_size(list) == 2,
       "amodal: those in the frame");
    OK(whole(e, "id") == 4 && IS_LIST(json_object_get(s, "size"), 0, 240, 320), "size is height, width");
    struct error err = ERROR_NONE;
    struct rle rle = { 0 };
    const char *counts = json_string_value(json_object_get(s, "counts"));
    static uint8_t mask[240 * 320];
    bool ok = counts && rle_from_string(&rle, counts, 320, 240, &err);
    if (ok) rle_decode(mask, &rle);
    for (int y = 0; y < 240; y++)
        for (int x = 0; x < 320; x++) ok = ok && mask[y * 320 + x] == (x >= 160 && x < 240 && y >= 100 && y < 180);
    OK(ok, "the mask is whole%s", err.text);
    rle_release(&rle);
    OK(IS_LIST(json_object_get(e, "depth_range_m"), 1e-4, 20, 20), "the range of its depth");
    OK(is_text(e, "depth", "00004.exr") && IS_LIST(json_object_get(e, "depth_box_px"), 0, 160, 100, 80, 80),
       "where its depth lies");
    struct image depth = { 0 };
    OK(image_read(&depth, in_folder("amodal/00004.exr"), &err) && depth.width_px == 80 && depth.height_px == 80 &&
           depth.type == PIXEL_F32 && fabs((double)*image_f32(&depth, 0, 0) - 20) < 1e-4,
       "amodal depth, where it is hidden too%s", err.text);
    image_release(&depth);
}

static void check_images(void)
{
    struct error err = ERROR_NONE;
    struct image instance = { 0 }, depth = { 0 }, visible = { 0 }, receiver = { 0 };
    OK(image_read(&instance, in_folder("instance.png"), &err) && instance.type == PIXEL_U16 && instance.channels == 1 &&
           *image_u16(&instance, 130, 90) == 9 && *image_u16(&instance, 235, 170) == 0 &&
           *image_u16(&instance, 210, 170) == 4 && *image_u16(&instance, 5, 5) == 0,
       "instance.png%s", err.text);
    OK(image_read(&depth, in_folder("depth.exr"), &err) && depth.type == PIXEL_F32 && depth.channels == 1 &&
           fabs((double)*image_f32(&depth, 130, 90) - 10) < 1e-5 && isnan(*image_f32(&depth, 5, 5)),
       "depth.exr, NaN where nothing is known%s", err.text);
    OK(image_read(&visible, in_folder("visible.png"), &err) && visible.type == PIXEL_U8 &&
           *image_u8(&visible, 235, 170) == 0 && *image_u8(&visible, 130, 90) == 255,
       "visible.png%s", err.text);
    OK(image_read(&receiver, in_folder("receiver.png"), &err) && *image_u8(&receiver, 235, 150) == 0, "receiver.png%s",
       err.text);
    image_release(&instance);
    image_release(&depth);
    image_release(&visible);
    image_release(&receiver);
}

/* A frame of a scene that moves, in a place that has labels, from where no photograph was taken. */
static void check_moving(json_t *root)
{
    struct error err = ERROR_NONE;
    json_t *list = json_object_get(root, "entities"), *person = json_array_get(list, 0), *car = json_array_get(list, 1);
    OK(is_text(root, "time", "2016-06-23T21:32:00.5Z") && real(root, "time_s") == 1.25, "when it is");
    OK(IS_LIST(json_object_get(person, "velocity_m_s"), 0, 1, -2, 0.5), "how fast an entity moves");
    OK(root && !json_object_get(root, "photograph"), "a new view names no photograph");
    OK(whole(person, "semantic_id") == 6 && whole(car, "semantic_id") == 7, "ids are those of the palette");
    struct image depth = { 0 }, label = { 0 }, motion = { 0 };
    OK(image_read(&depth, in_folder("place_depth.exr"), &err) && depth.type == PIXEL_F32 && depth.channels == 1 &&
           *image_f32(&depth, 7, 8) == 31.25f && isnan(*image_f32(&depth, 8, 8)),
       "place_depth.exr%s", err.text);
    OK(image_read(&label, in_folder("place_labels.png"), &err) && label.type == PIXEL_U8 && *image_u8(&label, 7, 8) == 3,
       "place_labels.png%s", err.text);
    OK(image_read(&motion, in_folder("motion.exr"), &err) && motion.type == PIXEL_F32 && motion.channels == 3 &&
           image_f32(&motion, 7, 8)[1] == -2.5f && image_f32(&motion, 7, 8)[0] == 0,
       "motion.exr%s", err.text);
    image_release(&depth);
    image_release(&label);
    image_release(&motion);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct solid near, far_;
    solid_plate(&near, 2, 2);
    solid_plate(&far_, 4, 4);
    const struct mat3 south = { { { 0, 1, 0 }, { -1, 0, 0 }, { 0, 0, 1 } } };
    struct entity entities[3] = {
        { .id = 9,
          .name = "the near one",
          .model_name = "plate",
          .class_ = CLASS_PERSON,
          .model = &near.model,
          .world_from_entity = { south, { 0, 10, 0 } } },
        { .id = 4,
          .name = "the far one",
          .model_name = "plate",
          .class_ = CLASS_CAR,
          .model = &far_.model,
          .world_from_entity = { south, { 2, 20, -2 } } },
        { .id = 5,
          .name = "gone",
          .model_name = "plate",
          .class_ = CLASS_CAR,
          .model = &near.model,
          .world_from_entity = { south, { 0, -10, 0 } } },
    };
    static const struct vec2 outline[4] = { { 230, 20 }, { 250, 20 }, { 250, 230 }, { 230, 230 } };
    static const struct occluder post = { "post", outline, 4, { 1, 5, 0 } };
    const struct model *models[2] = { &near.model, &far_.model };
    struct tracer *tracer = NULL;
    struct frame_labels labels = { 0 };
    bool ok = tracer_create(&tracer, models, 2, &err) &&
              trace_frame(&labels, tracer, &(struct trace_input){ .camera = &camera, .world_from_camera = camera_pose, .ground = &flat,
                                                                  .entities = entities, .entity_count = 3, .occluders = &post, .occluder_count = 1 }, &err);
    struct label_context context = {
        "000042", "/a/street.jpg", &camera, camera_pose, true, { 0, 0.6, 0.8 }, entities, 3, .time_s = NAN
    };

    strcpy(folder, "label.XXXXXX");
    if (!OK(ok && mkdtemp(folder) && mkdir(in_folder("amodal"), 0777) == 0 &&
                file_write(in_folder("amodal/00005.exr"), "old", 3, &err) &&
                labels_write(folder, &labels, &context, &err),
            "the labels of a frame are written%s", err.text))
        return tap_done();
    OK(!file_exists(in_folder("amodal/00005.exr")), "an earlier run's depth of what is no longer in the frame goes");

    json_t *root = load("labels.json"), *amodal = load("amodal.json");
    check_labels(root);
    check_amodal(amodal);
    check_images();

    const char *top = getenv("top_srcdir");
    char manual[600], *page = NULL, *first = NULL, *second = NULL;
    size_t size, first_size = 0, second_size = 1;
    snprintf(manual, sizeof manual, "%s/docs/labels.md", top ? top : ".");
    OK(file_read(&page, &size, manual, &err) && undocumented(root, page) == 0 && undocumented(amodal, page) == 0,
       "docs/labels.md has every key");
    ok = file_read(&first, &first_size, in_folder("labels.json"), &err) &&
         labels_write(folder, &labels, &context, &err) &&
         file_read(&second, &second_size, in_folder("labels.json"), &err);
    OK(ok && first_size == second_size && !memcmp(first, second, first_size), "written again, they are the same");

    context.has_sun = false;
    json_t *dark = labels_write(folder, &labels, &context, &err) ? load("labels.json") : NULL;
    OK(dark && !json_object_get(dark, "sun_direction"), "without a sun there is no direction to it");
    OK(dark && !json_object_get(dark, "time_s") && !json_object_get(dark, "time") &&
           !json_object_get(json_array_get(json_object_get(dark, "entities"), 0), "velocity_m_s") &&
           !file_exists(in_folder("motion.exr")) && !file_exists(in_folder("place_depth.exr")),
       "nor times, speeds and a place where there are none");

    context.photograph = NULL;
    context.time = "2016-06-23T21:32:00.5Z";
    context.time_s = 1.25;
    context.velocity_m_s = (const struct vec3[3]){ { 1, -2, 0.5 }, { 0, 0, 0 }, { 0, 13.9, 0 } };
    context.palette = PALETTE_UAVID;
    struct image motion = { 0 };
    ok = image_init(&motion, 320, 240, 3, PIXEL_F32, &err) && image_init(&labels.place_depth, 320, 240, 1, PIXEL_F32, &err) &&
         image_init(&labels.place_label, 320, 240, 1, PIXEL_U8, &err);
    if (ok) {
        image_f32(&motion, 7, 8)[1] = -2.5f;
        *image_f32(&labels.place_depth, 7, 8) = 31.25f;
        *image_f32(&labels.place_depth, 8, 8) = NAN;
        *image_u8(&labels.place_label, 7, 8) = 3;
    }
    context.motion = &motion;
    json_t *moving = ok && labels_write(folder, &labels, &context, &err) ? load("labels.json") : NULL;
    check_moving(moving);
    OK(page && undocumented(moving, page) == 0, "docs/labels.md has the keys of what moves");
    image_release(&motion);

    static const char *const files[] = { "place_depth.exr",  "place_labels.png", "motion.exr", "amodal/00009.exr", "amodal/00004.exr", "amodal.json", "labels.json",
                                         "instance.png",     "depth.exr",        "visible.png", "receiver.png" };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) unlink(in_folder(files[i]));
    rmdir(in_folder("amodal"));
    OK(rmdir(folder) == 0, "and there are no other files");
    free(page);
    free(first);
    free(second);
    json_decref(root);
    json_decref(amodal);
    json_decref(dark);
    json_decref(moving);
    frame_labels_release(&labels);
    tracer_destroy(tracer);
    solid_free(&near);
    solid_free(&far_);
    return tap_done();
}

/* Whole frames, from a scene's text to the files in its folder. */
#include "gen/generator.h"
#include "lib/file.h"
#include "lib/image.h"
#include "lib/manifest.h"

#include "tests/tap.h"

#include <jansson.h>
#include <unistd.h>

static char scratch[] = "frame-test.XXXXXX";
static char top[512]; /* the sources */

#define HIGH "pose: {look_at: {position_m: [0, -5, 30], target_m: [0, 0, 0]}}"

static char *in_scratch(const char *name)
{
    return string_format("%s/%s", scratch, name);
}

static void put(const char *name, const char *text)
{
    struct error err = ERROR_NONE;
    char *path = in_scratch(name);
    if (!file_write(path, text, strlen(text), &err)) OK(false, "%s can be written: %s", path, err.text);
    free(path);
}

/* A scene's first frame: head, then the rest of its text. False, and why, when it cannot be made. */
static bool make(const char *head, const char *rest, struct error *err)
{
    struct scene *scene = NULL;
    struct generator *generator = NULL;
    struct frame_result result;
    char *text = string_format("staffage: 1\nquality: draft\nlight: {sky: clear, sun: {azimuth_deg: 180, elevation_deg: 50}}\n"
                               "models: {box: {file: %s/tests/input/box.obj, unit_m: 1, up: +z, front: +x, class: car}}\n%s\n%s\n",
                               top, head, rest);
    char *rules = string_format("%s/templates/materials.rules", top), *path = in_scratch("scene.yaml"), *out = in_scratch("out");
    put("scene.yaml", text);
    bool ok = scene_read(&scene, path, NULL, err) && generator_create(&generator, scene, out, rules, err) &&
              generator_frame(&result, generator, 0, err);
    generator_destroy(generator);
    scene_destroy(scene);
    free(text);
    free(rules);
    free(path);
    free(out);
    return ok;
}

static bool makes(const char *head, const char *rest)
{
    struct error err = ERROR_NONE;
    bool ok = make(head, rest, &err);
    if (!ok) printf("# %s:%d: %s\n", err.file, err.line, err.text);
    return ok;
}

static char *of_frame(const char *name)
{
    return string_format("%s/out/frames/000000/%s", scratch, name);
}

/* The first entity's labels; the caller's. */
static json_t *labels(void)
{
    char *path = of_frame("labels.json");
    json_t *root = json_load_file(path, 0, NULL), *entity = json_incref(json_array_get(json_object_get(root, "entities"), 0));
    json_decref(root);
    free(path);
    return entity;
}

static char *fixed(const char *more)
{
    return string_format("photographs: {files: [%s/tests/input/street.png]%s}\n"
                         "camera: {model: PINHOLE, size_px: [64, 48], params: [60, 60, 32, 24], " HIGH "}", top, more);
}

static void test_occluder_over_mesh(void)
{
    char *head = fixed("");
    if (OK(makes(head, "static: {mesh: flat.ply}\nexposure: {value: 1}\n"
                       "entities: [{name: e, model: box, at: {world_m: [0, 0]}, heading_deg: 0}]\n"
                       "occluders: [{name: fence, polygon_px: [[20, 20], [44, 20], [44, 40], [20, 40]], ground_px: [32, 30]}]"),
           "a frame with an occluder over a static mesh")) {
        json_t *entity = labels(), *hider = json_array_get(json_object_get(entity, "hidden_by"), 0);
        const char *name = json_string_value(json_object_get(hider, "name"));
        OK(name && !strcmp(name, "fence"), "an occluder that stands on a static mesh hides what is behind it");
        OK(!json_object_get(entity, "velocity_m_s"), "nothing has a velocity in a scene that stands still");
        json_decref(entity);
    }
    free(head);
}

static void test_outline_of_one_shot(void)
{
    char *head = string_format("cameras: {drone: {model: PINHOLE, size_px: [64, 48], params: [60, 60, 32, 24]}}\n"
                               "shots:\n  - {photograph: %s/tests/input/street.png, camera: drone, " HIGH "}\n"
                               "  - {photograph: %s/tests/input/street.png, camera: drone, " HIGH "}\n", top, top);
    static const char rest[] = "static: {mesh: flat.ply}\nexposure: {value: 1}\n"
                               "entities: [{name: e, model: box, at: {world_m: [0, 0]}, heading_deg: 0}]\n"
                               "occluders: [{name: fence, polygon_px: [[20, 20], [44, 20], [44, 40], [20, 40]], ground_px: [32, 30], shot: %d}]";
    for (int shot = 0; shot < 2; shot++) {
        char text[400];
        snprintf(text, sizeof text, rest, shot);
        if (!OK(makes(head, text), "shot 0 of a flight, with an outline of shot %d", shot)) continue;
        json_t *entity = labels();
        size_t hiders = json_array_size(json_object_get(entity, "hidden_by"));
        OK(hiders == (shot ? 0 : 1), shot ? "an outline of another shot hides nothing" : "its own outline hides what is behind it");
        json_decref(entity);
    }
    free(head);
}

static void test_shade_that_moves(void)
{
    char *head = fixed(", rate_hz: 1"), *path = of_frame("motion.exr");
    struct image motion;
    struct error err = ERROR_NONE;
    if (OK(makes(head, "ground: {height_m: 0}\nexposure: {value: 1}\nlens: {exposure_s: 0.1}\n"
                       "paths: [{name: way, use: vehicles, width_m: 3, points_m: [[0, 0], [20, 0]]}]\n"
                       "entities: [{name: e, model: box, path: way, speed_m_s: 10}]"),
           "a frame of a box that moves over a plane") &&
        OK(image_read(&motion, path, &err), "its motion")) {
        /* 1 m to the right, seen from about 30 m with f = 60 px. North of the box lies its shadow. */
        double seen = (double)image_f32(&motion, 32, 24)[0], shade = (double)image_f32(&motion, 32, 19)[0];
        NEAR(seen, 2, 0.2, "the box moves");
        NEAR(shade, seen, 0.2, "its shadow on the plane moves with it");
        image_release(&motion);
    }
    free(head);
    free(path);
}

static void test_end_of_path(void)
{
    char *head = fixed(", rate_hz: 1");
    static const char rest[] = "time: 2021-05-01T10:53:40-04:00\nstatic: {mesh: %s.ply}\nexposure: {value: 1}\n"
                               "paths: [{name: way, use: vehicles, width_m: 3, points_m: [[-10, 0], [10, 0]]}]\n"
                               "entities: [{name: e, model: box, path: way, start_m: %s, speed_m_s: 6}]";
    static const struct { const char *mesh, *start; double velocity[3]; const char *what; } cases[] = {
        { "flat", "10", { 6, 0, 0 }, "who is on its way has its velocity" },
        { "flat", "20", { 0, 0, 0 }, "who came to the end of its path has none" },
        { "slope", "10", { 6, 0, 1.2 }, "uphill it goes up as well" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        snprintf(text, sizeof text, rest, cases[i].mesh, cases[i].start);
        if (!OK(makes(head, text), "a frame of a path")) continue;
        char *path = of_frame("labels.json");
        json_t *root = json_load_file(path, 0, NULL);
        const char *time = json_string_value(json_object_get(root, "time"));
        OK(time && !strcmp(time, "2021-05-01T14:53:40.000Z"), "the labels have the shot's time: %s", time ? time : "none");
        json_decref(root);
        free(path);
        json_t *entity = labels(), *velocity = json_object_get(entity, "velocity_m_s");
        for (size_t k = 0; k < 3; k++)
            NEAR(json_number_value(json_array_get(velocity, k)), cases[i].velocity[k], 0.02, "%s: %c", cases[i].what, "xyz"[k]);
        json_decref(entity);
    }
    free(head);
}

static void test_exposure_without_roads(void)
{
    struct error err = ERROR_NONE;
    char *head = fixed("");
    OK(!make(head, "static: {mesh: flat.ply}\nexposure: {roads: true}\n"
                   "paths: [{name: way, use: vehicles, width_m: 3, points_m: [[-28, 28], [28, 28]]}]\n"
                   "entities: [{name: e, model: box, at: {world_m: [0, 0]}, heading_deg: 0}]", &err) &&
       err.code == ERR_INPUT && err.line > 0 && strstr(err.text, "exposure.roads: frame 000000 shows no road in full light"),
       "a frame that shows no road cannot be exposed by roads, at its place in the scene: %s", err.text);
    free(head);
}

/* A frame's manifest; the caller releases it. */
static bool manifest_there(struct manifest *m)
{
    struct error err = ERROR_NONE;
    char *path = of_frame("frame.json");
    bool ok = OK(manifest_read(m, path, &err), "the frame's manifest: %s", err.text);
    free(path);
    return ok;
}

/* A grey photograph of 137, 0.25016 linear, under a ground of albedo 0.2: what light reaches it cannot be told from here. */
static void test_exposure_is_fitted(void)
{
    static uint8_t grey[64 * 48 * 3];
    struct image image = { 64, 48, 3, PIXEL_U8, grey };
    struct error err = ERROR_NONE;
    struct manifest one, other;
    static const char head[] = "photographs: {files: [grey.png]}\ncamera: {model: PINHOLE, size_px: [64, 48], params: [60, 60, 32, 24], " HIGH "}";
    static const char rest[] = "ground: {height_m: 0, albedo: %s}\nexposure: {patch_px: [4, 4, 20, 20]}\n"
                               "entities: [{name: e, model: box, at: {world_m: [0, 0]}, heading_deg: 0}]\n"
                               "surroundings: {skyline_deg: 0}";
    char *path = in_scratch("grey.png"), text[512];
    memset(grey, 137, sizeof grey);
    bool written = image_write(path, &image, &err);
    snprintf(text, sizeof text, rest, "0.2");
    if (OK(written && makes(head, text), "a frame whose exposure is fitted") && manifest_there(&one)) {
        OK(one.exposure_fitted && one.exposure_patch_px.x0 == 4 && one.exposure_patch_px.y1 == 20, "to a patch, says its manifest");
        NEAR(one.exposure_median[1], 0.25016, 1e-4, "of this brightness");
        snprintf(text, sizeof text, rest, "0.1");
        if (makes(head, text) && manifest_there(&other)) {
            for (int c = 0; c < 3; c++)
                NEAR(other.exposure[c] / one.exposure[c], 2, 1e-9, "half as white a ground needs twice the exposure");
            manifest_release(&other);
        }
        manifest_release(&one);
    }
    memset(grey, 180, sizeof grey); /* 0.45641 */
    if (OK(image_write(path, &image, &err) && makes(head, text) && manifest_there(&one), "of another photograph under the same name")) {
        NEAR(one.exposure_median[1], 0.45641, 1e-4, "the exposure is another");
        manifest_release(&one);
    }
    memset(grey, 255, sizeof grey);
    OK(image_write(path, &image, &err) && !make(head, text, &err) && err.code == ERR_INPUT && err.line == 8 && err.column == 22 &&
           strstr(err.text, "grey.png: exposure patch 4,4 to 20,20: 100.0 % of it is saturated"),
       "a patch that cannot be fitted to is an error at the scene's line: %s", err.text);
    free(path);
}

/* A road of 0.1 and a narrower sidewalk of 0.2 beside it, seen along the road from 6 m up, through haze of 0.5 that leaves
 * 5 % at visibility_m (0: none): far off the road is as bright as the sidewalk is here. */
static bool put_street(const char *name, double visibility_m)
{
    enum { W = 320, H = 240 };
    static uint8_t rgb[W * H * 3];
    struct image image = { W, H, 3, PIXEL_U8, rgb };
    struct error err = ERROR_NONE;
    double down = atan2(6, 28);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            double u = (x + 0.5 - 160) / 200, v = (y + 0.5 - 120) / 200, fall = sin(down) + v * cos(down), value = 0.5;
            if (fall > 0) {
                double range = 6 / fall, t = visibility_m > 0 ? pow(0.05, range * sqrt(1 + u * u + v * v) / visibility_m) : 1;
                value = (u * range < 3 ? 0.1 : 0.2) * t + 0.5 * (1 - t);
            }
            memset(rgb + 3 * (y * W + x), (int)(255 * (double)srgb_from_linear((float)value) + 0.5), 3);
        }
    char *path = in_scratch(name);
    bool ok = image_write(path, &image, &err);
    free(path);
    return ok;
}

static void test_exposure_in_mist(void)
{
    static const char head[] = "photographs: {files: [street.png]}\ncamera: {model: PINHOLE, size_px: [320, 240], params: [200, 200, 160, 120], "
                               "pose: {look_at: {position_m: [0, 0, 6], target_m: [0, 28, 0]}}}\nground: {height_m: 0, albedo: 0.1}\nexposure: auto";
    static const char car[] = "entities: [{name: e, model: box, at: {world_m: [0, 15]}, heading_deg: 0}]";
    static const char mist[] = "weather: {visibility_m: 120, haze: [0.5, 0.5, 0.5]}\n"
                               "entities: [{name: e, model: box, at: {world_m: [0, 15]}, heading_deg: 0}]";
    struct manifest clear, hazy;
    if (!OK(put_street("street.png", 0) && makes(head, car) && manifest_there(&clear), "a street, exposed by its ground")) return;
    if (OK(put_street("street.png", 120) && makes(head, mist) && manifest_there(&hazy), "the same in haze")) {
        for (int c = 0; c < 3; c++) NEAR(hazy.exposure[c] / clear.exposure[c], 1, 0.1, "has the same exposure, channel %d", c);
        manifest_release(&hazy);
    }
    manifest_release(&clear);
}

/* The warnings of what the first n frames of a scene show; the caller's, NULL when it cannot be made. */
static char *unseen(const char *head, const char *rest, size_t n)
{
    struct error err = ERROR_NONE;
    struct scene *scene = NULL;
    struct generator *generator = NULL;
    struct frame_result results[2];
    char *path = in_scratch("scene.yaml"), *out = in_scratch("out"), *rules = string_format("%s/templates/materials.rules", top);
    char *told = NULL;
    bool ok = make(head, rest, &err) && scene_read(&scene, path, NULL, &err) && generator_create(&generator, scene, out, rules, &err);
    for (size_t i = 0; ok && i < n; i++) ok = generator_frame(&results[i], generator, i, &err);
    if (ok && generator_warn_of_unseen(generator, results, n, &err)) told = string_format("%s", "");
    else printf("# %s:%d: %s\n", err.file, err.line, err.text);
    for (size_t i = 0; told && i < generator_warning_count(generator); i++) {
        char *longer = string_format("%s%s\n", told, generator_warning(generator, i));
        free(told);
        told = longer;
    }
    generator_destroy(generator);
    scene_destroy(scene);
    free(path);
    free(out);
    free(rules);
    return told;
}

static void check_unseen(const char *head, const char *rest, size_t n, const char *want, const char *what)
{
    char *told = unseen(head, rest, n);
    if (!OK(told && !strcmp(told, want), "%s", what)) printf("# %s\n", told ? told : "none");
    free(told);
}

/* The box is 4 m long. Seen from 30 m with f = 60 px it has 8 px, from 90 m 2 px or 3. */
static void test_unseen(void)
{
#define BOX(name, x, y) "{name: " name ", model: box, at: {world_m: [" x ", " y "]}, heading_deg: 0}"
#define PLAIN "ground: {height_m: 0}\nexposure: {value: 1}\n"
    char *head = fixed(""), *two = string_format(
        "photographs: {files: [%s/tests/input/street.png, %s/tests/input/street.png], rate_hz: 1}\n"
        "camera: {model: PINHOLE, size_px: [64, 48], params: [60, 60, 32, 24], " HIGH "}", top, top);
    char *level = string_format("photographs: {files: [%s/tests/input/street.png]}\n"
                                "camera: {model: PINHOLE, size_px: [64, 48], params: [60, 60, 32, 24], "
                                "pose: {look_at: {position_m: [0, 0, 6], target_m: [0, 28, 0]}}}", top);
    static const char far[] = PLAIN "entities: [" BOX("near", "0", "15") ", " BOX("beside", "60", "0") ", " BOX("tiny", "0", "90") "]";
    static const char many[] = PLAIN "entities: [" BOX("a", "60", "0") ", " BOX("b", "60", "9") ", " BOX("c", "60", "18") ", "
        BOX("d", "60", "27") ", " BOX("e", "60", "36") "]";
    static const char behind[] = PLAIN "entities: [" BOX("e", "0", "0") "]\n"
        "occluders: [{name: wall, polygon_px: [[0, 0], [64, 0], [64, 48], [0, 48]], ground_px: [32, 30]}]";
    static const char comes[] = PLAIN "paths: [{name: way, use: vehicles, width_m: 3, points_m: [[-60, 0], [60, 0]]}]\n"
        "entities: [{name: e, model: box, path: way, start_m: 0, speed_m_s: 60}]";
    check_unseen(level, far, 1, "beside is in no frame\ntiny is 2 px large at most (frame 000000)\n",
                 "who is in no frame, or very small, is named");
    check_unseen(level, far, 1, "beside is in no frame\ntiny is 2 px large at most (frame 000000)\n", "so with frames that are kept");
    check_unseen(head, many, 1, "a is in no frame\nb is in no frame\nc is in no frame\n2 more entities are in no frame\n",
                 "many are counted");
    check_unseen(head, behind, 1, "e is hidden in every frame that it is in\n", "who is hidden all the time is named");
    check_unseen(two, comes, 2, "", "who comes in a later frame is seen");
    check_unseen(two, comes, 1, "", "a part of the frames tells nothing of the others");
    free(head);
    free(two);
    free(level);
}

int main(void)
{
    snprintf(top, sizeof top, "%s", getenv("top_srcdir") ? getenv("top_srcdir") : ".");
    char *whole = realpath(top, NULL);
    if (whole) snprintf(top, sizeof top, "%s", whole);
    free(whole);
    if (!OK(mkdtemp(scratch) != NULL, "a scratch folder")) return tap_done();
    static const char mesh[] = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                               "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                               "-30 -30 %d\n30 -30 %d\n30 30 %d\n-30 30 %d\n3 0 1 2\n3 0 2 3\n";
    char text[512];
    snprintf(text, sizeof text, mesh, 0, 0, 0, 0);
    put("flat.ply", text);
    snprintf(text, sizeof text, mesh, -6, 6, 6, -6);
    put("slope.ply", text);
    test_occluder_over_mesh();
    test_outline_of_one_shot();
    test_shade_that_moves();
    test_end_of_path();
    test_exposure_without_roads();
    test_exposure_is_fitted();
    test_exposure_in_mist();
    test_unseen();
    char *remove = string_format("rm -rf %s", scratch);
    if (system(remove) != 0) printf("# %s is left\n", scratch);
    free(remove);
    return tap_done();
}

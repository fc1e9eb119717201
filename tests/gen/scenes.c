/* The models that we make, and the scenes that come with the program. */
#include "gen/model/model.h"
#include "gen/scene/scene.h"
#include "lib/file.h"

#include "tests/tap.h"

/* Volume by the divergence theorem: positive when the triangles face outward. */
static double volume_m3(const struct model *model)
{
    double six = 0;
    for (size_t i = 0; i < model->mesh_count; i++) {
        const struct mesh *mesh = &model->meshes[i];
        for (size_t t = 0; t < mesh->triangles; t++) {
            struct vec3 p[3];
            for (int k = 0; k < 3; k++) {
                const float *q = mesh->position_m[mesh->triangle[t][k]];
                p[k] = vec3(q[0], q[1], q[2]);
            }
            six += vec3_dot(p[0], vec3_cross(p[1], p[2]));
        }
    }
    return six / 6;
}

static bool has_finish(const struct model *model, enum finish_kind kind)
{
    for (size_t i = 0; i < model->material_count; i++)
        if (model->materials[i].kind == kind) return true;
    return false;
}

static void test_model(const char *folder, const struct material_rules *rules, const char *name, double least_m3, double most_m3)
{
    struct model_options options = { .rules = rules, .has_class = true, .class_ = CLASS_PERSON };
    struct error err = ERROR_NONE;
    struct model *model = NULL;
    char *path = string_format("%s/%s.glb", folder, name);
    if (OK(model_load(&model, path, &options, &err), "%s is read", name)) {
        double volume = volume_m3(model);
        OK(volume > least_m3 && volume < most_m3, "%s: faces look outward, %.3f m3", name, volume);
        OK(!has_finish(model, FINISH_PAINT) && !has_finish(model, FINISH_GLASS), "%s: has neither paint nor glass", name);
        model_destroy(model);
    } else {
        printf("# %s\n", err.text);
    }
    free(path);
}

/* Whole, upright people in the demo's frames: where the feet stand, and their height in the picture.
 * Boxes of what differs from the median picture by more than 40 of 255. */
static const struct { double x, y, height_px; } people[] = {
    { 687, 156, 55 }, { 496, 227, 77 }, { 88, 216, 62 },   { 226, 266, 77 },  { 735, 356, 100 }, { 645, 380, 108 },
    { 672, 175, 63 }, { 327, 240, 75 }, { 68, 249, 68 },   { 704, 307, 86 },  { 535, 389, 111 }, { 521, 241, 71 },
    { 324, 251, 74 }, { 640, 305, 96 }, { 548, 358, 100 }, { 567, 228, 74 },  { 280, 261, 79 },  { 702, 317, 101 },
    { 616, 383, 109 }, { 272, 259, 74 }, { 548, 326, 103 }, { 632, 374, 100 }, { 266, 219, 72 },  { 328, 448, 124 }
};

static void test_heights(const struct scene *scene)
{
    double sum_px = 0;
    size_t count = sizeof people / sizeof *people;
    struct pose camera_from_world = pose_inverse(scene->shots[0].world_from_camera);
    for (size_t i = 0; i < count; i++) {
        struct error err = ERROR_NONE;
        struct vec3 feet = { 0, 0, 0 };
        struct vec2 head = { NAN, NAN };
        ground_from_pixel(&feet, &scene->ground, &scene->cameras[0].camera, scene->shots[0].world_from_camera,
                          (struct vec2){ people[i].x, people[i].y }, &err);
        camera_project(&scene->cameras[0].camera, &head, pose_apply(camera_from_world, vec3_add(feet, vec3(0, 0, 1.75))), &err);
        sum_px += people[i].height_px - (people[i].y - head.y);
    }
    NEAR(sum_px / (double)count, 0, 2, "1.75 m where the %zu people stand is their height, on average, in px", count);
}

static void test_scene(const char *path, bool heights)
{
    char *built = string_format("%s/models", getenv("top_builddir") ? getenv("top_builddir") : ".");
    const char *const folders[] = { built, NULL };
    struct error err = ERROR_NONE;
    struct scene *scene = NULL;
    const char *name = path_name(path);
    bool read = scene_read(&scene, path, folders, &err);
    free(built);
    if (!OK(read, "%s is read", name)) {
        printf("# %s:%d: %s\n", err.file, err.line, err.text);
        return;
    }
    struct pose camera_from_world = pose_inverse(scene->shots[0].world_from_camera);
    size_t seen = 0, standing = 0;
    for (size_t i = 0; i < scene->entity_count; i++) {
        const struct scene_entity *entity = &scene->entities[i];
        struct vec2 q = { entity->at[0], entity->at[1] };
        struct vec3 p = vec3(q.x, q.y, plane_height(&scene->ground, q.x, q.y));
        if (entity->place == PLACE_WORLD &&
            !camera_project(&scene->cameras[0].camera, &q, pose_apply(camera_from_world, p), &err)) continue;
        seen += q.x > 0 && q.y > 0 && q.x < scene->cameras[0].camera.width_px && q.y < scene->cameras[0].camera.height_px;
    }
    OK(scene->entity_count && seen == scene->entity_count, "%s: all %zu entities stand in the picture", name,
       scene->entity_count);
    for (size_t i = 0; i < scene->occluder_count; i++) {
        struct vec3 p;
        standing += ground_from_pixel(&p, &scene->ground, &scene->cameras[0].camera, scene->shots[0].world_from_camera,
                                      scene->occluders[i].ground_px, &err);
    }
    OK(standing == scene->occluder_count, "%s: all %zu occluders stand on the ground", name, scene->occluder_count);
    if (heights) test_heights(scene);
    scene_destroy(scene);
}

int main(void)
{
    const char *top = getenv("top_srcdir"), *built = getenv("top_builddir"), *shared = tap_shared();
    if (!top) top = ".";
    if (!built) built = ".";
    struct error err = ERROR_NONE;
    struct material_rules *rules = NULL;
    char *rules_path = string_format("%s/templates/materials.rules", top);
    char *models = string_format("%s/models", built);
    if (OK(material_rules_read(&rules, rules_path, &err), "the rules are read")) {
        test_model(models, rules, "man-jacket", 0.08, 0.17);
        test_model(models, rules, "woman-skirt", 0.07, 0.15);
    }
    material_rules_destroy(rules);
    free(rules_path);
    free(models);

    char *demo = string_format("%s/scenes/demo/scene.yaml", top), *video = string_format("%s/scenes/demo/vtest.avi", top);
    if (file_exists(video))
        test_scene(demo, true);
    else
        SKIP("scenes/demo/scene.yaml", "no scenes/demo/vtest.avi");
    free(demo);
    free(video);
    static const char *const craig[] = { "sunny", "wet", "median" };
    for (size_t i = 0; i < sizeof craig / sizeof *craig; i++) {
        char *path = string_format("%s/scenes/craig/%s.yaml", top, craig[i]);
        char *photographs = string_format("%s/../shared/data/README.md", top); /* what the scenes name */
        if (shared && file_exists(photographs))
            test_scene(path, false);
        else
            SKIP(craig[i], "no ../shared");
        free(path);
        free(photographs);
    }
    return tap_done();
}

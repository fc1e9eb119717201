#include "gen/scene/scene.h"

#include "lib/file.h"
#include "tests/tap.h"

#include <unistd.h>

/* A path in the source tree; the caller frees. */
static char *source_path(const char *name)
{
    const char *top = getenv("top_srcdir");
    return string_format("%s/%s", top ? top : ".", name);
}

static struct scene *read_file(const char *path)
{
    struct error err = ERROR_NONE;
    struct scene *scene = NULL;
    if (!scene_read(&scene, path, NULL, &err)) printf("# %s:%d:%d: %s\n", err.file, err.line, err.column, err.text);
    return scene;
}

static struct scene *read_input(const char *name)
{
    char *path = source_path(name);
    struct scene *scene = read_file(path);
    free(path);
    return scene;
}

/* A folder with a scene that a test writes, and empty files for it to name. */
static char folder[] = "scene-test.XXXXXX";
static const char *const named_files[] = { "street.jpg", "street-wet.jpg", "street.avi", "my.rules", "sky.exr", "models/hatchback.obj",
                                           "models/suv.obj", "models/walker.glb", "place.ply", "scene.yaml" };
enum { NAMED_FILES = sizeof named_files / sizeof *named_files };

static char *folder_path(const char *name)
{
    return string_format("%s/%s", folder, name);
}

static bool folder_create(void)
{
    struct error err = ERROR_NONE;
    char *models = mkdtemp(folder) ? folder_path("models") : NULL;
    bool ok = models && folder_make(models, &err);
    free(models);
    for (int i = 0; ok && i < NAMED_FILES; i++) {
        char *path = folder_path(named_files[i]);
        ok = file_write(path, "", 0, &err);
        free(path);
    }
    return ok;
}

static void folder_remove(void)
{
    for (int i = 0; i < NAMED_FILES; i++) {
        char *path = folder_path(named_files[i]);
        unlink(path);
        free(path);
    }
    char *models = folder_path("models");
    rmdir(models);
    free(models);
    rmdir(folder);
}

static const struct { const char *key, *text; } sections[] = {
    { "staffage:", "staffage: 1\n" },
    { "photographs:", "photographs: {files: [street.jpg]}\n" },
    { "camera:", "camera: {model: PINHOLE, size_px: [2000, 1500], horizontal_fov_deg: 90, "
                 "pose: {look_at: {position_m: [0, 0, 6], target_m: [0, 20, 0]}}}\n" },
    { "light:", "light: {sky: overcast}\n" },
    { "ground:", "ground: {height_m: 0}\n" },
    { "exposure:", "exposure: {value: 1}\n" },
    { "models:", "models: {hatchback: {file: models/hatchback.obj, unit_m: 1, up: z, front: -y, class: car}}\n" },
    { "entities:", "entities: []\n" },
};

/* Does a line of the text begin with the key? */
static bool has_section(const char *text, const char *key)
{
    for (const char *line = text; line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL)
        if (!strncmp(line, key, strlen(key))) return true;
    return false;
}

/* What comes with the program. */
static const char *const *model_folders(void)
{
    static char built[600];
    static const char *const folders[] = { built, NULL };
    snprintf(built, sizeof built, "%s/models", getenv("top_builddir") ? getenv("top_builddir") : ".");
    return folders;
}

/* Read a scene of these sections; those that it lacks and that are required are added.
 * NULL when it is refused: the reason is in *err. */
static struct scene *read_sections(const char *text, struct error *err)
{
    char *whole = strdup(text), *path = folder_path("scene.yaml");
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
        bool replaced = has_section(text, "shots:") && (!strcmp(sections[i].key, "photographs:") || !strcmp(sections[i].key, "camera:"));
        if (replaced || has_section(text, sections[i].key)) continue;
        char *more = string_format("%s%s", whole, sections[i].text);
        free(whole);
        whole = more;
    }
    struct scene *scene = NULL;
    if (file_write(path, whole, strlen(whole), err)) scene_read(&scene, path, model_folders(), err);
    free(whole);
    free(path);
    return scene;
}

static void a_minimal_scene_takes_the_stated_defaults(void)
{
    struct scene *s = read_input("tests/input/minimal.yaml");
    if (!OK(s, "a scene with only what it must have is read")) return;
    OK(s->shot_count == 1 && !s->video && s->scale == 1, "one photograph, not reduced");
    OK(file_exists(s->shots[0].photograph), "its path is taken from the scene file's folder");
    OK(s->cameras[0].camera.model == CAMERA_PINHOLE && s->cameras[0].camera.width_px == 64 && s->cameras[0].camera.height_px == 48, "camera model and size");
    NEAR(s->cameras[0].camera.params[0], 32, 1e-12, "90 degrees over 64 px are a focal length of 32 px");
    NEAR(s->cameras[0].camera.params[3], 24, 0, "the principal point is the middle");
    OK(!s->has_place && !s->has_time && s->sun == SUN_NONE && s->north_rad == 0, "an overcast sky needs no place and time");
    NEAR(s->turbidity, 2.5, 0, "turbidity 2.5");
    NEAR(s->sun_scale, 1, 0, "sun_scale 1");
    OK(s->ground.normal.z == 1 && s->ground.offset_m == 0, "level ground");
    NEAR(s->ground_albedo[0], 0.2, 0, "albedo 0.2");
    NEAR(s->ground_albedo[2], 0.2, 0, "in each channel");
    NEAR(s->wet.reflection, 0, 0, "dry");
    OK(s->skyline.count == 1 && s->skyline.assumed, "what stands around is assumed");
    NEAR(s->skyline.point_rad[0][1], M_PI / 18, 1e-15, "up to 10 degrees");
    OK(!s->exposure_given && s->white_balance, "exposure and white balance are fitted");
    OK(s->exposure_patch_px[0].x == 10 && s->exposure_patch_px[1].y == 46, "to the patch");
    OK(s->entity_count == 1 && !s->entities[0].has_class && s->models[0].class_ == CLASS_CAR && !s->entities[0].has_color, "the entity takes its model's class");
    OK(s->occluder_count == 0 && s->transfer == TRANSFER_LAYERS && s->mask == MASK_TRACED, "layers, traced masks, no occluders");
    OK(s->quality == QUALITY_STANDARD && s->seed == 0 && !s->material_rules, "standard quality, seed 0, installed rules");
    scene_destroy(s);
}

static void a_full_scene_is_read_back(void)
{
    struct scene *s = read_input("tests/input/full.yaml");
    if (!OK(s, "a scene with every section is read")) return;
    OK(s->video && s->scale == 0.5, "a video, reduced");
    OK(s->shot_count == 5 && s->shots[0].number == 10 && s->shots[4].number == 30, "10:31:5 are the frames 10 to 30, the end excluded");
    OK(s->cameras[0].camera.model == CAMERA_OPENCV && s->cameras[0].camera.params[1] == 1002.5 && s->cameras[0].camera.params[7] == -0.002, "camera parameters");
    NEAR(s->place.latitude_rad, 0.70593227, 1e-7, "latitude in radians");
    NEAR(s->place.height_m, 280, 0, "height");
    NEAR(s->north_rad, -M_PI / 6, 1e-15, "north in radians");
    OK(s->time_utc.hour == 14 && s->time_utc.second == 40.5, "time in UTC");
    OK(s->sky == SKY_CLEAR && s->sun == SUN_BY_TIME && s->turbidity == 4.5 && s->sun_scale == 0.75, "light");
    double n = sqrt(0.36 + 4);
    NEAR(s->ground.normal.z, 2 / n, 1e-15, "a plane whose normal points down is turned up");
    NEAR(s->ground.normal.y, -0.6 / n, 1e-15, "with all of its normal");
    NEAR(s->ground.offset_m, -4 / n, 1e-15, "and its offset, in metres");
    NEAR(s->ground_albedo[0], 1, 1e-7, "#ff is 1 in linear light");
    NEAR(s->ground_albedo[1], 0.21586, 1e-5, "#80 is 0.216 in linear light");
    NEAR(s->ground_albedo[2], 0, 0, "#00 is 0");
    NEAR(s->wet.reflection, 0.125, 0, "reflection");
    NEAR(s->wet.roughness, 0.4, 0, "as rough as a road");
    OK(s->exposure_given && s->exposure[0] == 0.75 && s->exposure[2] == 0.75 && !s->white_balance, "exposure given, one for all channels");
    OK(s->model_count == 2 && !strcmp(s->models[1].name, "tall box") && file_exists(s->models[1].files[DETAIL_NEAR]), "models by name");
    OK(s->models[0].options.length_m == 4.2 && s->models[0].options.unit_m == 0 && s->models[1].options.height_m == 1.8, "model sizes");
    OK(s->models[0].options.axes_given && s->models[0].options.up == AXIS_NEG_Y && s->models[0].options.front == AXIS_POS_Z &&
           s->models[1].options.up == AXIS_POS_Y && s->models[1].options.front == AXIS_NEG_X, "model axes, with and without sign");
    OK(!s->models[0].has_class && s->models[1].has_class, "classes of models");
    OK(s->material_rules && file_exists(s->material_rules), "material rules");
    const struct scene_entity *e = s->entities;
    OK(s->entity_count == 3 && e[0].class_ == CLASS_FIRE_TRUCK && e[1].class_ == CLASS_PERSON && e[2].class_ == CLASS_RIDER,
       "an entity's class goes before its model's");
    OK(e[0].choice.models[0] == 0 && e[2].choice.models[0] == 1, "models of entities");
    OK(e[0].place == PLACE_WORLD && e[0].at[0] == 1.5 && e[0].at[1] == -2, "a place in the world");
    OK(e[1].place == PLACE_GEODETIC && e[1].at[0] == 40.447 && e[1].at[1] == -79.949, "a place on the earth, in degrees");
    OK(e[2].place == PLACE_PIXEL && e[2].at[0] == 2000 && e[2].at[1] == 750.5, "a place in the picture, up to its edge");
    NEAR(e[0].heading_rad, 1.5 * M_PI, 1e-15, "heading in radians");
    OK(e[0].has_color && e[0].color[2] == 0.3 && e[1].color[1] > 0.999 && !e[2].has_color, "colours");
    OK(e[1].source.line == 24 && e[1].source.column == 5 && e[1].at_source.column == 51, "where they stand in the file");
    OK(s->occluder_count == 1 && s->occluders[0].polygon_count == 3 && s->occluders[0].polygon_px[0].y == -3 &&
           s->occluders[0].ground_px.y == 1600, "an occluder may reach out of the picture");
    OK(s->transfer == TRANSFER_THRESHOLD && s->t1 == 10 && s->t2 == 20 && s->t3 == 40 && s->overwrite == OVERWRITE_BELOW, "transfer");
    OK(s->mask == MASK_DILATED && s->quality == QUALITY_HIGH && s->seed == 42, "mask, quality, seed");
    scene_destroy(s);
}

/* Poses. */

#define CAMERA "camera: {model: PINHOLE, size_px: [2000, 1500], horizontal_fov_deg: 90, pose: {"

static struct pose read_pose(const char *pose)
{
    struct error err = ERROR_NONE;
    char *text = string_format(CAMERA "%s}}\n", pose);
    struct scene *scene = read_sections(text, &err);
    struct pose read = { .translation = { NAN, NAN, NAN } };
    if (scene) read = scene->shots[0].world_from_camera;
    if (!scene) printf("# %d:%d: %s\n", err.line, err.column, err.text);
    scene_destroy(scene);
    free(text);
    return read;
}

static double vec3_distance(struct vec3 a, struct vec3 b)
{
    return vec3_norm(vec3_sub(a, b));
}

/* At 3 m east, 2 m north, 5 m up, level, looking north: told in every way. */
static void a_flight_is_read(void)
{
    struct error err = ERROR_NONE;
    const char *const text =
        "place: {latitude_deg: 46.8426, longitude_deg: -91.994}\n"
        "cameras: {wide: {model: PINHOLE, size_px: [200, 100], horizontal_fov_deg: 90},\n"
        "          tele: {model: SIMPLE_PINHOLE, size_px: [200, 100], params: [500, 100, 50]}}\n"
        "shots:\n"
        "  - {photograph: street.jpg, camera: tele, time: 2016-06-23T23:59:58-05:00, semantic: street-wet.jpg, pose: {look_at: {position_m: [0, 0, 6], target_m: [0, 20, 0]}}}\n"
        "  - {camera: wide, time: 2016-06-24T00:00:05.5-05:00, pose: {look_at: {position_m: [1, 0, 6], target_m: [0, 20, 0]}}}\n"
        "static: {mesh: place.ply, world_from_mesh: {scale: 8.3, quaternion_wxyz: [0, 1, 0, 0], translation_m: [1, 2, 3]}}\n"
        "ground: {albedo: 0.1}\n"
        "paths: [{name: a, use: vehicles, width_m: 6, points_px: [[20, 80], [150, 80]], shot: 1}]\n"
        "exposure: {roads: true}\n"
        "traffic: {vehicles: {count: 3, models: {hatchback: {weight: 2.5}}, colors: [\"#ff0000\"]}}\n"
        "labels: {palette: uavid}\n";
    struct scene *s = read_sections(text, &err);
    if (!OK(s, "a flight is read: %d:%d: %s", err.line, err.column, err.text)) return;
    OK(s->shot_count == 2 && !s->fixed_camera && s->cameras[s->shots[0].camera].camera.params[0] == 500 &&
           s->cameras[s->shots[1].camera].camera.model == CAMERA_PINHOLE, "each shot has its lens");
    OK(s->shots[0].photograph && s->shots[0].semantic && !s->shots[1].photograph, "a shot without a photograph is a new view");
    OK(s->has_time && s->time_utc.day == 24 && s->time_utc.hour == 4 && s->shots[0].time_s == 0 && s->shots[1].time_s == 7.5,
       "the first shot's time is the scene's, and midnight is no matter");
    OK(s->shots[1].world_from_camera.translation.x == 1, "each has its pose");
    struct vec3 p = similarity_apply(s->static_.world_from_mesh, vec3(1, 1, 1));
    NEAR(p.x, 9.3, 1e-12, "the mesh is scaled and moved");
    NEAR(p.z, 3 - 8.3, 1e-12, "and turned");
    OK(s->path_count == 1 && s->paths[0].shot == 1 && s->paths[0].use == ROAD_VEHICLES, "a path by pixels of a shot");
    OK(s->vehicles.count == 3 && s->vehicles.choice.weights[0] == 2.5 && s->vehicles.colors[0][0] == 1 && s->people.count == 0, "traffic");
    OK(s->exposure_of_roads && s->palette == PALETTE_UAVID, "exposure and palette");
    scene_destroy(s);
    s = read_sections("exposure: {value: [0.9, 1, 1.1]}\n", &err);
    OK(s && s->exposure_given && s->exposure[0] == 0.9 && s->exposure[1] == 1 && s->exposure[2] == 1.1, "an exposure of each channel");
    scene_destroy(s);
}

static void one_pose_in_many_conventions(void)
{
    static const struct { const char *name, *pose; } same[] = {
        { "look_at", "look_at: {position_m: [3, 2, 5], target_m: [3, 9, 5]}" },
        { "look_at in a world with y up", "world_axes: [east, up, south], look_at: {position_m: [3, 5, -2], target_m: [3, 5, -3]}" },
        { "matrix, opencv", "matrix: [[1, 0, 0, 3], [0, 0, 1, 2], [0, -1, 0, 5]]" },
        { "matrix, opencv, 4x4", "axes: opencv, matrix: [[1, 0, 0, 3], [0, 0, 1, 2], [0, -1, 0, 5], [0, 0, 0, 1]]" },
        { "matrix, opengl", "axes: opengl, matrix: [[1, 0, 0, 3], [0, 0, -1, 2], [0, 1, 0, 5]]" },
        { "matrix, x-left-y-up", "axes: x-left-y-up, matrix: [[-1, 0, 0, 3], [0, 0, 1, 2], [0, 1, 0, 5]]" },
        { "matrix, x-left-y-up in a world west, up, north",
          "axes: x-left-y-up, world_axes: [west, up, north], matrix: [[1, 0, 0, -3], [0, 1, 0, 5], [0, 0, 1, 2]]" },
        { "matrix, opencv in a left-handed world",
          "world_axes: [east, up, north], matrix: [[1, 0, 0, 3], [0, -1, 0, 5], [0, 0, 1, 2]]" },
        { "camera_from_world, quaternion",
          "camera_from_world: {quaternion_wxyz: [0.7071067811865476, 0.7071067811865476, 0, 0], translation_m: [-3, 5, -2]}" },
        { "camera_from_world, rotation",
          "camera_from_world: {rotation: [[1, 0, 0], [0, 0, -1], [0, 1, 0]], translation_m: [-3, 5, -2]}" },
        { "camera_from_world, opengl",
          "axes: opengl, camera_from_world: {rotation: [[1, 0, 0], [0, 0, 1], [0, -1, 0]], translation_m: [-3, -5, 2]}" },
        { "position and quaternion",
          "position_m: [3, 2, 5], quaternion_wxyz: [0.7071067811865476, -0.7071067811865476, 0, 0]" },
        { "position and rotation, opengl", "axes: opengl, position_m: [3, 2, 5], rotation: [[1, 0, 0], [0, 0, -1], [0, 1, 0]]" },
    };
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
        struct pose p = read_pose(same[i].pose);
        bool here = vec3_distance(p.translation, vec3(3, 2, 5)) < 1e-12;
        bool right = vec3_distance(mat3_column(p.rotation, 0), vec3(1, 0, 0)) < 1e-12;
        bool down = vec3_distance(mat3_column(p.rotation, 1), vec3(0, 0, -1)) < 1e-12;
        bool forward = vec3_distance(mat3_column(p.rotation, 2), vec3(0, 1, 0)) < 1e-12;
        OK(here && right && down && forward, "looks north from where it stands: %s", same[i].name);
    }
}

/* The matrix of ../shared/data/README.md: what it says of the place must come out. */
static void the_craig_camera(void)
{
    struct pose p = read_pose("axes: x-left-y-up, world_axes: [west, up, north], matrix: ["
                              "[-6.32009074e-01, 3.81421015e-01, 6.74598057e-01, -1.95597297e+01], "
                              "[5.25615099e-03, 8.72582680e-01, -4.88438164e-01, 6.43714192e+00], "
                              "[-7.74943161e-01, -3.05151563e-01, -5.53484978e-01, 4.94516235e+00]]");
    NEAR(p.translation.z, 6.43714192, 1e-9, "the craig camera stands 6.44 m high");
    NEAR(p.translation.x, 19.5597297, 1e-9, "its x points west");
    NEAR(p.translation.y, 4.94516235, 1e-9, "its z points north");
    struct vec3 forward = mat3_column(p.rotation, 2), right = mat3_column(p.rotation, 0), down = mat3_column(p.rotation, 1);
    NEAR(forward.z, -0.488438164, 1e-6, "it looks 29 degrees down");
    OK(forward.x < 0 && forward.y < 0, "towards the south west");
    OK(down.z < 0 && fabs(right.z) < 0.01, "upright, its horizon level");
    NEAR(mat3_determinant(p.rotation), 1, 1e-12, "without mirroring");
    NEAR(mat3_orthonormality(p.rotation), 0, 1e-12, "straightened");
}

static void look_at_rolls_and_looks_down(void)
{
    struct pose p = read_pose("look_at: {position_m: [0, 0, 40], target_m: [0, 0, 0], up: [0, 1, 0]}");
    OK(vec3_distance(mat3_column(p.rotation, 0), vec3(1, 0, 0)) < 1e-12 &&
           vec3_distance(mat3_column(p.rotation, 1), vec3(0, -1, 0)) < 1e-12, "a map: north at the top, east to the right");
    p = read_pose("look_at: {position_m: [0, 0, 5], target_m: [0, 9, 5], roll_deg: 90}");
    OK(vec3_distance(mat3_column(p.rotation, 0), vec3(0, 0, -1)) < 1e-12, "rolled clockwise by 90 degrees, its right side is down");
    OK(vec3_distance(mat3_column(p.rotation, 1), vec3(-1, 0, 0)) < 1e-12, "and its lower side to the left");
}

static void a_rounded_rotation_is_straightened(void)
{
    struct pose p = read_pose("matrix: [[0.866, 0, 0.5, 0], [0.5, 0, -0.866, 0], [0, 1, 0, 5]]");
    NEAR(mat3_orthonormality(p.rotation), 0, 1e-15, "a rotation with three digits becomes exact");
    NEAR(p.rotation.m[0][0], sqrt(0.75), 1e-4, "and stays what it was");
}

/* The text of the manual's page. */

static char *read_manual(void)
{
    struct error err = ERROR_NONE;
    char *path = source_path("docs/scene.md"), *text = NULL;
    size_t size;
    file_read(&text, &size, path, &err);
    free(path);
    return text;
}

/* Row "| `path` | type | unit | default | ..." as scene_schema_text writes it, or false. */
static bool manual_row(char *row, size_t size, const char *line, size_t length)
{
    char cell[4][512] = { "" };
    if (length < 3 || strncmp(line, "| `", 3)) return false;
    const char *c = line + 2;
    for (int i = 0; i < 4; i++) {
        const char *end = strstr(c, " |");
        if (!end || end > line + length) return false;
        snprintf(cell[i], sizeof cell[i], "%.*s", (int)(end - c), c);
        c = end + 3;
    }
    snprintf(row, size, "%.*s\t%s\t%s\t%s\n", (int)strcspn(cell[0] + 1, "`"), cell[0] + 1, cell[1], cell[2], cell[3]);
    return c < line + length && *c != '|';
}

static void the_manual_has_every_key_and_no_other(const char *manual)
{
    char *schema = scene_schema_text(), *told = strdup("");
    const char *end;
    for (const char *line = manual; (end = strchr(line, '\n')); line = end + 1) {
        char row[2048];
        if (!manual_row(row, sizeof row, line, (size_t)(end - line))) continue;
        char *more = string_format("%s%s", told, row);
        free(told);
        told = more;
        if (!strstr(schema, row)) printf("# docs/scene.md says, the schema does not: %s", row);
    }
    for (char *row = schema; *row; row = strchr(row, '\n') + 1) {
        char *one = strndup(row, (size_t)(strchr(row, '\n') + 1 - row));
        if (!strstr(told, one)) printf("# the schema says, docs/scene.md does not: %s", one);
        free(one);
    }
    OK(strlen(schema) > 4000, "the schema has its keys");
    OK(!strcmp(schema, told), "docs/scene.md has every key with its type, unit and default, in order, and no other");
    free(schema);
    free(told);
}

static void the_manual_names_the_camera_parameters(const char *manual)
{
    for (int i = 0; i < CAMERA_MODEL_COUNT; i++) {
        enum camera_model model = (enum camera_model)i;
        char *row = string_format("\n| %s | %s |\n", camera_model_name(model), camera_model_param_names(model));
        OK(strstr(manual, row), "docs/scene.md has the parameters of %s", camera_model_name(model));
        free(row);
    }
}

static void the_manuals_examples_are_read(const char *manual)
{
    int examples = 0;
    for (const char *start = manual; (start = strstr(start, "\n```yaml\n"));) {
        start += strlen("\n```yaml\n");
        const char *end = strstr(start, "```");
        char *text = strndup(start, (size_t)(end - start));
        struct error err = ERROR_NONE;
        struct scene *scene = read_sections(text, &err);
        OK(scene, "example %d of docs/scene.md is read: %.*s ...", ++examples, (int)strcspn(text, "\n"), text);
        if (!scene) printf("# %d:%d: %s\n%s", err.line, err.column, err.text, text);
        scene_destroy(scene);
        free(text);
        start = end;
    }
    OK(examples >= 15, "every section has an example");
}

/* Wherever a file is cut off, it is read or refused at a place in it. */
static void a_cut_off_file_is_refused_in_words(void)
{
    struct error err = ERROR_NONE;
    char *path = source_path("tests/input/full.yaml"), *cut = folder_path("scene.yaml"), *data;
    size_t size, refused = 0, told = 0;
    bool there = file_read(&data, &size, path, &err);
    OK(there, "a file to cut");
    for (size_t n = 0; there && n < size; n++) {
        struct scene *scene = NULL;
        err = ERROR_NONE;
        if (!file_write(cut, data, n, &err)) break;
        if (scene_read(&scene, cut, NULL, &err)) {
            scene_destroy(scene);
            continue;
        }
        refused++;
        told += err.code == ERR_INPUT && !strcmp(err.file, cut) && err.line > 0 && err.column > 0 && err.text[0];
    }
    OK(refused > 1000 && told == refused, "a file cut off anywhere is refused with line, column and text");
    if (there) free(data);
    free(path);
    free(cut);
}

static void text_is_not_guessed_to_be_something_else(void)
{
    static const struct { const char *line, *text; } wrong[] = {
        { "seed: 010\n", "seed: expected integer from 0 to 2147483647, found text \"010\"" },
        { "seed: 0x10\n", "seed: expected integer from 0 to 2147483647, found text \"0x10\"" },
        { "seed: 1_000\n", "seed: expected integer from 0 to 2147483647, found text \"1_000\"" },
        { "seed: 99999999999999999999\n", "seed: expected integer from 0 to 2147483647, found 99999999999999999999" },
        { "north_deg: nan\n", "north_deg: expected number from -360 to 360, found text \"nan\"" },
        { "north_deg: .inf\n", "north_deg: expected number from -360 to 360, found text \".inf\"" },
        { "north_deg: 1e999\n", "north_deg: expected number from -360 to 360, found text \"1e999\"" },
        { "north_deg: 1:30\n", "north_deg: expected number from -360 to 360, found text \"1:30\"" },
        { "north_deg: \n", "north_deg: expected number from -360 to 360, found nothing" },
        { "quality: Draft\n", "unknown quality \"Draft\" (did you mean \"draft\"?)" },
        { "quality: \"hi\\0gh\"\n", "a line break or control character in a value" },
        { "quality: &q high\n", "anchors (&name) are not understood here: remove it" },
        { "quality: *q\n", "aliases (*name) are not understood here: write the value out" },
        { "? [seed]\n: 1\n", "a key must be plain text" },
        { "quality: high\n\"quality\": draft\n", "key \"quality\" is here for the second time (first in line 1): keep one" },
        { "seed.x: 1\n", "unknown key \"seed.x\" (known here: staffage, photographs, camera, shots, cameras, place, north_deg, "
                         "north, time, light, ground, surroundings, static, roads, paths, exposure, models, materials, entities, occluders, "
                         "traffic, weather, lens, transfer, labels, quality, seed)" },
        { "photographs: {files: [street.jpg, street-wet.jpg]}\nplace: {latitude_deg: 46, longitude_deg: -92}\n"
          "paths: [{name: a, use: people, width_m: 2, points_m: [[0, 0], [9, 0]]}]\n"
          "traffic: {vehicles: {count: 2, models: {hatchback: {}}}}\n",
          "something moves, and the photographs have no times: give photographs.rate_hz" },
        { "traffic: {vehicles: {count: 2, models: {hatchback: {}}}}\n",
          "traffic: there is nowhere to go: give roads (a map) or paths" },
        { "paths: [{name: a, use: people, width_m: 2, lat_lon_deg: [[46, -92], [46.1, -92]]}]\n",
          "path \"a\": latitudes need the scene's place" },
        { "static: {mesh: place.ply}\nground: {height_m: 0}\n",
          "ground: the static mesh is the ground: only albedo has a meaning here" },
        { "paths: [{name: a, use: people, width_m: 2, points_m: [[0, 0], [9, 0]]}]\n"
          "traffic: {people: {count: 2, models: {hatchback: {}}}}\n",
          "traffic.people: model \"hatchback\" is of class car: people only walk here" },
        { "light: {sky: overcast, sun_scale: 2}\n",
          "light.sun_scale: has no meaning under an overcast sky: remove it, or use \"sky: clear\"" },
        { "light: {sky: cie, cie_type: 2, sun_scale: 2}\n",
          "light.sun_scale: has no meaning under a standard sky of type 1 to 6: they show no sun" },
        { "light: {sky: map, map: {file: sky.exr, north_px: 1}, sun: none, sun_scale: 2}\n",
          "light.sun_scale: has no meaning where the map is taken without a sun" },
        { "light: {sky: overcast, cie_type: 2}\n", "light.cie_type: means a standard sky: remove it, or use \"sky: cie\"" },
        { "light: {sky: auto, sun_scale: 2}\n",
          "light.sun_scale: \"sky: auto\" finds it by itself: remove it, or use \"sky: clear\"" },
        { "light: {sky: auto, sun: none}\n", "light.sun: where there is none, it is \"sky: overcast\"" },
        { "light: {sky: overcast, sky_share: [0.1, 0.1, 0.2]}\n",
          "light.sky_share: has a meaning under a clear sky only: remove it, or use \"sky: clear\"" },
        { "light: {sky: clear, sun: {azimuth_deg: 0, elevation_deg: 9}, sky_share: [0.1, 0.1, 0.2], sun_scale: 2}\n",
          "light.sun_scale: and sky_share say the same: remove one" },
        { "light: {sky: overcast, shadows: [{lit_px: [1, 1], shade_px: [2, 2]}]}\n",
          "light.shadows: are marked for \"sky: auto\": remove them, or use it" },
        { "surroundings: {skyline_deg: 81}\n", "surroundings.skyline_deg: an elevation of 81: it is from 0 to 80" },
        { "surroundings: {skyline_deg: [[400, 20]]}\n", "surroundings.skyline_deg: an azimuth of 400: it is from -360 to 360, and the order [azimuth, elevation]" },
        { "surroundings: {skyline_deg: [[0, 20], [360, 10]]}\n", "surroundings.skyline_deg: azimuth 0 comes twice" },
        { "static: {mesh: place.ply}\nground: {}\nsurroundings: {skyline_deg: 20}\n", "surroundings.skyline_deg: the static mesh tells what stands around" },
        { "light: {sky: map, map: {file: sky.exr, north_px: 7.5}}\nsurroundings: {albedo: 0.3}\n",
          "surroundings.albedo: the sky's map shows what stands around" },
        { "light: aut\n", "unknown light \"aut\" (did you mean \"auto\"?)" },
        { "lens: {focus_m: 3}\n", "lens: defocus_px and focus_m go together" },
        { "lens: {grain: 101}\n", "lens.grain: expected number from 0 to 100 or one of auto, none, found 101" },
        { "lens: {grain: aut}\n", "lens: unknown grain \"aut\" (did you mean \"auto\"?)" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct error err = ERROR_NONE;
        struct scene *scene = read_sections(wrong[i].line, &err);
        OK(!scene && !strcmp(err.text, wrong[i].text), "%.*s: %s", (int)strcspn(wrong[i].line, "\n"), wrong[i].line, err.text);
        scene_destroy(scene);
    }
    struct error err = ERROR_NONE;
    char deep[200] = "seed: ";
    memset(deep + 6, '[', 100);
    OK(!read_sections(deep, &err) && !strcmp(err.text, "nested too deeply"), "a hundred brackets: %s", err.text);
}

static void every_sky_is_read(void)
{
    static const struct { const char *line; enum sky_kind sky; enum sun_kind sun; } skies[] = {
        { "light: {sky: cie, cie_type: 5}\n", SKY_CIE, SUN_NONE },
        { "light: {sky: cie, cie_type: 6, sun: {azimuth_deg: 10, elevation_deg: 20}}\n", SKY_CIE, SUN_GIVEN },
        { "light: {sky: cie, cie_type: 13, sun_scale: 0.5, sun: {azimuth_deg: 10, elevation_deg: 20}}\n", SKY_CIE, SUN_GIVEN },
        { "light: {sky: cie, cie_type: 13}\nplace: {latitude_deg: 46, longitude_deg: -92}\ntime: 2016-06-23T12:00:00-05:00\n", SKY_CIE, SUN_BY_TIME },
        { "light: {sky: map, map: {file: sky.exr, north_px: 7.5}}\n", SKY_MAP, SUN_IN_MAP },
        { "light: {sky: map, sun: none, map: {file: sky.exr, middle_deg: 90}}\n", SKY_MAP, SUN_NONE },
        { "light: {sky: map, map: {file: sky.exr, middle_deg: 90}, sun: {azimuth_deg: 10, elevation_deg: 20}}\n", SKY_MAP, SUN_GIVEN },
    };
    for (size_t i = 0; i < sizeof skies / sizeof *skies; i++) {
        struct error err = ERROR_NONE;
        struct scene *s = read_sections(skies[i].line, &err);
        if (!OK(s, "%.*s: is read %s", (int)strcspn(skies[i].line, "\n"), skies[i].line, err.text)) continue;
        OK(s->sky == skies[i].sky && s->sun == skies[i].sun, "with its sky and its sun");
        if (s->sky == SKY_MAP)
            OK(file_exists(s->map.file) && s->map.by_column == (i == 4) && (i == 4 ? s->map.north_px == 7.5 : fabs(s->map.middle_rad - M_PI / 2) < 1e-12),
               "its file, and its north");
        else OK(s->cie_type == (i == 0 ? 5 : i == 1 ? 6 : 13), "its type");
        scene_destroy(s);
    }
}

static void a_skyline_is_read(void)
{
    struct error err = ERROR_NONE;
    struct scene *s = read_sections("surroundings: {skyline_deg: [[-90, 30], [0, 10], [90, 0]], albedo: 0.4}\n", &err);
    if (OK(s, "a skyline by azimuth %s", err.text)) {
        OK(s->skyline.count == 3 && !s->skyline.assumed && s->skyline.albedo[1] == 0.4, "is read");
        NEAR(s->skyline.point_rad[1][0], M_PI / 2, 1e-15, "its azimuths as they are");
        NEAR(s->skyline.point_rad[2][1], M_PI / 6, 1e-15, "or within a turn, in order");
        scene_destroy(s);
    }
    static const char *const nothing[] = { "surroundings: {skyline_deg: 0}\n", "static: {mesh: place.ply}\nground: {}\n",
                                           "light: {sky: map, map: {file: sky.exr, north_px: 7.5}}\n" };
    for (size_t i = 0; i < sizeof nothing / sizeof *nothing; i++) {
        s = read_sections(nothing[i], &err);
        OK(s && s->skyline.count == 0, "nothing is assumed to stand around: %.*s %s", (int)strcspn(nothing[i], "\n"), nothing[i], err.text);
        scene_destroy(s);
    }
}

static void a_file_that_is_not_there(void)
{
    struct error err = ERROR_NONE;
    struct scene *scene = NULL;
    OK(!scene_read(&scene, "no-such/scene.yaml", NULL, &err) && !scene, "a scene file that is not there is refused");
    OK(!strcmp(err.file, "no-such/scene.yaml") && strstr(err.text, "No such file"), "with its path and the reason");
}

int main(void)
{
    if (!OK(folder_create(), "a folder to write scenes into")) return tap_done();
    char *manual = read_manual();
    a_minimal_scene_takes_the_stated_defaults();
    a_full_scene_is_read_back();
    a_flight_is_read();
    one_pose_in_many_conventions();
    the_craig_camera();
    look_at_rolls_and_looks_down();
    a_rounded_rotation_is_straightened();
    if (OK(manual, "docs/scene.md is there")) {
        the_manual_has_every_key_and_no_other(manual);
        the_manual_names_the_camera_parameters(manual);
        the_manuals_examples_are_read(manual);
    }
    text_is_not_guessed_to_be_something_else();
    every_sky_is_read();
    a_skyline_is_read();
    a_cut_off_file_is_refused_in_words();
    a_file_that_is_not_there();
    free(manual);
    folder_remove();
    return tap_done();
}

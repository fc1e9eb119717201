#include "gen/scene.h"

#include "lib/file.h"
#include "tests/tap.h"

/* A path under the source tree's tests folder; the caller frees. */
static char *input_path(const char *name)
{
    const char *top = getenv("top_srcdir");
    return string_format("%s/tests/%s", top ? top : ".", name);
}

static struct scene *read_input(const char *name)
{
    struct error err = ERROR_NONE;
    struct scene *scene = NULL;
    char *path = input_path(name);
    if (!scene_read(&scene, path, &err)) printf("# %s:%d:%d: %s\n", err.file, err.line, err.column, err.text);
    free(path);
    return scene;
}

static void a_minimal_scene_takes_the_stated_defaults(void)
{
    struct scene *s = read_input("input/minimal.yaml");
    if (!OK(s, "a scene with only what it must have is read")) return;
    OK(s->photograph_count == 1 && !s->is_video && s->scale == 1, "one photograph, not reduced");
    OK(file_exists(s->photographs[0]), "its path is taken from the scene file's folder");
    OK(s->camera.model == CAMERA_PINHOLE && s->camera.width_px == 64 && s->camera.height_px == 48, "camera model and size");
    NEAR(s->camera.params[0], 32, 1e-12, "90 degrees over 64 px are a focal length of 32 px");
    NEAR(s->camera.params[3], 24, 0, "the principal point is the middle");
    OK(!s->has_place && !s->has_time && s->sun == SUN_NONE && s->north_rad == 0, "an overcast sky needs no place and time");
    NEAR(s->turbidity, 3, 0, "turbidity 3");
    NEAR(s->sun_scale, 1, 0, "sun_scale 1");
    OK(s->ground.normal.z == 1 && s->ground.offset_m == 0, "level ground");
    NEAR(s->ground_albedo[0], 0.2, 0, "albedo 0.2");
    NEAR(s->ground_albedo[2], 0.2, 0, "in each channel");
    NEAR(s->ground_reflection, 0, 0, "dry");
    OK(!s->exposure_given && s->white_balance, "exposure and white balance are fitted");
    OK(s->exposure_patch_px[0].x == 10 && s->exposure_patch_px[1].y == 46, "to the patch");
    OK(s->entity_count == 1 && s->entities[0].class_ == CLASS_CAR && !s->entities[0].has_color, "the entity takes its model's class");
    OK(s->occluder_count == 0 && s->transfer == TRANSFER_LAYERS && s->mask == MASK_TRACED, "layers, traced masks, no occluders");
    OK(s->quality == QUALITY_STANDARD && s->seed == 0 && !s->material_rules, "standard quality, seed 0, installed rules");
    scene_destroy(s);
}

int main(void)
{
    a_minimal_scene_takes_the_stated_defaults();
    return tap_done();
}

#include "gen/scene/scene.h"

#include "gen/scene/scene_keys.h"
#include "gen/scene/scene_read.h"
#include "lib/file.h"

#include <stdlib.h>
#include <string.h>

#define SCENE_VERSION 1
bool scene_copy_text(const struct reading *r, char **text, const struct yaml_node *node)
{
    *text = strdup(node->text);
    return *text || out_of_memory(r);
}

bool scene_copy_path(const struct reading *r, char **path, const struct yaml_node *node)
{
    *path = path_beside(r->path, node->text);
    return *path || out_of_memory(r);
}

/* "#rrggbb", three linear numbers, or one for all. */
void scene_read_color(double linear[3], const struct yaml_node *node)
{
    if (node->kind == YAML_SEQUENCE)
        schema_numbers(linear, 3, node);
    else if (!schema_color(linear, node))
        linear[0] = linear[1] = linear[2] = schema_number(node);
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
bool scene_refuse_given(const struct reading *r, const struct yaml_node *mapping, const char *const *keys,
                         const char *section, const char *why)
{
    for (; *keys; keys++) {
        const struct yaml_node *value = yaml_get(mapping, *keys);
        if (!value->is_default) return FAIL(r, value, "%s.%s: %s", section, *keys, why);
    }
    return true;
}

/* A trait of the camera: auto, none (0) or a number. Returns whether it is to be measured. */
static bool read_trait(double *given, const struct yaml_node *node)
{
    *given = 0;
    if (!strcmp(node->text, "auto")) return true;
    if (strcmp(node->text, "none") != 0) *given = schema_number(node);
    return false;
}

static void read_lens_effects(const struct reading *r, const struct yaml_node *lens, const struct yaml_node *weather)
{
    struct scene *scene = r->scene;
    const struct yaml_node *focus = yaml_get(lens, "focus_m");
    scene->exposure_s = number_at(lens, "exposure_s");
    scene->defocus_px = number_at(lens, "defocus_px");
    scene->sharpening_auto = read_trait(&scene->sharpening, yaml_get(lens, "sharpening"));
    scene->softness_auto = read_trait(&scene->softness_px, yaml_get(lens, "softness_px"));
    scene->grain_auto = read_trait(&scene->grain, yaml_get(lens, "grain"));
    scene->vignetting_auto = read_trait(&scene->vignetting, yaml_get(lens, "vignetting"));
    scene->highlights_auto = read_trait(&scene->highlights, yaml_get(lens, "highlights"));
    scene->blacks_auto = read_trait(&scene->blacks, yaml_get(lens, "blacks"));
    scene->compression_auto = !strcmp(yaml_get(lens, "compression")->text, "auto");
    if (focus) scene->focus_m = schema_number(focus);
    scene->has_mist = weather != NULL;
    if (!weather) return;
    scene->visibility_m = number_at(weather, "visibility_m");
    scene_read_color(scene->haze, yaml_get(weather, "haze"));
}

static bool check_lens_effects(const struct reading *r, const struct yaml_node *lens)
{
    const struct yaml_node *focus = yaml_get(lens, "focus_m");
    if (!focus == (r->scene->defocus_px > 0))
        return FAIL(r, focus ? focus : yaml_get(lens, "defocus_px"), "lens: defocus_px and focus_m go together");
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
           scene_refuse_given(r, node, of_threshold, "transfer", "has a meaning with \"method: threshold\" only");
}

static bool read_settings(const struct reading *r, const struct yaml_node *root)
{
    struct scene *scene = r->scene;
    const struct yaml_node *rules = yaml_get(yaml_get(root, "materials"), "rules");
    scene->mask = (enum mask_rule)schema_choice(mask_name, yaml_get(yaml_get(root, "labels"), "mask"));
    scene->quality = (enum quality)schema_choice(quality_name, yaml_get(root, "quality"));
    scene->palette = (enum palette)schema_choice(palette_name, yaml_get(yaml_get(root, "labels"), "palette"));
    yaml_integer(&scene->seed, yaml_get(root, "seed"));
    return !rules || scene_copy_path(r, &scene->material_rules, rules);
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

bool scene_read(struct scene **out, const char *path, const char *const *model_folders, struct error *err)
{
    char *data = NULL;
    size_t size;
    struct yaml_node *root = NULL;
    struct scene *scene = calloc(1, sizeof *scene);
    struct scene_library library = { .folders = model_folders };
    struct reading r = { scene, path, NULL, &library, err };
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
    scene->rendered_hash = schema_rendered_hash(&scene_schema, root);
    r.root = root;
    read_place(&r, root);
    read_lens_effects(&r, yaml_get(root, "lens"), yaml_get(root, "weather"));
    if (!scene_read_shots(&r, root) || !scene_read_light(&r, yaml_get(root, "light")) || !scene_read_static(&r, root) ||
        !scene_read_ground(&r, yaml_get(root, "ground")) || !scene_read_surroundings(&r, yaml_get(root, "surroundings")) ||
        !scene_read_north(&r, root) || !scene_read_roads(&r, root) ||
        !scene_read_exposure(&r, yaml_get(root, "exposure")) || !scene_read_models(&r, yaml_get(root, "models")) ||
        !scene_read_entities(&r, yaml_get(root, "entities")) || !scene_read_occluders(&r, yaml_get(root, "occluders")) ||
        !scene_read_traffic(&r, yaml_get(root, "traffic")) || !check_lens_effects(&r, yaml_get(root, "lens")) ||
        !read_transfer(&r, yaml_get(root, "transfer")) || !read_settings(&r, root))
        goto out;
    *out = scene;
    scene = NULL;
out:
    catalogue_destroy(library.catalogue);
    yaml_destroy(root);
    free(data);
    scene_destroy(scene);
    return err->code == ERR_OK;
}

static void choice_release(struct scene_choice *choice)
{
    free(choice->models);
    free(choice->weights);
}

void scene_destroy(struct scene *scene)
{
    if (!scene) return;
    free(scene->map.file);
    free(scene->marks);
    free(scene->skyline.point_rad);
    for (size_t i = 0; i < scene->camera_count; i++) free(scene->cameras[i].name);
    for (size_t i = 0; i < scene->shot_count; i++) {
        free(scene->shots[i].photograph);
        free(scene->shots[i].semantic);
        free(scene->shots[i].depth);
    }
    for (size_t i = 0; i < scene->path_count; i++) {
        free(scene->paths[i].name);
        free(scene->paths[i].points);
    }
    struct scene_movers *const movers[] = { &scene->vehicles, &scene->people };
    for (int i = 0; i < 2; i++) {
        choice_release(&movers[i]->choice);
        free(movers[i]->colors);
    }
    for (size_t i = 0; i < scene->model_count; i++) {
        free(scene->models[i].name);
        free(scene->models[i].colors);
        for (int k = 0; k < DETAIL_COUNT; k++) free(scene->models[i].files[k]);
    }
    for (size_t i = 0; i < scene->entity_count; i++) {
        free(scene->entities[i].name);
        choice_release(&scene->entities[i].choice);
        free(scene->entities[i].path);
    }
    for (size_t i = 0; i < scene->occluder_count; i++) {
        free(scene->occluders[i].name);
        free(scene->occluders[i].polygon_px);
    }
    free(scene->cameras);
    free(scene->shots);
    free(scene->paths);
    free(scene->video);
    free(scene->static_.mesh);
    free(scene->osm);
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

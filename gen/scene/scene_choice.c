#include "gen/scene/nearest.h"
#include "gen/scene/scene_read.h"
#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ANY "any "

/* --- the catalogue --- */

static bool open_catalogue(const struct reading *r)
{
    struct scene_library *library = r->library;
    if (library->catalogue) return true;
    size_t n = 0;
    while (library->folders && library->folders[n]) n++;
    char *beside = path_beside(r->path, "models");
    const char **folders = calloc(n + 2, sizeof *folders);
    bool ok = beside && folders;
    if (ok) {
        folders[0] = beside;
        for (size_t i = 0; i < n; i++) folders[i + 1] = library->folders[i];
        ok = catalogue_read(&library->catalogue, folders, r->err);
    } else
        out_of_memory(r);
    free(folders);
    free(beside);
    return ok;
}

static bool copy_model(const struct reading *r, struct scene_model *to, const struct catalogue_model *from)
{
    *to = (struct scene_model){ .options = from->options, .has_class = true, .class_ = from->class_, .color_count = from->color_count };
    to->name = strdup(from->name);
    to->colors = calloc(from->color_count + 1, sizeof *to->colors);
    bool ok = to->name && to->colors;
    if (to->colors && from->color_count) memcpy(to->colors, from->colors, from->color_count * sizeof *to->colors);
    for (int i = 0; i < DETAIL_COUNT; i++)
        if (from->files[i] && !(to->files[i] = strdup(from->files[i]))) ok = false;
    return ok || out_of_memory(r);
}

static bool scene_has(const struct scene *scene, size_t *index, const char *name)
{
    for (*index = 0; *index < scene->model_count; ++*index)
        if (!strcmp(scene->models[*index].name, name)) return true;
    return false;
}

/* The index of a model of the catalogue, which becomes one of the scene's. */
static bool take(const struct reading *r, size_t *index, const struct catalogue_model *model)
{
    struct scene *scene = r->scene;
    if (scene_has(scene, index, model->name)) return true;
    struct scene_model *grown = realloc(scene->models, (scene->model_count + 1) * sizeof *grown);
    if (!grown) return out_of_memory(r);
    scene->models = grown;
    return copy_model(r, &grown[scene->model_count++], model);
}

/* --- names --- */

static bool fail_unknown(const struct reading *r, const char *name, const struct yaml_node *at, const char *who)
{
    const struct catalogue *catalogue = r->library->catalogue;
    struct nearest nearest = { NULL, 0 };
    for (size_t i = 0; i < r->scene->model_count; i++) nearest_offer(&nearest, name, r->scene->models[i].name);
    for (size_t i = 0; i < catalogue->count; i++) nearest_offer(&nearest, name, catalogue->models[i].name);
    if (nearest.name) return FAIL(r, at, "%s: unknown model \"%.80s\" (did you mean \"%s\"?)", who, name, nearest.name);
    return FAIL(r, at, "%s: unknown model \"%.80s\" (it must be one of the names under models, or one that staffage models lists)", who, name);
}

static bool add(const struct reading *r, struct scene_choice *choice, size_t model, double weight)
{
    size_t *models = realloc(choice->models, (choice->count + 1) * sizeof *models);
    if (!models) return out_of_memory(r);
    choice->models = models;
    double *weights = realloc(choice->weights, (choice->count + 1) * sizeof *weights);
    if (!weights) return out_of_memory(r);
    choice->weights = weights;
    models[choice->count] = model;
    weights[choice->count++] = weight;
    return true;
}

static bool is_vehicle(enum entity_class class_)
{
    return !class_info(class_)->is_person && class_ != CLASS_ANIMAL && class_ != CLASS_OTHER;
}

/* What the catalogue has of a class, each as common as it says there. */
static bool add_class(const struct reading *r, struct scene_choice *choice, const char *name, double weight,
                      const struct yaml_node *at, const char *who)
{
    enum entity_class class_ = CLASS_COUNT;
    bool vehicles = !strcmp(name, "vehicle");
    if (!vehicles && !class_from_name(&class_, name)) {
        struct nearest nearest = { NULL, 0 };
        nearest_offer(&nearest, name, "vehicle");
        for (int i = 0; i < CLASS_COUNT; i++) nearest_offer(&nearest, name, class_info((enum entity_class)i)->name);
        return FAIL(r, at, "%s: \"any %.60s\": unknown class (%s%s%s", who, name, nearest.name ? "did you mean \"any " : "any vehicle, any person, any car or another class would be right",
                    nearest.name ? nearest.name : "", nearest.name ? "\"?)" : ")");
    }
    if (!open_catalogue(r)) return false;
    const struct catalogue *catalogue = r->library->catalogue;
    double sum = 0;
    for (size_t i = 0; i < catalogue->count; i++)
        if (vehicles ? is_vehicle(catalogue->models[i].class_) : catalogue->models[i].class_ == class_) sum += catalogue->models[i].weight;
    if (!(sum > 0)) return FAIL(r, at, "%s: the catalogue has no model of class %s: staffage models lists what it has", who, name);
    for (size_t i = 0; i < catalogue->count; i++) {
        const struct catalogue_model *model = &catalogue->models[i];
        size_t index;
        if (!(vehicles ? is_vehicle(model->class_) : model->class_ == class_)) continue;
        if (!take(r, &index, model) || !add(r, choice, index, weight * model->weight / sum)) return false;
    }
    return true;
}

static bool add_name(const struct reading *r, struct scene_choice *choice, const char *name, double weight,
                     const struct yaml_node *at, const char *who)
{
    size_t index;
    if (scene_has(r->scene, &index, name)) return add(r, choice, index, weight);
    if (!strncmp(name, ANY, strlen(ANY))) return add_class(r, choice, name + strlen(ANY), weight, at, who);
    if (!open_catalogue(r)) return false;
    const struct catalogue_model *model = catalogue_find(r->library->catalogue, name);
    if (!model) return fail_unknown(r, name, at, who);
    return take(r, &index, model) && add(r, choice, index, weight);
}

bool scene_read_choice(const struct reading *r, struct scene_choice *choice, const struct yaml_node *node, const char *who)
{
    if (node->kind == YAML_SCALAR) return add_name(r, choice, node->text, 1, node, who);
    if (!node->count) return FAIL(r, node, "%s: names no model", who);
    for (size_t i = 0; i < node->count; i++) {
        const struct yaml_node *item = node->items[i];
        if (node->kind == YAML_SEQUENCE) {
            if (!add_name(r, choice, item->text, 1, item, who)) return false;
            continue;
        }
        const struct yaml_node key = { .line = node->keys[i].line, .column = node->keys[i].column };
        double weight = item->kind == YAML_MAPPING ? number_at(item, "weight") : schema_number(item);
        if (!add_name(r, choice, node->keys[i].text, weight, &key, who)) return false;
    }
    return true;
}

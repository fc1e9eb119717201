#include "gen/scene/scene_keys.h"
#include "gen/scene/scene_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define ENTITIES_MAX 65535 /* instance ids have 16 bits, 0 is none */

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
    if (!scene_copy_path(r, &model->files[DETAIL_NEAR], file)) return false;
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

bool scene_read_models(const struct reading *r, const struct yaml_node *node)
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

static bool read_at(const struct reading *r, struct scene_entity *entity, const struct yaml_node *at, const char *who)
{
    const struct scene *scene = r->scene;
    const struct yaml_node *world = yaml_get(at, "world_m"), *pixel = yaml_get(at, "pixel"), *shot = yaml_get(at, "shot");
    const struct yaml_node *latitude = yaml_get(at, "latitude_deg"), *longitude = yaml_get(at, "longitude_deg");
    int index;
    yaml_integer(&index, shot);
    entity->shot = (size_t)index;
    entity->at_source = source_of(world ? world : pixel ? pixel : latitude);
    if (!pixel && !shot->is_default) return FAIL(r, shot, "%s: shot has a meaning with pixel only", who);
    if (!latitude != !longitude)
        return FAIL(r, latitude ? latitude : longitude, "%s: latitude_deg and longitude_deg go together", who);
    if (latitude && !scene->has_place) return FAIL(r, latitude, "%s: a latitude needs the scene's place", who);
    if (world || pixel) {
        entity->place = world ? PLACE_WORLD : PLACE_PIXEL;
        schema_numbers(entity->at, 2, world ? world : pixel);
    } else {
        entity->place = PLACE_GEODETIC;
        entity->at[0] = schema_number(latitude);
        entity->at[1] = schema_number(longitude);
    }
    return !pixel || scene_check_pixel(r, (struct vec2){ entity->at[0], entity->at[1] }, entity->shot, pixel, who);
}

/* One that stands somewhere, or one that follows a path. */
static bool read_course(const struct reading *r, struct scene_entity *entity, const struct yaml_node *node, const char *who)
{
    static const char *const of_path[] = { "start_m", "offset_m", "speed_m_s" };
    const struct yaml_node *path = yaml_get(node, "path"), *heading = yaml_get(node, "heading_deg");
    const struct yaml_node *value[3];
    for (int i = 0; i < 3; i++) {
        value[i] = yaml_get(node, of_path[i]);
        if (!path && value[i]) return FAIL(r, value[i], "%s: %s has a meaning with path only", who, of_path[i]);
    }
    if (!path) {
        if (!heading) return FAIL(r, node, "%s: key \"heading_deg\" is missing (number)", who);
        entity->heading_rad = rad_from_deg(schema_number(heading));
        return read_at(r, entity, yaml_get(node, "at"), who);
    }
    if (heading) return FAIL(r, heading, "%s: its heading is that of its path: remove heading_deg", who);
    entity->at_source = source_of(path);
    entity->start_m = value[0] ? schema_number(value[0]) : 0;
    entity->offset_m = value[1] ? schema_number(value[1]) : 0;
    entity->speed_m_s = value[2] ? schema_number(value[2]) : 0;
    return scene_copy_text(r, &entity->path, path);
}

static bool read_entity(const struct reading *r, struct scene_entity *entity, const struct yaml_node *node)
{
    const struct yaml_node *name = yaml_get(node, "name"), *model = yaml_get(node, "model");
    const struct yaml_node *class_ = yaml_get(node, "class"), *color = yaml_get(node, "color");
    entity->source = source_of(node);
    if (!scene_copy_text(r, &entity->name, name)) return false;
    char who[160];
    snprintf(who, sizeof who, "entity \"%s\"", entity->name);
    if (!scene_read_choice(r, &entity->choice, model, who)) return false;
    entity->has_class = class_ != NULL;
    if (class_) entity->class_ = (enum entity_class)schema_choice(class_choice_name, class_);
    for (size_t i = 0; !class_ && i < entity->choice.count; i++) {
        const struct scene_model *of = &r->scene->models[entity->choice.models[i]];
        if (!of->has_class)
            return FAIL(r, node,
                        "entity \"%s\": class is missing, and its model \"%.80s\" has none", entity->name, of->name);
    }
    yaml_boolean(&entity->parked, yaml_get(node, "parked"));
    if (entity->parked && yaml_get(node, "path")) return FAIL(r, yaml_get(node, "parked"), "%s: who follows a path is not parked", who);
    entity->has_color = color != NULL;
    if (color) scene_read_color(entity->color, color);
    return read_course(r, entity, node, who);
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

bool scene_read_entities(const struct reading *r, const struct yaml_node *node)
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

/* The shot that an outline is drawn on. */
static bool read_outlined_shot(const struct reading *r, struct scene_occluder *occluder, const struct yaml_node *node)
{
    const struct yaml_node *shot = yaml_get(node, "shot");
    int index = 0;
    occluder->in_each_shot = !shot;
    if (!shot)
        return r->scene->fixed_camera ||
               FAIL(r, node, "occluder \"%s\": key \"shot\" is missing: an outline fits one shot of a flight", occluder->name);
    yaml_integer(&index, shot);
    occluder->shot = (size_t)index;
    if (occluder->shot >= r->scene->shot_count)
        return FAIL(r, shot, "occluder \"%s\": there is no shot %d: they run from 0 to %zu", occluder->name, index, r->scene->shot_count - 1);
    return r->scene->fixed_camera || r->scene->shots[occluder->shot].photograph ||
           FAIL(r, shot, "occluder \"%s\": shot %d is a new view: it has no photograph to outline anything on", occluder->name, index);
}

static bool read_occluder(const struct reading *r, struct scene_occluder *occluder, const struct yaml_node *node)
{
    const struct yaml_node *polygon = yaml_get(node, "polygon_px");
    double p[2];
    occluder->source = source_of(node);
    if (!scene_copy_text(r, &occluder->name, yaml_get(node, "name")) || !read_outlined_shot(r, occluder, node)) return false;
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

bool scene_read_occluders(const struct reading *r, const struct yaml_node *node)
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


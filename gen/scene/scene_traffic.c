#include "gen/scene/scene_keys.h"
#include "gen/scene/scene_read.h"
#include "lib/class.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool read_path(const struct reading *r, struct scene_path *path, const struct yaml_node *node)
{
    const struct yaml_node *world = yaml_get(node, "points_m"), *geodetic = yaml_get(node, "lat_lon_deg");
    const struct yaml_node *pixels = yaml_get(node, "points_px"), *shot = yaml_get(node, "shot");
    const struct yaml_node *points = world ? world : geodetic ? geodetic : pixels;
    int index;
    char who[160];
    path->source = source_of(node);
    path->use = (enum road_use)schema_choice(road_use_name, yaml_get(node, "use"));
    path->place = world ? PLACE_WORLD : geodetic ? PLACE_GEODETIC : PLACE_PIXEL;
    path->width_m = number_at(node, "width_m");
    yaml_boolean(&path->oneway, yaml_get(node, "oneway"));
    yaml_integer(&index, shot);
    path->shot = (size_t)index;
    if (!scene_copy_text(r, &path->name, yaml_get(node, "name"))) return false;
    snprintf(who, sizeof who, "path \"%s\"", path->name);
    if (!pixels && !shot->is_default) return FAIL(r, shot, "%s: shot has a meaning with points_px only", who);
    if (geodetic && !r->scene->has_place) return FAIL(r, geodetic, "%s: latitudes need the scene's place", who);
    path->points = calloc(points->count, sizeof *path->points);
    if (!path->points) return out_of_memory(r);
    path->n = points->count;
    for (size_t i = 0; i < path->n; i++) {
        double p[2];
        schema_numbers(p, 2, points->items[i]);
        path->points[i] = (struct vec2){ p[0], p[1] };
        if (pixels && !scene_check_pixel(r, path->points[i], path->shot, points->items[i], who)) return false;
    }
    return true;
}

bool scene_read_roads(const struct reading *r, const struct yaml_node *root)
{
    struct scene *scene = r->scene;
    const struct yaml_node *roads = yaml_get(root, "roads"), *paths = yaml_get(root, "paths");
    if (roads) {
        if (!scene->has_place) return FAIL(r, roads, "roads: a map needs the scene's place");
        if (!scene_copy_path(r, &scene->osm, yaml_get(roads, "osm"))) return false;
        scene->driving_side = (enum driving_side)schema_choice(driving_side_name, yaml_get(roads, "driving_side"));
        scene->sidewalk_m = number_at(roads, "sidewalk_m");
    }
    if (!paths->count) return true;
    scene->paths = calloc(paths->count, sizeof *scene->paths);
    if (!scene->paths) return out_of_memory(r);
    scene->path_count = paths->count;
    for (size_t i = 0; i < paths->count; i++) {
        if (!read_path(r, &scene->paths[i], paths->items[i])) return false;
        for (size_t k = 0; k < i; k++)
            if (!strcmp(scene->paths[k].name, scene->paths[i].name))
                return FAIL(r, yaml_get(paths->items[i], "name"), "the name \"%s\" is taken by the path in line %d",
                            scene->paths[i].name, scene->paths[k].source.line);
    }
    return true;
}

static bool read_movers(const struct reading *r, struct scene_movers *movers, const struct yaml_node *node, bool people)
{
    const char *who = people ? "traffic.people" : "traffic.vehicles";
    if (!node) return true;
    const struct yaml_node *models = yaml_get(node, "models"), *colors = yaml_get(node, "colors");
    size_t color_count = colors ? colors->count : 0;
    int count;
    movers->source = source_of(node);
    yaml_integer(&count, yaml_get(node, "count"));
    movers->count = (size_t)count;
    movers->speed_m_s = number_at(node, "speed_m_s");
    if (!scene_read_choice(r, &movers->choice, models, who)) return false;
    movers->colors = calloc(color_count + 1, sizeof *movers->colors);
    if (!movers->colors) return out_of_memory(r);
    movers->color_count = color_count;
    for (size_t i = 0; i < color_count; i++) schema_color(movers->colors[i], colors->items[i]);
    for (size_t i = 0; i < movers->choice.count; i++) {
        const struct scene_model *of = &r->scene->models[movers->choice.models[i]];
        if (!of->has_class) return FAIL(r, models, "%s: model \"%.80s\" must say its class", who, of->name);
        const struct class_info *is = class_info(of->class_);
        if (is->is_person != people)
            return FAIL(r, models, "%s: model \"%.80s\" is of class %s: %s", who, of->name, is->name,
                        people ? "people only walk here" : "vehicles only drive here");
    }
    return true;
}

bool scene_read_traffic(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    if (!read_movers(r, &scene->vehicles, yaml_get(node, "vehicles"), false) ||
        !read_movers(r, &scene->people, yaml_get(node, "people"), true))
        return false;
    bool moves = scene->vehicles.count || scene->people.count;
    for (size_t i = 0; i < scene->entity_count; i++) moves = moves || scene->entities[i].speed_m_s != 0;
    if (moves && !scene->osm && !scene->path_count) {
        const struct yaml_node at = { .line = node->line, .column = node->column };
        return FAIL(r, &at, "traffic: there is nowhere to go: give roads (a map) or paths");
    }
    if (moves && !scene->has_times && scene->shot_count > 1) {
        const struct yaml_node at = { .line = scene->shots[0].source.line, .column = scene->shots[0].source.column };
        return FAIL(r, &at, "something moves, and the photographs have no times: give %s",
                    scene->fixed_camera ? "photographs.rate_hz" : "each shot its time");
    }
    return true;
}

#include "gen/stage.h"

#include "gen/detail.h"
#include "gen/moment.h"
#include "gen/scene/nearest.h"
#include "gen/stage_cast.h"
#include "gen/world/ground.h"
#include "lib/file.h"
#include "lib/place.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEG (180 / M_PI)

/* Boxes may touch: two cars of a real queue stand bumper to bumper. */
static const double overlap_tolerance_m = 0.02;

bool stage_fail(const struct scene *scene, struct source where, struct error *err)
{
    if (!err->file[0]) {
        snprintf(err->file, sizeof err->file, "%s", scene->path);
        err->line = where.line;
        err->column = where.column;
    }
    return false;
}

static bool out_of_memory(struct error *err)
{
    return error_set(err, ERR_MEMORY, "no memory for the scene");
}

/* --- where things are --- */

/* East and north of a latitude and longitude, in the world's axes. */
static bool world_from_geodetic(struct vec2 *p, const struct scene *s, double latitude_deg, double longitude_deg,
                                struct error *err)
{
    double origin[3] = { s->place.latitude_rad * DEG, s->place.longitude_rad * DEG, s->place.height_m };
    double enu[3], there[3] = { latitude_deg, longitude_deg, s->place.height_m };
    if (!place_enu_from_geodetic(enu, origin, there, err)) return false;
    /* The world's +y may point elsewhere than true north. */
    double c = cos(s->north_rad), n = sin(s->north_rad);
    *p = (struct vec2){ c * enu[0] - n * enu[1], n * enu[0] + c * enu[1] };
    return true;
}

bool stage_ground_at(struct vec3 *p, const struct stage *stage, const struct scene_shot *shot, struct vec2 q_px,
                     struct error *err)
{
    const struct camera *camera = &stage->scene->cameras[shot->camera].camera;
    struct vec3 ray;
    if (!stage->mesh) return ground_from_pixel(p, &stage->scene->ground, camera, shot->world_from_camera, q_px, err);
    return camera_unproject(camera, &ray, q_px, err) &&
           (surface_intersect(&stage->surface, p, shot->world_from_camera.translation,
                              mat3_apply(shot->world_from_camera.rotation, ray)) ||
            error_set(err, ERR_INPUT, "pixel (%.6g, %.6g) does not see the static mesh", q_px.x, q_px.y));
}

static bool world_from_pixel(struct vec2 *p, const struct stage *stage, struct vec2 q_px, size_t shot, struct error *err)
{
    struct vec3 at;
    if (!stage_ground_at(&at, stage, &stage->scene->shots[shot], q_px, err)) return false;
    *p = (struct vec2){ at.x, at.y };
    return true;
}

static bool find_place(struct vec2 *p, const struct stage *stage, enum place_kind kind, const double at[2], size_t shot,
                       struct error *err)
{
    *p = (struct vec2){ at[0], at[1] };
    switch (kind) {
    case PLACE_GEODETIC: return world_from_geodetic(p, stage->scene, at[0], at[1], err);
    case PLACE_PIXEL: return world_from_pixel(p, stage, *p, shot, err);
    case PLACE_WORLD:
    default: return true;
    }
}

static bool find_course(struct stage *stage, size_t entity, struct error *err)
{
    const struct scene_entity *e = &stage->scene->entities[entity];
    struct nearest nearest = { NULL, 0 };
    for (size_t i = 0; i < stage->roads.way_count; i++) {
        const struct way *way = &stage->roads.ways[i];
        if (!strcmp(way->name, e->path)) {
            stage->courses[entity] = way;
            double length = path_length(&way->path);
            if ((e->start_m < 0 && e->speed_m_s <= 0) || (e->start_m > length && e->speed_m_s >= 0))
                return error_set(err, ERR_INPUT, "entity \"%s\": starts at %g m, path \"%s\" is %.1f m long, and its speed does not bring it there",
                                 e->name, e->start_m, e->path, length) ||
                       stage_fail(stage->scene, e->at_source, err);
            return true;
        }
        nearest_offer(&nearest, e->path, way->name);
    }
    error_set(err, ERR_INPUT, "entity \"%s\": unknown path \"%.80s\"%s%s%s", e->name, e->path,
              nearest.name ? " (did you mean \"" : " (it must be the name of a path or road)", nearest.name ? nearest.name : "",
              nearest.name ? "\"?)" : "");
    return stage_fail(stage->scene, e->at_source, err);
}

static bool place_entities(struct stage *stage, struct error *err)
{
    const struct scene *s = stage->scene;
    for (size_t i = 0; i < s->entity_count; i++) {
        const struct scene_entity *e = &s->entities[i];
        struct vec2 p;
        if (e->path) {
            if (!find_course(stage, i, err)) return false;
        } else if (find_place(&p, stage, e->place, e->at, e->shot, err)) {
            stage->stand_m[i] = p;
        } else {
            stage_fail(s, e->at_source, err);
            return error_prefix(err, "entity \"%s\": ", e->name);
        }
    }
    return true;
}

/* --- the place --- */

static bool add_paths(struct stage *stage, const struct road_rules *rules, struct error *err)
{
    const struct scene *s = stage->scene;
    for (size_t i = 0; i < s->path_count; i++) {
        const struct scene_path *path = &s->paths[i];
        struct vec2 *points = calloc(path->n, sizeof *points);
        bool ok = points || out_of_memory(err);
        for (size_t k = 0; ok && k < path->n; k++)
            ok = find_place(&points[k], stage, path->place, (double[]){ path->points[k].x, path->points[k].y }, path->shot, err);
        ok = ok && roads_add(&stage->roads, path->name, path->use, points, path->n, path->width_m, path->oneway, rules, err);
        free(points);
        if (!ok) {
            stage_fail(s, path->source, err);
            return error_prefix(err, "path \"%s\": ", path->name);
        }
    }
    return true;
}

/* Pixels of photographs are found on the mesh as it is, before roads are laid into it. */
static bool load_roads(struct stage *stage, size_t *of_map, struct error *err)
{
    const struct scene *s = stage->scene;
    struct road_rules rules = { s->driving_side, s->sidewalk_m, s->place, s->north_rad };
    struct vec2 keep[2] = { { -INFINITY, -INFINITY }, { INFINITY, INFINITY } };
    if (stage->mesh) {
        struct vec3 min_m, max_m;
        static_mesh_bounds(stage->mesh, &min_m, &max_m);
        keep[0] = (struct vec2){ min_m.x, min_m.y };
        keep[1] = (struct vec2){ max_m.x, max_m.y };
    }
    if (s->osm && (!roads_read_osm(&stage->roads, s->osm, &rules, keep, err) || !file_hash(&stage->hash, s->osm, err)))
        return false;
    *of_map = stage->roads.way_count;
    if (!add_paths(stage, &rules, err)) return false;
    if (stage->mesh) static_mesh_unindex(stage->mesh);
    return true;
}

static bool load_mesh(struct stage *stage, struct error *err)
{
    const struct scene_static *from = &stage->scene->static_;
    bool by_pixel = false;
    for (size_t i = 0; i < stage->scene->path_count; i++) by_pixel = by_pixel || stage->scene->paths[i].place == PLACE_PIXEL;
    if (!static_mesh_load(&stage->mesh, from->mesh, from->world_from_mesh, err)) return false;
    stage->surface = (struct surface){ .has_mesh = true, .mesh = stage->mesh };
    uint64_t hash = static_mesh_hash(stage->mesh);
    stage->hash = hash_bytes(stage->hash, &hash, sizeof hash);
    return !by_pixel || static_mesh_index(stage->mesh, from->detail_m, err);
}

/* A smooth road along every way. Of the map, those that hardly touch the mesh are none of this place's;
 * a path by hand is meant to lie on it. */
static bool smooth_roads(struct stage *stage, size_t of_map, struct error *err)
{
    stage->ribbons = calloc(stage->roads.way_count + 1, sizeof *stage->ribbons);
    if (!stage->ribbons) return out_of_memory(err);
    while (stage->ribbon_count < stage->roads.way_count) {
        size_t i = stage->ribbon_count;
        struct error wrong = ERROR_NONE;
        if (ribbon_fit(&stage->ribbons[i], &stage->roads.ways[i], stage->mesh, &wrong)) {
            stage->ribbon_count++;
        } else if (wrong.code == ERR_INPUT && i < of_map) {
            roads_drop(&stage->roads, i);
            of_map--;
        } else {
            *err = wrong;
            if (i >= of_map) stage_fail(stage->scene, stage->scene->paths[i - of_map].source, err);
            return error_prefix(err, "path ");
        }
    }
    if (!ribbons_lay(stage->mesh, stage->ribbons, stage->ribbon_count, err)) return false;
    stage->surface.ribbons = stage->ribbons;
    stage->surface.ribbon_count = stage->ribbon_count;
    return static_mesh_index(stage->mesh, stage->scene->static_.detail_m, err);
}

static bool load_place(struct stage *stage, struct error *err)
{
    stage->surface = (struct surface){ .plane = stage->scene->ground };
    size_t of_map;
    if (!stage->scene->static_.mesh) return load_roads(stage, &of_map, err);
    return load_mesh(stage, err) && load_roads(stage, &of_map, err) && smooth_roads(stage, of_map, err);
}

/* --- traffic --- */

static bool list_kinds(struct mover_kind **kinds, const struct stage *stage, const struct scene_movers *movers, struct error *err)
{
    const struct scene_choice *choice = &movers->choice;
    *kinds = calloc(choice->count + 1, sizeof **kinds);
    if (!*kinds) return out_of_memory(err);
    for (size_t i = 0; i < choice->count; i++) {
        const struct model *model = stage->models[choice->models[i]];
        (*kinds)[i] = (struct mover_kind){ choice->models[i], choice->weights[i], model->max_m.x - model->min_m.x,
                                           model->max_m.y - model->min_m.y };
    }
    return true;
}

static bool start_traffic(struct stage *stage, struct error *err)
{
    const struct scene *s = stage->scene;
    struct mover_kind *vehicles = NULL, *people = NULL;
    double begin = INFINITY, end = -INFINITY;
    if (!s->vehicles.count && !s->people.count) return true;
    for (size_t i = 0; i < s->shot_count; i++) {
        begin = fmin(begin, s->shots[i].time_s);
        end = fmax(end, s->shots[i].time_s + s->exposure_s);
    }
    bool ok = list_kinds(&vehicles, stage, &s->vehicles, err) && list_kinds(&people, stage, &s->people, err);
    if (ok) {
        struct traffic_options options = {
            .vehicles = vehicles, .people = people, .vehicle_kinds = s->vehicles.choice.count, .people_kinds = s->people.choice.count,
            .vehicle_count = s->vehicles.count, .people_count = s->people.count,
            .vehicle_speed_m_s = s->vehicles.speed_m_s, .people_speed_m_s = s->people.speed_m_s, .lateral_m_s2 = 2,
            .color_count = s->vehicles.color_count, .first_id = (uint16_t)(s->entity_count + 1), .seed = (uint64_t)s->seed,
        };
        ok = traffic_create(&stage->traffic, &stage->roads, &options, begin, end, err) ||
             stage_fail(s, strstr(err->text, " people ") || !s->vehicles.count ? s->people.source : s->vehicles.source, err);
    }
    free(vehicles);
    free(people);
    return ok;
}

/* Those that stand run into none of each other. */
static bool check_overlaps(const struct stage *stage, struct error *err)
{
    const struct scene *s = stage->scene;
    struct moment moment;
    if (!moment_at(&moment, stage, 0, err)) return false;
    for (size_t i = 0; i < s->entity_count; i++)
        for (size_t k = 0; k < i; k++)
            if (!s->entities[i].path && !s->entities[k].path &&
                entities_intersect(&moment.entities[i], &moment.entities[k], overlap_tolerance_m))
                error_at(err, ERR_INPUT, s->path, s->entities[i].source.line, s->entities[i].source.column,
                         "entity \"%s\" runs into entity \"%s\" (line %d): their boxes intersect; "
                         "move or turn one of them", s->entities[i].name, s->entities[k].name, s->entities[k].source.line);
    moment_release(&moment);
    return err->code == ERR_OK;
}

bool stage_create(struct stage **out, const struct scene *scene, const struct material_rules *rules, struct error *err)
{
    struct stage *stage = calloc(1, sizeof *stage);
    if (!stage) return out_of_memory(err);
    *stage = (struct stage){ .scene = scene, .hash = FILE_HASH_SEED };
    stage->cast = calloc(scene->entity_count + 1, sizeof *stage->cast);
    stage->details = calloc(scene->model_count + 1, sizeof *stage->details);
    stage->models = calloc(scene->model_count + 1, sizeof *stage->models);
    stage->repertoires = calloc(scene->model_count + 1, sizeof *stage->repertoires);
    stage->stand_m = calloc(scene->entity_count + 1, sizeof *stage->stand_m);
    stage->courses = calloc(scene->entity_count + 1, sizeof *stage->courses);
    if (!stage->cast || !stage->details || !stage->models || !stage->repertoires || !stage->stand_m || !stage->courses) {
        out_of_memory(err);
        goto failed;
    }
    stage_cast_entities(stage);
    if (!load_place(stage, err) || !place_entities(stage, err)) goto failed;
    details_choose(stage->details, stage);
    if (!stage_load_models(stage, rules, err) || !start_traffic(stage, err) || !check_overlaps(stage, err)) goto failed;
    *out = stage;
    return true;
failed:
    stage_destroy(stage);
    return false;
}

void stage_destroy(struct stage *stage)
{
    if (!stage) return;
    traffic_destroy(stage->traffic);
    for (size_t i = 0; i < stage->ribbon_count; i++) ribbon_release(&stage->ribbons[i]);
    free(stage->ribbons);
    roads_release(&stage->roads);
    static_mesh_destroy(stage->mesh);
    for (size_t i = 0; stage->repertoires && i < stage->scene->model_count; i++) repertoire_release(&stage->repertoires[i]);
    for (size_t i = 0; stage->models && i < stage->scene->model_count; i++) model_destroy(stage->models[i]);
    for (size_t i = 0; i < stage->warning_count; i++) free(stage->warnings[i]);
    free(stage->warnings);
    free(stage->cast);
    free(stage->details);
    free(stage->models);
    free(stage->repertoires);
    free(stage->stand_m);
    free(stage->courses);
    free(stage);
}

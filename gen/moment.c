#include "gen/moment.h"

#include "lib/class.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* In: color linear, or NULL */
static void paint(struct entity *entity, const double *color)
{
    entity->has_color = color != NULL;
    if (color) memcpy(entity->color, color, sizeof entity->color);
}

static struct entity scene_entity(const struct stage *stage, size_t i)
{
    const struct scene_entity *e = &stage->scene->entities[i];
    size_t model = stage->cast[i];
    struct entity entity = { .id = (uint16_t)(i + 1), .name = e->name, .model_name = stage->scene->models[model].name,
                             .class_ = stage_class(stage, i), .model = stage->models[model] };
    paint(&entity, e->has_color ? e->color : stage_color(stage, model, entity.id));
    return entity;
}

/* Stand an entity at (x, y): people upright, vehicles as their wheels have it. */
static bool stand(struct entity *entity, const struct stage *stage, struct vec2 p, double heading_rad, struct error *err)
{
    const struct model *model = entity->model;
    if (!stage->mesh) {
        entity->world_from_entity = entity_stand(&stage->scene->ground, vec3(p.x, p.y, 0), heading_rad);
        return true;
    }
    bool upright = class_info(entity->class_)->is_person;
    double wheelbase = upright ? 0 : 0.6 * (model->max_m.x - model->min_m.x);
    double track = upright ? 0 : 0.85 * (model->max_m.y - model->min_m.y);
    return surface_stand(&stage->surface, &entity->world_from_entity, p.x, p.y, heading_rad, wheelbase, track) ||
           error_set(err, ERR_INPUT, "at (%.2f, %.2f) there is no static mesh to stand on: a hole in it, or its edge", p.x, p.y);
}

/* As fast over the ground as it goes on the map, up and down with its own front. */
static struct vec3 velocity(const struct entity *entity, double speed_m_s, double heading_rad)
{
    struct vec3 front = mat3_column(entity->world_from_entity.rotation, 0);
    if (speed_m_s == 0) return vec3(0, 0, 0);
    return vec3_scale(vec3(sin(heading_rad), cos(heading_rad), front.z / hypot(front.x, front.y)), speed_m_s);
}

/* Its rigged model as it is now. */
static bool pose_entity(struct moment *moment, const struct stage *stage, const struct pace_now *now, struct error *err)
{
    struct entity *entity = &moment->entities[moment->n];
    if (!entity->model->rig) return true;
    struct posture posture = repertoire_posture(&stage->repertoires[moment->model_index[moment->n]], now);
    struct model *posed = &moment->posed[moment->posed_count];
    if (!model_pose(posed, entity->model, &posture, err)) return false;
    moment->posed_count++;
    entity->model = posed;
    return true;
}

static bool add_entity(struct moment *moment, const struct stage *stage, size_t i, double time_s, struct error *err)
{
    const struct scene_entity *e = &stage->scene->entities[i];
    struct entity *entity = &moment->entities[moment->n];
    struct vec2 p = stage->stand_m[i];
    double heading = e->heading_rad, way_m = 0, speed = 0;
    *entity = scene_entity(stage, i);
    moment->model_index[moment->n] = stage->cast[i];
    if (stage->courses[i]) {
        const struct path *path = &stage->courses[i]->path;
        double s = e->start_m + e->speed_m_s * time_s;
        double held = fmin(fmax(s, 0), path_length(path)); /* who comes to an end of the path stands there */
        struct path_point at = path_at(path, held, e->offset_m);
        p = at.p_m;
        heading = at.heading_rad + (e->speed_m_s < 0 ? M_PI : 0);
        way_m = held - fmin(e->start_m, path_length(path));
        bool ahead = e->speed_m_s > 0 ? s < path_length(path) : s > 0;
        if (ahead && held == s) speed = fabs(e->speed_m_s);
    }
    if (!stand(entity, stage, p, heading, err)) {
        stage_fail(stage->scene, e->at_source, err);
        return error_prefix(err, "entity \"%s\": ", e->name);
    }
    moment->velocity_m_s[moment->n] = velocity(entity, speed, heading);
    struct pace_now now = { .speed_m_s = speed, .wish_m_s = stage->courses[i] ? e->speed_m_s : 0,
                            .distance_m = e->speed_m_s < 0 ? -way_m : way_m, .time_s = time_s };
    /* Those who stand about do not all shift their weight at once. */
    if (stage->repertoires[stage->cast[i]].has[PACE_STAND] && !stage->courses[i]) now.phase = fmod(0.618034 * (double)(i + 1), 1);
    if (!pose_entity(moment, stage, &now, err)) return false;
    moment->n++;
    return true;
}

static bool add_mover(struct moment *moment, const struct stage *stage, const struct mover *mover, double time_s,
                      struct error *err)
{
    const struct scene *s = stage->scene;
    const struct scene_movers *movers = mover->is_person ? &s->people : &s->vehicles;
    size_t model = movers->choice.models[mover->kind];
    struct entity *entity = &moment->entities[moment->n];
    char *name = moment->names[moment->n];
    snprintf(name, MOVER_NAME_SIZE, "%s %d", mover->is_person ? "person" : "vehicle", (int)mover->id);
    *entity = (struct entity){ .id = mover->id, .name = name, .model_name = s->models[model].name,
                               .class_ = s->models[model].class_, .model = stage->models[model] };
    /* What comes in one colour only, a taxi or a fire engine, keeps it. */
    bool painted = !mover->is_person && mover->color >= 0 && s->models[model].color_count != 1;
    paint(entity, painted ? movers->colors[mover->color] : stage_color(stage, model, mover->id));
    moment->model_index[moment->n] = model;
    if (!stand(entity, stage, mover->p_m, mover->heading_rad, err)) {
        stage_fail(s, movers->source, err);
        return error_prefix(err, "%s: ", name);
    }
    moment->velocity_m_s[moment->n] = velocity(entity, mover->speed_m_s, mover->heading_rad);
    struct pace_now now = { .speed_m_s = mover->speed_m_s, .wish_m_s = mover->wish_m_s, .distance_m = mover->distance_m,
                            .phase = mover->phase, .time_s = time_s };
    if (!pose_entity(moment, stage, &now, err)) return false;
    moment->n++;
    return true;
}

bool moment_at(struct moment *out, const struct stage *stage, double time_s, struct error *err)
{
    const struct scene *s = stage->scene;
    size_t mover_count = stage->traffic ? traffic_mover_count(stage->traffic) : 0, most = s->entity_count + mover_count + 1;
    struct moment moment = {
        .entities = calloc(most, sizeof *moment.entities), .model_index = calloc(most, sizeof *moment.model_index),
        .velocity_m_s = calloc(most, sizeof *moment.velocity_m_s), .posed = calloc(most, sizeof *moment.posed),
        .names = calloc(most, sizeof *moment.names),
    };
    struct mover *movers = calloc(most, sizeof *movers);
    bool ok = (moment.entities && moment.model_index && moment.velocity_m_s && moment.posed && moment.names && movers) ||
              error_set(err, ERR_MEMORY, "no memory for a moment of the scene");
    for (size_t i = 0; ok && i < s->entity_count; i++) ok = add_entity(&moment, stage, i, time_s, err);
    size_t present = ok && stage->traffic ? traffic_at(stage->traffic, movers, time_s) : 0;
    for (size_t i = 0; ok && i < present; i++) ok = add_mover(&moment, stage, &movers[i], time_s, err);
    free(movers);
    if (ok) *out = moment;
    else moment_release(&moment);
    return ok;
}

void moment_release(struct moment *moment)
{
    for (size_t i = 0; i < moment->posed_count; i++) model_posed_release(&moment->posed[i]);
    free(moment->entities);
    free(moment->model_index);
    free(moment->velocity_m_s);
    free(moment->posed);
    free(moment->names);
    *moment = (struct moment){ 0 };
}

#include "gen/moment.h"

#include "gen/model/rig.h"
#include "gen/motion/journey.h"
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
static bool pose_entity(struct moment *moment, const struct posture *posture, struct error *err)
{
    struct entity *entity = &moment->entities[moment->n];
    if (!entity->model->rig) return true;
    struct model *posed = &moment->posed[moment->posed_count];
    if (!model_pose(posed, entity->model, posture, err)) return false;
    moment->posed_count++;
    entity->model = posed;
    return true;
}

/* How one on a path is on his way: where on it, how fast, how far he has gone; from which phase of his gait on; how
 * long he rests, and how far to the left he stands then. */
struct progress { double s_m, speed_m_s, gone_m, phase, rest_s, aside_m; bool waits; /* stands where the path begins */ };

static double clamp(double x, double low, double high) { return fmin(fmax(x, low), high); }

/* Who comes to an end of the path stands there. */
static struct progress drive_on(const struct scene_entity *e, double length_m, double time_s)
{
    double s = e->start_m + e->speed_m_s * time_s, held = clamp(s, 0, length_m), way_m = held - fmin(e->start_m, length_m);
    bool ahead = e->speed_m_s > 0 ? s < length_m : s > 0;
    double speed = ahead && held == s ? fabs(e->speed_m_s) : 0;
    return (struct progress){ .s_m = held, .speed_m_s = speed, .gone_m = e->speed_m_s < 0 ? -way_m : way_m };
}

/* Who walks slows down to stand there, and sets out from rest where he was to come from beyond its other end; both as
 * the foot on the ground is where it is when he stands. */
static struct progress walk_on(const struct scene_entity *e, const struct repertoire *repertoire, double length_m, double time_s)
{
    const struct gait *gait = repertoire_gait(repertoire, e->speed_m_s);
    bool back = e->speed_m_s < 0;
    double begin_m = back ? length_m - e->start_m : e->start_m, left_m = length_m - clamp(begin_m, 0, length_m);
    struct journey journey = { .length_m = left_m, .speed_m_s = fabs(e->speed_m_s), .from_rest = begin_m < 0 };
    if (journey.from_rest) {
        time_s += begin_m / journey.speed_m_s;
        journey.length_m = floor(left_m / gait->stride_m) * gait->stride_m;
        begin_m = 0;
    }
    struct journey_now now = journey_at(&journey, time_s);
    struct progress p = { .speed_m_s = now.speed_m_s, .gone_m = now.gone_m, .rest_s = now.rest_s,
                          .phase = gait_time(gait, gait->meet_m - journey.length_m, 0) / gait->duration_s };
    if (!repertoire->halts) p.aside_m = gait->meet_aside_m;
    if (begin_m + p.gone_m < 0) p.gone_m = -begin_m, p.speed_m_s = 0, p.waits = true;
    double at_m = fmin(begin_m + p.gone_m, length_m);
    p.s_m = back ? length_m - at_m : at_m;
    return p;
}

static bool walks(const struct entity *entity, const struct repertoire *repertoire, double speed_m_s)
{
    return entity->model->rig && class_info(entity->class_)->is_person && speed_m_s != 0 && repertoire_gait(repertoire, speed_m_s)->walks;
}

static bool add_entity(struct moment *moment, const struct stage *stage, size_t i, double time_s, struct error *err)
{
    const struct scene_entity *e = &stage->scene->entities[i];
    struct entity *entity = &moment->entities[moment->n];
    const struct repertoire *repertoire = &stage->repertoires[stage->cast[i]];
    struct vec2 p = stage->stand_m[i];
    double heading = e->heading_rad;
    struct progress progress = { 0 };
    struct posture posture = { 0 };
    *entity = scene_entity(stage, i);
    moment->model_index[moment->n] = stage->cast[i];
    bool walking = stage->courses[i] && walks(entity, repertoire, e->speed_m_s);
    /* Those who stand about do not all shift their weight at once. */
    if (!stage->courses[i] && repertoire->has[PACE_STAND]) progress.phase = fmod(0.618034 * (double)(i + 1), 1);
    if (stage->courses[i]) {
        const struct path *path = &stage->courses[i]->path;
        progress = walking ? walk_on(e, repertoire, path_length(path), time_s) : drive_on(e, path_length(path), time_s);
        struct path_point at = path_at(path, progress.s_m, e->offset_m);
        p = at.p_m;
        heading = at.heading_rad + (e->speed_m_s < 0 ? M_PI : 0);
    }
    if (entity->model->rig) {
        struct pace_now now = { .speed_m_s = progress.speed_m_s, .wish_m_s = stage->courses[i] ? e->speed_m_s : 0, .distance_m = progress.gone_m,
                                .phase = progress.phase, .time_s = time_s };
        posture = walking && !progress.waits ? repertoire_rest(repertoire, &now, progress.rest_s)
                                             : repertoire_posture(repertoire, &now, pace_stands(&now));
        p.x -= posture.share * progress.aside_m * cos(heading);
        p.y += posture.share * progress.aside_m * sin(heading);
    }
    if (!stand(entity, stage, p, heading, err)) {
        stage_fail(stage->scene, e->at_source, err);
        return error_prefix(err, "entity \"%s\": ", e->name);
    }
    moment->velocity_m_s[moment->n] = velocity(entity, progress.speed_m_s, heading);
    posture.parked = e->parked;
    if (!pose_entity(moment, &posture, err)) return false;
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
    struct posture posture = { 0 };
    if (entity->model->rig) posture = repertoire_posture(&stage->repertoires[model], &now, pace_stands(&now));
    if (!pose_entity(moment, &posture, err)) return false;
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

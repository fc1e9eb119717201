#include "gen/detail.h"

#include <math.h>

/* Half of a large vehicle: nearer than that to the picture, a part of it can be seen. */
#define REACH_M 5.0
#define MIDDLE_M 0.75 /* of a body, above the ground */
#define STEP_M 2.0    /* along roads */

const double detail_least_px_m[DETAIL_COUNT] = { [DETAIL_NEAR] = 50, [DETAIL_MIDDLE] = 15, [DETAIL_FAR] = 0 };

const char *detail_file(const struct scene_model *model, enum detail detail)
{
    int i = (int)detail;
    while (!model->files[i]) i--;
    return model->files[i];
}

/* Pixels that a metre at a point is long in a shot; 0 where the point is far beside the picture. */
static double metre_px(const struct scene *scene, const struct scene_shot *shot, struct vec3 p)
{
    const struct camera *camera = &scene->cameras[shot->camera].camera;
    struct pose camera_from_world = pose_inverse(shot->world_from_camera);
    struct vec3 at = pose_apply(camera_from_world, p);
    struct error ignored = ERROR_NONE;
    struct vec2 q, beside;
    double range = vec3_norm(at);
    if (range < 2 * REACH_M) return INFINITY;
    if (!camera_project(camera, &q, at, &ignored)) return 0;
    /* A metre across the line of sight, which every lens shows. */
    struct vec3 across = vec3_unit(vec3_cross(at, fabs(at.y) < fabs(at.x) ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    if (!camera_project(camera, &beside, vec3_add(at, across), &ignored)) return 0;
    double px = hypot(beside.x - q.x, beside.y - q.y), margin = REACH_M * px;
    bool inside = q.x > -margin && q.y > -margin && q.x < camera->width_px + margin && q.y < camera->height_px + margin;
    return inside ? px * scene->scale : 0;
}

static double most_px(const struct stage *stage, struct vec2 p)
{
    const struct scene *s = stage->scene;
    double z, most = 0;
    struct vec3 normal;
    if (!surface_at(&stage->surface, &z, &normal, p.x, p.y)) return 0;
    for (size_t i = 0; i < (s->fixed_camera ? 1 : s->shot_count); i++)
        most = fmax(most, metre_px(s, &s->shots[i], vec3(p.x, p.y, z + MIDDLE_M)));
    return most;
}

static double most_px_along(const struct stage *stage, const struct path *path, double offset_m)
{
    double most = 0, length = path_length(path);
    for (double s = 0; s < length + STEP_M; s += STEP_M) most = fmax(most, most_px(stage, path_at(path, s, offset_m).p_m));
    return most;
}

static double most_px_of_use(const struct stage *stage, enum road_use use)
{
    double most = 0;
    for (size_t i = 0; i < stage->roads.way_count; i++) {
        const struct way *way = &stage->roads.ways[i];
        for (size_t k = 0; k < way->lane_count; k++)
            if (way->lanes[k].use == use) most = fmax(most, most_px_along(stage, &way->path, way->lanes[k].offset_m));
    }
    return most;
}

static void need(enum detail *details, size_t model, double px_m)
{
    int detail = DETAIL_NEAR;
    while (px_m < detail_least_px_m[detail]) detail++;
    if (detail < (int)details[model]) details[model] = (enum detail)detail;
}

void details_choose(enum detail *details, const struct stage *stage)
{
    const struct scene *s = stage->scene;
    for (size_t i = 0; i < s->model_count; i++) details[i] = DETAIL_FAR;
    for (size_t i = 0; i < s->entity_count; i++) {
        const struct way *course = stage->courses[i];
        double px = course ? most_px_along(stage, &course->path, s->entities[i].offset_m) : most_px(stage, stage->stand_m[i]);
        need(details, stage->cast[i], px);
    }
    const struct scene_movers *const movers[] = { [ROAD_VEHICLES] = &s->vehicles, [ROAD_PEOPLE] = &s->people };
    for (int use = ROAD_VEHICLES; use <= ROAD_PEOPLE; use++) {
        if (!movers[use]->count) continue;
        double px = most_px_of_use(stage, (enum road_use)use);
        for (size_t k = 0; k < movers[use]->choice.count; k++) need(details, movers[use]->choice.models[k], px);
    }
}

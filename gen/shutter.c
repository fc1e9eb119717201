#include "gen/shutter.h"

#include "gen/trace/motion.h"

#include <stdlib.h>

/* Did one camera take both, the one on its way to the other? A new view is on nobody's way. */
static bool is_on_one_way(const struct scene_shot *a, const struct scene_shot *b)
{
    return a->camera == b->camera && a->time_s != b->time_s && a->photograph && b->photograph;
}

/* The shot that the camera comes to from this one, or came from. NULL: there is none, or it stays. */
static const struct scene_shot *neighbour(const struct scene *scene, const struct scene_shot *shot)
{
    const struct scene_shot *next = shot + 1, *last = scene->shots + scene->shot_count;
    if (scene->fixed_camera || !scene->has_times) return NULL;
    if (next < last && is_on_one_way(shot, next)) return next;
    return shot > scene->shots && is_on_one_way(shot, shot - 1) ? shot - 1 : NULL;
}

/* The camera when the shutter closes: on its way to the next shot, or on from the one before. */
static struct pose closing_pose(const struct scene *scene, const struct scene_shot *shot)
{
    const struct scene_shot *other = neighbour(scene, shot);
    struct pose here = shot->world_from_camera;
    if (!other) return here;
    struct pose there = other->world_from_camera;
    double t = scene->exposure_s / (other->time_s - shot->time_s);
    struct quat a = quat_from_mat3(here.rotation), b = quat_from_mat3(there.rotation);
    double sign = a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0 ? -1 : 1;
    struct quat q = { a.w + t * (sign * b.w - a.w), a.x + t * (sign * b.x - a.x), a.y + t * (sign * b.y - a.y),
                      a.z + t * (sign * b.z - a.z) };
    return (struct pose){ mat3_from_quat(q), vec3_add(here.translation, vec3_scale(vec3_sub(there.translation, here.translation), t)) };
}

bool shutter_motion(struct image *motion, const struct stage *stage, const struct scene_shot *shot,
                    const struct moment *moment, const struct trace_input *trace, const struct frame_labels *labels,
                    struct error *err)
{
    size_t n = moment->n;
    struct moment closing = { 0 };
    struct pose *poses = calloc(2 * n + 1, sizeof *poses);
    size_t *owner = calloc(n + 1, sizeof *owner);
    bool ok = (poses && owner) || error_set(err, ERR_MEMORY, "no memory for a frame");
    ok = ok && moment_at(&closing, stage, shot->time_s + stage->scene->exposure_s, err);
    for (size_t i = 0; ok && i < n; i++) {
        owner[i] = i;
        poses[i] = poses[n + i] = moment->entities[i].world_from_entity;
        for (size_t k = 0; k < closing.n; k++)
            if (closing.entities[k].id == moment->entities[i].id) poses[n + i] = closing.entities[k].world_from_entity;
    }
    struct motion_input move = { shot->world_from_camera, closing_pose(stage->scene, shot), poses, poses + n };
    ok = ok && motion_trace(motion, trace, owner, labels, &move, err);
    moment_release(&closing);
    free(poses);
    free(owner);
    return ok;
}

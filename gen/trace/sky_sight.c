#include "gen/trace/sky_sight.h"

#include "gen/trace/shape.h"
#include "gen/world/cut_rays.h"

#include <stdlib.h>

/* An entity in the sky's way. */
struct blocker {
    const struct shape *shape;
    struct shape *own;
    const struct receiver *receiver;
    struct pose entity_from_world;
    struct vec2 centre_m;   /* of a circle round the receiver */
    double radius_m;
    struct vec3 *direction; /* (directions) in entity coordinates */
};

struct sky_sight {
    struct sky_light *light; /* (n) */
    struct vec3 *direction;  /* (n) theirs */
    float *share, *past;     /* (n) room for one point's rays */
    size_t n;
    struct cut_rays *place; /* or NULL */
    struct blocker *blockers;
    size_t blocker_count;
};

bool sky_sight_create(struct sky_sight **sight, const struct light *light, size_t directions, const struct static_cut *place,
                      struct error *err)
{
    struct sky_sight *s = calloc(1, sizeof *s);
    if (s) {
        s->n = directions;
        s->light = calloc(directions + 1, sizeof *s->light);
        s->direction = calloc(directions + 1, sizeof *s->direction);
        s->share = calloc(directions + 1, sizeof *s->share);
        s->past = calloc(directions + 1, sizeof *s->past);
    }
    if (!s || !s->light || !s->direction || !s->share || !s->past) {
        sky_sight_destroy(s);
        return error_set(err, ERR_MEMORY, "no memory for the sky's directions");
    }
    if (place && place->triangles && !cut_rays_create(&s->place, place, err)) {
        sky_sight_destroy(s);
        return false;
    }
    light_sample_sky(s->light, directions, light);
    for (size_t i = 0; i < directions; i++) s->direction[i] = s->light[i].direction;
    *sight = s;
    return true;
}

bool sky_sight_add(struct sky_sight *s, const struct tracer *tracer, const struct entity *entity,
                   const struct receiver *receiver, struct error *err)
{
    struct blocker *grown = realloc(s->blockers, (s->blocker_count + 1) * sizeof *grown);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for what is in the sky's way");
    s->blockers = grown;
    struct blocker b = { .receiver = receiver, .entity_from_world = pose_inverse(entity->world_from_entity) };
    b.direction = calloc(s->n + 1, sizeof *b.direction);
    if (!b.direction) return error_set(err, ERR_MEMORY, "no memory for what is in the sky's way");
    if (!tracer_shape(&b.shape, &b.own, tracer, entity->model, err)) {
        free(b.direction);
        return false;
    }
    for (size_t i = 0; i < receiver->corners; i++) {
        b.centre_m.x += receiver->corner_m[i].x / (double)receiver->corners;
        b.centre_m.y += receiver->corner_m[i].y / (double)receiver->corners;
    }
    for (size_t i = 0; i < receiver->corners; i++)
        b.radius_m = fmax(b.radius_m, hypot(receiver->corner_m[i].x - b.centre_m.x, receiver->corner_m[i].y - b.centre_m.y));
    for (size_t i = 0; i < s->n; i++) b.direction[i] = mat3_apply(b.entity_from_world.rotation, s->direction[i]);
    s->blockers[s->blocker_count++] = b;
    return true;
}

void sky_sight_destroy(struct sky_sight *s)
{
    if (!s) return;
    for (size_t i = 0; i < s->blocker_count; i++) {
        shape_destroy(s->blockers[i].own);
        free(s->blockers[i].direction);
    }
    cut_rays_destroy(s->place);
    free(s->blockers);
    free(s->light);
    free(s->direction);
    free(s->share);
    free(s->past);
    free(s);
}

bool sky_sight_hidden(const struct sky_sight *s, struct vec3 p, struct vec3 eye)
{
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        if (!(receiver_share(b->receiver, p) > 0)) continue;
        struct vec3 towards = mat3_apply(b->entity_from_world.rotation, vec3_unit(vec3_sub(eye, p)));
        float passes = 1;
        shape_shade(b->shape, &passes, pose_apply(b->entity_from_world, p), &towards, 1);
        if (!(passes > 0)) return true;
    }
    return false;
}

static void gather(double rgb[3], const struct sky_sight *s, struct vec3 normal)
{
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (size_t i = 0; i < s->n; i++) {
        double weight = (double)s->share[i] * fmax(0, vec3_dot(s->direction[i], normal));
        for (int c = 0; c < 3; c++) rgb[c] += weight * s->light[i].color[c];
    }
}

double sky_sight_distance(const struct sky_sight *s, struct vec3 p)
{
    double nearest = INFINITY;
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        nearest = fmin(nearest, hypot(p.x - b->centre_m.x, p.y - b->centre_m.y) - b->radius_m);
    }
    return nearest;
}

struct sky_seen sky_sight_at(const struct sky_sight *s, struct vec3 p, struct vec3 normal)
{
    struct sky_seen seen;
    for (size_t i = 0; i < s->n; i++)
        s->share[i] = vec3_dot(s->direction[i], normal) > 0 && !(s->place && cut_rays_blocked(s->place, p, s->direction[i]));
    gather(seen.without, s, normal);
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        float most = (float)receiver_share(b->receiver, p);
        if (!(most > 0)) continue;
        for (size_t i = 0; i < s->n; i++) s->past[i] = s->share[i] > 0;
        shape_shade(b->shape, s->past, pose_apply(b->entity_from_world, p), b->direction, s->n);
        for (size_t i = 0; i < s->n; i++) s->share[i] *= 1 - most * (1 - s->past[i]);
    }
    gather(seen.with, s, normal);
    return seen;
}

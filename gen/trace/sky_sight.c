#include "gen/trace/sky_sight.h"

#include "gen/trace/exitance.h"
#include "gen/trace/shape.h"
#include "gen/world/cut_rays.h"
#include "lib/luminance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FAR_M 1e5
#define LOOK_M 0.5 /* so high above its foot what stands round an entity is looked for */

/* An entity in the sky's way. */
struct blocker {
    const struct shape *shape;
    struct shape *own;
    struct exitance *exitance; /* NULL: it sends nothing back */
    const struct receiver *receiver;
    struct pose entity_from_world;
    struct vec2 centre_m;   /* of a circle round the receiver */
    double radius_m;
    struct vec3 *direction; /* (rays) in entity coordinates */
    double (*color)[3];     /* (rays) what comes along them to its receiver */
    double share;           /* room for one point's: receiver_share */
};

struct sky_sight {
    struct sky_rays rays;
    struct sky_round round;
    struct entity_light lit; /* without a radiance around: entities send nothing back */
    float *open, *share, *past; /* (rays) room for one point's: past the place, past entities too, and past one of them */
    double (*color)[3];         /* (rays) and what comes along them */
    struct cut_rays *near; /* of the place; or NULL */
    struct blocker *blockers;
    size_t blocker_count;
};

bool sky_sight_create(struct sky_sight **sight, const struct sky_sight_input *in, struct error *err)
{
    size_t n = in->directions;
    struct sky_sight *s = calloc(1, sizeof *s);
    bool ok = s && (s->open = calloc(n + 1, sizeof *s->open)) && (s->share = calloc(n + 1, sizeof *s->share)) &&
              (s->past = calloc(n + 1, sizeof *s->past)) && (s->color = calloc(n + 1, sizeof *s->color));
    if (!ok) error_set(err, ERR_MEMORY, "no memory for the sky's directions");
    ok = ok && sky_rays_init(&s->rays, in->light, n, err) &&
         (!in->near || !in->near->triangles || cut_rays_create(&s->near, in->near, err));
    if (!ok) {
        sky_sight_destroy(s);
        return false;
    }
    s->round = in->round;
    s->lit = (struct entity_light){ in->light, in->round.radiance, s->near, in->sun_share };
    *sight = s;
    return true;
}

static void blocker_release(struct blocker *b)
{
    exitance_destroy(b->exitance);
    shape_destroy(b->own);
    free(b->direction);
    free(b->color);
}

static void enclose(struct blocker *b)
{
    const struct receiver *r = b->receiver;
    for (size_t i = 0; i < r->corners; i++) {
        b->centre_m.x += r->corner_m[i].x / (double)r->corners;
        b->centre_m.y += r->corner_m[i].y / (double)r->corners;
    }
    for (size_t i = 0; i < r->corners; i++)
        b->radius_m = fmax(b->radius_m, hypot(r->corner_m[i].x - b->centre_m.x, r->corner_m[i].y - b->centre_m.y));
}

bool sky_sight_add(struct sky_sight *s, const struct tracer *tracer, const struct entity *entity,
                   const struct receiver *receiver, struct error *err)
{
    size_t n = s->rays.n;
    struct blocker *grown = realloc(s->blockers, (s->blocker_count + 1) * sizeof *grown);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for what is in the sky's way");
    s->blockers = grown;
    struct blocker b = { .receiver = receiver, .entity_from_world = pose_inverse(entity->world_from_entity),
                         .direction = calloc(n + 1, sizeof *b.direction), .color = calloc(n + 1, sizeof *b.color) };
    bool ok = (b.direction && b.color) || error_set(err, ERR_MEMORY, "no memory for what is in the sky's way");
    ok = ok && tracer_shape(&b.shape, &b.own, tracer, entity->model, err) &&
         (!s->lit.around || exitance_create(&b.exitance, entity, b.shape, &s->lit, err));
    if (!ok) {
        blocker_release(&b);
        return false;
    }
    enclose(&b);
    for (size_t i = 0; i < n; i++) b.direction[i] = mat3_apply(b.entity_from_world.rotation, s->rays.direction[i]);
    sky_rays_round(b.color, &s->rays, &s->round, receiver, vec3_add(entity->world_from_entity.translation, vec3(0, 0, LOOK_M)));
    s->blockers[s->blocker_count++] = b;
    return true;
}

void sky_sight_destroy(struct sky_sight *s)
{
    if (!s) return;
    for (size_t i = 0; i < s->blocker_count; i++) blocker_release(&s->blockers[i]);
    free(s->blockers);
    cut_rays_destroy(s->near);
    sky_rays_release(&s->rays);
    free(s->open);
    free(s->share);
    free(s->past);
    free(s->color);
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

double sky_sight_distance(const struct sky_sight *s, struct vec3 p)
{
    double nearest = INFINITY;
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        nearest = fmin(nearest, hypot(p.x - b->centre_m.x, p.y - b->centre_m.y) - b->radius_m);
    }
    return nearest;
}

/* --- one point --- */

/* What comes along the rays to the receivers that a point lies in. */
static void mix_colors(const struct sky_sight *s, struct vec3 p)
{
    double all = 0;
    for (size_t k = 0; k < s->blocker_count; k++) all += s->blockers[k].share = receiver_share(s->blockers[k].receiver, p);
    if (!(all > 0)) {
        memcpy(s->color, s->rays.color, s->rays.n * sizeof *s->color);
        return;
    }
    memset(s->color, 0, s->rays.n * sizeof *s->color);
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        for (size_t i = 0; b->share > 0 && i < s->rays.n; i++)
            for (int c = 0; c < 3; c++) s->color[i][c] += b->share / all * b->color[i][c];
    }
}

static void gather(double rgb[3], const struct sky_sight *s, const float *share, struct vec3 normal)
{
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (size_t i = 0; i < s->rays.n; i++) {
        double weight = (double)share[i] * fmax(0, vec3_dot(s->rays.direction[i], normal));
        for (int c = 0; c < 3; c++) rgb[c] += weight * s->color[i][c];
    }
}

/* What a point receives with entities, of level ground's in the open. */
static double left_of(const struct sky_sight *s, const double sky[3], struct vec3 p, struct vec3 normal)
{
    const struct light *light = s->lit.light;
    double all[3] = { sky[0], sky[1], sky[2] };
    bool lit = light->has_sun && !(s->near && cut_rays_blocked(s->near, p, light->sun_direction)) &&
               !sky_sight_hidden(s, p, vec3_add(p, vec3_scale(light->sun_direction, FAR_M)));
    for (int c = 0; lit && c < 3; c++) all[c] += fmax(0, vec3_dot(normal, light->sun_direction)) * light->sun_color[c];
    return luminance_of(all) / luminance_of(light->irradiance);
}

/* Where a ray first meets an entity; NULL: nowhere */
static const struct blocker *meet(struct shape_point *first, const struct sky_sight *s, struct vec3 p, size_t ray)
{
    const struct blocker *nearest = NULL;
    struct shape_point point;
    first->range_m = INFINITY;
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        if (!(b->share > 0) || !shape_meet(b->shape, &point, pose_apply(b->entity_from_world, p), b->direction[ray]) ||
            point.range_m > first->range_m) continue;
        nearest = b;
        *first = point;
    }
    return nearest;
}

static void add_sent_back(double rgb[3], const struct sky_sight *s, struct vec3 p, struct vec3 normal)
{
    double left = left_of(s, rgb, p, normal), radiance[3];
    for (size_t i = 0; i < s->rays.n; i++) {
        struct shape_point point;
        double weight = (double)(s->open[i] - s->share[i]) * s->rays.solid_angle[i] * vec3_dot(s->rays.direction[i], normal);
        const struct blocker *b = weight > 0 ? meet(&point, s, p, i) : NULL;
        if (!b) continue;
        exitance_at(radiance, b->exitance, &point, b->direction[i], left);
        for (int c = 0; c < 3; c++) rgb[c] += weight * radiance[c];
    }
}

struct sky_seen sky_sight_at(const struct sky_sight *s, struct vec3 p, struct vec3 normal)
{
    struct sky_seen seen;
    for (size_t i = 0; i < s->rays.n; i++) {
        struct vec3 d = s->rays.direction[i];
        s->share[i] = s->open[i] = vec3_dot(d, normal) > 0 && !(s->near && cut_rays_blocked(s->near, p, d));
    }
    mix_colors(s, p);
    gather(seen.without, s, s->open, normal);
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        if (!(b->share > 0)) continue;
        for (size_t i = 0; i < s->rays.n; i++) s->past[i] = s->share[i] > 0;
        shape_shade(b->shape, s->past, pose_apply(b->entity_from_world, p), b->direction, s->rays.n);
        for (size_t i = 0; i < s->rays.n; i++) s->share[i] *= 1 - (float)b->share * (1 - s->past[i]);
    }
    gather(seen.with, s, s->share, normal);
    if (s->lit.around) add_sent_back(seen.with, s, p, normal);
    return seen;
}

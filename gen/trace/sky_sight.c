#include "gen/trace/sky_sight.h"

#include "gen/light/sky_image.h"
#include "gen/trace/exitance.h"
#include "gen/trace/shape.h"
#include "gen/world/cut_rays.h"
#include "lib/luminance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { UPWARD = 2 }; /* so many for each of the sky's rays */
#define ROUGH_M 0.5 /* so far the near place is taken for rough ground */
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
    struct vec3 *upward;    /* (upward) in entity coordinates */
    double share;           /* room for one point: its receiver_share, */
    struct vec3 from_m;     /* and the point in entity coordinates */
};

struct sky_sight {
    struct sky_rays rays;
    struct vec3 *upward; /* (upward_count) by their cosine with up: what entities send may come from where the sky has little light */
    size_t upward_count;
    struct sky_round round;
    double round_gain[3];
    const struct light *light;
    const struct sun_share *sun_share;
    bool *walled;               /* (rays) room for one point's: does the near place end them, farther than ROUGH_M, */
    float *share, *past;        /* what of their light comes past entities, and past one of them, */
    double (*color)[3];         /* and the light */
    struct cut_rays *near; /* of the place; or NULL */
    struct blocker *blockers;
    size_t blocker_count;
};

bool sky_sight_create(struct sky_sight **sight, const struct sky_sight_input *in, struct error *err)
{
    size_t n = in->directions;
    struct sky_sight *s = calloc(1, sizeof *s);
    bool ok = s && (s->upward = calloc(UPWARD * n + 1, sizeof *s->upward)) && (s->walled = calloc(n + 1, sizeof *s->walled)) &&
              (s->share = calloc(n + 1, sizeof *s->share)) && (s->past = calloc(n + 1, sizeof *s->past)) &&
              (s->color = calloc(n + 1, sizeof *s->color));
    if (!ok) error_set(err, ERR_MEMORY, "no memory for the sky's directions");
    ok = ok && sky_rays_init(&s->rays, in->light, n, err) &&
         (!in->near || !in->near->triangles || cut_rays_create(&s->near, in->near, err));
    if (!ok) {
        sky_sight_destroy(s);
        return false;
    }
    s->upward_count = UPWARD * n;
    for (size_t i = 0; i < s->upward_count; i++) s->upward[i] = cosine_direction(i, s->upward_count);
    s->round = in->round;
    sky_round_gain(s->round_gain, &s->rays, &s->round);
    s->light = in->light;
    s->sun_share = in->sun_share;
    *sight = s;
    return true;
}

static void blocker_release(struct blocker *b)
{
    exitance_destroy(b->exitance);
    shape_destroy(b->own);
    free(b->direction);
    free(b->color);
    free(b->upward);
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
                         .direction = calloc(n + 1, sizeof *b.direction), .color = calloc(n + 1, sizeof *b.color),
                         .upward = calloc(s->upward_count + 1, sizeof *b.upward) };
    bool ok = (b.direction && b.color && b.upward) || error_set(err, ERR_MEMORY, "no memory for what is in the sky's way");
    ok = ok && tracer_shape(&b.shape, &b.own, tracer, entity->model, err) &&
         (!s->round.radiance || exitance_create(&b.exitance, entity, &(struct entity_light){ s->light, s->round.radiance, s }, err));
    if (!ok) {
        blocker_release(&b);
        return false;
    }
    enclose(&b);
    for (size_t i = 0; i < n; i++) b.direction[i] = mat3_apply(b.entity_from_world.rotation, s->rays.direction[i]);
    for (size_t i = 0; i < s->upward_count; i++) b.upward[i] = mat3_apply(b.entity_from_world.rotation, s->upward[i]);
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
    free(s->upward);
    free(s->walled);
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

void sky_sight_shade(const struct sky_sight *s, float *share, struct vec3 p, const struct vec3 *directions, size_t n)
{
    enum { BATCH = 32 };
    struct vec3 turned[BATCH];
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        struct vec3 from = pose_apply(b->entity_from_world, p);
        for (size_t at = 0; at < n; at += BATCH) {
            size_t some = n - at < BATCH ? n - at : BATCH;
            for (size_t i = 0; i < some; i++) turned[i] = mat3_apply(b->entity_from_world.rotation, directions[at + i]);
            shape_shade(b->shape, share + at, from, turned, some);
        }
    }
}

double sky_sight_sun(const struct sky_sight *s, struct vec3 p)
{
    struct vec3 towards = s->light->sun_direction;
    float left = s->light->has_sun;
    sky_sight_shade(s, &left, p, &towards, 1);
    if (!(left > 0)) return 0;
    return (double)left * sun_share_past(s->sun_share, p, towards, s->near && cut_rays_blocked(s->near, p, towards, INFINITY));
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

/* What ends a point's rays near by brings what stands round there, if that is known; but for the ground itself, which a reconstruction
 * has rough: as it is smooth, what it hides tells nothing. */
static void meet_near(const struct sky_sight *s, struct vec3 p, struct vec3 normal)
{
    for (size_t i = 0; i < s->rays.n; i++) {
        struct vec3 d = s->rays.direction[i];
        bool up = vec3_dot(d, normal) > 0;
        bool ended = up && s->near && cut_rays_blocked(s->near, p, d, INFINITY);
        s->walled[i] = ended && s->round.radiance && !cut_rays_blocked(s->near, p, d, ROUGH_M);
        s->share[i] = up && (!ended || s->walled[i]);
        if (s->walled[i]) sky_ray_color(s->color[i], &s->rays, i, s->round.radiance);
    }
}

/* What comes along the rays to the receivers that a point lies in. */
static void mix_colors(const struct sky_sight *s, struct vec3 p)
{
    double all = 0;
    for (size_t k = 0; k < s->blocker_count; k++) {
        struct blocker *b = &s->blockers[k];
        b->from_m = pose_apply(b->entity_from_world, p);
        all += b->share = receiver_share(b->receiver, p);
    }
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

static void gather(double rgb[3], const struct sky_sight *s, struct vec3 normal)
{
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (size_t i = 0; i < s->rays.n; i++) {
        double weight = (double)s->share[i] * fmax(0, vec3_dot(s->rays.direction[i], normal));
        for (int c = 0; c < 3; c++) rgb[c] += weight * s->color[i][c];
    }
}

/* What a point receives with entities, of level ground's in the open. */
static double left_of(const struct sky_sight *s, const double sky[3], struct vec3 p, struct vec3 normal)
{
    const struct light *light = s->light;
    double all[3] = { sky[0], sky[1], sky[2] };
    double sun = light->has_sun ? fmax(0, vec3_dot(normal, light->sun_direction)) * sky_sight_sun(s, p) : 0;
    for (int c = 0; c < 3; c++) all[c] += sun * light->sun_color[c];
    return luminance_of(all) / luminance_of(light->irradiance);
}

/* The entity that an upward ray meets first, before the place does; NULL: none */
static const struct blocker *meet(struct shape_point *first, const struct sky_sight *s, struct vec3 p, size_t ray)
{
    const struct blocker *nearest = NULL;
    struct shape_point point;
    first->range_m = INFINITY;
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        if (!(b->share > 0) || !shape_meet(b->shape, &point, b->from_m, b->upward[ray]) ||
            point.range_m > first->range_m)
            continue;
        nearest = b;
        *first = point;
    }
    return nearest && s->near && cut_rays_blocked(s->near, p, s->upward[ray], first->range_m) ? NULL : nearest;
}

static void add_sent_back(double rgb[3], const struct sky_sight *s, struct vec3 p, struct vec3 normal)
{
    double left = left_of(s, rgb, p, normal), radiance[3];
    for (size_t i = 0; i < s->upward_count; i++) {
        struct shape_point point;
        double cosine = vec3_dot(s->upward[i], normal);
        const struct blocker *b = cosine > 0 ? meet(&point, s, p, i) : NULL;
        if (!b) continue;
        float past = 1;
        shape_shade(b->shape, &past, b->from_m, &b->upward[i], 1);
        double weight = b->share * (1 - (double)past) * cosine / s->upward[i].z / (double)s->upward_count;
        exitance_radiance(radiance, b->exitance, &point, b->upward[i], left);
        for (int c = 0; c < 3; c++) rgb[c] += weight * radiance[c];
    }
}

/* An entity takes nothing from rays that the place ends before it. */
static void spare_walled(const struct sky_sight *s, const struct blocker *b, struct vec3 p)
{
    struct shape_point point;
    for (size_t i = 0; i < s->rays.n; i++)
        if (s->walled[i] && s->past[i] < 1 && shape_meet(b->shape, &point, b->from_m, b->direction[i]) &&
            cut_rays_blocked(s->near, p, s->rays.direction[i], point.range_m))
            s->past[i] = 1;
}

struct sky_seen sky_sight_at(const struct sky_sight *s, struct vec3 p, struct vec3 normal)
{
    struct sky_seen seen;
    mix_colors(s, p);
    meet_near(s, p, normal);
    gather(seen.without, s, normal);
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        if (!(b->share > 0)) continue;
        for (size_t i = 0; i < s->rays.n; i++) s->past[i] = s->share[i] > 0;
        shape_shade(b->shape, s->past, b->from_m, b->direction, s->rays.n);
        spare_walled(s, b, p);
        for (size_t i = 0; i < s->rays.n; i++) s->share[i] *= 1 - (float)b->share * (1 - s->past[i]);
    }
    gather(seen.with, s, normal);
    if (s->round.radiance) add_sent_back(seen.with, s, p, normal);
    return seen;
}

/* --- what wet ground mirrors --- */

static void radiance_round(double rgb[3], const struct sky_sight *s, struct vec3 direction)
{
    if (!s->round.radiance) {
        light_sky_radiance(rgb, s->light, direction);
        return;
    }
    const float *radiance = sky_radiance(s->round.radiance, direction);
    for (int c = 0; c < 3; c++) rgb[c] = s->round_gain[c] * (double)radiance[c];
}

/* The entity that a ray from the point meets first, farther than range_m. */
static const struct blocker *meet_next(struct shape_point *next, const struct sky_sight *s, struct vec3 ray, double range_m)
{
    const struct blocker *nearest = NULL;
    for (size_t k = 0; k < s->blocker_count; k++) {
        const struct blocker *b = &s->blockers[k];
        struct shape_point point;
        if (!(b->share > 0) || !shape_meet(b->shape, &point, b->from_m, mat3_apply(b->entity_from_world.rotation, ray)) ||
            point.range_m <= range_m || (nearest && point.range_m >= next->range_m))
            continue;
        nearest = b;
        *next = point;
    }
    return nearest;
}

/* What comes along a ray past entities, and from them: the nearer before the farther. In: left  of the light on the ground there */
static void look_along(double rgb[3], const struct sky_sight *s, struct vec3 ray, double left)
{
    double passes = 1, behind[3];
    struct shape_point point = { .range_m = 0 };
    const struct blocker *b;
    radiance_round(behind, s, ray);
    rgb[0] = rgb[1] = rgb[2] = 0;
    while (passes > 0 && (b = meet_next(&point, s, ray, point.range_m))) {
        struct vec3 direction = mat3_apply(b->entity_from_world.rotation, ray);
        double own[3] = { 0, 0, 0 };
        float past = 1;
        shape_shade(b->shape, &past, b->from_m, &direction, 1);
        double stops = b->share * (1 - (double)past);
        if (b->exitance && stops > 0) exitance_radiance(own, b->exitance, &point, direction, left);
        for (int c = 0; c < 3; c++) rgb[c] += passes * stops * own[c];
        passes *= 1 - stops;
    }
    for (int c = 0; c < 3; c++) rgb[c] += passes * behind[c];
}

struct sky_seen sky_sight_mirrored(const struct sky_sight *s, const struct wet *wet, struct vec3 p, struct vec3 normal, struct vec3 eye,
                                   const double with[3])
{
    struct sky_seen seen = { { 0 }, { 0 } };
    struct wet_rays rays;
    double left = left_of(s, with, p, normal), rgb[3];
    wet_rays(&rays, wet, normal, vec3_unit(vec3_sub(eye, p)), WET_RAYS_MAX);
    for (size_t k = 0; k < s->blocker_count; k++) {
        s->blockers[k].from_m = pose_apply(s->blockers[k].entity_from_world, p);
        s->blockers[k].share = receiver_share(s->blockers[k].receiver, p);
    }
    for (size_t i = 0; i < rays.n; i++) {
        radiance_round(rgb, s, rays.direction[i]);
        for (int c = 0; c < 3; c++) seen.without[c] += rays.weight[i] * rgb[c];
        look_along(rgb, s, rays.direction[i], left);
        for (int c = 0; c < 3; c++) seen.with[c] += rays.weight[i] * rgb[c];
    }
    return seen;
}

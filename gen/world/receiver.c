#include "gen/world/receiver.h"

#include <stdlib.h>

enum { ROUND = 12, POINTS_MAX = 8 * (2 * ROUND + 1) };

/* A sun at the horizon casts shadows without end: beyond this they leave the scene. */
static const double shadow_max_m = 60;

static double turn(struct vec3 o, struct vec3 a, struct vec3 b)
{
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

static int by_x_then_y(const void *a, const void *b)
{
    const struct vec3 *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : (p->y > q->y) - (p->y < q->y);
}

/* Andrew's monotone chain. Out: hull (at most 2 n), counter-clockwise. */
static size_t convex_hull(struct vec3 *hull, struct vec3 *points, size_t n)
{
    qsort(points, n, sizeof *points, by_x_then_y);
    size_t k = 0;
    for (size_t i = 0; i < n; i++) {
        while (k >= 2 && turn(hull[k - 2], hull[k - 1], points[i]) <= 0) k--;
        hull[k++] = points[i];
    }
    for (size_t i = n - 1, lower = k + 1; i-- > 0;) {
        while (k >= lower && turn(hull[k - 2], hull[k - 1], points[i]) <= 0) k--;
        hull[k++] = points[i];
    }
    return k - 1;
}

/* Where an eye sees a corner mirrored in the ground, before it leaves the scene. */
static struct vec3 mirrored_at(struct vec3 corner, struct vec3 eye, const struct plane *ground)
{
    double high = vec3_dot(ground->normal, corner) - ground->offset_m, eye_high = vec3_dot(ground->normal, eye) - ground->offset_m;
    struct vec3 below = vec3_sub(eye, vec3_scale(ground->normal, 2 * eye_high)), way = vec3_sub(below, corner);
    double length = high > 0 && eye_high > 0 ? vec3_norm(way) * high / (high + eye_high) : 0;
    return vec3_add(corner, vec3_scale(vec3_unit(way), fmin(length, shadow_max_m)));
}

static void put_round(struct vec3 *points, size_t *n, struct vec3 middle, double radius_m)
{
    for (int k = 0; k < ROUND; k++) {
        double angle = 2 * M_PI * k / ROUND;
        points[(*n)++] = vec3_add(middle, vec3(radius_m * cos(angle), radius_m * sin(angle), 0));
    }
}

bool receiver_create(struct receiver *receiver, const struct entity *entity, const struct plane *ground,
                     const struct light *light, bool shaded, const struct vec3 *eye, struct error *err)
{
    struct vec3 corners[8], points[POINTS_MAX], hull[2 * POINTS_MAX];
    size_t n = 0;
    entity_corners(corners, entity);
    /* Where the sun shines, the sky's share of the light is small, and so is what is taken of it. */
    double reach = (light->has_sun && !shaded ? 1.6 : 3.2) * (entity->model->max_m.z - entity->model->min_m.z);
    for (int i = 0; i < 8; i++) {
        put_round(points, &n, corners[i], reach);
        if (eye) put_round(points, &n, mirrored_at(corners[i], *eye, ground), reach / 2); /* past where it fades */
        if (!light->has_sun) continue;
        struct vec3 away = vec3_scale(light->sun_direction, -1), foot;
        if (!plane_intersect(ground, &foot, corners[i], away)) continue;
        struct vec3 way = vec3_sub(foot, corners[i]);
        double length = vec3_norm(way);
        if (length > shadow_max_m) foot = vec3_add(corners[i], vec3_scale(way, shadow_max_m / length));
        points[n++] = vec3_add(foot, vec3_scale(vec3(way.x, way.y, 0), 0.3 / fmax(length, 1e-6)));
    }
    size_t corners_of_hull = convex_hull(hull, points, n);
    struct vec3 *kept = calloc(corners_of_hull, sizeof *kept);
    if (!kept) return error_set(err, ERR_MEMORY, "no memory for a receiver");
    for (size_t i = 0; i < corners_of_hull; i++)
        kept[i] = vec3(hull[i].x, hull[i].y, plane_height(ground, hull[i].x, hull[i].y));
    *receiver = (struct receiver){ kept, corners_of_hull, reach / 2 };
    return true;
}

void receiver_release(struct receiver *receiver)
{
    free(receiver->corner_m);
    *receiver = (struct receiver){ 0 };
}

bool receiver_contains(const struct receiver *receiver, struct vec3 p)
{
    for (size_t i = 0; i < receiver->corners; i++)
        if (turn(receiver->corner_m[i], receiver->corner_m[(i + 1) % receiver->corners], p) < 0) return false;
    return true;
}

double receiver_reach(const struct receiver *receiver, struct vec3 p, struct vec2 d)
{
    double reach = INFINITY;
    for (size_t i = 0; i < receiver->corners; i++) {
        struct vec3 a = receiver->corner_m[i], b = receiver->corner_m[(i + 1) % receiver->corners];
        double inside = turn(a, b, p), outwards = (b.y - a.y) * d.x - (b.x - a.x) * d.y;
        if (inside < 0) return 0;
        if (outwards > 0) reach = fmin(reach, inside / outwards);
    }
    return reach;
}

double receiver_share(const struct receiver *receiver, struct vec3 p)
{
    double inside = receiver->fade_m;
    for (size_t i = 0; i < receiver->corners && inside > 0; i++) {
        struct vec3 a = receiver->corner_m[i], b = receiver->corner_m[(i + 1) % receiver->corners];
        inside = fmin(inside, turn(a, b, p) / fmax(hypot(b.x - a.x, b.y - a.y), 1e-9));
    }
    double share = fmax(0, inside / receiver->fade_m);
    return share * share * (3 - 2 * share);
}

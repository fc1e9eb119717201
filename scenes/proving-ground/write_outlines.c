#include "write_outlines.h"

#include <stdlib.h>

/* One shot's outlines. */
struct outlining {
    FILE *f;
    const struct camera *camera;
    struct vec3 eye_m;
    struct pose camera_from_world;
    bool flat;     /* what stands on the sidewalk stands on the plane */
    int shot;      /* -1: the scene file has no shots */
    size_t written;
};

static bool project(const struct outlining *o, struct vec2 *q_px, struct vec3 p, struct error *err)
{
    return camera_project(o->camera, q_px, pose_apply(o->camera_from_world, p), err);
}

static bool inside(const struct outlining *o, struct vec2 q)
{
    return q.x >= 0 && q.x <= o->camera->width_px && q.y >= 0 && q.y <= o->camera->height_px;
}

static void put_outline(struct outlining *o, const char *name, const struct vec2 *q_px, size_t n, struct vec2 ground_px)
{
    if (!o->written++) fputs("occluders:\n", o->f);
    fprintf(o->f, "  - name: %s\n    polygon_px: [", name);
    for (size_t i = 0; i < n; i++) fprintf(o->f, "%s[%.2f, %.2f]", i ? ", " : "", q_px[i].x, q_px[i].y);
    fprintf(o->f, "]\n    ground_px: [%.2f, %.2f]\n", ground_px.x, ground_px.y);
    if (o->shot >= 0) fprintf(o->f, "    shot: %d\n", o->shot);
}

static int ascending(const void *a, const void *b)
{
    const struct vec2 *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : (p->y > q->y) - (p->y < q->y);
}

/* The convex hull, by Andrew's monotone chain. In/out: q (n), sorted. Out: hull (n + 1). Returns its number of points */
static size_t hull_of(struct vec2 *hull, struct vec2 *q, size_t n)
{
    size_t m = 0, floor = 2;
    qsort(q, n, sizeof *q, ascending);
    for (size_t i = 0; i < 2 * n - 1; i++) {
        struct vec2 p = q[i < n ? i : 2 * n - 2 - i];
        if (i == n) floor = m + 1;
        while (m >= floor && (hull[m - 1].x - hull[m - 2].x) * (p.y - hull[m - 2].y) <= (hull[m - 1].y - hull[m - 2].y) * (p.x - hull[m - 2].x)) m--;
        hull[m++] = p;
    }
    return m - 1;
}

/* The parked cars as their user would draw them: round body and roof, standing below their middle. */
static bool outline_parked(struct outlining *o, struct error *err)
{
    static const struct vec3 corner_m[] = { { 2.1, 0.82, 0.5 }, { 2.05, 0.8, 0.86 }, { 1.5, 0.82, 0.02 }, { 0.75, 0.7, 1.42 } };
    enum { CORNERS = 4 * sizeof corner_m / sizeof *corner_m };
    for (size_t i = 0; i < proving_parked_count; i++) {
        struct vec2 q[CORNERS], hull[CORNERS + 1], ground;
        size_t n = 0;
        while (n < CORNERS) {
            struct vec3 p = corner_m[n / 4];
            p = vec3_add(proving_parked_m[i], vec3(n % 2 ? p.x : n / 4 == 3 ? -p.x - 0.3 : -p.x, n / 2 % 2 ? p.y : -p.y, p.z));
            if (!project(o, &q[n], p, err)) return false;
            n++;
        }
        if (!project(o, &ground, proving_parked_m[i], err)) return false;
        if (inside(o, ground)) put_outline(o, "parked car", hull, hull_of(hull, q, n), ground);
    }
    return true;
}

enum { STEPS = 12 };
/* A straight rod, both its sides in steps, for a lens bends them. */
static bool outline_rod(struct outlining *o, struct vec3 from, struct vec3 to, double radius_m, struct vec2 ground_px, struct error *err)
{
    struct vec3 along = vec3_sub(to, from);
    struct vec3 aside = vec3_scale(vec3_unit(vec3_cross(vec3_sub(from, o->eye_m), along)), radius_m);
    struct vec2 q[2 * STEPS];
    for (int i = 0; i < 2 * STEPS; i++) {
        int step = i < STEPS ? i : 2 * STEPS - 1 - i;
        struct vec3 p = vec3_add(from, vec3_scale(along, (double)step / (STEPS - 1)));
        p = i < STEPS ? vec3_add(p, aside) : vec3_sub(p, aside);
        if (!project(o, &q[i], p, err)) return false;
    }
    put_outline(o, "lamp post", q, 2 * STEPS, ground_px);
    return true;
}

/* The lamp post as its user would draw it: both sides from the ground up, and where it stands; over a mesh its arm and its
 * head, too, which stand there as well. Its measures are street.inc's. */
static bool outline_post(struct outlining *o, struct error *err)
{
    struct vec3 foot = proving_post_m, top = vec3(foot.x, foot.y, PROVING_POST_HEIGHT_M);
    struct vec3 arm = vec3_add(top, vec3(0, 0, -0.05)), head = vec3_add(top, vec3(0, PROVING_POST_REACH_M, 0.08));
    struct vec2 ground, q[8], hull[9];
    if (!project(o, &ground, vec3(foot.x, foot.y, o->flat ? 0 : foot.z), err)) return false;
    if (!outline_rod(o, foot, top, PROVING_POST_RADIUS_M, ground, err)) return false;
    if (o->flat) return true;
    for (int i = 0; i < 8; i++)
        if (!project(o, &q[i], vec3_add(head, vec3(i & 1 ? 0.12 : -0.12, i & 2 ? 0.3 : -0.3, i & 4 ? 0.06 : -0.06)), err)) return false;
    if (!outline_rod(o, arm, vec3(arm.x, arm.y + PROVING_POST_REACH_M, arm.z + 0.15), 0.04, ground, err)) return false;
    put_outline(o, "lamp post", hull, hull_of(hull, q, 8), ground);
    return true;
}

/* From straight above a post hides nothing but what it stands on. */
static bool outlined(const struct outlining *o)
{
    struct error ignored = ERROR_NONE;
    struct vec2 foot;
    struct vec3 up = vec3_unit(vec3_sub(o->eye_m, proving_post_m));
    return up.z < sin(M_PI / 3) && project(o, &foot, proving_post_m, &ignored) && inside(o, foot);
}

bool write_outlines(FILE *f, const struct proving_case *c, const struct camera *camera, struct error *err)
{
    struct outlining o = { .f = f, .camera = camera, .flat = !c->has_mesh };
    for (size_t i = 0; i < c->shot_count; i++) {
        o.shot = c->has_mesh ? (int)i : -1;
        o.eye_m = c->shots[i].eye_m;
        o.camera_from_world = pose_inverse(proving_shot_pose(&c->shots[i]));
        if (outlined(&o) && !outline_post(&o, err)) return false;
        if (!c->flies && !outline_parked(&o, err)) return false;
    }
    return true;
}

#include "gen/world/sun_blockers.h"

#include "gen/light/light.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>

enum { SIDE = 60, THINGS = 40, RAYS = 60 };
static const double cell_m = 0.25;

static double uniform(void) { return rand() / (RAND_MAX + 1.0); }

/* Moeller and Trumbore 1997 */
static bool hits(struct vec3 from, struct vec3 d, struct vec3 a, struct vec3 b, struct vec3 c)
{
    struct vec3 ab = vec3_sub(b, a), ac = vec3_sub(c, a), p = vec3_cross(d, ac), t = vec3_sub(from, a), q = vec3_cross(t, ab);
    double det = vec3_dot(ab, p), u = vec3_dot(t, p) / det, v = vec3_dot(d, q) / det;
    return fabs(det) > 1e-12 && u >= 0 && v >= 0 && u + v <= 1 && vec3_dot(ac, q) / det > 0;
}

/* Somewhere on the sun's disc. */
static struct vec3 towards(struct vec3 sun)
{
    struct vec3 across = vec3_unit(vec3_cross(sun, vec3(0.3, -0.5, 0.8))), other = vec3_cross(sun, across);
    double angle = 2 * M_PI * uniform(), r = tan(SUN_RADIUS_RAD) * sqrt(uniform());
    return vec3_unit(vec3_add(sun, vec3_add(vec3_scale(across, r * cos(angle)), vec3_scale(other, r * sin(angle)))));
}

struct things { float position_m[3 * THINGS][3]; uint32_t triangle[THINGS][3]; };

/* Leaves in the air, and blades of grass. */
static void scatter(struct things *t)
{
    for (uint32_t i = 0; i < THINGS; i++) {
        struct vec3 at = vec3(15 * uniform(), 15 * uniform(), i % 2 ? 0 : 6 * uniform());
        for (uint32_t k = 0; k < 3; k++) {
            struct vec3 p = vec3_add(at, vec3(0.4 * uniform(), 0.4 * uniform(), 0.4 * uniform()));
            t->triangle[i][k] = 3 * i + k;
            t->position_m[3 * i + k][0] = (float)p.x;
            t->position_m[3 * i + k][1] = (float)p.y;
            t->position_m[3 * i + k][2] = (float)p.z;
        }
    }
}

static struct vec3 corner_of(const struct things *t, size_t i, int k)
{
    const float *p = t->position_m[t->triangle[i][k]];
    return vec3((double)p[0], (double)p[1], (double)p[2]);
}

static struct vec3 ground_at(int x, int y)
{
    return vec3(cell_m * x, cell_m * y, 0.3 * sin(0.4 * x) * cos(0.3 * y));
}

static void check(struct vec3 sun)
{
    struct error err = ERROR_NONE;
    struct sun_blockers *blockers = NULL;
    struct things things;
    struct vec3 points[(SIDE + 1) * (SIDE + 1)];
    size_t free_count = 0, wrong = 0, blocked = 0;
    scatter(&things);
    for (int i = 0; i < (SIDE + 1) * (SIDE + 1); i++) points[i] = ground_at(i % (SIDE + 1), i / (SIDE + 1));
    if (!OK(sun_blockers_create(&blockers, sun, points, sizeof points / sizeof *points, &err) &&
            sun_blockers_add(blockers, pose_identity(), things.position_m, 3 * THINGS, things.triangle, THINGS, &err), "things %s", err.text)) return;
    for (int i = 0; i < SIDE * SIDE; i++) {
        int x = i % SIDE, y = i / SIDE;
        struct vec3 corner[3] = { ground_at(x, y), ground_at(x + 1, y), ground_at(x, y + 1) };
        bool reach = sun_blockers_reach(blockers, corner), hit = false;
        for (int k = 0; k < RAYS && !hit; k++) {
            double u = uniform(), v = (1 - u) * uniform();
            struct vec3 from = vec3_add(corner[0], vec3_add(vec3_scale(vec3_sub(corner[1], corner[0]), u), vec3_scale(vec3_sub(corner[2], corner[0]), v)));
            struct vec3 d = towards(sun);
            for (size_t j = 0; j < THINGS && !hit; j++) hit = hits(from, d, corner_of(&things, j, 0), corner_of(&things, j, 1), corner_of(&things, j, 2));
        }
        free_count += !reach;
        blocked += hit;
        wrong += hit && !reach;
    }
    OK(wrong == 0, "sun at %.0f deg: nothing blocks where nothing is told to: %zu of %d", asin(sun.z) * 180 / M_PI, wrong, SIDE * SIDE);
    OK(blocked > 30 && free_count > (SIDE * SIDE - blocked) / 2, "of %d triangles %zu were seen blocked, %zu are told to be free", SIDE * SIDE, blocked, free_count);
    sun_blockers_destroy(blockers);
}

static void check_above(void)
{
    struct error err = ERROR_NONE;
    struct sun_blockers *blockers = NULL;
    const struct vec3 sun = vec3_unit(vec3(1, 0, 1)), points[] = { vec3(0, 0, 0), vec3(10, 10, 0) };
    const struct vec3 sheet[3] = { vec3(4, 4, 0), vec3(6, 4, 0), vec3(4, 6, 0) }, below[3] = { vec3(4.5, 4.5, 0), vec3(4.6, 4.5, 0), vec3(4.5, 4.6, 0) };
    const struct vec3 beside[3] = { vec3(8, 8, 0), vec3(8.1, 8, 0), vec3(8, 8.1, 0) }, far[3] = { vec3(0.1, 0.1, 0), vec3(0.2, 0.1, 0), vec3(0.1, 0.2, 0) };
    if (!OK(sun_blockers_create(&blockers, sun, points, 2, &err), "a sheet %s", err.text)) return;
    OK(!sun_blockers_reach(blockers, below), "without anything all is free");
    sun_blockers_add_above(blockers, sheet, 0.1);
    OK(sun_blockers_reach(blockers, below), "right above the ground it is in the way");
    OK(!sun_blockers_reach(blockers, beside), "but not beside");
    sun_blockers_add_above(blockers, sheet, 350);
    OK(sun_blockers_reach(blockers, beside), "unless it hangs so high that its penumbra is wide");
    OK(!sun_blockers_reach(blockers, far), "and that of the sun ends");
    sun_blockers_destroy(blockers);
}

int main(void)
{
    srand(3);
    check(vec3_unit(vec3(0.4, -0.3, 1.2)));
    check(vec3_unit(vec3(-0.8, 0.5, 0.25)));
    check(vec3(0, 0, 1));
    check_above();
    return tap_done();
}

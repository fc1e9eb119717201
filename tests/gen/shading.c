/* What of a place shades what: against a rule said in one line for each place. */
#include "gen/world/shading.h"
#include "tests/tap.h"

#include <stdint.h>

enum { SIDE = 41 };

/* A sheet of SIDE x SIDE points, 0.2 m apart, round (x, y) at z. */
static struct static_cut sheet(double x, double y, double z)
{
    struct static_cut cut = { .vertices = SIDE * SIDE, .position_m = calloc(SIDE * SIDE, sizeof *cut.position_m),
                              .triangle = calloc(2 * SIDE * SIDE, sizeof *cut.triangle) };
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        uint32_t column = i % SIDE, row = i / SIDE;
        cut.position_m[i][0] = (float)(x + 0.2 * (column - 20.0));
        cut.position_m[i][1] = (float)(y + 0.2 * (row - 20.0));
        cut.position_m[i][2] = (float)z;
        if (column + 1 == SIDE || row + 1 == SIDE) continue;
        const uint32_t two[2][3] = { { i, i + 1, i + SIDE + 1 }, { i, i + SIDE + 1, i + SIDE } };
        memcpy(cut.triangle[cut.triangles], two, sizeof two);
        cut.triangles += 2;
    }
    return cut;
}

/* Two cuts in one. */
static struct static_cut both(const struct static_cut *a, const struct static_cut *b)
{
    struct static_cut cut = { .vertices = a->vertices + b->vertices, .triangles = a->triangles + b->triangles };
    cut.position_m = calloc(cut.vertices, sizeof *cut.position_m);
    cut.triangle = calloc(cut.triangles, sizeof *cut.triangle);
    memcpy(cut.position_m, a->position_m, a->vertices * sizeof *a->position_m);
    memcpy(cut.position_m + a->vertices, b->position_m, b->vertices * sizeof *b->position_m);
    memcpy(cut.triangle, a->triangle, a->triangles * sizeof *a->triangle);
    for (size_t i = 0; i < b->triangles; i++)
        for (int k = 0; k < 3; k++) cut.triangle[a->triangles + i][k] = b->triangle[i][k] + (uint32_t)a->vertices;
    return cut;
}

static struct vec3 middle_of(const struct static_cut *cut, size_t i)
{
    struct vec3 sum = { 0, 0, 0 };
    for (int k = 0; k < 3; k++) {
        const float *p = cut->position_m[cut->triangle[i][k]];
        sum = vec3_add(sum, vec3_scale(vec3((double)p[0], (double)p[1], (double)p[2]), 1.0 / 3));
    }
    return sum;
}

/* A roof 5 m over the ground, ground and roof 8 m square, and a light 45 degrees high in the east:
 * of the roof, what lies west of x = 4 + 5 + a ring shades. */
static void roofs(void)
{
    struct static_cut ground = sheet(0, 0, 0), roof = sheet(7, 0, 5), cut = both(&ground, &roof), shading = { 0 }, rest = { 0 };
    struct error err = ERROR_NONE;
    struct vec3 east = vec3_unit(vec3(1, 0, 1));
    bool ok = shading_part(&shading, &rest, &cut, &ground, &east, 1, &err);
    OK(ok && shading.triangles + rest.triangles == cut.triangles, "every triangle is in one of the parts");
    bool none = true, all = true;
    for (size_t i = 0; i < shading.triangles; i++) {
        struct vec3 p = middle_of(&shading, i);
        none = none && p.z > 4 && p.x < 9 + 0.5;
    }
    for (size_t i = 0; i < rest.triangles; i++) {
        struct vec3 p = middle_of(&rest, i);
        all = all && (p.z < 1 || p.x > 9);
    }
    OK(none, "level ground shades nothing, and of a roof does what the light comes past");
    OK(all, "all that shades is found");
    static_cut_release(&shading);
    static_cut_release(&rest);
    struct vec3 west = vec3_unit(vec3(-1, 0, 1));
    ok = shading_part(&shading, &rest, &cut, &ground, &west, 1, &err);
    OK(ok && shading.triangles == 0, "a roof whose shadow falls beside the ground does not shade it");
    static_cut_release(&shading);
    static_cut_release(&rest);
    struct vec3 two[] = { west, vec3(0, 0, 1) };
    ok = shading_part(&shading, &rest, &cut, &ground, two, 2, &err);
    bool over = ok && shading.triangles > 0;
    for (size_t i = 0; i < shading.triangles; i++) over = over && middle_of(&shading, i).x < 4 + 0.5;
    OK(over, "one light of several is enough");
    static_cut_release(&shading);
    static_cut_release(&rest);
    static_cut_release(&ground);
    static_cut_release(&roof);
    static_cut_release(&cut);
}

/* None of its corners lies over the ground. */
static void large_triangles(void)
{
    float corner[3][3] = { { -100, -100, 5 }, { 100, -100, 5 }, { 0, 200, 5 } };
    uint32_t triangle[1][3] = { { 0, 1, 2 } };
    struct static_cut ground = sheet(0, 0, 0), cut = { .position_m = corner, .triangle = triangle, .vertices = 3, .triangles = 1 },
                      shading = { 0 }, rest = { 0 }, nothing = { 0 };
    struct error err = ERROR_NONE;
    struct vec3 up = vec3(0, 0, 1);
    OK(shading_part(&shading, &rest, &cut, &ground, &up, 1, &err) && shading.triangles == 1,
       "a triangle larger than the ground below its middle shades it");
    static_cut_release(&shading);
    static_cut_release(&rest);
    OK(shading_part(&shading, &rest, &nothing, &nothing, &up, 1, &err) && shading.triangles == 0 && rest.triangles == 0,
       "nothing has no parts");
    static_cut_release(&shading);
    static_cut_release(&rest);
    static_cut_release(&ground);
}

int main(void)
{
    roofs();
    large_triangles();
    return tap_done();
}

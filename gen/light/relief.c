#include "gen/light/relief.h"

#include "gen/light/orthophoto.h"
#include "gen/world/prism.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A step of 1.4 degrees is half a metre at 20 m: mirrors on a car are no flatter than that. */
enum { COLUMNS = 256, ABOVE = COLUMNS / 4, BELOW = ABOVE / 3, ROWS = ABOVE + BELOW };
_Static_assert(3 * BELOW <= ABOVE, "as low as the panorama has a picture");
#define GAP 1.5           /* farther apart than this, as a ratio of ranges, two neighbours are two things */

static struct vec3 direction_of(int column, int row)
{
    double turn = 2 * M_PI * column / COLUMNS, elevation = (row - BELOW) * 2 * M_PI / COLUMNS;
    return vec3(cos(elevation) * cos(turn), cos(elevation) * sin(turn), sin(elevation));
}

/* What a direction shows. */
enum shown { NOTHING, THING, GROUND, KNOWN_GROUND };

static bool is_ground(const struct relief_input *in, const struct static_hit *hit, struct vec3 p)
{
    if (p.z > in->from_m.z || fabs(static_mesh_normal(in->place, hit->triangle).z) < RELIEF_LEVEL) return false;
    for (size_t i = 0; i < in->n; i++) {
        struct vec3 away = vec3_sub(p, in->entities[i].world_from_entity.translation);
        if (hypot(away.x, away.y) < orthophoto_whole(&in->entities[i])) return true;
    }
    return false;
}

static enum shown shown_at(const struct relief_input *in, const struct static_hit *hit, struct vec3 p)
{
    if (!isfinite(hit->range_m)) return NOTHING;
    if (!is_ground(in, hit, p)) return THING;
    for (size_t i = 0; i < in->known_count; i++)
        if (prism_contains(&in->known[i], p)) return KNOWN_GROUND;
    return GROUND;
}

/* The points of a row of directions; a direction's has the number of the direction. */
static void meet_row(struct relief *relief, uint8_t *shown, const struct relief_input *in, int row)
{
    struct vec3 direction[COLUMNS];
    struct static_hit hit[COLUMNS];
    for (int i = 0; i < COLUMNS; i++) direction[i] = direction_of(i, row);
    static_mesh_hits(in->place, hit, in->from_m, direction, COLUMNS);
    for (int i = 0; i < COLUMNS; i++) {
        struct vec3 p = isfinite(hit[i].range_m) ? vec3_add(in->from_m, vec3_scale(direction[i], hit[i].range_m)) : in->from_m;
        shown[i] = (uint8_t)shown_at(in, &hit[i], p);
        relief->point_m[row * COLUMNS + i] = p;
    }
}

static void add_face(struct relief *relief, const uint8_t *shown, struct vec3 from, int a, int b, int c)
{
    uint32_t corner[3] = { (uint32_t)a, (uint32_t)b, (uint32_t)c };
    double near = INFINITY, far = 0;
    size_t ground = 0, known = 0;
    for (int i = 0; i < 3; i++) {
        if (shown[corner[i]] == NOTHING) return;
        ground += shown[corner[i]] != THING;
        known += shown[corner[i]] == KNOWN_GROUND;
        double range = vec3_norm(vec3_sub(relief->point_m[corner[i]], from));
        near = fmin(near, range);
        far = fmax(far, range);
    }
    if (known == 3 || (far > GAP * near && ground < 3)) return;
    memcpy(ground == 3 ? relief->ground[relief->grounds++] : relief->triangle[relief->triangles++], corner, sizeof corner);
}

bool relief_create(struct relief *relief, const struct relief_input *in, struct error *err)
{
    size_t points = (size_t)ROWS * COLUMNS;
    struct relief out = { .point_m = calloc(points, sizeof *out.point_m), .points = points,
                          .triangle = calloc(2 * points, sizeof *out.triangle), .ground = calloc(2 * points, sizeof *out.ground) };
    uint8_t *shown = calloc(points, sizeof *shown);
    *relief = (struct relief){ 0 };
    if (!out.point_m || !out.triangle || !out.ground || !shown) {
        free(shown);
        relief_release(&out);
        return error_set(err, ERR_MEMORY, "no memory for what mirrors show of the place");
    }
    for (int row = 0; row < ROWS; row++) meet_row(&out, shown + row * COLUMNS, in, row);
    for (int row = 0; row + 1 < ROWS; row++)
        for (int i = 0; i < COLUMNS; i++) {
            int a = row * COLUMNS + i, b = row * COLUMNS + (i + 1) % COLUMNS;
            add_face(&out, shown, in->from_m, a, b, b + COLUMNS);
            add_face(&out, shown, in->from_m, a, b + COLUMNS, a + COLUMNS);
        }
    free(shown);
    *relief = out;
    return true;
}

void relief_release(struct relief *relief)
{
    free(relief->point_m);
    free(relief->triangle);
    free(relief->ground);
    *relief = (struct relief){ 0 };
}

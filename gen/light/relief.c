#include "gen/light/relief.h"

#include <math.h>
#include <stdlib.h>

/* A step of 1.4 degrees is half a metre at 20 m: mirrors on a car are no flatter than that. */
enum { COLUMNS = 256, ABOVE = COLUMNS / 4, BELOW = ABOVE / 3, ROWS = ABOVE + BELOW };
_Static_assert(3 * BELOW <= ABOVE, "as low as the panorama has a picture");
#define GAP 1.5           /* farther apart than this, as a ratio of ranges, two neighbours are two things */
#define NOWHERE UINT32_MAX

static struct vec3 direction_of(int column, int row)
{
    double turn = 2 * M_PI * column / COLUMNS, elevation = (row - BELOW) * 2 * M_PI / COLUMNS;
    return vec3(cos(elevation) * cos(turn), cos(elevation) * sin(turn), sin(elevation));
}

/* Ground that is known better than by a look along it. */
static bool is_near_ground(const struct relief_input *in, const struct static_hit *hit, struct vec3 p)
{
    return p.z < in->from_m.z && p.x > in->low_m.x && p.x < in->high_m.x && p.y > in->low_m.y && p.y < in->high_m.y &&
           fabs(static_mesh_normal(in->place, hit->triangle).z) > RELIEF_LEVEL;
}

/* The points of a row of directions, and which point each direction has. */
static void meet_row(struct relief *relief, uint32_t *index, const struct relief_input *in, int row)
{
    struct vec3 direction[COLUMNS];
    struct static_hit hit[COLUMNS];
    for (int i = 0; i < COLUMNS; i++) direction[i] = direction_of(i, row);
    static_mesh_hits(in->place, hit, in->from_m, direction, COLUMNS);
    for (int i = 0; i < COLUMNS; i++) {
        struct vec3 p = vec3_add(in->from_m, vec3_scale(direction[i], hit[i].range_m));
        bool counts = isfinite(hit[i].range_m) && !is_near_ground(in, &hit[i], p);
        index[i] = counts ? (uint32_t)relief->points : NOWHERE;
        if (counts) relief->point_m[relief->points++] = p;
    }
}

static void add_face(struct relief *relief, struct vec3 from, uint32_t a, uint32_t b, uint32_t c)
{
    if (a == NOWHERE || b == NOWHERE || c == NOWHERE) return;
    uint32_t corner[3] = { a, b, c };
    double near = INFINITY, far = 0;
    for (int i = 0; i < 3; i++) {
        double range = vec3_norm(vec3_sub(relief->point_m[corner[i]], from));
        near = fmin(near, range);
        far = fmax(far, range);
    }
    if (far > GAP * near) return;
    for (int i = 0; i < 3; i++) relief->triangle[relief->triangles][i] = corner[i];
    relief->triangles++;
}

bool relief_create(struct relief *relief, const struct relief_input *in, struct error *err)
{
    struct relief out = { .point_m = calloc((size_t)ROWS * COLUMNS, sizeof *out.point_m),
                          .triangle = calloc((size_t)2 * ROWS * COLUMNS, sizeof *out.triangle) };
    uint32_t (*index)[COLUMNS] = calloc(ROWS, sizeof *index);
    *relief = (struct relief){ 0 };
    if (!out.point_m || !out.triangle || !index) {
        free(index);
        relief_release(&out);
        return error_set(err, ERR_MEMORY, "no memory for what mirrors show of the place");
    }
    for (int row = 0; row < ROWS; row++) meet_row(&out, index[row], in, row);
    for (int row = 0; row + 1 < ROWS; row++)
        for (int i = 0; i < COLUMNS; i++) {
            int next = (i + 1) % COLUMNS;
            add_face(&out, in->from_m, index[row][i], index[row][next], index[row + 1][next]);
            add_face(&out, in->from_m, index[row][i], index[row + 1][next], index[row + 1][i]);
        }
    free(index);
    *relief = out;
    return true;
}

void relief_release(struct relief *relief)
{
    free(relief->point_m);
    free(relief->triangle);
    *relief = (struct relief){ 0 };
}

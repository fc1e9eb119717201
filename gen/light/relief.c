#include "gen/light/relief.h"

#include "gen/light/orthophoto.h"
#include "gen/world/prism.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A step of 1.4 degrees is half a metre at 20 m: mirrors on a car are no flatter than that. */
enum { COLUMNS = 256, ABOVE = COLUMNS / 4, BELOW = ABOVE / 3, ROWS = ABOVE + BELOW };
_Static_assert(3 * BELOW <= ABOVE, "as low as the panorama has a picture");
#define CELL_M 0.5        /* of the ground's lattice, while it has no more points than this, 1 km by 1 km: */
#define POINTS_MAX 4e6
#define STEEPEST 0.3      /* of what neighbours on the ground rise, as a share of how far apart they are */
#define HEADROOM_M 1.0    /* over the ground: what hangs higher leaves it ground */
/* Two neighbours are one thing where their ranges differ by no more than this ratio, or where each lies on the other's surface: */
#define GAP 1.1
#define OFF_SURFACE 0.15  /* no farther off it than this share of the distance between them */

static struct vec3 direction_of(int column, int row)
{
    double turn = 2 * M_PI * column / COLUMNS, elevation = (row - BELOW) * 2 * M_PI / COLUMNS;
    return vec3(cos(elevation) * cos(turn), cos(elevation) * sin(turn), sin(elevation));
}

/* What a direction shows: ground has its orthophoto, a floor is level ground farther away. */
enum shown { NOTHING, THING, FLOOR, GROUND };

static bool is_level(const struct static_mesh *place, const struct static_hit *hit)
{
    return fabs(static_mesh_normal(place, hit->triangle).z) > RELIEF_LEVEL;
}

/* --- the ground's lattice --- */

/* Points of the world's own, so that an entity that moves leaves the ground as it is; and which entity is nearest to each, of
 * those that have their orthophoto there. */
struct lattice { double cell_m; int x0, y0, columns, rows, *owner, *number; size_t owned; /* number: of the owned, in their order */ };

static void measure(struct lattice *l, const double low[2], const double high[2])
{
    l->x0 = (int)floor(low[0] / l->cell_m);
    l->y0 = (int)floor(low[1] / l->cell_m);
    l->columns = (int)ceil(high[0] / l->cell_m) - l->x0 + 1;
    l->rows = (int)ceil(high[1] / l->cell_m) - l->y0 + 1;
}

static double away_of(const struct entity *e, double x, double y)
{
    return hypot(x - e->world_from_entity.translation.x, y - e->world_from_entity.translation.y);
}

static void own(struct lattice *l, const struct relief_input *in, int entity)
{
    const struct entity *e = &in->entities[entity];
    double reach = orthophoto_whole(e);
    struct vec3 at = e->world_from_entity.translation;
    for (int y = (int)ceil((at.y - reach) / l->cell_m); y <= (int)floor((at.y + reach) / l->cell_m); y++)
        for (int x = (int)ceil((at.x - reach) / l->cell_m); x <= (int)floor((at.x + reach) / l->cell_m); x++) {
            double away = away_of(e, x * l->cell_m, y * l->cell_m);
            int *owner = &l->owner[(y - l->y0) * l->columns + x - l->x0];
            if (away <= reach && (*owner < 0 || away < away_of(&in->entities[*owner], x * l->cell_m, y * l->cell_m))) *owner = entity;
        }
}

static bool lattice_init(struct lattice *l, const struct relief_input *in)
{
    double low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    *l = (struct lattice){ .cell_m = CELL_M };
    for (size_t i = 0; i < in->n; i++) {
        struct vec3 at = in->entities[i].world_from_entity.translation;
        double reach = orthophoto_whole(&in->entities[i]), p[2] = { at.x, at.y };
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], p[k] - reach);
            high[k] = fmax(high[k], p[k] + reach);
        }
    }
    while (in->n && (high[0] - low[0]) * (high[1] - low[1]) > POINTS_MAX * l->cell_m * l->cell_m) l->cell_m *= 2;
    if (in->n) measure(l, low, high);
    int n = l->columns * l->rows;
    l->owner = malloc(((size_t)n + 1) * sizeof *l->owner);
    l->number = calloc((size_t)n + 1, sizeof *l->number);
    if (!l->owner || !l->number) return false;
    for (int i = 0; i < n; i++) l->owner[i] = -1;
    for (size_t i = 0; i < in->n; i++) own(l, in, (int)i);
    for (int i = 0; i < n; i++)
        if (l->owner[i] >= 0) l->number[i] = (int)l->owned++;
    return true;
}

/* What lies higher is no ground. */
static double ground_top(const struct relief_input *in, const struct lattice *l, int i)
{
    return in->entities[l->owner[i]].world_from_entity.translation.z + HEADROOM_M;
}

static bool has_orthophoto(const struct relief_input *in, const struct lattice *l, struct vec3 p)
{
    int column = (int)floor(p.x / l->cell_m + 0.5) - l->x0, row = (int)floor(p.y / l->cell_m + 0.5) - l->y0;
    int i = row * l->columns + column;
    return column >= 0 && row >= 0 && column < l->columns && row < l->rows && l->owner[i] >= 0 && p.z < ground_top(in, l, i);
}

static bool is_gentle(struct vec3 a, struct vec3 b)
{
    return fabs(a.z - b.z) <= STEEPEST * hypot(a.x - b.x, a.y - b.y);
}

/* --- what is seen --- */

static enum shown shown_at(const struct relief_input *in, const struct lattice *l, const struct static_hit *hit, struct vec3 p)
{
    if (!isfinite(hit->range_m)) return NOTHING;
    if (p.z > in->from_m.z || !is_level(in->place, hit)) return THING;
    return has_orthophoto(in, l, p) ? GROUND : FLOOR;
}

/* The points of a row of directions; a direction's has the number of the direction. */
static void meet_row(struct relief_part *seen, struct vec3 *normal, uint8_t *shown, const struct relief_input *in, const struct lattice *l, int row)
{
    struct vec3 direction[COLUMNS];
    struct static_hit hit[COLUMNS];
    for (int i = 0; i < COLUMNS; i++) direction[i] = direction_of(i, row);
    static_mesh_hits(in->place, hit, in->from_m, direction, COLUMNS);
    for (int i = 0; i < COLUMNS; i++) {
        struct vec3 p = isfinite(hit[i].range_m) ? vec3_add(in->from_m, vec3_scale(direction[i], hit[i].range_m)) : vec3(0, 0, 0);
        shown[i] = (uint8_t)shown_at(in, l, &hit[i], p);
        normal[i] = isfinite(hit[i].range_m) ? static_mesh_normal(in->place, hit[i].triangle) : vec3(0, 0, 0);
        seen->point_m[row * COLUMNS + i] = p;
    }
}

static void add_face(struct relief_part *part, int a, int b, int c)
{
    memcpy(part->triangle[part->triangles++], (uint32_t[]){ (uint32_t)a, (uint32_t)b, (uint32_t)c }, sizeof *part->triangle);
}

static bool on_surface(const struct vec3 *point, const struct vec3 *normal, int a, int b)
{
    struct vec3 way = vec3_sub(point[b], point[a]);
    double off = OFF_SURFACE * vec3_norm(way);
    return fabs(vec3_dot(way, normal[a])) <= off && fabs(vec3_dot(way, normal[b])) <= off;
}

static void add_seen(struct relief_part *seen, const struct vec3 *normal, const uint8_t *shown, struct vec3 from, int a, int b, int c)
{
    const int corner[] = { a, b, c };
    double near = INFINITY, far = 0;
    int ground = 0, level = 0;
    for (int i = 0; i < 3; i++) {
        if (shown[corner[i]] == NOTHING) return;
        ground += shown[corner[i]] == GROUND;
        level += shown[corner[i]] != THING;
        double range = vec3_norm(vec3_sub(seen->point_m[corner[i]], from));
        near = fmin(near, range);
        far = fmax(far, range);
    }
    const struct vec3 *p = seen->point_m;
    /* Along the ground, neighbours lie far apart. */
    bool floor = level == 3 && is_gentle(p[a], p[b]) && is_gentle(p[b], p[c]) && is_gentle(p[c], p[a]);
    bool one = on_surface(p, normal, a, b) && on_surface(p, normal, b, c) && on_surface(p, normal, c, a);
    if (ground < 3 && (floor || one || far <= GAP * near)) add_face(seen, a, b, c);
}

static bool part_init(struct relief_part *part, size_t points)
{
    *part = (struct relief_part){ .point_m = calloc(points + 1, sizeof *part->point_m), .points = points,
                                  .triangle = calloc(2 * points + 1, sizeof *part->triangle) };
    return part->point_m && part->triangle;
}

static bool see(struct relief_part *seen, const struct relief_input *in, const struct lattice *l)
{
    uint8_t *shown = calloc((size_t)ROWS * COLUMNS, sizeof *shown);
    struct vec3 *normal = calloc((size_t)ROWS * COLUMNS, sizeof *normal);
    bool ok = part_init(seen, (size_t)ROWS * COLUMNS) && shown && normal;
    for (int row = 0; ok && row < ROWS; row++) meet_row(seen, normal + row * COLUMNS, shown + row * COLUMNS, in, l, row);
    for (int row = 0; ok && row + 1 < ROWS; row++)
        for (int i = 0; i < COLUMNS; i++) {
            int a = row * COLUMNS + i, b = row * COLUMNS + (i + 1) % COLUMNS;
            add_seen(seen, normal, shown, in->from_m, a, b, b + COLUMNS);
            add_seen(seen, normal, shown, in->from_m, a, b + COLUMNS, a + COLUMNS);
        }
    free(normal);
    free(shown);
    return ok;
}

/* --- the ground --- */

/* The level ground below a point and what hangs over it. */
static bool ground_below(struct vec3 *p, const struct relief_input *in, const struct lattice *l, int i)
{
    struct static_hit hit;
    struct vec3 down = vec3(0, 0, -1);
    struct vec3 from = vec3((l->x0 + i % l->columns) * l->cell_m, (l->y0 + i / l->columns) * l->cell_m, ground_top(in, l, i));
    static_mesh_hits(in->place, &hit, from, &down, 1);
    if (!isfinite(hit.range_m)) return false;
    *p = vec3(from.x, from.y, from.z - hit.range_m);
    return is_level(in->place, &hit);
}

/* A cell of which all corners are ground, none a step above the next, and not all are known. In: there (l->owned) */
static void add_cell(struct relief_part *ground, const struct relief_input *in, const struct lattice *l, const bool *there, const int corner[4])
{
    int known = 0, k[4];
    for (int i = 0; i < 4; i++) {
        if (l->owner[corner[i]] < 0 || !there[l->number[corner[i]]]) return;
        k[i] = l->number[corner[i]];
        known += in->known && prism_contains(&in->known[l->owner[corner[i]]], ground->point_m[k[i]]);
    }
    const struct vec3 *p = ground->point_m;
    bool gentle = is_gentle(p[k[0]], p[k[1]]) && is_gentle(p[k[1]], p[k[2]]) && is_gentle(p[k[2]], p[k[3]]) && is_gentle(p[k[3]], p[k[0]]);
    if (known == 4 || !gentle) return;
    add_face(ground, k[0], k[1], k[2]);
    add_face(ground, k[0], k[2], k[3]);
}

static bool lay_ground(struct relief_part *ground, const struct relief_input *in, const struct lattice *l)
{
    bool *there = calloc(l->owned + 1, sizeof *there), ok = part_init(ground, l->owned) && there;
    for (int i = 0; ok && i < l->columns * l->rows; i++)
        if (l->owner[i] >= 0) there[l->number[i]] = ground_below(&ground->point_m[l->number[i]], in, l, i);
    for (int y = 0; ok && y + 1 < l->rows; y++)
        for (int x = 0; x + 1 < l->columns; x++) {
            int a = y * l->columns + x;
            add_cell(ground, in, l, there, (const int[]){ a, a + 1, a + 1 + l->columns, a + l->columns });
        }
    free(there);
    return ok;
}

bool relief_create(struct relief *relief, const struct relief_input *in, struct error *err)
{
    struct relief out = { 0 };
    struct lattice lattice;
    bool ok = lattice_init(&lattice, in) && see(&out.seen, in, &lattice) && lay_ground(&out.ground, in, &lattice);
    free(lattice.owner);
    free(lattice.number);
    *relief = (struct relief){ 0 };
    if (ok) *relief = out;
    else relief_release(&out);
    return ok || error_set(err, ERR_MEMORY, "no memory for what mirrors show of the place");
}

void relief_release(struct relief *relief)
{
    free(relief->seen.point_m);
    free(relief->seen.triangle);
    free(relief->ground.point_m);
    free(relief->ground.triangle);
    *relief = (struct relief){ 0 };
}

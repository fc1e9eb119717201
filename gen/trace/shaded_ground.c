#include "gen/trace/shaded_ground.h"

#include "gen/light/sky_image.h"

#include <stdlib.h>
#include <string.h>

#define CELL_M 0.25
/* Of POV-Ray's rays, those straight at an edge can meet neither of its triangles. So no edge lies along the axes, where rows
 * of pixels can, and edges are not parted in their very middle. */
#define LATTICE_RAD 0.3
#define PARTED_AT 0.48

/* Between an edge's ends, the share of the sky's light that entities leave may differ by so much: more where it is bright. */
#define STEP 0.04
#define STEP_OF_SHARE 0.12

/* Doubling: one more at a time would copy all each time. */
static size_t room_for(size_t n)
{
    size_t room = 64;
    while (room < n) room *= 2;
    return room;
}

static bool grow_vertices(struct shaded_ground *g, size_t vertices, struct error *err)
{
    if (g->hidden && room_for(vertices) == room_for(g->vertices)) return true;
    vertices = room_for(vertices);
    void *p = realloc(g->position_m, (vertices + 1) * sizeof *g->position_m);
    if (p) g->position_m = p;
    void *n = realloc(g->normal, (vertices + 1) * sizeof *g->normal);
    if (n) g->normal = n;
    void *s = realloc(g->sky, (vertices + 1) * sizeof *g->sky);
    if (s) g->sky = s;
    void *h = realloc(g->hidden, (vertices + 1) * sizeof *g->hidden);
    if (h) g->hidden = h;
    return (p && n && s && h) || error_set(err, ERR_MEMORY, "no memory for the ground");
}

static bool grow_triangles(struct shaded_ground *g, size_t triangles, struct error *err)
{
    if (g->triangle && room_for(triangles) == room_for(g->triangles)) return true;
    triangles = room_for(triangles);
    void *t = realloc(g->triangle, (triangles + 1) * sizeof *g->triangle);
    if (t) g->triangle = t;
    return t || error_set(err, ERR_MEMORY, "no memory for the ground");
}

void shaded_ground_release(struct shaded_ground *g)
{
    free(g->position_m);
    free(g->normal);
    free(g->sky);
    free(g->hidden);
    free(g->triangle);
    free(g->sunlit);
    *g = (struct shaded_ground){ 0 };
}

bool shaded_ground_pick(struct shaded_ground *part, const struct shaded_ground *g, const bool *taken, bool wanted, struct error *err)
{
    struct shaded_ground picked = { 0 };
    uint32_t *number = malloc((g->vertices + 1) * sizeof *number);
    bool ok = number || error_set(err, ERR_MEMORY, "no memory for the ground");
    ok = ok && grow_vertices(&picked, g->vertices, err) && grow_triangles(&picked, g->triangles, err);
    for (size_t i = 0; ok && i < g->vertices; i++) number[i] = UINT32_MAX;
    for (size_t i = 0; ok && i < g->triangles; i++) {
        if (taken[i] != wanted) continue;
        for (int k = 0; k < 3; k++) {
            uint32_t from = g->triangle[i][k];
            if (number[from] == UINT32_MAX) {
                size_t to = picked.vertices++;
                number[from] = (uint32_t)to;
                picked.position_m[to] = g->position_m[from];
                picked.normal[to] = g->normal[from];
                picked.sky[to] = g->sky[from];
                picked.hidden[to] = g->hidden[from];
            }
            picked.triangle[picked.triangles][k] = number[from];
        }
        picked.triangles++;
    }
    free(number);
    if (ok) *part = picked;
    else shaded_ground_release(&picked);
    return ok;
}

/* --- a number for each pair of numbers --- */

struct pairs {
    struct pair { uint32_t a, b, value; bool used; } *slots;
    size_t mask, n;
};

static bool pairs_init(struct pairs *pairs, size_t room, struct error *err)
{
    size_t size = 64;
    while (size < 2 * room) size *= 2;
    *pairs = (struct pairs){ calloc(size, sizeof *pairs->slots), size - 1, 0 };
    return pairs->slots || error_set(err, ERR_MEMORY, "no memory for the ground");
}

/* The pair's slot; a new one if !slot->used. There must be room. */
static struct pair *pairs_find(struct pairs *pairs, uint32_t a, uint32_t b)
{
    uint64_t key = ((uint64_t)a << 32 | b) * 0x9e3779b97f4a7c15u;
    size_t at = (size_t)(key >> 32) & pairs->mask;
    while (pairs->slots[at].used && (pairs->slots[at].a != a || pairs->slots[at].b != b)) at = (at + 1) & pairs->mask;
    pairs->slots[at].a = a;
    pairs->slots[at].b = b;
    return &pairs->slots[at];
}

/* --- a plane --- */

struct cells { int x0, y0, x1, y1; };

static struct vec3 world_from_lattice(double x, double y)
{
    double c = CELL_M * cos(LATTICE_RAD), s = CELL_M * sin(LATTICE_RAD);
    return vec3(c * x - s * y, s * x + c * y, 0);
}

static struct cells cells_of(const struct receiver *r)
{
    struct cells c = { INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN };
    double cosine = cos(LATTICE_RAD) / CELL_M, sine = sin(LATTICE_RAD) / CELL_M;
    for (size_t i = 0; i < r->corners; i++) {
        struct vec3 p = r->corner_m[i];
        int x = (int)floor(cosine * p.x + sine * p.y), y = (int)floor(cosine * p.y - sine * p.x);
        c = (struct cells){ x < c.x0 ? x : c.x0, y < c.y0 ? y : c.y0, x + 1 > c.x1 ? x + 1 : c.x1, y + 1 > c.y1 ? y + 1 : c.y1 };
    }
    return c;
}

static bool add_cell(struct shaded_ground *g, struct pairs *numbers, const struct plane *plane, int x, int y, struct error *err)
{
    uint32_t corner[4];
    if (!grow_vertices(g, g->vertices + 4, err) || !grow_triangles(g, g->triangles + 2, err)) return false;
    for (int k = 0; k < 4; k++) {
        int cx = x + (k == 1 || k == 2), cy = y + k / 2;
        struct pair *number = pairs_find(numbers, (uint32_t)cx, (uint32_t)cy);
        if (!number->used) {
            *number = (struct pair){ (uint32_t)cx, (uint32_t)cy, (uint32_t)g->vertices, true };
            struct vec3 p = world_from_lattice(cx, cy);
            g->position_m[g->vertices] = vec3(p.x, p.y, plane_height(plane, p.x, p.y));
            g->normal[g->vertices++] = plane->normal;
        }
        corner[k] = number->value;
    }
    bool falls = (x + y) % 2; /* diagonals in turn */
    const uint32_t two[2][3] = { { corner[0], corner[1], corner[falls ? 3 : 2] }, { corner[falls ? 1 : 0], corner[2], corner[3] } };
    memcpy(g->triangle[g->triangles], two, sizeof two);
    g->triangles += 2;
    return true;
}

bool shaded_ground_of_plane(struct shaded_ground *ground, const struct plane *plane, const struct receiver *receivers, size_t n,
                         struct error *err)
{
    struct shaded_ground g = { 0 };
    struct pairs taken = { 0 }, numbers = { 0 };
    size_t room = 0;
    for (size_t i = 0; i < n; i++) {
        struct cells c = cells_of(&receivers[i]);
        room += (size_t)(c.x1 - c.x0) * (size_t)(c.y1 - c.y0);
    }
    bool ok = pairs_init(&taken, room, err) && pairs_init(&numbers, 2 * room + 2, err);
    for (size_t i = 0; ok && i < n; i++) {
        struct cells c = cells_of(&receivers[i]);
        for (int y = c.y0; ok && y < c.y1; y++)
            for (int x = c.x0; ok && x < c.x1; x++) {
                bool within = false;
                for (int k = 0; k < 5 && !within; k++)
                    within = receiver_contains(&receivers[i], world_from_lattice(x + (k == 4 ? 0.5 : k % 2), y + (k == 4 ? 0.5 : k / 2)));
                if (!within) continue;
                struct pair *slot = pairs_find(&taken, (uint32_t)x, (uint32_t)y);
                if (slot->used) continue;
                slot->used = true;
                ok = add_cell(&g, &numbers, plane, x, y, err);
            }
    }
    free(taken.slots);
    free(numbers.slots);
    if (ok) *ground = g;
    else shaded_ground_release(&g);
    return ok;
}

/* --- a cut --- */

bool shaded_ground_of_cut(struct shaded_ground *ground, const struct static_cut *cut, struct error *err)
{
    struct shaded_ground g = { 0 };
    if (!grow_vertices(&g, cut->vertices, err) || !grow_triangles(&g, cut->triangles, err)) {
        shaded_ground_release(&g);
        return false;
    }
    struct vec3 *normal = NULL;
    if (!static_cut_normals(&normal, cut, err)) {
        shaded_ground_release(&g);
        return false;
    }
    memcpy(g.normal, normal, cut->vertices * sizeof *normal);
    free(normal);
    for (size_t i = 0; i < cut->vertices; i++) {
        const float *p = cut->position_m[i];
        g.position_m[i] = vec3((double)p[0], (double)p[1], (double)p[2]);
    }
    memcpy(g.triangle, cut->triangle, cut->triangles * sizeof *cut->triangle);
    g.vertices = cut->vertices;
    g.triangles = cut->triangles;
    *ground = g;
    return true;
}

/* --- light --- */

/* The share of the sky's light that entities leave. */
static double share_left(const struct sky_seen *seen)
{
    double all = luminance_of(seen->without);
    return all > 0 ? luminance_of(seen->with) / all : 1;
}

/* As if it were more of the light: of that the albedo gives back as much, in all, and in its own colour. */
static void add_mirrored(struct sky_seen *sky, const struct sky_sight *sight, struct vec3 p, struct vec3 normal, const struct shaded_ground_detail *detail)
{
    struct sky_seen mirrored = sky_sight_mirrored(sight, &detail->wet, p, normal, detail->eye_m, sky->with);
    double albedo = luminance_of(detail->albedo);
    for (int c = 0; c < 3; c++) {
        sky->without[c] += mirrored.without[c] / albedo;
        sky->with[c] += mirrored.with[c] / albedo;
    }
}

static void light_vertex(struct shaded_ground *g, size_t i, const struct sky_sight *sight, const struct shaded_ground_detail *detail)
{
    g->sky[i] = sky_sight_at(sight, g->position_m[i], g->normal[i]);
    if (detail->wet.reflection > 0 && detail->wet.roughness > 0) add_mirrored(&g->sky[i], sight, g->position_m[i], g->normal[i], detail);
    g->hidden[i] = sky_sight_hidden(sight, g->position_m[i], detail->eye_m);
}

static bool is_coarse(const struct shaded_ground *g, const struct sky_sight *sight, uint32_t a, uint32_t b,
                      const struct shaded_ground_detail *detail)
{
    struct vec3 p = g->position_m[a], q = g->position_m[b], middle = vec3_scale(vec3_add(p, q), 0.5);
    double length = vec3_norm(vec3_sub(p, q));
    /* So long that shade could lie between its ends. */
    if (length > 1.5 * CELL_M && length > sky_sight_distance(sight, middle)) return true;
    if (g->hidden[a] && g->hidden[b]) return false;
    double here = share_left(&g->sky[a]), there = share_left(&g->sky[b]);
    return fabs(here - there) > STEP + STEP_OF_SHARE * fmin(here, there) &&
           length > detail->fine_px * detail->pixel_rad * vec3_norm(vec3_sub(middle, detail->eye_m));
}

static struct pair *edge_of(struct pairs *edges, const uint32_t triangle[3], int k)
{
    uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
    return pairs_find(edges, a < b ? a : b, a < b ? b : a);
}

static int longest_edge(const struct shaded_ground *g, const uint32_t triangle[3])
{
    int longest = 0;
    double most = -1;
    for (int k = 0; k < 3; k++) {
        double length = vec3_norm(vec3_sub(g->position_m[triangle[(k + 1) % 3]], g->position_m[triangle[k]]));
        if (length > most * 1.0001) most = length, longest = k;
    }
    return longest;
}

/* What is known of an edge, until it is the number of the vertex in its middle. */
#define WHOLE UINT32_MAX
#define HALVED (UINT32_MAX - 1)

/* Out: edges; false when none is to be halved */
static bool choose_edges(struct pairs *edges, const struct shaded_ground *g, const struct sky_sight *sight,
                         const struct shaded_ground_detail *detail)
{
    bool any = false, more = true;
    for (size_t i = 0; i < g->triangles; i++)
        for (int k = 0; k < 3; k++) {
            struct pair *edge = edge_of(edges, g->triangle[i], k);
            if (edge->used) continue;
            edge->used = true;
            edge->value = is_coarse(g, sight, edge->a, edge->b, detail) ? HALVED : WHOLE;
            any = any || edge->value == HALVED;
        }
    /* With an edge, the triangle's longest: or slivers would never end. */
    while (any && more) {
        more = false;
        for (size_t i = 0; i < g->triangles; i++) {
            const uint32_t *t = g->triangle[i];
            bool halved = false;
            for (int k = 0; k < 3; k++) halved = halved || edge_of(edges, t, k)->value == HALVED;
            struct pair *longest = halved ? edge_of(edges, t, longest_edge(g, t)) : NULL;
            if (!longest || longest->value == HALVED) continue;
            longest->value = HALVED;
            more = true;
        }
    }
    return any;
}

/* The same from both ends, whichever has the lower number. */
static struct vec3 part(struct vec3 a, struct vec3 b)
{
    bool turned = a.x != b.x ? a.x > b.x : a.y != b.y ? a.y > b.y : a.z > b.z;
    double share = turned ? 1 - PARTED_AT : PARTED_AT;
    return vec3_add(vec3_scale(a, 1 - share), vec3_scale(b, share));
}

/* The vertices that part edges. */
static bool halve_edges(struct shaded_ground *g, struct pairs *edges, const struct sky_sight *sight,
                        const struct shaded_ground_detail *detail, struct error *err)
{
    for (size_t i = 0; i < g->triangles; i++)
        for (int k = 0; k < 3; k++) {
            struct pair *edge = edge_of(edges, g->triangle[i], k);
            if (edge->value != HALVED) continue;
            if (!grow_vertices(g, g->vertices + 1, err)) return false;
            struct vec3 p = part(g->position_m[edge->a], g->position_m[edge->b]);
            struct vec3 n = vec3_add(g->normal[edge->a], g->normal[edge->b]);
            n = vec3_norm(n) > 0 ? vec3_unit(n) : g->normal[edge->a];
            edge->value = (uint32_t)g->vertices++;
            g->position_m[edge->value] = p;
            g->normal[edge->value] = n;
            light_vertex(g, edge->value, sight, detail);
        }
    return true;
}

/* A triangle into as many as it has halved edges more. Out: parts */
static int cut_triangle(uint32_t parts[4][3], const struct shaded_ground *g, const uint32_t t[3], struct pairs *edges)
{
    uint32_t m[3];
    int halved = 0;
    for (int k = 0; k < 3; k++) halved += (m[k] = edge_of(edges, t, k)->value) != WHOLE;
    if (halved == 3) {
        const uint32_t four[4][3] = { { t[0], m[0], m[2] }, { m[0], t[1], m[1] }, { m[2], m[1], t[2] }, { m[0], m[1], m[2] } };
        memcpy(parts, four, sizeof four);
        return 4;
    }
    for (int k = 0; k < 3; k++) { /* turned so that the first edge is the one halved, or the one whole */
        uint32_t a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = m[k], bc = m[(k + 1) % 3], ca = m[(k + 2) % 3];
        if (halved == 1 && ab != WHOLE) {
            const uint32_t two[2][3] = { { a, ab, c }, { ab, b, c } };
            memcpy(parts, two, sizeof two);
            return 2;
        }
        if (halved == 2 && ab == WHOLE) { /* along the shorter diagonal of what c is cut from */
            bool from_a = vec3_norm(vec3_sub(g->position_m[a], g->position_m[bc])) < vec3_norm(vec3_sub(g->position_m[b], g->position_m[ca]));
            const uint32_t three[3][3] = { { ca, bc, c }, { a, b, from_a ? bc : ca }, { from_a ? a : b, bc, ca } };
            memcpy(parts, three, sizeof three);
            return 3;
        }
    }
    memcpy(parts[0], t, sizeof parts[0]);
    return 1;
}

bool shaded_ground_shade(struct shaded_ground *g, const struct sky_sight *sight, struct shaded_ground_detail detail, struct error *err)
{
    bool ok = true, more = true;
    for (size_t i = 0; i < g->vertices; i++) light_vertex(g, i, sight, &detail);
    while (ok && more) {
        struct pairs edges;
        size_t before = g->triangles;
        if (!pairs_init(&edges, 3 * g->triangles, err)) return false;
        more = choose_edges(&edges, g, sight, &detail);
        ok = !more || halve_edges(g, &edges, sight, &detail, err);
        for (size_t i = 0; ok && more && i < before; i++) {
            uint32_t parts[4][3];
            int n = cut_triangle(parts, g, g->triangle[i], &edges);
            memcpy(g->triangle[i], parts[0], sizeof parts[0]);
            ok = n == 1 || grow_triangles(g, g->triangles + (size_t)n - 1, err);
            for (int k = 1; ok && k < n; k++) memcpy(g->triangle[g->triangles++], parts[k], sizeof parts[k]);
        }
        free(edges.slots);
    }
    return ok;
}

#include "gen/trace/fusion.h"

#include "gen/trace/rays.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SLOTS 4           /* labels that a face has votes for; a fifth takes the place of the least */
#define BORDER_SHARE 0.25f
#define CREASE_FACTOR 4.0 /* a step over an edge that bends by 90 deg is so many times longer, and its own length */

struct ballot { uint8_t label[SLOTS]; float weight[SLOTS]; };

struct fusion {
    const struct static_mesh *mesh;
    struct ballot *ballots; /* (triangles) */
};

bool fusion_create(struct fusion **fusion, const struct static_mesh *mesh, struct error *err)
{
    struct fusion *f = calloc(1, sizeof *f);
    if (f) f->ballots = calloc(static_mesh_triangle_count(mesh), sizeof *f->ballots);
    if (!f || !f->ballots) {
        fusion_destroy(f);
        return error_set(err, ERR_MEMORY, "no memory for the votes of a mesh");
    }
    f->mesh = mesh;
    *fusion = f;
    return true;
}

void fusion_destroy(struct fusion *fusion)
{
    if (!fusion) return;
    free(fusion->ballots);
    free(fusion);
}

/* --- votes --- */

static void vote(struct ballot *ballot, uint8_t label, float weight)
{
    int least = 0;
    for (int i = 0; i < SLOTS; i++) {
        if (ballot->weight[i] > 0 && ballot->label[i] == label) {
            ballot->weight[i] += weight;
            return;
        }
        if (ballot->weight[i] < ballot->weight[least]) least = i;
    }
    if (ballot->weight[least] >= weight) return;
    ballot->label[least] = label;
    ballot->weight[least] = weight;
}

static bool at_border(const struct image *ids, int x, int y)
{
    uint8_t id = *image_u8(ids, x, y);
    return (x > 0 && *image_u8(ids, x - 1, y) != id) || (x + 1 < ids->width_px && *image_u8(ids, x + 1, y) != id) ||
           (y > 0 && *image_u8(ids, x, y - 1) != id) || (y + 1 < ids->height_px && *image_u8(ids, x, y + 1) != id);
}

bool fusion_add(struct fusion *fusion, const struct image *ids, const struct camera *camera,
                struct pose world_from_camera, struct error *err)
{
    assert(ids->width_px == camera->width_px && ids->height_px == camera->height_px);
    size_t width = (size_t)camera->width_px;
    struct rays rays;
    struct vec3 *direction = malloc(width * sizeof *direction);
    struct static_hit *hits = malloc(width * sizeof *hits);
    int *at = malloc(width * sizeof *at);
    bool ok = rays_init(&rays, camera, err);
    if (ok && (!direction || !hits || !at)) ok = error_set(err, ERR_MEMORY, "no memory for the votes of an image");
    for (int y = 0; ok && y < camera->height_px; y++) {
        size_t n = 0;
        rays_begin_row(&rays, y);
        for (int x = 0; x < camera->width_px; x++) {
            struct vec3 d;
            if (*image_u8(ids, x, y) == STATIC_LABEL_UNKNOWN || !rays_get(&rays, &d, x)) continue;
            at[n] = x;
            direction[n++] = mat3_apply(world_from_camera.rotation, d);
        }
        static_mesh_hits(fusion->mesh, hits, world_from_camera.translation, direction, n);
        for (size_t i = 0; i < n; i++) {
            if (hits[i].triangle == STATIC_NO_TRIANGLE) continue;
            float weight = (float)fabs(vec3_dot(direction[i], static_mesh_normal(fusion->mesh, hits[i].triangle)));
            if (at_border(ids, at[i], y)) weight *= BORDER_SHARE;
            vote(&fusion->ballots[hits[i].triangle], *image_u8(ids, at[i], y), weight);
        }
    }
    rays_release(&rays);
    free(direction);
    free(hits);
    free(at);
    return ok;
}

static uint8_t majority(const struct ballot *ballot)
{
    float sum = 0;
    int most = 0;
    for (int i = 0; i < SLOTS; i++) {
        sum += ballot->weight[i];
        if (ballot->weight[i] > ballot->weight[most]) most = i;
    }
    bool decided = (double)sum >= FUSION_SUPPORT && ballot->weight[most] > sum / 2;
    return decided ? ballot->label[most] : STATIC_LABEL_UNKNOWN;
}

/* --- filling --- */

/* Faces about each vertex. */
struct fans { uint32_t *first, *face; };

static bool fans_init(struct fans *fans, const struct static_mesh *mesh, struct error *err)
{
    size_t vertices = static_mesh_vertex_count(mesh), faces = static_mesh_triangle_count(mesh);
    const uint32_t (*triangle)[3] = static_mesh_triangles(mesh);
    fans->first = calloc(vertices + 2, sizeof *fans->first);
    fans->face = malloc((3 * faces + 1) * sizeof *fans->face);
    if (!fans->first || !fans->face) return error_set(err, ERR_MEMORY, "no memory for the neighbours of faces");
    for (size_t i = 0; i < faces; i++)
        for (int c = 0; c < 3; c++) fans->first[triangle[i][c] + 2]++;
    for (size_t v = 2; v < vertices + 2; v++) fans->first[v] += fans->first[v - 1];
    for (size_t i = 0; i < faces; i++)
        for (int c = 0; c < 3; c++) fans->face[fans->first[triangle[i][c] + 1]++] = (uint32_t)i;
    return true;
}

struct step { double way_m; uint32_t face; uint8_t label; };

/* The nearest first; of two as near, the face of the lower number. */
static bool before(struct step a, struct step b)
{
    return a.way_m < b.way_m || (a.way_m == b.way_m && a.face < b.face);
}

struct heap { struct step *steps; size_t n, capacity; };

static bool push(struct heap *heap, struct step step)
{
    if (heap->n == heap->capacity) {
        size_t capacity = 2 * heap->capacity + 1024;
        struct step *grown = realloc(heap->steps, capacity * sizeof *grown);
        if (!grown) return false;
        heap->steps = grown;
        heap->capacity = capacity;
    }
    size_t i = heap->n++;
    for (; i > 0 && before(step, heap->steps[(i - 1) / 2]); i = (i - 1) / 2) heap->steps[i] = heap->steps[(i - 1) / 2];
    heap->steps[i] = step;
    return true;
}

static struct step pop(struct heap *heap)
{
    struct step top = heap->steps[0], last = heap->steps[--heap->n];
    size_t i = 0;
    for (size_t child; (child = 2 * i + 1) < heap->n; i = child) {
        if (child + 1 < heap->n && before(heap->steps[child + 1], heap->steps[child])) child++;
        if (!before(heap->steps[child], last)) break;
        heap->steps[i] = heap->steps[child];
    }
    heap->steps[i] = last;
    return top;
}

static struct vec3 centre(const struct static_mesh *mesh, uint32_t face)
{
    const uint32_t *t = static_mesh_triangles(mesh)[face];
    struct vec3 sum = vec3_add(static_mesh_vertex(mesh, t[0]), vec3_add(static_mesh_vertex(mesh, t[1]), static_mesh_vertex(mesh, t[2])));
    return vec3_scale(sum, 1 / 3.0);
}

/* Steps from a face to those of its neighbours that have no label yet. */
static bool push_neighbours(struct heap *heap, const struct static_mesh *mesh, const struct fans *fans,
                            const uint8_t *label, struct step from, double fill_m)
{
    struct vec3 here = centre(mesh, from.face), normal = static_mesh_normal(mesh, from.face);
    for (int c = 0; c < 3; c++) {
        uint32_t vertex = static_mesh_triangles(mesh)[from.face][c];
        for (uint32_t k = fans->first[vertex]; k < fans->first[vertex + 1]; k++) {
            uint32_t face = fans->face[k];
            if (label[face] != STATIC_LABEL_UNKNOWN) continue;
            double bend = 1 - vec3_dot(normal, static_mesh_normal(mesh, face));
            double way = from.way_m + vec3_norm(vec3_sub(centre(mesh, face), here)) * (1 + CREASE_FACTOR * bend);
            if (way <= fill_m && !push(heap, (struct step){ way, face, from.label })) return false;
        }
    }
    return true;
}

/* Src: Dijkstra 1959, from all labelled faces at once */
static bool fill(const struct fusion *fusion, uint8_t *label, size_t *filled, double fill_m, struct error *err)
{
    const struct static_mesh *mesh = fusion->mesh;
    size_t faces = static_mesh_triangle_count(mesh);
    struct fans fans = { 0 };
    struct heap heap = { 0 };
    bool ok = fans_init(&fans, mesh, err);
    for (size_t i = 0; ok && i < faces; i++)
        if (label[i] != STATIC_LABEL_UNKNOWN)
            ok = push_neighbours(&heap, mesh, &fans, label, (struct step){ 0, (uint32_t)i, label[i] }, fill_m);
    while (ok && heap.n > 0) {
        struct step step = pop(&heap);
        if (label[step.face] != STATIC_LABEL_UNKNOWN) continue;
        label[step.face] = step.label;
        ++*filled;
        ok = push_neighbours(&heap, mesh, &fans, label, step, fill_m);
    }
    free(fans.first);
    free(fans.face);
    free(heap.steps);
    return ok || error_set(err, ERR_MEMORY, "no memory for the neighbours of faces");
}

bool fusion_decide(const struct fusion *fusion, uint8_t *label, struct fusion_counts *counts, double fill_m,
                   struct error *err)
{
    size_t faces = static_mesh_triangle_count(fusion->mesh);
    *counts = (struct fusion_counts){ 0 };
    for (size_t i = 0; i < faces; i++) {
        label[i] = majority(&fusion->ballots[i]);
        counts->voted += label[i] != STATIC_LABEL_UNKNOWN;
    }
    if (!fill(fusion, label, &counts->filled, fill_m, err)) return false;
    counts->unknown = faces - counts->voted - counts->filled;
    return true;
}

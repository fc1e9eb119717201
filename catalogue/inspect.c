#include "catalogue/inspect.h"

#include "gen/trace/shape.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define WELD_SHARE 1e-5   /* of the longest side: nearer vertices are one */
#define CONTACT_SHARE 0.02 /* of the height: lower is on the ground */
#define FACES_LOOKED_AT 1500
#define RAYS 24           /* from each side of a face */

/* --- edges --- */

struct corner { int64_t cell[3]; size_t index; };
struct edge { uint32_t from, to; };

static int by_cell(const void *a, const void *b)
{
    return memcmp(((const struct corner *)a)->cell, ((const struct corner *)b)->cell, sizeof ((struct corner *)0)->cell);
}
static int by_ends(const void *a, const void *b)
{
    const struct edge *p = a, *q = b;
    if (p->from != q->from) return p->from < q->from ? -1 : 1;
    return p->to < q->to ? -1 : p->to > q->to;
}

/* Vertices that lie at one place have one number, whatever mesh they are of.
 * Out: *number (all vertices of the model), the caller's */
static bool weld(uint32_t **number, const struct model *model, struct error *err)
{
    size_t n = 0, at = 0;
    for (size_t i = 0; i < model->mesh_count; i++) n += model->meshes[i].vertices;
    struct corner *corners = malloc((n + 1) * sizeof *corners);
    *number = malloc((n + 1) * sizeof **number);
    if (!corners || !*number) {
        free(corners);
        free(*number);
        return error_set(err, ERR_MEMORY, "no memory for the edges of a model");
    }
    struct vec3 size = vec3_sub(model->max_m, model->min_m);
    double step = WELD_SHARE * fmax(size.x, fmax(size.y, size.z));
    for (size_t i = 0; i < model->mesh_count; i++)
        for (size_t v = 0; v < model->meshes[i].vertices; v++, at++) {
            for (int k = 0; k < 3; k++) corners[at].cell[k] = llround((double)model->meshes[i].position_m[v][k] / step);
            corners[at].index = at;
        }
    qsort(corners, n, sizeof *corners, by_cell);
    uint32_t current = 0;
    for (size_t i = 0; i < n; i++) {
        if (i && by_cell(&corners[i - 1], &corners[i])) current++;
        (*number)[corners[i].index] = current;
    }
    free(corners);
    return true;
}

static bool count_edges(struct inspection *out, const struct model *model, struct error *err)
{
    uint32_t *number;
    size_t n = 0, base = 0, open = 0;
    if (!weld(&number, model, err)) return false;
    struct edge *edges = malloc((3 * out->triangles + 1) * sizeof *edges);
    if (!edges) {
        free(number);
        return error_set(err, ERR_MEMORY, "no memory for the edges of a model");
    }
    for (size_t i = 0; i < model->mesh_count; i++) {
        const struct mesh *mesh = &model->meshes[i];
        for (size_t t = 0; t < mesh->triangles; t++)
            for (int k = 0; k < 3; k++) {
                uint32_t a = number[base + mesh->triangle[t][k]], b = number[base + mesh->triangle[t][(k + 1) % 3]];
                if (a != b) edges[n++] = (struct edge){ a < b ? a : b, a < b ? b : a };
            }
        base += mesh->vertices;
    }
    qsort(edges, n, sizeof *edges, by_ends);
    for (size_t i = 0, run; i < n; i += run) {
        for (run = 1; i + run < n && !by_ends(&edges[i], &edges[i + run]); run++) {}
        open += run == 1;
        out->edges++;
    }
    out->open_share = out->edges ? (double)open / (double)out->edges : 0;
    free(edges);
    free(number);
    return true;
}

/* --- which way faces look --- */

/* Directions all over the sphere, evenly.
 * Src: the spherical Fibonacci lattice (Swinbank, Purser 2006) */
static void spread_directions(struct vec3 direction[2 * RAYS])
{
    for (int i = 0; i < 2 * RAYS; i++) {
        double z = 1 - (2 * i + 1) / (2.0 * RAYS), angle = 2 * M_PI * i * 0.6180339887498949, r = sqrt(1 - z * z);
        direction[i] = vec3(r * cos(angle), r * sin(angle), z);
    }
}

/* How many rays from a point, on the side that normal points to, meet nothing. */
static int sky_seen(const struct shape *shape, struct vec3 from, struct vec3 normal, const struct vec3 direction[2 * RAYS])
{
    struct vec3 there[2 * RAYS];
    double range[2 * RAYS];
    size_t n = 0;
    int seen = 0;
    for (int i = 0; i < 2 * RAYS; i++)
        if (vec3_dot(direction[i], normal) > 0.05) there[n++] = direction[i];
    shape_hits(shape, range, from, there, n);
    for (size_t i = 0; i < n; i++) seen += isinf(range[i]);
    return seen;
}

/* A face whose back sees more of the sky than its front is turned around. Crossings counted along one ray would say as
 * much of a closed body, but not of the sheets and the seats behind glass that vehicles are made of. */
static bool look_at_faces(struct inspection *out, const struct model *model, struct error *err)
{
    RTCDevice device = rtcNewDevice("threads=1");
    struct shape *shape = NULL;
    struct vec3 direction[2 * RAYS];
    double seen = 0, inward = 0;
    if (!device) return error_set(err, ERR_MEMORY, "no memory for a search tree");
    bool ok = shape_create(&shape, device, model, err);
    size_t stride = out->triangles / FACES_LOOKED_AT + 1, number = 0;
    spread_directions(direction);
    for (size_t i = 0; ok && i < model->mesh_count; i++) {
        const struct mesh *mesh = &model->meshes[i];
        for (size_t t = 0; t < mesh->triangles; t++) {
            if (number++ % stride) continue;
            struct vec3 p[3];
            for (int k = 0; k < 3; k++) {
                const float *v = mesh->position_m[mesh->triangle[t][k]];
                p[k] = vec3((double)v[0], (double)v[1], (double)v[2]);
            }
            struct vec3 twice = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0])), middle = vec3_scale(vec3_add(p[0], vec3_add(p[1], p[2])), 1 / 3.0);
            double area = vec3_norm(twice);
            if (!(area > 0)) continue;
            struct vec3 normal = vec3_scale(twice, 1 / area), off = vec3_scale(normal, 1e-4);
            int front = sky_seen(shape, vec3_add(middle, off), normal, direction);
            int back = sky_seen(shape, vec3_sub(middle, off), vec3_scale(normal, -1), direction);
            if (front + back == 0) continue;
            seen += area;
            if (back > front) inward += area;
        }
    }
    out->inward_share = seen > 0 ? inward / seen : 0;
    shape_destroy(shape);
    rtcReleaseDevice(device);
    return ok;
}

/* --- ground --- */

static void find_contact(struct inspection *out, const struct model *model)
{
    double low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    struct vec3 size = vec3_sub(model->max_m, model->min_m);
    for (size_t i = 0; i < model->mesh_count; i++)
        for (size_t v = 0; v < model->meshes[i].vertices; v++) {
            const float *p = model->meshes[i].position_m[v];
            if ((double)p[2] > CONTACT_SHARE * size.z) continue;
            for (int k = 0; k < 2; k++) {
                low[k] = fmin(low[k], (double)p[k]);
                high[k] = fmax(high[k], (double)p[k]);
            }
        }
    out->contact_length = size.x > 0 ? (high[0] - low[0]) / size.x : 0;
    out->contact_width = size.y > 0 ? (high[1] - low[1]) / size.y : 0;
}

bool inspect_model(struct inspection *out, const struct model *model, struct error *err)
{
    *out = (struct inspection){ 0 };
    for (size_t i = 0; i < model->mesh_count; i++) out->triangles += model->meshes[i].triangles;
    for (size_t i = 0; i < model->image_count; i++) {
        int side = model->images[i].width_px > model->images[i].height_px ? model->images[i].width_px : model->images[i].height_px;
        if (side > out->largest_texture_px) out->largest_texture_px = side;
    }
    find_contact(out, model);
    return count_edges(out, model, err) && look_at_faces(out, model, err);
}

#include "color_place.h"

#include "map_flight.h"
#include "write_pov.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#define OFF_M 0.3         /* rays start this far off the surface, whose heights are those of cells */
#define LEAST_FACING 0.1  /* cosine: flatter, a surface off by centimetres gets the colours of others */

static bool sees(const struct place_heights *heights, struct vec3 p, struct vec3 way, double length)
{
    assert(isfinite(length) || way.z > 0);
    double step = 0.75 * PROVING_MESH_CELL_M;
    for (double done = 0; done < length; done += step) {
        struct vec3 q = vec3_add(p, vec3_scale(way, done));
        if (q.z > PROVING_HIGHEST_M) return true;
        if (place_heights_solid(heights, q)) return false;
    }
    return true;
}

static bool from_photographs(float srgb[3], struct vec3 p, struct vec3 normal, const struct place_views *v)
{
    double sum[3] = { 0 }, n = 0;
    for (size_t i = 0; v->photographs && i < v->c->shot_count; i++) {
        struct error ignored = ERROR_NONE;
        struct vec2 q;
        struct vec3 start = vec3_add(p, vec3_scale(normal, OFF_M)), way = vec3_sub(v->c->shots[i].eye_m, start);
        double length = vec3_norm(way);
        way = vec3_unit(way);
        if (vec3_dot(way, normal) < LEAST_FACING) continue;
        struct vec3 in_camera = pose_apply(pose_inverse(proving_shot_pose(&v->c->shots[i])), p);
        if (!camera_project(v->camera, &q, in_camera, &ignored)) continue;
        if (!(q.x >= 0 && q.y >= 0 && q.x < v->camera->width_px && q.y < v->camera->height_px)) continue;
        if (!sees(v->heights, start, way, length)) continue;
        for (int k = 0; k < 3; k++) sum[k] += image_u8(&v->photographs[i], (int)q.x, (int)q.y)[k];
        n++;
    }
    for (int k = 0; n > 0 && k < 3; k++) srgb[k] = (float)(sum[k] / n);
    return n > 0;
}

static bool from_map(float srgb[3], struct vec3 p, struct vec3 normal, const struct map_view *map, const struct place_views *v)
{
    double most = LEAST_FACING;
    for (int i = 0; i < PROVING_MAP_VIEWS; i++) {
        struct vec3 way = vec3_scale(map[i].forward, -1);
        int x, y;
        if (vec3_dot(way, normal) <= most || !map_view_pixel(&map[i], &x, &y, p) ||
            !sees(v->heights, vec3_add(p, vec3_scale(normal, OFF_M)), way, INFINITY))
            continue;
        most = vec3_dot(way, normal);
        const float *radiance = image_f32(&v->map[i], x, y);
        for (int k = 0; k < 3; k++)
            srgb[k] = 255 * srgb_from_linear(fminf(fmaxf(radiance[k] * (float)v->c->k[k], 0), 1));
    }
    return most > LEAST_FACING;
}

/* Unit, means of the faces by their areas. */
static void normals_of(struct vec3 *normals, const struct place_mesh *mesh)
{
    const struct vec3 *p = mesh->vertices_m;
    for (size_t i = 0; i < mesh->vertex_count; i++) normals[i] = vec3(0, 0, 0);
    for (size_t i = 0; i < mesh->face_count; i++) {
        const int *f = mesh->faces[i];
        struct vec3 n = vec3_cross(vec3_sub(p[f[1]], p[f[0]]), vec3_sub(p[f[2]], p[f[0]]));
        for (int k = 0; k < 3; k++) normals[f[k]] = vec3_add(normals[f[k]], n);
    }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        double length = vec3_norm(normals[i]);
        normals[i] = length > 0 ? vec3_scale(normals[i], 1 / length) : vec3(0, 0, 1);
    }
}

/* One edge farther: those beside colored ones get their mean. In/out: srgb; c[0] NAN: none yet. Returns how many */
struct srgb { float c[3]; };
struct sum { float c[3], n; };
static size_t spread(struct srgb *srgb, struct sum *sums, const struct place_mesh *mesh)
{
    size_t colored = 0;
    memset(sums, 0, mesh->vertex_count * sizeof *sums);
    for (size_t i = 0; i < mesh->face_count; i++)
        for (int k = 0; k < 6; k++) {
            int to = mesh->faces[i][k % 3], from = mesh->faces[i][(k + (k < 3 ? 1 : 2)) % 3];
            if (!isnan(srgb[to].c[0]) || isnan(srgb[from].c[0])) continue;
            for (int j = 0; j < 3; j++) sums[to].c[j] += srgb[from].c[j];
            sums[to].n++;
        }
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        if (sums[i].n == 0) continue;
        for (int j = 0; j < 3; j++) srgb[i].c[j] = sums[i].c[j] / sums[i].n;
        colored++;
    }
    return colored;
}

bool color_place(struct place_mesh *mesh, const struct place_views *views, struct error *err)
{
    size_t n = mesh->vertex_count;
    struct vec3 *normals = malloc(n * sizeof *normals);
    struct srgb *srgb = malloc(n * sizeof *srgb);
    struct sum *sums = malloc(n * sizeof *sums);
    mesh->colors = malloc(n * sizeof *mesh->colors);
    bool ok = (normals && srgb && sums && mesh->colors) || error_set(err, ERR_MEMORY, "no memory for the reconstruction's colours");
    struct map_view map[PROVING_MAP_VIEWS];
    for (int i = 0; i < PROVING_MAP_VIEWS; i++) {
        map[i] = map_view(i);
        ok = ok && ((views->map[i].width_px == map[i].width_px && views->map[i].height_px == map[i].height_px) ||
                    error_set(err, ERR_INPUT, "%s is %d x %d pixels, not %d x %d", map[i].kind, views->map[i].width_px,
                              views->map[i].height_px, map[i].width_px, map[i].height_px));
    }
    if (ok) normals_of(normals, mesh);
    for (size_t i = 0; ok && i < n; i++)
        if (!from_photographs(srgb[i].c, mesh->vertices_m[i], normals[i], views) &&
            !from_map(srgb[i].c, mesh->vertices_m[i], normals[i], map, views))
            srgb[i].c[0] = NAN;
    while (ok && spread(srgb, sums, mesh) > 0) continue;
    for (size_t i = 0; ok && i < n; i++) {
        ok = !isnan(srgb[i].c[0]) || error_set(err, ERR_INPUT, "no view has a colour for a part of the reconstruction");
        for (int k = 0; ok && k < 3; k++) mesh->colors[i][k] = (uint8_t)(srgb[i].c[k] + 0.5f);
    }
    free(normals);
    free(srgb);
    free(sums);
    return ok;
}

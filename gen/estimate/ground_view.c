#include "gen/estimate/ground_view.h"

#include "lib/air.h"

#include <math.h>
#include <stdlib.h>

#define LEVEL_COS 0.866
#define APART 2        /* nodes from one whose slope is looked at: a mesh is rough */

static const struct ground_node no_ground = { { NAN, NAN, NAN }, NAN };

static void meet_plane(struct ground_view *v, const struct plane *ground, struct vec3 eye, const struct vec3 *rays)
{
    for (size_t i = 0, n = (size_t)v->width * (size_t)v->height; i < n; i++) {
        struct vec3 p;
        v->node[i] = no_ground;
        if (!(vec3_norm(rays[i]) > 0) || !plane_intersect(ground, &p, eye, rays[i])) continue;
        v->node[i] = (struct ground_node){ { (float)p.x, (float)p.y, (float)p.z }, (float)vec3_norm(vec3_sub(p, eye)) };
    }
}

static bool meet_mesh(struct ground_view *v, const struct static_mesh *mesh, struct vec3 eye, const struct vec3 *rays)
{
    size_t n = (size_t)v->width * (size_t)v->height;
    struct static_hit *hits = malloc(n * sizeof *hits + 1);
    if (!hits) return false;
    static_mesh_hits(mesh, hits, eye, rays, n);
    for (size_t i = 0; i < n; i++) {
        v->node[i] = no_ground;
        if (!isfinite(hits[i].range_m) || !(vec3_norm(rays[i]) > 0)) continue;
        struct vec3 p = vec3_add(eye, vec3_scale(rays[i], hits[i].range_m));
        v->node[i] = (struct ground_node){ { (float)p.x, (float)p.y, (float)p.z }, (float)hits[i].range_m };
    }
    free(hits);
    return true;
}

static struct vec3 point(const struct ground_node *node)
{
    return vec3((double)node->p_m[0], (double)node->p_m[1], (double)node->p_m[2]);
}

/* Is the surface about a node level, and seen closely? */
static bool is_near_and_level(const struct ground_view *v, int x, int y, bool level_by_itself, double coarsest_m)
{
    const struct ground_node *at = &v->node[(size_t)y * (size_t)v->width + (size_t)x];
    if (x < APART || y < APART || x >= v->width - APART || y >= v->height - APART || !isfinite(at->range_m)) return false;
    struct vec3 right = vec3_sub(point(at + APART), point(at - APART));
    struct vec3 down = vec3_sub(point(at + APART * v->width), point(at - APART * v->width));
    double apart_px = 2 * APART * GROUND_STEP_PX;
    if (!(vec3_norm(right) < coarsest_m * apart_px && vec3_norm(down) < coarsest_m * apart_px)) return false;
    struct vec3 normal = vec3_cross(right, down);
    return level_by_itself || fabs(normal.z) > LEVEL_COS * vec3_norm(normal);
}

bool ground_view_of(struct ground_view *view, const struct stage *stage, const struct tones *tones,
                    const struct camera *camera, struct pose world_from_camera, double coarsest_m, struct error *err)
{
    struct ground_view v = { (tones->width_px + GROUND_STEP_PX - 1) / GROUND_STEP_PX,
                             (tones->height_px + GROUND_STEP_PX - 1) / GROUND_STEP_PX, NULL };
    size_t n = (size_t)v.width * (size_t)v.height;
    struct vec3 *rays = calloc(n + 1, sizeof *rays), eye = world_from_camera.translation;
    bool *keep = calloc(n + 1, sizeof *keep);
    v.node = malloc(n * sizeof *v.node + 1);
    bool ok = rays && v.node && keep;
    for (int y = 0; ok && y < v.height; y++)
        for (int x = 0; x < v.width; x++) {
            struct error ignored = ERROR_NONE;
            struct vec3 ray;
            struct vec2 q = tones_photograph_px(tones, x * GROUND_STEP_PX, y * GROUND_STEP_PX);
            if (camera_unproject(camera, &ray, q, &ignored))
                rays[(size_t)y * (size_t)v.width + (size_t)x] = mat3_apply(world_from_camera.rotation, ray);
        }
    if (ok && stage->mesh) ok = meet_mesh(&v, stage->mesh, eye, rays);
    else if (ok) meet_plane(&v, &stage->scene->ground, eye, rays);
    for (int y = 0; ok && y < v.height; y++)
        for (int x = 0; x < v.width; x++)
            keep[(size_t)y * (size_t)v.width + (size_t)x] = is_near_and_level(&v, x, y, !stage->mesh, coarsest_m);
    for (size_t i = 0; ok && i < n; i++)
        if (!keep[i]) v.node[i] = no_ground;
    free(rays);
    free(keep);
    if (!ok) {
        free(v.node);
        return error_set(err, ERR_MEMORY, "no memory for the ground of a photograph");
    }
    *view = v;
    return true;
}

void ground_view_release(struct ground_view *view)
{
    free(view->node);
    *view = (struct ground_view){ 0 };
}

static const struct ground_node *node_at(const struct ground_view *view, int x, int y)
{
    return &view->node[(size_t)(y / GROUND_STEP_PX) * (size_t)view->width + (size_t)(x / GROUND_STEP_PX)];
}

bool ground_view_at(struct vec3 *p_m, const struct ground_view *view, int x, int y)
{
    const struct ground_node *node = node_at(view, x, y);
    *p_m = point(node);
    return isfinite(node->range_m);
}

void ground_view_clear(struct tones *tones, const struct ground_view *view, double visibility_m, const double haze[3])
{
    for (int y = 0; y < tones->height_px; y++)
        for (int x = 0; x < tones->width_px; x++) {
            double range = (double)node_at(view, x, y)->range_m, through = air_transmission(visibility_m, range);
            size_t at = (size_t)y * (size_t)tones->width_px + (size_t)x;
            for (size_t c = 0; isfinite(range) && c < 3; c++) {
                double own = (exp((double)tones->ln[3 * at + c]) - haze[c] * (1 - through)) / through;
                if (own > 0.001) tones->ln[3 * at + c] = (float)log(own);
                else tones->good[at] = 0;
            }
        }
}

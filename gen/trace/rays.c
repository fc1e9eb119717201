#include "gen/trace/rays.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CELL_PX 16

enum { NODE_UNKNOWN, NODE_KNOWN, NODE_NONE };

static bool init(struct rays *rays, const struct camera *camera, double within_px, struct error *err)
{
    *rays = (struct rays){ .camera = camera, .in = camera_intrinsics(camera), .pinhole = camera_is_pinhole(camera),
                           .within_px = within_px };
    if (rays->pinhole) return true;
    rays->cells = (3 * camera->width_px + CELL_PX - 1) / CELL_PX;
    size_t pixels = (size_t)rays->cells * CELL_PX, nodes = (size_t)rays->cells + 3;
    rays->ray = malloc(pixels * sizeof *rays->ray);
    rays->exists = malloc(pixels * sizeof *rays->exists);
    rays->node = malloc(nodes * sizeof *rays->node);
    rays->node_state = malloc(nodes * sizeof *rays->node_state);
    rays->cell_ready = malloc((size_t)rays->cells * sizeof *rays->cell_ready);
    if (!rays->ray || !rays->exists || !rays->node || !rays->node_state || !rays->cell_ready)
        return error_set(err, ERR_MEMORY, "no memory for a row of rays");
    return true;
}

bool rays_init(struct rays *rays, const struct camera *camera, struct error *err)
{
    return init(rays, camera, 0.5, err);
}

bool rays_init_corners(struct rays *rays, const struct camera *camera, struct error *err)
{
    return init(rays, camera, 0, err);
}

void rays_release(struct rays *rays)
{
    free(rays->ray);
    free(rays->exists);
    free(rays->node);
    free(rays->node_state);
    free(rays->cell_ready);
    *rays = (struct rays){ 0 };
}

void rays_begin_row(struct rays *rays, int y)
{
    rays->y = y;
    if (rays->pinhole) return;
    memset(rays->node_state, NODE_UNKNOWN, ((size_t)rays->cells + 3) * sizeof *rays->node_state);
    memset(rays->cell_ready, 0, (size_t)rays->cells * sizeof *rays->cell_ready);
}

/* index 0 is x = -width_px */
static bool exact(const struct rays *rays, struct vec3 *direction, int index)
{
    struct error none = ERROR_NONE;
    return camera_unproject(rays->camera, direction,
                            (struct vec2){ index - rays->camera->width_px + rays->within_px, rays->y + rays->within_px }, &none);
}

static bool node(struct rays *rays, int k)
{
    if (rays->node_state[k] == NODE_UNKNOWN)
        rays->node_state[k] = exact(rays, &rays->node[k], (k - 1) * CELL_PX) ? NODE_KNOWN : NODE_NONE;
    return rays->node_state[k] == NODE_KNOWN;
}

/* Lagrange's cubic through the four nodes around a cell, at t from 0 to 1 across it. */
static struct vec3 between(const struct vec3 p[4], double t)
{
    double a = -t * (t - 1) * (t - 2) / 6, b = (t + 1) * (t - 1) * (t - 2) / 2, c = -(t + 1) * t * (t - 2) / 2,
           d = (t + 1) * t * (t - 1) / 6;
    return vec3_unit(vec3(a * p[0].x + b * p[1].x + c * p[2].x + d * p[3].x,
                          a * p[0].y + b * p[1].y + c * p[2].y + d * p[3].y,
                          a * p[0].z + b * p[1].z + c * p[2].z + d * p[3].z));
}

static void make_cell(struct rays *rays, int cell)
{
    int first = cell * CELL_PX, middle = CELL_PX / 2;
    struct vec3 there;
    bool smooth = node(rays, cell) && node(rays, cell + 1) && node(rays, cell + 2) && node(rays, cell + 3) &&
                  exact(rays, &there, first + middle);
    if (smooth) {
        double off = vec3_norm(vec3_sub(between(&rays->node[cell], (double)middle / CELL_PX), there));
        smooth = off * fmax(rays->in.fx_px, rays->in.fy_px) <= RAYS_TOLERANCE_PX;
    }
    for (int i = 0; i < CELL_PX; i++) {
        if (smooth) rays->ray[first + i] = between(&rays->node[cell], (double)i / CELL_PX);
        rays->exists[first + i] = smooth || exact(rays, &rays->ray[first + i], first + i);
    }
    rays->cell_ready[cell] = true;
}

bool rays_get(struct rays *rays, struct vec3 *direction, int x)
{
    if (rays->pinhole) {
        *direction = vec3_unit(
            vec3((x + rays->within_px - rays->in.cx_px) / rays->in.fx_px,
                 (rays->y + rays->within_px - rays->in.cy_px) / rays->in.fy_px, 1));
        return true;
    }
    int index = x + rays->camera->width_px;
    if (!rays->cell_ready[index / CELL_PX]) make_cell(rays, index / CELL_PX);
    if (rays->exists[index]) *direction = rays->ray[index];
    return rays->exists[index];
}

#include "gen/world/shading.h"

#include "gen/world/cut_rays.h"

#include <stdlib.h>

/* Does a shadow fall from p on something? */
static bool casts(const struct cut_rays *receivers, const float p[3], const struct vec3 *towards, size_t n)
{
    struct vec3 from = vec3((double)p[0], (double)p[1], (double)p[2]);
    for (size_t i = 0; i < n; i++)
        if (cut_rays_blocked(receivers, from, vec3_scale(towards[i], -1), INFINITY)) return true;
    return false;
}

static bool is_large(const struct static_cut *cut, const uint32_t triangle[3])
{
    for (int k = 0; k < 3; k++) {
        const float *a = cut->position_m[triangle[k]], *b = cut->position_m[triangle[(k + 1) % 3]];
        struct vec3 edge = vec3((double)(b[0] - a[0]), (double)(b[1] - a[1]), (double)(b[2] - a[2]));
        if (vec3_norm(edge) > SHADING_SAMPLE_M) return true;
    }
    return false;
}

/* Mark the corners of every triangle that has a marked one. Out: to (cut->vertices) */
static void spread(bool *to, const bool *from, const struct static_cut *cut)
{
    for (size_t i = 0; i < cut->triangles; i++) {
        const uint32_t *t = cut->triangle[i];
        if (from[t[0]] || from[t[1]] || from[t[2]]) to[t[0]] = to[t[1]] = to[t[2]] = true;
    }
}

/* Out: taken (cut->triangles) those that have a marked corner */
static void take(bool *taken, const bool *marked, const struct static_cut *cut)
{
    for (size_t i = 0; i < cut->triangles; i++) {
        const uint32_t *t = cut->triangle[i];
        taken[i] = marked[t[0]] || marked[t[1]] || marked[t[2]];
    }
}

bool shading_part(struct static_cut *shading, struct static_cut *rest, const struct static_cut *cut,
                  const struct static_cut *receivers, const struct vec3 *towards, size_t n, struct error *err)
{
    struct cut_rays *rays = NULL;
    if (!cut_rays_create(&rays, receivers, err)) return false;
    bool *casting = calloc(cut->vertices + 1, sizeof *casting), *near = calloc(cut->vertices + 1, sizeof *near);
    bool *taken = calloc(cut->triangles + 1, sizeof *taken);
    struct static_cut part = { 0 };
    bool ok = casting && near && taken;
    for (size_t i = 0; ok && i < cut->vertices; i++) casting[i] = casts(rays, cut->position_m[i], towards, n);
    for (size_t i = 0; ok && i < cut->triangles; i++)
        for (int k = 0; is_large(cut, cut->triangle[i]) && k < 3; k++) near[cut->triangle[i][k]] = true;
    if (ok) spread(near, casting, cut);
    if (ok) take(taken, near, cut);
    ok = ok && static_cut_pick(&part, cut, taken, true) && static_cut_pick(rest, cut, taken, false);
    if (ok) *shading = part;
    else static_cut_release(&part);
    free(taken);
    free(near);
    free(casting);
    cut_rays_destroy(rays);
    return ok || error_set(err, ERR_MEMORY, "no memory for what shades the place");
}

#include "gen/light/hidden_place.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CORNERS = 12 };
#define OFF_M 0.35       /* before what is looked at, nothing of its own surface is met */
#define HIGH_M 200.0     /* above the look, and below */
#define GRAZING 0.1      /* cosine: what is seen flatter is on no relief */

/* The place round each entity. Out: corners (n, CORNERS), prisms (n) that borrow them */
static void surround(struct prism *prisms, struct vec2 (*corners)[CORNERS], const struct relief_input *in)
{
    for (size_t i = 0; i < in->n; i++) {
        struct vec3 at = in->entities[i].world_from_entity.translation;
        for (int k = 0; k < CORNERS; k++) {
            double turn = 2 * M_PI * k / CORNERS;
            corners[i][k] = (struct vec2){ at.x + HIDDEN_PLACE_REACH_M * cos(turn), at.y + HIDDEN_PLACE_REACH_M * sin(turn) };
        }
        prisms[i] = (struct prism){ corners[i], CORNERS, at.z, { 0, 0, 1 }, -HIGH_M, HIGH_M };
    }
}

static struct vec3 corner_of(const struct static_cut *cut, size_t triangle, int k)
{
    const float *p = cut->position_m[cut->triangle[triangle][k]];
    return vec3((double)p[0], (double)p[1], (double)p[2]);
}

/* Does it stand, and is it on no relief? */
static bool is_hidden(const struct relief_input *in, const struct static_cut *cut, size_t triangle)
{
    struct vec3 a = corner_of(cut, triangle, 0), b = corner_of(cut, triangle, 1), c = corner_of(cut, triangle, 2);
    struct vec3 normal = vec3_cross(vec3_sub(b, a), vec3_sub(c, a)), middle = vec3_scale(vec3_add(a, vec3_add(b, c)), 1.0 / 3);
    double area = vec3_norm(normal), range = vec3_norm(vec3_sub(middle, in->from_m));
    if (!(area > 0) || (middle.z < in->from_m.z && fabs(normal.z) > RELIEF_LEVEL * area)) return false;
    if (!(range > OFF_M)) return true;
    struct vec3 look = vec3_scale(vec3_sub(middle, in->from_m), 1 / range);
    return look.z < -sin(RELIEF_LOWEST_RAD) || fabs(vec3_dot(look, normal)) < GRAZING * area ||
           static_mesh_blocks(in->place, in->from_m, look, 0, range - OFF_M);
}

/* Out: *taken (cut->triangles), the caller's. Returns how many, or -1 without memory */
static int take_hidden(bool **taken, const struct relief_input *in, const struct static_cut *cut)
{
    int n = 0;
    *taken = malloc(cut->triangles + 1);
    for (size_t i = 0; *taken && i < cut->triangles; i++) n += (*taken)[i] = is_hidden(in, cut, i);
    return *taken ? n : -1;
}

/* The means of the corners' colours. */
static void paint(struct image *radiance, const struct static_cut *cut, const bool *taken, const double color_gain[3])
{
    float *at = radiance->data;
    for (size_t i = 0; i < cut->triangles; i++) {
        if (!taken[i]) continue;
        const uint32_t *t = cut->triangle[i];
        for (int c = 0; c < 3; c++) *at++ = (float)color_gain[c] * (cut->color[t[0]][c] + cut->color[t[1]][c] + cut->color[t[2]][c]) / 3;
    }
}

bool hidden_place_create(struct hidden_place *hidden, const struct relief_input *in, const double color_gain[3], struct error *err)
{
    struct hidden_place out = { 0 };
    struct static_cut cut = { 0 };
    struct prism *prisms = calloc(in->n + 1, sizeof *prisms);
    struct vec2 (*corners)[CORNERS] = calloc(in->n + 1, sizeof *corners);
    bool *taken = NULL, ok = (prisms && corners) || error_set(err, ERR_MEMORY, "no memory for what mirrors show of the place");
    if (ok) surround(prisms, corners, in);
    ok = ok && static_mesh_cut(in->place, &cut, prisms, in->n, err);
    if (ok) {
        int n = take_hidden(&taken, in, &cut), rows = n / HIDDEN_PLACE_COLUMNS + 1;
        ok = (n >= 0 && static_cut_pick(&out.part, &cut, taken, true)) || error_set(err, ERR_MEMORY, "no memory for what mirrors show of the place");
        ok = ok && image_init(&out.radiance, HIDDEN_PLACE_COLUMNS, rows, 3, PIXEL_F32, err);
        if (ok) paint(&out.radiance, &cut, taken, color_gain);
    }
    free(taken);
    free(corners);
    free(prisms);
    static_cut_release(&cut);
    if (ok) *hidden = out;
    else hidden_place_release(&out);
    return ok;
}

void hidden_place_release(struct hidden_place *hidden)
{
    static_cut_release(&hidden->part);
    image_release(&hidden->radiance);
    *hidden = (struct hidden_place){ 0 };
}

#include "gen/world/surroundings.h"

#include <math.h>
#include <stdlib.h>

/* What hangs over an entity higher than this takes little of the sky's light from it. */
static const double overhang_m = 15;
/* The ground falls or rises beside an entity by at most this. */
static const double drop_m = 4;

bool surroundings_create(struct surroundings *out, const struct receiver *receivers, const struct entity *entities,
                         size_t n, const struct light *light, double top_m, struct error *err)
{
    struct surroundings s = { .n = n };
    size_t corners = 0;
    for (size_t i = 0; i < n; i++) corners += receivers[i].corners;
    s.receivers = calloc(n + 1, sizeof *s.receivers);
    s.shades = calloc(2 * n + 1, sizeof *s.shades);
    s.corner_m = calloc(corners + 1, sizeof *s.corner_m);
    if (!s.receivers || !s.shades || !s.corner_m) {
        surroundings_release(&s);
        return error_set(err, ERR_MEMORY, "no memory for the surroundings");
    }
    struct vec2 *at = s.corner_m;
    for (size_t i = 0; i < n; i++) {
        double base = entities[i].world_from_entity.translation.z;
        /* Shadows fall downward: nothing much higher than an entity takes any of its. */
        struct prism prism = { at, receivers[i].corners, base, vec3(0, 0, 1), -drop_m, entities[i].model->max_m.z + 0.5 };
        for (size_t k = 0; k < receivers[i].corners; k++)
            *at++ = (struct vec2){ receivers[i].corner_m[k].x, receivers[i].corner_m[k].y };
        s.receivers[i] = prism;
        prism.above_m = overhang_m;
        s.shades[s.shade_count++] = prism;
        if (!light->has_sun || light->sun_direction.z <= 0.01) continue;
        prism.axis = light->sun_direction;
        prism.above_m = fmax(top_m - base, overhang_m);
        s.shades[s.shade_count++] = prism;
    }
    *out = s;
    return true;
}

void surroundings_release(struct surroundings *s)
{
    free(s->receivers);
    free(s->shades);
    free(s->corner_m);
    *s = (struct surroundings){ 0 };
}

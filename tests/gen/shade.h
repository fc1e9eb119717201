/* The sky's light on the ground of passes, as frames have it. */
#ifndef STAFFAGE_TESTS_GEN_SHADE_H
#define STAFFAGE_TESTS_GEN_SHADE_H

#include "gen/render/passes.h"
#include "gen/trace/shaded_ground.h"

#include <string.h>

/* In/out: ground: what passes->receivers is to be, unlit
 * In:     receivers of passes' entities; place: as struct sky_sight_input's near */
static bool shade_ground(struct shaded_ground *ground, const struct passes *passes, const struct receiver *receivers,
                         const struct static_cut *place, struct error *err)
{
    struct pass_settings settings = pass_settings(passes->scene->quality);
    struct shaded_ground_detail detail = { passes->world_from_camera.translation, 1 / passes->view.fx_px, settings.fine_px, passes->scene->wet, { 0 } };
    memcpy(detail.albedo, passes->scene->ground_albedo, sizeof detail.albedo);
    struct sky_sight *sight = NULL;
    struct tracer *tracer = NULL;
    bool ok = tracer_create(&tracer, NULL, 0, err) && /* each model gets a tree of its own */
              sky_sight_create(&sight, &(struct sky_sight_input){ .light = passes->light, .directions = settings.sky_directions, .near = place }, err);
    for (size_t i = 0; ok && i < passes->entity_count; i++)
        ok = sky_sight_add(sight, tracer, &passes->entities[i], &receivers[i], err);
    ok = ok && shaded_ground_shade(ground, sight, detail, err);
    sky_sight_destroy(sight);
    tracer_destroy(tracer);
    return ok;
}

#endif

#include "gen/frame_impl.h"

#include "gen/render/place_sdl.h"
#include "gen/world/shading.h"
#include "lib/file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The parts of the static mesh that the entities that matter need, and a plane below them.
 * Out: path of the include, relative to the output folder */
static bool write_place(char path[64], struct plane *below, const struct frame *f, struct error *err)
{
    struct static_cut receivers = { 0 }, around = { 0 }, shades = { 0 }, rest = { 0 };
    struct vec3 *lights = NULL;
    size_t light_count = 0;
    struct prism *near = calloc(f->around.n + 1, sizeof *near), *above = calloc(f->around.shade_count + 1, sizeof *above);
    size_t near_count = 0, above_count = 0, per_entity = f->around.n ? f->around.shade_count / f->around.n : 0;
    bool ok = (near && above) || error_set(err, ERR_MEMORY, "no memory for the place");
    for (size_t i = 0; ok && i < f->around.n; i++) {
        if (!f->matters[i]) continue;
        near[near_count++] = f->around.receivers[i];
        for (size_t k = 0; k < per_entity; k++) above[above_count++] = f->around.shades[i * per_entity + k];
    }
    ok = ok && static_mesh_cut(f->stage->mesh, &receivers, near, near_count, err) &&
         static_mesh_cut(f->stage->mesh, &around, above, above_count, err) &&
         pass_lights(&lights, &light_count, f->scene, f->context->light, err) &&
         shading_part(&shades, &rest, &around, &receivers, lights, light_count, err);
    snprintf(path, 64, "frames/%s/place.inc", f->name);
    char *file = string_format("%s/place.inc", f->folder);
    ok = ok && (file || error_set(err, ERR_MEMORY, "no memory for a path")) &&
         place_include_write(file, &receivers, &shades, &rest, err);
    double lowest = INFINITY;
    for (size_t i = 0; i < f->moment.n; i++)
        if (f->matters[i]) lowest = fmin(lowest, f->moment.entities[i].world_from_entity.translation.z);
    for (size_t i = 0; i < receivers.vertices; i++) lowest = fmin(lowest, (double)receivers.position_m[i][2]);
    *below = (struct plane){ vec3(0, 0, 1), lowest - 0.5 };
    static_cut_release(&receivers);
    static_cut_release(&around);
    static_cut_release(&shades);
    static_cut_release(&rest);
    free(lights);
    free(file);
    free(near);
    free(above);
    return ok;
}

bool frame_write_passes(struct frame *f, const struct view *view, struct error *err)
{
    const struct frame_context *c = f->context;
    struct entity *entities = calloc(f->moment.n + 1, sizeof *entities);
    struct receiver *receivers = calloc(f->moment.n + 1, sizeof *receivers);
    struct model_include *includes = calloc(f->moment.n + 1, sizeof *includes);
    size_t n = 0;
    char place[64];
    struct pass_surroundings surroundings;
    bool ok = (entities && receivers && includes) || error_set(err, ERR_MEMORY, "no memory for a frame");
    for (size_t i = 0; ok && i < f->moment.n; i++) {
        if (!f->matters[i]) continue;
        size_t model = f->moment.model_index[i];
        bool posed = f->moment.entities[i].model != f->stage->models[model];
        entities[n] = f->moment.entities[i];
        receivers[n] = f->receivers[i];
        includes[n] = posed ? model_include_posed(f->name, &entities[n]) : model_include(model, &entities[n]);
        ok = model_include_write(&includes[n], posed ? NULL : c->includes, c->out_folder, &entities[n], err);
        n++;
    }
    struct passes passes = {
        .scene = f->scene, .sky_map = c->sky_map, .light = c->light, .view = *view,
        .world_from_camera = f->shot->world_from_camera, .entities = entities, .includes = includes, .entity_count = n,
        .ground = f->scene->ground, .receivers = receivers, .receiver_count = n,
        .place_include = f->stage->mesh ? place : NULL, .surroundings = &surroundings,
    };
    ok = ok && frame_write_surroundings(&surroundings, f, err) && (!f->stage->mesh || write_place(place, &passes.ground, f, err)) && passes_write(f->folder, &passes, err);
    free(entities);
    free(receivers);
    free(includes);
    return ok;
}

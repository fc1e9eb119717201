#include "gen/frame_impl.h"

#include "gen/render/place_sdl.h"
#include "gen/trace/sunlit_ground.h"
#include "gen/world/shading.h"
#include "lib/file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Paths of a frame's place, relative to the output folder. */
struct place_files { char place[64], shades[64]; };

/* The parts of the static mesh that the entities that matter need, and a plane below them.
 * Out: ground (unlit), around: what can be in the way of its light, shades: of the sun's; the caller's, after a failure, too */
static bool write_place(struct place_files *files, struct shaded_ground *ground, struct static_cut *around, struct static_cut *shades,
                        struct plane *below, const struct frame *f, struct error *err)
{
    struct static_cut receivers = { 0 }, rest = { 0 };
    struct prism *near = calloc(f->around.n + 1, sizeof *near), *above = calloc(f->around.shade_count + 1, sizeof *above);
    const struct light *light = f->context->light;
    size_t near_count = 0, above_count = 0, per_entity = f->around.n ? f->around.shade_count / f->around.n : 0;
    bool ok = (near && above) || error_set(err, ERR_MEMORY, "no memory for the place");
    for (size_t i = 0; ok && i < f->around.n; i++) {
        if (!f->matters[i]) continue;
        near[near_count++] = f->around.receivers[i];
        for (size_t k = 0; k < per_entity; k++) above[above_count++] = f->around.shades[i * per_entity + k];
    }
    ok = ok && static_mesh_cut(f->stage->mesh, &receivers, near, near_count, err) &&
         static_mesh_cut(f->stage->mesh, around, above, above_count, err) &&
         shading_part(shades, &rest, around, &receivers, &light->sun_direction, light->has_sun, err) &&
         shaded_ground_of_cut(ground, &receivers, err);
    snprintf(files->place, sizeof files->place, "frames/%s/place.inc", f->name);
    char *place = string_format("%s/place.inc", f->folder);
    ok = ok && (place || error_set(err, ERR_MEMORY, "no memory for a path")) && place_include_write(place, &receivers, &rest, err);
    double lowest = INFINITY;
    for (size_t i = 0; i < f->moment.n; i++)
        if (f->matters[i]) lowest = fmin(lowest, f->moment.entities[i].world_from_entity.translation.z);
    for (size_t i = 0; i < receivers.vertices; i++) lowest = fmin(lowest, (double)receivers.position_m[i][2]);
    *below = (struct plane){ vec3(0, 0, 1), lowest - 0.5 };
    static_cut_release(&receivers);
    static_cut_release(&rest);
    free(place);
    free(near);
    free(above);
    return ok;
}

/* Once it is known where the photograph tells of the shade. */
static bool write_shades(struct place_files *files, struct static_cut *shades, const struct frame *f, const struct sun_share *share, struct error *err)
{
    size_t told[TOLD_KINDS];
    snprintf(files->shades, sizeof files->shades, "frames/%s/shades.inc", f->name);
    char *path = string_format("%s/shades.inc", f->folder);
    bool ok = (path || error_set(err, ERR_MEMORY, "no memory for a path")) &&
              sun_share_part(told, share, shades, f->context->light->sun_direction, err) && shades_include_write(path, shades, told, err);
    free(path);
    return ok;
}

/* The sky past the entities that matter and, unless around is NULL, the place. In: lit  what stands round; NULL: nothing, and they send nothing back
 * Out: *sight, the caller's, after a failure, too */
static bool open_sight(struct sky_sight **sight, const struct static_cut *around, const struct pass_surroundings *lit, const struct frame *f, struct error *err)
{
    struct sky_sight_input in = { .light = f->context->light, .directions = pass_settings(f->scene->quality).sky_directions, .near = around };
    if (lit && lit->lighting.data) in.round = (struct sky_round){ &lit->lighting, f->stage->mesh };
    else if (lit) in.round.radiance = &in.light->sky;
    if (lit) in.sun_share = &lit->sun_share;
    bool ok = sky_sight_create(sight, &in, err);
    for (size_t i = 0; ok && i < f->moment.n; i++)
        ok = !f->matters[i] || sky_sight_add(*sight, f->context->tracer, &f->moment.entities[i], &f->receivers[i], err);
    return ok;
}

static bool light_ground(struct shaded_ground *ground, const struct sky_sight *sight, const struct frame *f, struct error *err)
{
    double fine_px = pass_settings(f->scene->quality).fine_px;
    struct shaded_ground_detail detail = { f->shot->world_from_camera.translation, 1 / camera_intrinsics(f->camera).fx_px, fine_px, f->scene->wet, { 0 } };
    memcpy(detail.albedo, f->scene->ground_albedo, sizeof detail.albedo);
    return shaded_ground_shade(ground, sight, detail, err);
}

static bool find_sunlit(struct shaded_ground *ground, const struct passes *p, const struct static_cut *shades, struct error *err)
{
    struct sunlit_input in = { p->light->sun_direction, p->entities, p->entity_count, shades, &p->surroundings->sun_share };
    return !p->light->has_sun || sunlit_ground_find(ground, &in, err);
}

/* The entities that matter, as their passes name them. */
struct cast_list { struct entity *entities; struct receiver *receivers; struct model_include *includes; size_t n; };

static void cast_list_release(struct cast_list *list)
{
    free(list->entities);
    free(list->receivers);
    free(list->includes);
}

/* Their includes are written. Out: *list, the caller's, after a failure, too; receivers are borrowed from the frame */
static bool list_cast(struct cast_list *list, struct frame *f, struct error *err)
{
    const struct frame_context *c = f->context;
    size_t room = f->moment.n + 1;
    *list = (struct cast_list){ calloc(room, sizeof *list->entities), calloc(room, sizeof *list->receivers), calloc(room, sizeof *list->includes), 0 };
    bool ok = (list->entities && list->receivers && list->includes) || error_set(err, ERR_MEMORY, "no memory for a frame");
    for (size_t i = 0; ok && i < f->moment.n; i++) {
        if (!f->matters[i]) continue;
        size_t model = f->moment.model_index[i], n = list->n++;
        bool posed = f->moment.entities[i].model != f->stage->models[model];
        list->entities[n] = f->moment.entities[i];
        list->receivers[n] = f->receivers[i];
        list->includes[n] = posed ? model_include_posed(f->name, &list->entities[n]) : model_include(model, &list->entities[n]);
        ok = model_include_write(&list->includes[n], posed ? NULL : c->includes, c->out_folder, &list->entities[n], err);
    }
    return ok;
}

bool frame_write_passes(struct frame *f, const struct view *view, struct error *err)
{
    const struct frame_context *c = f->context;
    struct cast_list cast;
    struct pass_surroundings surroundings = { 0 };
    struct place_files files;
    struct shaded_ground ground = { 0 };
    struct static_cut around = { 0 }, shades = { 0 };
    struct sky_sight *sight = NULL, *past_entities = NULL;
    bool ok = list_cast(&cast, f, err);
    struct passes passes = {
        .scene = f->scene, .sky_map = c->sky_map, .light = c->light, .view = *view,
        .world_from_camera = f->shot->world_from_camera, .entities = cast.entities, .includes = cast.includes, .entity_count = cast.n,
        .ground = f->scene->ground, .receivers = &ground,
        .place_include = f->stage->mesh ? files.place : NULL, .shades_include = f->stage->mesh ? files.shades : NULL,
        .surroundings = &surroundings,
    };
    ok = ok &&
         (f->stage->mesh ? write_place(&files, &ground, &around, &shades, &passes.ground, f, err)
                         : shaded_ground_of_plane(&ground, &f->scene->ground, cast.receivers, cast.n, err)) &&
         open_sight(&past_entities, NULL, NULL, f, err) && frame_write_surroundings(&surroundings, f, past_entities, err) &&
         open_sight(&sight, &around, &surroundings, f, err) &&
         (!f->stage->mesh || write_shades(&files, &shades, f, &surroundings.sun_share, err)) && light_ground(&ground, sight, f, err) &&
         find_sunlit(&ground, &passes, &shades, err) && passes_write(f->folder, &passes, err);
    sky_sight_destroy(past_entities);
    sky_sight_destroy(sight);
    frame_release_surroundings(&surroundings);
    shaded_ground_release(&ground);
    static_cut_release(&around);
    static_cut_release(&shades);
    cast_list_release(&cast);
    return ok;
}

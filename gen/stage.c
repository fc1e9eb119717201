#include "gen/stage.h"

#include "gen/world/ground.h"
#include "lib/file.h"
#include "lib/place.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEG (180 / M_PI)

/* Boxes may touch: two cars of a real queue stand bumper to bumper. */
static const double overlap_tolerance_m = 0.02;

bool stage_fail(const struct scene *scene, struct source where, struct error *err)
{
    if (!err->file[0]) {
        snprintf(err->file, sizeof err->file, "%s", scene->path);
        err->line = where.line;
        err->column = where.column;
    }
    return false;
}

static bool out_of_memory(struct error *err)
{
    return error_set(err, ERR_MEMORY, "no memory for the scene");
}

/* --- models --- */

static bool warn(struct stage *stage, const char *model, const char *texture, struct error *err)
{
    char **grown = realloc(stage->warnings, (stage->warning_count + 1) * sizeof *grown);
    if (!grown) return out_of_memory(err);
    stage->warnings = grown;
    grown[stage->warning_count] = string_format("%s: texture \"%s\" not found beside it or in the folders around it; "
                                                "its material has its plain colour", model, texture);
    return grown[stage->warning_count++] || out_of_memory(err);
}

/* Of what was loaded: a model can lie in several files (.bin, .mtl, textures). */
static uint64_t hash_model(uint64_t hash, const struct model *model)
{
    for (size_t i = 0; i < model->mesh_count; i++) {
        const struct mesh *m = &model->meshes[i];
        const size_t counts[] = { m->vertices, m->triangles, m->material, m->uv != NULL };
        hash = hash_bytes(hash, counts, sizeof counts);
        hash = hash_bytes(hash, m->position_m, m->vertices * sizeof *m->position_m);
        hash = hash_bytes(hash, m->normal, m->vertices * sizeof *m->normal);
        if (m->uv) hash = hash_bytes(hash, m->uv, m->vertices * sizeof *m->uv);
        hash = hash_bytes(hash, m->triangle, m->triangles * sizeof *m->triangle);
    }
    for (size_t i = 0; i < model->material_count; i++) {
        const struct material *m = &model->materials[i];
        const double figures[] = { m->kind, m->base_color[0], m->base_color[1], m->base_color[2], m->alpha, m->alpha_mode,
                                   m->alpha_cutoff, m->metallic, m->roughness, m->emissive[0], m->emissive[1],
                                   m->emissive[2], m->clearcoat, m->clearcoat_roughness, m->transmission, m->ior,
                                   m->base_image.width_px, m->base_image.height_px, m->base_image.channels };
        hash = hash_bytes(hash, figures, sizeof figures);
        if (m->base_image.data) hash = hash_bytes(hash, m->base_image.data, image_size(&m->base_image));
    }
    return hash;
}

/* In: class_ of who uses it first: a model that says nothing is what its first entity is. */
static bool load_model(struct stage *stage, size_t index, const struct material_rules *rules, enum entity_class class_,
                       struct error *err)
{
    const struct scene_model *named = &stage->scene->models[index];
    if (stage->models[index]) return true;
    struct model_options options = named->options;
    options.rules = rules;
    if (!options.has_class) {
        options.has_class = true;
        options.class_ = class_;
    }
    if (!model_load(&stage->models[index], named->file, &options, err)) return false;
    struct model *model = stage->models[index];
    for (size_t k = 0; k < model->missing_texture_count; k++)
        if (!warn(stage, named->file, model->missing_textures[k], err)) return false;
    stage->hash = hash_model(stage->hash, model);
    return true;
}

static bool load_models(struct stage *stage, const struct material_rules *rules, struct error *err)
{
    const struct scene *s = stage->scene;
    for (size_t i = 0; i < s->entity_count; i++)
        if (!load_model(stage, s->entities[i].model_index, rules, s->entities[i].class_, err)) return false;
    return true;
}

/* --- where things are --- */

/* East and north of a latitude and longitude, in the world's axes. */
static bool world_from_geodetic(struct vec2 *p, const struct scene *s, double latitude_deg, double longitude_deg,
                                struct error *err)
{
    double origin[3] = { s->place.latitude_rad * DEG, s->place.longitude_rad * DEG, s->place.height_m };
    double enu[3], there[3] = { latitude_deg, longitude_deg, s->place.height_m };
    if (!place_enu_from_geodetic(enu, origin, there, err)) return false;
    /* The world's +y may point elsewhere than true north. */
    double c = cos(s->north_rad), n = sin(s->north_rad);
    *p = (struct vec2){ c * enu[0] - n * enu[1], n * enu[0] + c * enu[1] };
    return true;
}

static bool world_from_pixel(struct vec2 *p, const struct stage *stage, struct vec2 q_px, size_t shot, struct error *err)
{
    const struct scene_shot *from = &stage->scene->shots[shot];
    const struct camera *camera = &stage->scene->cameras[from->camera].camera;
    struct vec3 at;
    if (!ground_from_pixel(&at, &stage->scene->ground, camera, from->world_from_camera, q_px, err)) return false;
    *p = (struct vec2){ at.x, at.y };
    return true;
}

static bool find_place(struct vec2 *p, const struct stage *stage, enum place_kind kind, const double at[2], size_t shot,
                       struct error *err)
{
    *p = (struct vec2){ at[0], at[1] };
    switch (kind) {
    case PLACE_GEODETIC: return world_from_geodetic(p, stage->scene, at[0], at[1], err);
    case PLACE_PIXEL: return world_from_pixel(p, stage, *p, shot, err);
    case PLACE_WORLD:
    default: return true;
    }
}

static struct entity scene_entity(const struct stage *stage, size_t i)
{
    const struct scene_entity *e = &stage->scene->entities[i];
    return (struct entity){
        .id = (uint16_t)(i + 1), .name = e->name, .model_name = e->model, .class_ = e->class_,
        .model = stage->models[e->model_index], .has_color = e->has_color,
        .color = { e->color[0], e->color[1], e->color[2] },
    };
}

static bool place_entities(struct stage *stage, struct error *err)
{
    const struct scene *s = stage->scene;
    for (size_t i = 0; i < s->entity_count; i++) {
        const struct scene_entity *e = &s->entities[i];
        struct vec2 p;
        if (!find_place(&p, stage, e->place, e->at, e->shot, err)) {
            stage_fail(s, e->at_source, err);
            return error_prefix(err, "entity \"%s\": ", e->name);
        }
        stage->stand_m[i] = vec3(p.x, p.y, 0);
    }
    return true;
}

static bool stand(struct entity *entity, const struct stage *stage, struct vec2 p, double heading_rad, struct error *err)
{
    (void)err;
    entity->world_from_entity = entity_stand(&stage->scene->ground, vec3(p.x, p.y, 0), heading_rad);
    return true;
}

/* Those that stand run into none of each other. */
static bool check_overlaps(const struct stage *stage, struct error *err)
{
    const struct scene *s = stage->scene;
    struct moment moment;
    if (!stage_at(&moment, stage, 0, err)) return false;
    for (size_t i = 0; i < s->entity_count; i++)
        for (size_t k = 0; k < i; k++)
            if (!s->entities[i].path && !s->entities[k].path &&
                entities_intersect(&moment.entities[i], &moment.entities[k], overlap_tolerance_m))
                error_at(err, ERR_INPUT, s->path, s->entities[i].source.line, s->entities[i].source.column,
                         "entity \"%s\" runs into entity \"%s\" (line %d): their boxes intersect; "
                         "move or turn one of them", s->entities[i].name, s->entities[k].name, s->entities[k].source.line);
    moment_release(&moment);
    return err->code == ERR_OK;
}

bool stage_create(struct stage **out, const struct scene *scene, const struct material_rules *rules, struct error *err)
{
    struct stage *stage = calloc(1, sizeof *stage);
    if (!stage) return out_of_memory(err);
    *stage = (struct stage){ .scene = scene, .hash = FILE_HASH_SEED };
    stage->models = calloc(scene->model_count + 1, sizeof *stage->models);
    stage->gaits = calloc(scene->model_count + 1, sizeof *stage->gaits);
    stage->stand_m = calloc(scene->entity_count + 1, sizeof *stage->stand_m);
    stage->courses = calloc(scene->entity_count + 1, sizeof *stage->courses);
    if (!stage->models || !stage->gaits || !stage->stand_m || !stage->courses) {
        out_of_memory(err);
        goto failed;
    }
    if (!load_models(stage, rules, err) || !place_entities(stage, err) || !check_overlaps(stage, err)) goto failed;
    *out = stage;
    return true;
failed:
    stage_destroy(stage);
    return false;
}

void stage_destroy(struct stage *stage)
{
    if (!stage) return;
    for (size_t i = 0; stage->models && i < stage->scene->model_count; i++) model_destroy(stage->models[i]);
    for (size_t i = 0; i < stage->warning_count; i++) free(stage->warnings[i]);
    free(stage->warnings);
    free(stage->models);
    free(stage->gaits);
    free(stage->stand_m);
    free(stage->courses);
    free(stage);
}

/* --- a moment --- */

bool stage_at(struct moment *out, const struct stage *stage, double time_s, struct error *err)
{
    const struct scene *s = stage->scene;
    struct moment moment = { 0 };
    size_t most = s->entity_count;
    (void)time_s;
    moment.entities = calloc(most + 1, sizeof *moment.entities);
    moment.model_index = calloc(most + 1, sizeof *moment.model_index);
    moment.velocity_m_s = calloc(most + 1, sizeof *moment.velocity_m_s);
    if (!moment.entities || !moment.model_index || !moment.velocity_m_s) {
        out_of_memory(err);
        goto failed;
    }
    for (size_t i = 0; i < s->entity_count; i++) {
        moment.entities[i] = scene_entity(stage, i);
        moment.model_index[i] = s->entities[i].model_index;
        struct vec2 p = { stage->stand_m[i].x, stage->stand_m[i].y };
        if (!stand(&moment.entities[i], stage, p, s->entities[i].heading_rad, err)) goto failed;
        moment.n++;
    }
    *out = moment;
    return true;
failed:
    moment_release(&moment);
    return false;
}

void moment_release(struct moment *moment)
{
    free(moment->entities);
    free(moment->model_index);
    free(moment->velocity_m_s);
    free(moment->names);
    *moment = (struct moment){ 0 };
}

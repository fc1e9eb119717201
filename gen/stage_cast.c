#include "gen/stage_cast.h"

#include "gen/detail.h"
#include "gen/model/rig.h"
#include "lib/draw.h"
#include "lib/file.h"

#include <stdlib.h>
#include <string.h>

/* --- who is who --- */

void stage_cast_entities(struct stage *stage)
{
    const struct scene *s = stage->scene;
    for (size_t i = 0; i < s->entity_count; i++) {
        const struct scene_choice *choice = &s->entities[i].choice;
        struct draw_key key = { .seed = (uint64_t)s->seed, .entity = (uint32_t)(i + 1), .purpose = DRAW_CAST };
        stage->cast[i] = choice->models[draw_weighted(key, choice->weights, choice->count)];
        stage->hash = hash_bytes(stage->hash, &stage->cast[i], sizeof stage->cast[i]);
    }
}

enum entity_class stage_class(const struct stage *stage, size_t entity)
{
    const struct scene_entity *e = &stage->scene->entities[entity];
    return e->has_class ? e->class_ : stage->scene->models[stage->cast[entity]].class_;
}

const double *stage_color(const struct stage *stage, size_t model, uint16_t id)
{
    const struct scene_model *of = &stage->scene->models[model];
    struct draw_key key = { .seed = (uint64_t)stage->scene->seed, .entity = id, .purpose = DRAW_PAINT };
    double sum = 0;
    for (size_t i = 0; i < of->color_count; i++) sum += of->colors[i].weight;
    double left = draw_uniform(key, 0) * sum;
    size_t i = 0;
    while (i + 1 < of->color_count && left >= of->colors[i].weight) left -= of->colors[i++].weight;
    return of->color_count ? of->colors[i].linear : NULL;
}

/* --- what they look like --- */

bool stage_warn(struct stage *stage, char *text, struct error *err)
{
    char **grown = text ? realloc(stage->warnings, (stage->warning_count + 1) * sizeof *grown) : NULL;
    if (!grown) {
        free(text);
        return error_set(err, ERR_MEMORY, "no memory for a warning");
    }
    stage->warnings = grown;
    grown[stage->warning_count++] = text;
    return true;
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
    return model->rig ? rig_hash(hash, model->rig) : hash;
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
    const char *file = detail_file(named, stage->details[index]);
    if (!model_load(&stage->models[index], file, &options, err)) return false;
    struct model *model = stage->models[index];
    if (model->rig && !repertoire_create(&stage->repertoires[index], model, err)) return false;
    for (size_t k = 0; k < model->missing_texture_count; k++)
        if (!stage_warn(stage, string_format("%s: texture \"%s\" not found beside it or in the folders around it; its material has its "
                                       "plain colour", file, model->missing_textures[k]), err))
            return false;
    stage->hash = hash_bytes(hash_model(stage->hash, model), named->colors, named->color_count * sizeof *named->colors);
    return true;
}

/* Who comes by walks by an animation: without one it glides. */
static bool warn_of_gliding(struct stage *stage, size_t model, struct error *err)
{
    if (stage->models[model]->rig) return true;
    return stage_warn(stage, string_format("%s: has no animation: as traffic it glides over the ground; glTF with a skin walks",
                                     stage->models[model]->path), err);
}

/* The coarser levels of the cast have no driver; where the finest has none either, somebody may sit there in the model's one piece. */
static bool warn_of_parked(struct stage *stage, size_t entity, struct error *err)
{
    const struct scene_entity *e = &stage->scene->entities[entity];
    const struct scene_model *named = &stage->scene->models[stage->cast[entity]];
    const struct model *model = stage->models[stage->cast[entity]];
    if (!e->parked || model_has_driver(model) || strcmp(model->path, detail_file(named, DETAIL_NEAR)) != 0) return true;
    return stage_warn(stage, string_format("%s:%d:%d: entity \"%s\" is parked, but %s has no driver that can be left out: an animated glTF "
                                           "with a node \"driver\" would be right", stage->scene->path, e->source.line, e->source.column,
                                           e->name, model->path), err);
}

bool stage_load_models(struct stage *stage, const struct material_rules *rules, struct error *err)
{
    const struct scene *s = stage->scene;
    for (size_t i = 0; i < s->entity_count; i++)
        if (!load_model(stage, stage->cast[i], rules, stage_class(stage, i), err) || !warn_of_parked(stage, i, err)) return false;
    const struct scene_movers *const movers[] = { &s->vehicles, &s->people };
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < movers[k]->choice.count; i++) {
            size_t model = movers[k]->choice.models[i];
            if (!load_model(stage, model, rules, s->models[model].class_, err) ||
                (movers[k] == &s->people && !warn_of_gliding(stage, model, err)))
                return false;
        }
    return true;
}

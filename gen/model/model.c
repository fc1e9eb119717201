#include "gen/model/model.h"

#include "gen/model/model_import.h"
#include "gen/model/model_texture.h"
#include "gen/model/rig.h"
#include "lib/file.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* A longest side outside of this is a wrong unit, not a model of a thing on a road. */
#define SIZE_MIN_M 0.05
#define SIZE_MAX_M 500.0

static const struct { const char *extension; bool (*import)(struct import *, const char *, struct error *); bool knows_axes; } formats[] = {
    { ".gltf", import_gltf, true },   { ".glb", import_gltf, true },    { ".obj", import_assimp, false },
    { ".ply", import_ply, false }, { ".dae", import_assimp, false }, { ".fbx", import_assimp, false },
};

const char *axis_name(enum axis axis)
{
    static const char *const names[] = { "+x", "-x", "+y", "-y", "+z", "-z" };
    return names[axis];
}

bool axis_from_name(enum axis *axis, const char *name)
{
    for (int i = AXIS_POS_X; i <= AXIS_NEG_Z; i++)
        if (!strcmp(name, axis_name((enum axis)i)) || (i % 2 == 0 && !strcmp(name, axis_name((enum axis)i) + 1))) {
            *axis = (enum axis)i;
            return true;
        }
    return false;
}

static struct vec3 axis_vector(enum axis axis)
{
    double sign = axis % 2 ? -1 : 1;
    return vec3(axis / 2 == 0 ? sign : 0, axis / 2 == 1 ? sign : 0, axis / 2 == 2 ? sign : 0);
}

/* Rows are the entity's forward, left and up in the file's axes. Left = up x forward makes it a
 * rotation whatever the two axes are: nothing is ever mirrored. */
static bool entity_from_file(struct mat3 *rotation, const char *path, const struct model_options *options, bool format_knows, struct error *err)
{
    if (!options->axes_given && !format_knows)
        return error_at(err, ERR_INPUT, path, 0, 0, "this format does not tell which axes are up and front: say so in the scene, for example \"up: z\" and \"front: -y\"");
    struct vec3 up = axis_vector(options->axes_given ? options->up : AXIS_POS_Y);
    struct vec3 front = axis_vector(options->axes_given ? options->front : AXIS_POS_Z);
    if (vec3_dot(up, front) != 0)
        return error_at(err, ERR_INPUT, path, 0, 0, "up and front lie along the same axis of the file: two different axes would be right");
    *rotation = mat3_transpose(mat3_from_columns(front, vec3_cross(up, front), up));
    return true;
}

static void apply_rotation(struct model *model, struct mat3 rotation)
{
    for (size_t i = 0; i < model->mesh_count; i++) {
        struct mesh *mesh = &model->meshes[i];
        for (size_t v = 0; v < mesh->vertices; v++) {
            float *p = mesh->position_m[v], *n = mesh->normal[v];
            struct vec3 q = mat3_apply(rotation, vec3((double)p[0], (double)p[1], (double)p[2]));
            struct vec3 m = mat3_apply(rotation, vec3((double)n[0], (double)n[1], (double)n[2]));
            p[0] = (float)q.x, p[1] = (float)q.y, p[2] = (float)q.z;
            n[0] = (float)m.x, n[1] = (float)m.y, n[2] = (float)m.z;
        }
    }
}

static void measure(struct model *model)
{
    struct vec3 low = { DBL_MAX, DBL_MAX, DBL_MAX }, high = { -DBL_MAX, -DBL_MAX, -DBL_MAX };
    for (size_t i = 0; i < model->mesh_count; i++)
        for (size_t v = 0; v < model->meshes[i].vertices; v++) {
            const float *p = model->meshes[i].position_m[v];
            low = vec3(fmin(low.x, (double)p[0]), fmin(low.y, (double)p[1]), fmin(low.z, (double)p[2]));
            high = vec3(fmax(high.x, (double)p[0]), fmax(high.y, (double)p[1]), fmax(high.z, (double)p[2]));
        }
    model->min_m = low;
    model->max_m = high;
}

/* Metres to a unit of the file. */
static bool find_scale(double *scale, const struct model *model, double file_unit_m, const char *path, const struct model_options *options, struct error *err)
{
    if ((options->unit_m > 0) + (options->length_m > 0) + (options->height_m > 0) > 1)
        return error_at(err, ERR_INPUT, path, 0, 0, "a unit, a length and a height exclude each other: give one of them in the scene");
    double length = model->max_m.x - model->min_m.x, height = model->max_m.z - model->min_m.z;
    if ((options->length_m > 0 && !(length > 0)) || (options->height_m > 0 && !(height > 0)))
        return error_at(err, ERR_INPUT, path, 0, 0, "is flat along the axis that the scene gives a real size for");
    if (options->length_m > 0) *scale = options->length_m / length;
    else if (options->height_m > 0) *scale = options->height_m / height;
    else if (options->unit_m > 0) *scale = options->unit_m;
    else if (file_unit_m > 0) *scale = file_unit_m;
    else return error_at(err, ERR_INPUT, path, 0, 0, "this file does not tell its unit: say so in the scene, for example \"unit_m: 0.01\", or give its real size, for example \"length_m: 4.2\"");
    return true;
}

/* Scale, and put the middle of the box over the origin and its lowest vertex on the ground. */
static bool stand(struct model *model, struct mat3 rotation, double scale, const char *path, struct error *err)
{
    struct vec3 size = vec3_scale(vec3_sub(model->max_m, model->min_m), scale);
    double longest = fmax(size.x, fmax(size.y, size.z));
    double origin[3] = { (model->min_m.x + model->max_m.x) / 2, (model->min_m.y + model->max_m.y) / 2, model->min_m.z };
    if (!(longest >= SIZE_MIN_M && longest <= SIZE_MAX_M))
        return error_at(err, ERR_INPUT, path, 0, 0, "would be %.4g m long with a unit of %.4g m: the unit cannot be right", longest, scale);
    for (size_t i = 0; i < model->mesh_count; i++)
        for (size_t v = 0; v < model->meshes[i].vertices; v++)
            for (int k = 0; k < 3; k++) {
                float *x = &model->meshes[i].position_m[v][k];
                *x = (float)(((double)*x - origin[k]) * scale);
            }
    measure(model);
    model->min_m.z = 0;
    for (int i = 0; model->rig && i < 3; i++)
        for (int j = 0; j < 4; j++) model->rig->entity_from_file.a[i][j] = scale * (j < 3 ? rotation.m[i][j] : -origin[i]);
    return true;
}

/* Only the materials that a mesh shows stay: importers add some that none does. */
static bool drop_unused_materials(struct import *import, struct error *err)
{
    size_t *to = calloc(import->material_count + 1, sizeof *to), kept = 0;
    if (!to) return error_set(err, ERR_MEMORY, "no memory for a model");
    for (size_t i = 0; i < import->mesh_count; i++)
        if (import->meshes[i].triangles > 0) to[import->meshes[i].material] = 1;
    for (size_t i = 0; i < import->material_count; i++) {
        if (!to[i]) continue;
        import->materials[kept] = import->materials[i];
        to[i] = kept++;
    }
    import->material_count = kept;
    for (size_t i = 0; i < import->mesh_count; i++) import->meshes[i].material = to[import->meshes[i].material];
    free(to);
    return true;
}

static bool at_path(const struct model *model, struct error *err)
{
    if (err->code == ERR_INPUT && !err->file[0]) snprintf(err->file, sizeof err->file, "%s", model->path);
    return err->code == ERR_OK;
}

/* Take the meshes over, tidied; the empty ones go. */
static bool take_meshes(struct model *model, struct import *import, struct error *err)
{
    struct rig *rig = import->rig;
    for (size_t i = 0; i < import->mesh_count; i++)
        if (!mesh_tidy(&import->meshes[i], err)) {
            error_prefix(err, "mesh %zu: ", i);
            return at_path(model, err);
        }
    model->meshes = calloc(import->mesh_count + 1, sizeof *model->meshes);
    if (!model->meshes) return error_set(err, ERR_MEMORY, "no memory for a model");
    if (!drop_unused_materials(import, err)) return false;
    for (size_t i = 0; i < import->mesh_count; i++) {
        struct mesh *mesh = &import->meshes[i];
        if (mesh->triangles == 0) continue;
        if (rig) {
            struct rig_mesh keep = rig->meshes[model->mesh_count];
            rig->meshes[model->mesh_count] = rig->meshes[i];
            rig->meshes[i] = keep;
        }
        model->meshes[model->mesh_count++] = *mesh;
        *mesh = (struct mesh){ 0 };
    }
    if (model->mesh_count == 0) return error_at(err, ERR_INPUT, model->path, 0, 0, "has no triangles");
    if (!rig || rig->channel_count == 0) return true; /* what only stands needs no rig any more */
    while (rig->mesh_count > model->mesh_count) rig_mesh_release(&rig->meshes[--rig->mesh_count]);
    model->rig = rig;
    import->rig = NULL;
    return rig_follow(rig, model->meshes, err);
}

static bool take_materials(struct model *model, struct import *import, const struct model_options *options, struct error *err)
{
    model->materials = calloc(import->material_count + 1, sizeof *model->materials);
    if (!model->materials) return error_set(err, ERR_MEMORY, "no memory for a model");
    model->material_count = import->material_count;
    for (size_t i = 0; i < import->material_count; i++) model->materials[i] = import->materials[i].material;
    model->missing_textures = import->missing;
    model->missing_texture_count = import->missing_count;
    import->missing = NULL;
    import->missing_count = 0;
    if (!model_attach_textures(model, import, err)) return false;
    for (size_t i = 0; options->rules && i < model->material_count; i++)
        material_rules_apply(options->rules, &model->materials[i], options->has_class ? options->class_ : CLASS_COUNT);
    return true;
}

bool model_load(struct model **model, const char *path, const struct model_options *options, struct error *err)
{
    const char *extension = strrchr(path_name(path), '.');
    size_t format = 0, known = sizeof formats / sizeof *formats;
    while (format < known && (!extension || strcasecmp(extension, formats[format].extension) != 0)) format++;
    if (!file_exists(path)) return error_at(err, ERR_INPUT, path, 0, 0, "does not exist");
    if (format == known)
        return error_at(err, ERR_INPUT, path, 0, 0, "is no model file by its name: .gltf, .glb, .obj, .ply, .dae or .fbx would be right");
    struct mat3 rotation;
    if (!entity_from_file(&rotation, path, options, formats[format].knows_axes, err)) return false;

    struct import import = { 0 };
    double scale = 1;
    struct model *made = calloc(1, sizeof *made);
    if (!made || !(made->path = strdup(path))) {
        error_set(err, ERR_MEMORY, "no memory for a model");
        goto out;
    }
    if (!formats[format].import(&import, path, err)) goto out;
    if (!take_meshes(made, &import, err) || !take_materials(made, &import, options, err)) goto out;
    apply_rotation(made, rotation);
    measure(made);
    if (!find_scale(&scale, made, import.unit_m, path, options, err)) goto out;
    made->unit_m = scale;
    made->stated_unit_m = import.unit_m;
    made->lowest_m = scale * made->min_m.z;
    if (!stand(made, rotation, scale, path, err)) goto out;
    if (made->rig && !rig_measure_drift(made->rig, err)) at_path(made, err);
    *model = made;
    made = NULL;
out:
    import_release(&import);
    model_destroy(made);
    return err->code == ERR_OK;
}

void model_destroy(struct model *model)
{
    if (!model) return;
    for (size_t i = 0; i < model->mesh_count; i++) mesh_release(&model->meshes[i]);
    for (size_t i = 0; i < model->image_count; i++) image_release(&model->images[i]);
    for (size_t i = 0; i < model->missing_texture_count; i++) free(model->missing_textures[i]);
    free(model->meshes);
    free(model->materials);
    free(model->images);
    free(model->missing_textures);
    for (size_t i = 0; i < model->texture_count; i++) free(model->textures[i]);
    free(model->textures);
    rig_destroy(model->rig);
    free(model->path);
    free(model);
}

/* Half-way between two postures legs are longer than hips are high: bones turn in proportion, heights do not go so. */
static void lift(struct model *model, double up_m)
{
    for (size_t i = 0; i < model->mesh_count; i++)
        for (size_t v = 0; v < model->meshes[i].vertices; v++) model->meshes[i].position_m[v][2] += (float)up_m;
    measure(model);
}

bool model_has_driver(const struct model *model)
{
    const struct rig *rig = model->rig;
    for (size_t i = 0; rig && i < rig->mesh_count; i++)
        if (rig->nodes[rig->meshes[i].node].is_driver) return true;
    return false;
}

static void leave_driver_out(struct model *posed, const struct rig *rig)
{
    size_t kept = 0;
    for (size_t i = 0; i < posed->mesh_count; i++) {
        struct mesh *mesh = &posed->meshes[i];
        if (rig->nodes[rig->meshes[i].node].is_driver) free(mesh->position_m), free(mesh->normal);
        else posed->meshes[kept++] = *mesh;
    }
    posed->mesh_count = kept;
}

bool model_pose(struct model *posed, const struct model *model, const struct posture *posture, struct error *err)
{
    if (!model->rig) return error_at(err, ERR_INPUT, model->path, 0, 0, "has no animation: it cannot move");
    struct model made = *model;
    made.rig = NULL;
    made.meshes = calloc(model->mesh_count, sizeof *made.meshes);
    if (!made.meshes) return error_set(err, ERR_MEMORY, "no memory for a model's pose");
    for (size_t i = 0; i < model->mesh_count; i++) {
        struct mesh *mesh = &made.meshes[i];
        *mesh = model->meshes[i];
        mesh->position_m = malloc(mesh->vertices * sizeof *mesh->position_m);
        mesh->normal = malloc(mesh->vertices * sizeof *mesh->normal);
        if (!mesh->position_m || !mesh->normal) error_set(err, ERR_MEMORY, "no memory for a model's pose");
    }
    if (err->code != ERR_OK || !rig_pose(made.meshes, model->rig, posture, err)) {
        model_posed_release(&made);
        error_prefix(err, "at %.3f s: ", posture->time_s);
        return at_path(model, err);
    }
    if (posture->parked) leave_driver_out(&made, model->rig);
    measure(&made);
    if (posture->share > 0 && posture->share < 1 && made.min_m.z < 0) lift(&made, -made.min_m.z);
    *posed = made;
    return true;
}

void model_posed_release(struct model *posed)
{
    for (size_t i = 0; posed->meshes && i < posed->mesh_count; i++) {
        free(posed->meshes[i].position_m);
        free(posed->meshes[i].normal);
    }
    free(posed->meshes);
    *posed = (struct model){ 0 };
}

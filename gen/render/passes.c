#include "gen/render/passes.h"

#include "gen/render/camera_sdl.h"
#include "gen/render/sdl.h"
#include "gen/model/texture.h"
#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct pass_settings pass_settings(enum quality quality, enum sky_kind sky)
{
    /* Under a clear sky the sun makes the shadow, with edges, and the sky fills it: points of the
     * sky do. Under clouds the sky makes all of it: points would show as steps, and areas of the sky
     * are dear, but what they make is smooth. */
    bool clear = sky == SKY_CLEAR;
    const char *edges = "+A0.03 +AM2 +R1 -J", *fine = "+A0.03 +AM2 +R2 -J", *none = "-A";
    switch (quality) {
    case QUALITY_DRAFT:
        return (struct pass_settings){ 10, false, 30, 0.9, clear ? 1 : 2, none, none };
    case QUALITY_HIGH:
        return (struct pass_settings){ 48, !clear, 200, 0.4, 1, fine, clear ? fine : none };
    case QUALITY_STANDARD:
    default:
        return (struct pass_settings){ clear ? 16 : 24, !clear, 40, 0.8, clear ? 1 : 2, edges, clear ? edges : none };
    }
}

/* --- models --- */

void model_include_name(char name[MODEL_NAME_SIZE], size_t model_index, const struct entity *entity)
{
    if (!entity->has_color) {
        snprintf(name, MODEL_NAME_SIZE, "Model_%zu", model_index);
        return;
    }
    uint64_t hash = hash_bytes(FILE_HASH_SEED, entity->color, sizeof entity->color);
    snprintf(name, MODEL_NAME_SIZE, "Model_%zu_%016llx", model_index, (unsigned long long)hash);
}

/* What lets light through: 0 for all but glass and blended surfaces. */
static double transmittance(const struct material *m)
{
    return m->transmission > 0 ? m->transmission : m->alpha_mode == ALPHA_BLEND ? 1 - m->alpha : 0;
}

static bool write_pigment(struct sdl *sdl, const char *out_folder, const struct model *model, size_t index,
                          const double *paint, struct error *err)
{
    const struct material *m = &model->materials[index];
    sdl_begin(sdl, "pigment");
    if (m->base_image.data) {
        char name[TEXTURE_NAME_SIZE];
        bool has_alpha;
        char *folder = string_format("%s/" TEXTURES_FOLDER, out_folder);
        char *path = NULL;
        bool ok = folder && texture_write(name, &has_alpha, model, index, paint, folder, 0, err);
        if (ok) path = string_format(TEXTURES_FOLDER "/%s", name);
        if (path) {
            sdl_begin(sdl, "image_map");
            sdl_word(sdl, "png");
            sdl_string(sdl, path);
            sdl_word(sdl, "interpolate");
            sdl_number(sdl, 2);
            sdl_end(sdl);
        }
        free(path);
        free(folder);
        if (!ok) return false;
    } else {
        const double *rgb = paint && m->kind == FINISH_PAINT ? paint : m->base_color;
        sdl_color(sdl, rgb);
        if (transmittance(m) > 0) {
            sdl_word(sdl, "transmit");
            sdl_number(sdl, transmittance(m));
        }
    }
    sdl_end(sdl);
    return true;
}

static void write_finish(struct sdl *sdl, const struct material *m)
{
    double f0 = pow((m->ior - 1) / (m->ior + 1), 2);
    if (m->transmission > 0 || m->kind == FINISH_GLASS) {
        sdl_call(sdl, "Finish_Glass", &f0, 1);
        return;
    }
    /* Emission is relative to the pigment in POV-Ray: its luminance is what carries over. */
    double emission = 0.2126 * m->emissive[0] + 0.7152 * m->emissive[1] + 0.0722 * m->emissive[2];
    sdl_call(sdl, "Finish_Surface", (double[]){ m->metallic, m->roughness, m->clearcoat, f0, emission }, 5);
}

static void write_mesh(struct sdl *sdl, const struct mesh *mesh, bool textured)
{
    struct { const char *name; const float (*value)[3]; } lists[] = {
        { "vertex_vectors", (const float (*)[3])mesh->position_m }, { "normal_vectors", (const float (*)[3])mesh->normal }
    };
    for (int k = 0; k < 2; k++) {
        sdl_begin(sdl, lists[k].name);
        sdl_number(sdl, (double)mesh->vertices);
        for (size_t i = 0; i < mesh->vertices; i++) {
            const float *v = lists[k].value[i];
            sdl_comma(sdl);
            sdl_vector(sdl, vec3((double)v[0], (double)v[1], (double)v[2]));
            if (i % 8 == 7) sdl_newline(sdl);
        }
        sdl_end(sdl);
    }
    if (textured) {
        sdl_begin(sdl, "uv_vectors");
        sdl_number(sdl, (double)mesh->vertices);
        for (size_t i = 0; i < mesh->vertices; i++) {
            sdl_comma(sdl);
            sdl_vector2(sdl, (double)mesh->uv[i][0], (double)mesh->uv[i][1]);
            if (i % 8 == 7) sdl_newline(sdl);
        }
        sdl_end(sdl);
    }
    sdl_begin(sdl, "face_indices");
    sdl_number(sdl, (double)mesh->triangles);
    for (size_t i = 0; i < mesh->triangles; i++) {
        const uint32_t *t = mesh->triangle[i];
        sdl_comma(sdl);
        sdl_vector(sdl, vec3(t[0], t[1], t[2]));
        if (i % 8 == 7) sdl_newline(sdl);
    }
    sdl_end(sdl);
}

bool model_include_write(const char *out_folder, size_t model_index, const struct entity *entity, struct error *err)
{
    const struct model *model = entity->model;
    const double *paint = entity->has_color ? entity->color : NULL;
    char name[MODEL_NAME_SIZE];
    model_include_name(name, model_index, entity);
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "a model in one colour: metres, x forward, y left, z up. Needs materials.inc, Shapes_Only");
    sdl_declare(&sdl, name);
    sdl_begin(&sdl, "union");
    bool ok = true;
    for (size_t i = 0; ok && i < model->mesh_count; i++) {
        const struct mesh *mesh = &model->meshes[i];
        const struct material *material = &model->materials[mesh->material];
        bool textured = mesh->uv && material->base_image.data;
        sdl_begin(&sdl, "mesh2");
        write_mesh(&sdl, mesh, textured);
        /* A texture that stops all light need not be read to know the shadow. */
        bool shape_tells = !textured || material->alpha_mode == ALPHA_OPAQUE;
        if (shape_tells) {
            sdl_if(&sdl, "Shapes_Only");
            sdl_begin(&sdl, "pigment");
            sdl_word(&sdl, "rgb");
            sdl_number(&sdl, 0.5);
            sdl_word(&sdl, "transmit");
            sdl_number(&sdl, transmittance(material));
            sdl_end(&sdl);
            sdl_else(&sdl);
        }
        if (textured) {
            sdl_word(&sdl, "uv_mapping");
            sdl_newline(&sdl);
        }
        sdl_begin(&sdl, "texture");
        ok = write_pigment(&sdl, out_folder, model, mesh->material, paint, err);
        write_finish(&sdl, material);
        sdl_end(&sdl);
        if (shape_tells) sdl_endif(&sdl);
        sdl_end(&sdl);
    }
    sdl_end(&sdl);
    char *folder = string_format("%s/" MODELS_FOLDER, out_folder);
    char *path = folder ? string_format("%s/%s.inc", folder, name) : NULL;
    ok = ok && path && folder_make(folder, err) && sdl_write(&sdl, path, err);
    free(path);
    free(folder);
    sdl_release(&sdl);
    return ok;
}

/* --- passes --- */

bool sky_map_write(char path[SKY_MAP_SIZE], const char *out_folder, const struct light *light, struct error *err)
{
    uint64_t hash = hash_bytes(FILE_HASH_SEED, light->sky.data, image_size(&light->sky));
    snprintf(path, SKY_MAP_SIZE, "frames/sky_%016llx.exr", (unsigned long long)hash);
    char *file = string_format("%s/%s", out_folder, path), *folder = string_format("%s/frames", out_folder);
    bool ok = file && folder && folder_make(folder, err) && (file_exists(file) || image_write(file, &light->sky, err));
    free(folder);
    free(file);
    return ok;
}

/* How the sky lights a pass: by radiosity; by lights, with or without something in their way. */
enum lights { LIGHTS_RADIOSITY, LIGHTS_OPEN, LIGHTS_SHADED };

/* What lights give a plane, as one light above it. */
static struct sky_light light_of_plane(const struct sky_light *lights, size_t n, struct vec3 normal)
{
    struct sky_light sum = { .direction = normal };
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) sum.color[c] += lights[i].color[c] * fmax(0, vec3_dot(lights[i].direction, normal));
    return sum;
}

static void write_light(struct sdl *sdl, const struct passes *p, const struct pass_settings *settings, enum lights lights)
{
    const struct light *light = p->light;
    if (light->has_sun) {
        sdl_declare_vector(sdl, "Sun_Direction", light->sun_direction);
        sdl_declare_color(sdl, "Sun_Color", light->sun_color);
        sdl_declare_number(sdl, "Sun_Tangent", tan(SUN_RADIUS_RAD));
        sdl_include(sdl, "sun.inc");
    }
    sdl_declare_string(sdl, "Sky_Map", p->sky_map);
    if (lights == LIGHTS_RADIOSITY || p->scene->ground_reflection > 0) sdl_include(sdl, "sky.inc");
    if (lights == LIGHTS_RADIOSITY) return;
    size_t n = settings->sky_lights;
    struct sky_light *sky = calloc(n, sizeof *sky);
    if (!sky) {
        error_set(&sdl->err, ERR_MEMORY, "no memory for the sky's lights");
        return;
    }
    light_sample_sky(sky, n, light);
    if (lights == LIGHTS_OPEN) { /* with nothing to shade the plane, one light gives what all of them give */
        sky[0] = light_of_plane(sky, n, p->scene->ground.normal);
        n = 1;
    }
    /* Each light's share of the hemisphere as a cone: 2 pi (1 - cos r) = 2 pi / n. */
    double radius = acos(1 - 1.0 / (double)n);
    sdl_declare_number(sdl, "Sky_Light_Soft", settings->soft_sky_lights && n > 1 ? tan(radius) : 0);
    sdl_include(sdl, "sky_lights.inc");
    for (size_t i = 0; i < n; i++) {
        const struct sky_light *s = &sky[i];
        sdl_call(sdl, "Sky_Light",
                 (double[]){ s->direction.x, s->direction.y, s->direction.z, s->color[0], s->color[1], s->color[2] }, 6);
    }
    free(sky);
}

static void write_entities(struct sdl *sdl, const struct passes *p, bool shapes_only)
{
    char name[MODEL_NAME_SIZE], other[MODEL_NAME_SIZE], path[sizeof MODELS_FOLDER + MODEL_NAME_SIZE + 8];
    sdl_include(sdl, "materials.inc");
    sdl_declare_number(sdl, "Shapes_Only", shapes_only);
    for (size_t i = 0; i < p->entity_count; i++) {
        model_include_name(name, p->model_index[i], &p->entities[i]);
        bool seen = false;
        for (size_t k = 0; k < i && !seen; k++) {
            model_include_name(other, p->model_index[k], &p->entities[k]);
            seen = !strcmp(name, other);
        }
        if (seen) continue;
        snprintf(path, sizeof path, MODELS_FOLDER "/%s.inc", name);
        sdl_include(sdl, path);
    }
    sdl_declare(sdl, "Entities");
    sdl_begin(sdl, "union");
    for (size_t i = 0; i < p->entity_count; i++) {
        model_include_name(name, p->model_index[i], &p->entities[i]);
        sdl_begin(sdl, "object");
        sdl_word(sdl, name);
        sdl_matrix(sdl, p->entities[i].world_from_entity);
        sdl_end(sdl);
    }
    sdl_end(sdl);
}

static void write_receivers(struct sdl *sdl, const struct passes *p)
{
    sdl_declare(sdl, "Receivers");
    sdl_begin(sdl, "union");
    for (size_t i = 0; i < p->receiver_count; i++) {
        const struct receiver *r = &p->receivers[i];
        sdl_begin(sdl, "mesh2");
        sdl_begin(sdl, "vertex_vectors");
        sdl_number(sdl, (double)r->corners);
        for (size_t k = 0; k < r->corners; k++) {
            sdl_comma(sdl);
            sdl_vector(sdl, r->corner_m[k]);
        }
        sdl_end(sdl);
        sdl_begin(sdl, "face_indices");
        sdl_number(sdl, (double)r->corners - 2);
        for (size_t k = 2; k < r->corners; k++) {
            sdl_comma(sdl);
            sdl_vector(sdl, vec3(0, (double)k - 1, (double)k));
        }
        sdl_end(sdl);
        sdl_end(sdl);
    }
    sdl_end(sdl);
}

static bool write_pass(const char *frame_folder, const char *name, const struct passes *p, bool entities,
                       bool receivers, struct error *err)
{
    const struct scene *scene = p->scene;
    struct pass_settings settings = pass_settings(scene->quality, scene->sky);
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "a pass of a frame: POV-Ray runs in the output folder, templates on its library path");
    sdl_declare_number(&sdl, "Radiosity", receivers ? 0 : 1);
    sdl_declare_number(&sdl, "Radiosity_Count", settings.radiosity_count);
    sdl_declare_number(&sdl, "Radiosity_Error", settings.radiosity_error);
    sdl_include(&sdl, "settings.inc");
    struct view view = view_reduced(&p->view, receivers ? settings.receiver_reduction : 1);
    camera_write(&sdl, &view, p->world_from_camera);
    write_light(&sdl, p, &settings, !receivers ? LIGHTS_RADIOSITY : entities ? LIGHTS_SHADED : LIGHTS_OPEN);
    sdl_declare_color(&sdl, "Ground_Albedo", scene->ground_albedo);
    sdl_declare_number(&sdl, "Ground_Reflection", scene->ground_reflection);
    sdl_include(&sdl, "ground.inc");
    if (entities) write_entities(&sdl, p, receivers && scene->ground_reflection <= 0);
    if (receivers) write_receivers(&sdl, p);
    else {
        sdl_declare_vector(&sdl, "Ground_Normal", scene->ground.normal);
        sdl_declare_number(&sdl, "Ground_Offset", scene->ground.offset_m);
        double sky[3];
        light_sky_irradiance(sky, p->light, scene->ground.normal);
        sdl_declare_color(&sdl, "Ground_Sky", sky);
    }
    char *include = string_format("pass_%s.inc", name), *path = string_format("%s/%s.pov", frame_folder, name);
    bool ok = include && path;
    if (ok) {
        sdl_include(&sdl, include);
        ok = sdl_write(&sdl, path, err);
    }
    free(include);
    free(path);
    sdl_release(&sdl);
    return ok;
}

bool passes_write(const char *frame_folder, const struct passes *passes, struct error *err)
{
    return write_pass(frame_folder, "object", passes, true, false, err) &&
           write_pass(frame_folder, "plane", passes, false, true, err) &&
           write_pass(frame_folder, "shadow", passes, true, true, err);
}

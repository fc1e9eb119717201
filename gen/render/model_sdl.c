#include "gen/render/model_sdl.h"

#include "gen/model/texture.h"
#include "gen/render/mesh_sdl.h"
#include "gen/render/sdl.h"
#include "lib/file.h"
#include "lib/luminance.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct model_include model_include(size_t model_index, const struct entity *entity)
{
    struct model_include include;
    if (entity->has_color) {
        uint64_t hash = hash_bytes(FILE_HASH_SEED, entity->color, sizeof entity->color);
        snprintf(include.name, sizeof include.name, "Model_%zu_%016llx", model_index, (unsigned long long)hash);
    } else
        snprintf(include.name, sizeof include.name, "Model_%zu", model_index);
    snprintf(include.path, sizeof include.path, MODELS_FOLDER "/%s.inc", include.name);
    return include;
}

struct model_include model_include_posed(const char *frame, const struct entity *entity)
{
    struct model_include include;
    snprintf(include.name, sizeof include.name, "Posed_%d", (int)entity->id);
    snprintf(include.path, sizeof include.path, "frames/%s/%s.inc", frame, include.name);
    return include;
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
    sdl_call(sdl, "Finish_Surface", (double[]){ m->metallic, m->roughness, m->clearcoat, f0, luminance_of(m->emissive) }, 5);
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
    mesh_sdl_faces(sdl, mesh->triangle, mesh->triangles);
}

/* What has gone through glass POV-Ray takes for a part of the picture, whatever ray it was: where the sky is not in the picture, it
 * would light nothing behind glass. So radiosity's rays do not meet the glass there, but a screen in its place, black: as much of
 * its faces as the glass keeps back. */
#define SCREENS "Glass_Screens"
#define ENTERS 0.91 /* of a hemisphere's light, what no surface of glass reflects; Src: Walter and others 2007, for 1.5 */

static double face_area(const struct mesh *mesh, const uint32_t triangle[3])
{
    struct vec3 p[3];
    for (int k = 0; k < 3; k++) {
        const float *v = mesh->position_m[triangle[k]];
        p[k] = vec3((double)v[0], (double)v[1], (double)v[2]);
    }
    return vec3_norm(vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0])));
}

static bool write_screen(struct sdl *sdl, const struct mesh *mesh, double kept, struct error *err)
{
    uint32_t (*triangle)[3] = malloc((mesh->triangles + 1) * sizeof *triangle);
    size_t n = 0;
    double due = 0;
    if (!triangle) return error_set(err, ERR_MEMORY, "no memory for a model");
    for (size_t i = 0; i < mesh->triangles; i++) {
        double area = face_area(mesh, mesh->triangle[i]);
        due += kept * area;
        if (due < area / 2) continue;
        due -= area;
        memcpy(triangle[n++], mesh->triangle[i], sizeof *triangle);
    }
    if (n) {
        struct mesh screen = *mesh;
        screen.triangle = triangle;
        screen.triangles = n;
        sdl_begin(sdl, "mesh2");
        write_mesh(sdl, &screen, false);
        sdl_begin(sdl, "pigment");
        sdl_word(sdl, "rgb");
        sdl_number(sdl, 0);
        sdl_end(sdl);
        sdl_word(sdl, "no_image");
        sdl_word(sdl, "no_reflection");
        sdl_word(sdl, "no_shadow");
        sdl_end(sdl);
    }
    free(triangle);
    return true;
}

void include_set_release(struct include_set *set)
{
    free(set->names);
    *set = (struct include_set){ 0 };
}

static bool remember(struct include_set *set, const struct model_include *include, struct error *err)
{
    void *grown = realloc(set->names, (set->n + 1) * sizeof *set->names);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for the names of models");
    set->names = grown;
    memcpy(set->names[set->n++], include->name, sizeof include->name);
    return true;
}

bool model_include_write(const struct model_include *include, struct include_set *written, const char *out_folder,
                         const struct entity *entity, struct error *err)
{
    const struct model *model = entity->model;
    for (size_t i = 0; written && i < written->n; i++)
        if (!strcmp(written->names[i], include->name)) return true;
    const double *paint = entity->has_color ? entity->color : NULL;
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "a model in one colour: metres, x forward, y left, z up. Needs materials.inc, Shapes_Only");
    sdl_declare(&sdl, include->name);
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
        bool is_glass = transmittance(material) > 0 && !textured;
        if (is_glass) {
            sdl_ifdef(&sdl, SCREENS);
            sdl_word(&sdl, "no_radiosity");
            sdl_endif(&sdl);
        }
        sdl_end(&sdl);
        if (!is_glass) continue;
        sdl_ifdef(&sdl, SCREENS);
        ok = ok && write_screen(&sdl, mesh, 1 - ENTERS * transmittance(material), err);
        sdl_endif(&sdl);
    }
    sdl_end(&sdl);
    char *path = string_format("%s/%s", out_folder, include->path), *folder = path ? path_folder(path) : NULL;
    ok = ok && (folder || error_set(err, ERR_MEMORY, "no memory for a path")) && folder_make(folder, err) &&
         sdl_write(&sdl, path, err) && (!written || remember(written, include, err));
    free(path);
    free(folder);
    sdl_release(&sdl);
    return ok;
}

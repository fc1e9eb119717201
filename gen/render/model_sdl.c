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

/* --- glass --- */

/* What has gone through a surface POV-Ray takes for a part of the picture, whatever ray it was: where the sky is not in the picture,
 * it would light nothing behind glass. So radiosity's rays do not meet the glass there, but a screen in its place, black: as many of
 * its pieces as the glass keeps back. (What is blended, or glass by its texture, stays dark behind.) */
#define SCREENS "Glass_Screens"
#define ENTERS 0.91 /* of a hemisphere's light, what no surface of glass reflects; Src: Walsh 1926, for an index of 1.5 */
enum { PIECES_LEAST = 64 };

static bool is_glass(const struct mesh *mesh, const struct material *m)
{
    return transmittance(m) > 0 && (m->transmission > 0 || m->kind == FINISH_GLASS) && !(mesh->uv && m->base_image.data);
}

static struct vec3 vertex_of(const struct mesh *mesh, uint32_t i)
{
    const float *v = mesh->position_m[i];
    return vec3((double)v[0], (double)v[1], (double)v[2]);
}

/* Piece k of a face of parts x parts alike. Out: corner (3) */
static void piece_of(struct vec3 *corner, const struct mesh *mesh, size_t face, int parts, int k)
{
    int row = (int)floor(sqrt(k + 0.5)), at = k - row * row, left = at / 2; /* row r has 2 r + 1 pieces */
    int along[3][2] = { { row, left }, { row + 1, left }, { row + 1, left + 1 } };
    if (at % 2) memcpy(along, (int[3][2]){ { row, left }, { row + 1, left + 1 }, { row, left + 1 } }, sizeof along);
    const uint32_t *t = mesh->triangle[face];
    struct vec3 a = vertex_of(mesh, t[0]), down = vec3_sub(vertex_of(mesh, t[1]), a), across = vec3_sub(vertex_of(mesh, t[2]), vertex_of(mesh, t[1]));
    for (int i = 0; i < 3; i++)
        corner[i] = vec3_add(a, vec3_add(vec3_scale(down, (double)along[i][0] / parts), vec3_scale(across, (double)along[i][1] / parts)));
}

/* Out: corner (as many as pieces, 3). Returns how many of the pieces are kept */
static size_t keep_pieces(struct vec3 *corner, const struct mesh *mesh, int parts, double share)
{
    size_t n = 0;
    double due = 0;
    for (size_t i = 0; i < mesh->triangles; i++)
        for (int k = 0; k < parts * parts; k++) {
            struct vec3 *p = &corner[3 * n];
            piece_of(p, mesh, i, parts, k);
            double size = vec3_norm(vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0])));
            due += share * size;
            if (due < size / 2) continue;
            due -= size;
            n++;
        }
    return n;
}

static bool write_screen(struct sdl *sdl, const struct mesh *mesh, double share, struct error *err)
{
    int parts = mesh->triangles ? (int)ceil(sqrt((double)PIECES_LEAST / (double)mesh->triangles)) : 1;
    size_t most = mesh->triangles * (size_t)(parts * parts);
    struct vec3 *corner = malloc((3 * most + 1) * sizeof *corner);
    uint32_t (*triangle)[3] = malloc((most + 1) * sizeof *triangle);
    bool ok = (corner && triangle) || error_set(err, ERR_MEMORY, "no memory for a model");
    size_t n = ok ? keep_pieces(corner, mesh, parts, share) : 0;
    for (size_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < 3; k++) triangle[i][k] = 3 * (uint32_t)i + k;
    if (n) {
        sdl_ifdef(sdl, SCREENS);
        sdl_begin(sdl, "mesh2");
        mesh_sdl_vectors(sdl, "vertex_vectors", corner, 3 * n);
        mesh_sdl_faces(sdl, triangle, n);
        sdl_begin(sdl, "pigment");
        sdl_word(sdl, "rgb");
        sdl_number(sdl, 0);
        sdl_end(sdl);
        sdl_word(sdl, "no_image");
        sdl_word(sdl, "no_reflection");
        sdl_word(sdl, "no_shadow");
        sdl_end(sdl);
        sdl_endif(sdl);
    }
    free(corner);
    free(triangle);
    return ok;
}

/* --- models --- */

static bool write_part(struct sdl *sdl, const char *out_folder, const struct model *model, const struct mesh *mesh, const double *paint,
                       struct error *err)
{
    const struct material *material = &model->materials[mesh->material];
    bool textured = mesh->uv && material->base_image.data;
    sdl_begin(sdl, "mesh2");
    write_mesh(sdl, mesh, textured);
    /* A texture that stops all light need not be read to know the shadow. */
    bool shape_tells = !textured || material->alpha_mode == ALPHA_OPAQUE;
    if (shape_tells) {
        sdl_if(sdl, "Shapes_Only");
        sdl_begin(sdl, "pigment");
        sdl_word(sdl, "rgb");
        sdl_number(sdl, 0.5);
        sdl_word(sdl, "transmit");
        sdl_number(sdl, transmittance(material));
        sdl_end(sdl);
        sdl_else(sdl);
    }
    if (textured) {
        sdl_word(sdl, "uv_mapping");
        sdl_newline(sdl);
    }
    sdl_begin(sdl, "texture");
    bool ok = write_pigment(sdl, out_folder, model, mesh->material, paint, err);
    write_finish(sdl, material);
    sdl_end(sdl);
    if (shape_tells) sdl_endif(sdl);
    if (is_glass(mesh, material)) {
        sdl_ifdef(sdl, SCREENS);
        sdl_word(sdl, "no_radiosity");
        sdl_endif(sdl);
    }
    sdl_end(sdl);
    return ok && (!is_glass(mesh, material) || write_screen(sdl, mesh, 1 - ENTERS * transmittance(material), err));
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
    for (size_t i = 0; ok && i < model->mesh_count; i++) ok = write_part(&sdl, out_folder, model, &model->meshes[i], paint, err);
    sdl_end(&sdl);
    char *path = string_format("%s/%s", out_folder, include->path), *folder = path ? path_folder(path) : NULL;
    ok = ok && (folder || error_set(err, ERR_MEMORY, "no memory for a path")) && folder_make(folder, err) &&
         sdl_write(&sdl, path, err) && (!written || remember(written, include, err));
    free(path);
    free(folder);
    sdl_release(&sdl);
    return ok;
}

/* OBJ, COLLADA and FBX by assimp's C API. */
#include "gen/model/model_import.h"
#include "lib/file.h"
#include "lib/image.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool has_extension(const char *path, const char *extension)
{
    const char *dot = strrchr(path_name(path), '.');
    return dot && !strcasecmp(dot, extension);
}

/* --- what assimp passes over in silence --- */

/* Material files that an OBJ file names and that are not beside it. */
static bool check_obj(struct import *import, const char *path, const char *data, struct error *err)
{
    for (const char *line = data; line; line = (line = strchr(line, '\n')) ? line + 1 : NULL) {
        line += strspn(line, " \t");
        if (strncmp(line, "mtllib", 6) != 0 || !strchr(" \t", line[6])) continue;
        line += 6 + strspn(line + 6, " \t");
        size_t n = strcspn(line, "\r\n");
        while (n && (line[n - 1] == ' ' || line[n - 1] == '\t')) n--;
        char *name = strndup(line, n), *file = name ? path_beside(path, name) : NULL;
        bool ok = file && (file_exists(file) || import_add_missing(import, name, err));
        if (!file) error_set(err, ERR_MEMORY, "no memory for a path");
        free(name);
        free(file);
        if (!ok) return false;
    }
    return true;
}

/* The unit that a COLLADA file states, 1 m without; assimp has multiplied every position by it. */
static double collada_unit(const char *data)
{
    const char *unit = strstr(data, "<unit"), *end = unit ? strchr(unit, '>') : NULL, *meter = unit ? strstr(unit, "meter") : NULL;
    if (!meter || !end || meter > end) return 1;
    meter += strcspn(meter, "\"'>");
    double value = *meter == '>' ? 0 : strtod(meter + 1, NULL);
    return value > 0 && isfinite(value) ? value : 1;
}

static bool check(struct import *import, const char *path, struct error *err)
{
    char *data;
    size_t size;
    if (!file_read(&data, &size, path, err)) return false;
    bool ok = size > 0 || error_at(err, ERR_INPUT, path, 0, 0, "is empty");
    if (ok && has_extension(path, ".obj")) ok = check_obj(import, path, data, err);
    if (ok && has_extension(path, ".dae")) import->unit_m = collada_unit(data);
    free(data);
    return ok;
}

/* --- materials --- */

static bool get_color(double linear[3], const struct aiMaterial *from, const char *key, unsigned type, unsigned index)
{
    struct aiColor4D color;
    if (aiGetMaterialColor(from, key, type, index, &color) != aiReturn_SUCCESS) return false;
    float c[3] = { color.r, color.g, color.b };
    for (int i = 0; i < 3; i++) /* a NaN becomes 0; these formats give colours as they look on a screen */
        linear[i] = (double)linear_from_srgb(c[i] > 0 ? c[i] < 1 ? c[i] : 1 : 0);
    return true;
}

static bool get_image(struct import *import, int *image, const struct aiMaterial *from, enum aiTextureType type, struct error *err)
{
    struct aiString name;
    if (aiGetMaterialTexture(from, type, 0, &name, NULL, NULL, NULL, NULL, NULL, NULL) != aiReturn_SUCCESS || !name.length) return true;
    *image = import_add_image(import, name.data, err);
    return *image != NO_IMAGE;
}

static bool add_material(struct import *import, const struct aiMaterial *from, struct error *err)
{
    struct aiString name = { 0 };
    aiGetMaterialString(from, AI_MATKEY_NAME, &name);
    struct import_material *to = import_add_material(import, name.data, err);
    if (!to) return false;
    struct material *m = &to->material;
    m->names_only = true;
    to->base_replaces_color = true;
    get_color(m->base_color, from, AI_MATKEY_COLOR_DIFFUSE);
    get_color(m->emissive, from, AI_MATKEY_COLOR_EMISSIVE);
    float opacity = 1;
    if (aiGetMaterialFloatArray(from, AI_MATKEY_OPACITY, &opacity, NULL) == aiReturn_SUCCESS && opacity < 1) {
        m->alpha = opacity > 0 ? (double)opacity : 0;
        m->alpha_mode = ALPHA_BLEND;
    }
    if (!get_image(import, &to->base, from, aiTextureType_DIFFUSE, err)) return false;
    if (to->base == NO_IMAGE && !get_image(import, &to->base, from, aiTextureType_BASE_COLOR, err)) return false;
    if (!get_image(import, &to->opacity, from, aiTextureType_OPACITY, err)) return false;
    if (to->opacity != NO_IMAGE && m->alpha_mode == ALPHA_OPAQUE) m->alpha_mode = ALPHA_MASK;
    return true;
}

/* Images that lie in the file itself (FBX): "*0", or by the name that they had. */
static bool add_embedded(struct import *import, const struct aiScene *scene, struct error *err)
{
    for (size_t i = 0; i < import->image_count; i++) {
        struct import_image *image = &import->images[i];
        for (unsigned k = 0; k < scene->mNumTextures; k++) {
            const struct aiTexture *from = scene->mTextures[k];
            char number[16];
            snprintf(number, sizeof number, "*%u", k);
            bool same = !strcmp(image->name, number) || (from->mFilename.length && !strcmp(image->name, from->mFilename.data));
            if (!same || from->mHeight != 0) continue; /* mHeight 0: compressed, mWidth is its size in bytes */
            image->size = from->mWidth;
            if (!(image->data = malloc(image->size + 1))) return error_set(err, ERR_MEMORY, "no memory for a texture");
            memcpy(image->data, from->pcData, image->size);
            break;
        }
    }
    return true;
}

/* --- meshes --- */

static double determinant(const struct aiMatrix4x4 *m)
{
    return (double)m->a1 * (double)(m->b2 * m->c3 - m->b3 * m->c2) - (double)m->a2 * (double)(m->b1 * m->c3 - m->b3 * m->c1) +
           (double)m->a3 * (double)(m->b1 * m->c2 - m->b2 * m->c1);
}

static bool add_mesh(struct import *import, const struct aiMesh *from, const struct aiMatrix4x4 *world, struct error *err)
{
    if (!(from->mPrimitiveTypes & aiPrimitiveType_TRIANGLE)) return true;
    struct mesh mesh;
    bool textured = from->mTextureCoords[0] && import->materials[from->mMaterialIndex].base != NO_IMAGE;
    if (!mesh_init(&mesh, from->mNumVertices, from->mNumFaces, from->mNormals, textured, err)) return false;
    struct aiMatrix3x3 turn; /* normals go by the inverse transpose */
    aiMatrix3FromMatrix4(&turn, world);
    aiMatrix3Inverse(&turn);
    aiTransposeMatrix3(&turn);
    for (unsigned i = 0; i < from->mNumVertices; i++) {
        struct aiVector3D p = from->mVertices[i];
        aiTransformVecByMatrix4(&p, world);
        mesh.position_m[i][0] = p.x, mesh.position_m[i][1] = p.y, mesh.position_m[i][2] = p.z;
        if (from->mNormals) {
            struct aiVector3D n = from->mNormals[i];
            aiTransformVecByMatrix3(&n, &turn);
            mesh.normal[i][0] = n.x, mesh.normal[i][1] = n.y, mesh.normal[i][2] = n.z;
        }
        if (textured) mesh.uv[i][0] = from->mTextureCoords[0][i].x, mesh.uv[i][1] = from->mTextureCoords[0][i].y;
    }
    bool mirrored = determinant(world) < 0;
    size_t kept = 0;
    for (unsigned i = 0; i < from->mNumFaces; i++) {
        const struct aiFace *face = &from->mFaces[i];
        if (face->mNumIndices != 3) continue; /* a point or a line among the triangles */
        uint32_t *t = mesh.triangle[kept++];
        t[0] = face->mIndices[0];
        t[1] = face->mIndices[mirrored ? 2 : 1];
        t[2] = face->mIndices[mirrored ? 1 : 2];
    }
    mesh.triangles = kept;
    mesh.material = from->mMaterialIndex;
    bool ok = import_add_mesh(import, &mesh, err);
    mesh_release(&mesh);
    return ok;
}

static bool add_node(struct import *import, const struct aiScene *scene, const struct aiNode *node,
                     const struct aiMatrix4x4 *parent, struct error *err)
{
    struct aiMatrix4x4 world = *parent;
    aiMultiplyMatrix4(&world, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        if (!add_mesh(import, scene->mMeshes[node->mMeshes[i]], &world, err)) return false;
    for (unsigned i = 0; i < node->mNumChildren; i++)
        if (!add_node(import, scene, node->mChildren[i], &world, err)) return false;
    return true;
}

/* FBX states its unit in centimetres; assimp leaves the positions as they are. */
static double fbx_unit(const struct aiScene *scene)
{
    for (unsigned i = 0; scene->mMetaData && i < scene->mMetaData->mNumProperties; i++) {
        if (strcmp(scene->mMetaData->mKeys[i].data, "UnitScaleFactor") != 0) continue;
        const struct aiMetadataEntry *entry = &scene->mMetaData->mValues[i];
        double cm = entry->mType == AI_FLOAT ? (double)*(float *)entry->mData : entry->mType == AI_DOUBLE ? *(double *)entry->mData : 0;
        if (cm > 0 && isfinite(cm)) return cm / 100;
    }
    return 0;
}

/* One call: aiApplyPostProcessing on its own frees a scene twice when it fails. NULL on failure. */
static const struct aiScene *read_scene(const char *path, struct error *err)
{
    struct aiPropertyStore *settings = aiCreatePropertyStore();
    if (!settings) {
        error_set(err, ERR_MEMORY, "no memory for a model");
        return NULL;
    }
    aiSetImportPropertyInteger(settings, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
    aiSetImportPropertyInteger(settings, AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, 0);
    const struct aiScene *scene = aiImportFileExWithProperties(
        path, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType | aiProcess_ValidateDataStructure, NULL, settings);
    aiReleasePropertyStore(settings);
    if (scene && scene->mRootNode) return scene;
    const char *text = aiGetErrorString();
    if (strstr(text, "contains no faces")) error_at(err, ERR_INPUT, path, 0, 0, "has no triangles");
    else error_at(err, ERR_INPUT, path, 0, 0, "is no model that can be read: %s", text);
    aiReleaseImport(scene);
    return NULL;
}

bool import_assimp(struct import *import, const char *path, struct error *err)
{
    if (!check(import, path, err)) return false;
    const struct aiScene *scene = read_scene(path, err);
    if (!scene) return false;
    for (unsigned i = 0; i < scene->mNumMaterials; i++)
        if (!add_material(import, scene->mMaterials[i], err)) goto out;
    if (!add_embedded(import, scene, err)) goto out;
    if (has_extension(path, ".fbx")) import->unit_m = fbx_unit(scene);
    struct aiMatrix4x4 file_units;
    aiIdentityMatrix4(&file_units);
    if (has_extension(path, ".dae")) file_units.a1 = file_units.b2 = file_units.c3 = (ai_real)(1 / import->unit_m);
    add_node(import, scene, scene->mRootNode, &file_units, err);
out:
    aiReleaseImport(scene);
    return err->code == ERR_OK;
}

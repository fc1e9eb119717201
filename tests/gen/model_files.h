/* Files that the tests of models write, and what they ask of the models read from them. */
#ifndef STAFFAGE_TESTS_GEN_MODEL_FILES_H
#define STAFFAGE_TESTS_GEN_MODEL_FILES_H

#include "gen/model/model.h"
#include "lib/file.h"
#include "lib/image.h"
#include "tests/tap.h"

#include <dirent.h>
#include <stdint.h>
#include <sys/stat.h>
#include <unistd.h>

/* --- a folder of files that the tests write --- */

static char folder[] = "model-test.XXXXXX";

static const char *put(const char *name, const void *data, size_t size)
{
    static char path[256];
    struct error err = ERROR_NONE;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *above = path_folder(path);
    if (!folder_make(above, &err) || !file_write(path, data, size, &err)) error_print(&err, "test");
    free(above);
    return path;
}

__attribute__((unused))
static const char *put_text(const char *name, const char *text)
{
    return put(name, text, strlen(text));
}

/* A 2x2 picture of one colour. */
__attribute__((unused))
static const char *put_image(const char *name, uint8_t r, uint8_t g, uint8_t b)
{
    static char path[256];
    struct error err = ERROR_NONE;
    struct image image;
    put_text(name, "");
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (image_init(&image, 2, 2, 3, PIXEL_U8, &err)) {
        for (int i = 0; i < 4; i++) memcpy((uint8_t *)image.data + 3 * i, (uint8_t[]){ r, g, b }, 3);
        image_write(path, &image, &err);
        image_release(&image);
    }
    return path;
}

__attribute__((unused))
static void remove_tree(const char *path)
{
    DIR *dir = opendir(path);
    for (struct dirent *entry; dir && (entry = readdir(dir));) {
        if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..")) continue;
        char *below = string_format("%s/%s", path, entry->d_name);
        remove_tree(below);
        free(below);
    }
    if (dir) closedir(dir);
    remove(path);
}

/* --- loading --- */

__attribute__((unused))
static const struct model_options metres_z_up = { .unit_m = 1, .axes_given = true, .up = AXIS_POS_Z, .front = AXIS_POS_X };
__attribute__((unused))
static const struct model_options as_in_file = { .axes_given = true, .up = AXIS_POS_Z, .front = AXIS_POS_X };

__attribute__((unused))
static struct model *load(const char *path, const struct model_options *options)
{
    struct error err = ERROR_NONE;
    struct model *model = NULL;
    if (!model_load(&model, path, options, &err)) printf("# %s: %s\n", err.file, err.text);
    return model;
}

/* `want` stands after the folder's name. */
__attribute__((unused))
static void refused(const char *path, const struct model_options *options, const char *want, const char *behaviour)
{
    struct error err = ERROR_NONE;
    struct model *model = NULL;
    char got[2048];
    bool ok = !model_load(&model, path, options, &err) && !model && err.code == ERR_INPUT;
    snprintf(got, sizeof got, "%s: %s", path_name(err.file), err.text);
    if (!OK(ok && !strcmp(got, want), "%s", behaviour)) printf("# got:  %s\n# want: %s\n", got, want);
    model_destroy(model);
}

/* Six times the volume is the sum of triple products: positive when triangles wind outward. */
__attribute__((unused))
static double volume(const struct model *model)
{
    double sum = 0;
    for (size_t i = 0; i < model->mesh_count; i++) {
        const struct mesh *m = &model->meshes[i];
        for (size_t t = 0; t < m->triangles; t++) {
            struct vec3 p[3];
            for (int k = 0; k < 3; k++) {
                const float *v = m->position_m[m->triangle[t][k]];
                p[k] = vec3((double)v[0], (double)v[1], (double)v[2]);
            }
            sum += vec3_dot(p[0], vec3_cross(p[1], p[2])) / 6;
        }
    }
    return sum;
}

/* Do all normals lie on the side from which their triangles are seen counter-clockwise? */
__attribute__((unused))
static bool normals_outward(const struct model *model)
{
    for (size_t i = 0; i < model->mesh_count; i++) {
        const struct mesh *m = &model->meshes[i];
        for (size_t t = 0; t < m->triangles; t++) {
            struct vec3 p[3], n[3];
            for (int k = 0; k < 3; k++) {
                const float *v = m->position_m[m->triangle[t][k]], *w = m->normal[m->triangle[t][k]];
                p[k] = vec3((double)v[0], (double)v[1], (double)v[2]);
                n[k] = vec3((double)w[0], (double)w[1], (double)w[2]);
            }
            struct vec3 face = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
            for (int k = 0; k < 3; k++)
                if (vec3_dot(face, n[k]) <= 0 || fabs(vec3_norm(n[k]) - 1) > 1e-5) return false;
        }
    }
    return true;
}

__attribute__((unused))
static bool has_vertex(const struct model *model, double x, double y, double z)
{
    for (size_t i = 0; i < model->mesh_count; i++)
        for (size_t v = 0; v < model->meshes[i].vertices; v++) {
            const float *p = model->meshes[i].position_m[v];
            if (fabs((double)p[0] - x) < 1e-5 && fabs((double)p[1] - y) < 1e-5 && fabs((double)p[2] - z) < 1e-5) return true;
        }
    return false;
}

__attribute__((unused))
static size_t vertices(const struct model *model)
{
    size_t n = 0;
    for (size_t i = 0; i < model->mesh_count; i++) n += model->meshes[i].vertices;
    return n;
}

__attribute__((unused))
static size_t triangles(const struct model *model)
{
    size_t n = 0;
    for (size_t i = 0; i < model->mesh_count; i++) n += model->meshes[i].triangles;
    return n;
}

__attribute__((unused))
static enum axis axis_of(const char *text)
{
    return (enum axis)(2 * (text[1] - 'x') + (text[0] == '-'));
}

/* --- glTF --- */

struct bytes { uint8_t data[4096]; size_t size; };

__attribute__((unused))
static void add_floats(struct bytes *b, const float *values, size_t n)
{
    memcpy(b->data + b->size, values, n * sizeof *values);
    b->size += n * sizeof *values;
}

__attribute__((unused))
static void base64(char *out, const uint8_t *data, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        uint32_t v = (uint32_t)data[i] << 16 | (i + 1 < size ? (uint32_t)data[i + 1] << 8 : 0) | (i + 2 < size ? data[i + 2] : 0);
        *out++ = digits[v >> 18];
        *out++ = digits[v >> 12 & 63];
        *out++ = i + 1 < size ? digits[v >> 6 & 63] : '=';
        *out++ = i + 2 < size ? digits[v & 63] : '=';
    }
    *out = 0;
}

/* A .gltf file: one buffer of these bytes, and the rest of the JSON as given. */
__attribute__((unused))
static const char *put_gltf(const char *name, const struct bytes *b, const char *rest)
{
    static char text[32768], data[8192];
    base64(data, b->data, b->size);
    snprintf(text, sizeof text, "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu,\"uri\":\"data:application/octet-stream;base64,%s\"}],%s}",
             b->size, data, rest);
    return put_text(name, text);
}

#endif

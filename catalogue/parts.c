#include "catalogue/parts.h"

#include "lib/file.h"
#include "lib/json_file.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool ends_in(const char *path, const char *ending)
{
    size_t n = strlen(path), m = strlen(ending);
    return n > m && !strcasecmp(path + n - m, ending);
}

static bool same_content(const char *a, const char *b, struct error *err)
{
    uint64_t hash_a = FILE_HASH_SEED, hash_b = FILE_HASH_SEED;
    return file_hash(&hash_a, a, err) && file_hash(&hash_b, b, err) && hash_a == hash_b;
}

static bool add(struct parts *parts, const char *model, const char *from, const char *to, struct error *err)
{
    for (size_t i = 0; i < parts->count; i++) {
        if (strcasecmp(parts->list[i].to, to)) continue;
        if (!strcmp(parts->list[i].from, from) || same_content(from, parts->list[i].from, err)) return true;
        return error_at(err, ERR_INPUT, model, 0, 0, "has two files of one name, %.150s and %.150s: another name for one of them would be right",
                        parts->list[i].from, from);
    }
    struct part *grown = realloc(parts->list, (parts->count + 1) * sizeof *grown);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for a model's files");
    parts->list = grown;
    grown[parts->count] = (struct part){ strdup(from), strdup(to) };
    return (grown[parts->count].from && grown[parts->count++].to) || error_set(err, ERR_MEMORY, "no memory for a model's files");
}

/* A file that the model names by its path, which the copy keeps. */
static bool add_named(struct parts *parts, const char *model, const char *name, struct error *err)
{
    if (name[0] == '/' || !strncmp(name, "../", 3) || strstr(name, "/../"))
        return error_at(err, ERR_INPUT, model, 0, 0, "names the file %.200s, which is not in its folder: put it there, and its name alone into the model", name);
    char *from = path_beside(model, name);
    bool ok = from ? !file_exists(from) || add(parts, model, from, name, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(from);
    return ok;
}

static bool add_material_files(struct parts *parts, const char *model, struct error *err)
{
    char *data;
    size_t size;
    bool ok = true;
    if (!file_read(&data, &size, model, err)) return false;
    for (char *line = data, *next; ok && line; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = 0;
        line += strspn(line, " \t");
        if (strncmp(line, "mtllib", 6) || !strchr(" \t", line[6])) continue;
        line += 6 + strspn(line + 6, " \t");
        size_t n = strlen(line);
        while (n && strchr(" \t\r", line[n - 1])) line[--n] = 0;
        ok = !n || add_named(parts, model, line, err);
    }
    free(data);
    return ok;
}

/* %20 and so on. */
static void unescape(char *to, size_t size, const char *uri)
{
    size_t n = 0;
    for (; *uri && n + 1 < size; uri++) {
        char hex[3] = { uri[0] == '%' ? uri[1] : 0, uri[0] == '%' && uri[1] ? uri[2] : 0, 0 };
        if (strlen(hex) == 2 && strspn(hex, "0123456789abcdefABCDEF") == 2) {
            to[n++] = (char)strtoul(hex, NULL, 16);
            uri += 2;
        } else
            to[n++] = *uri;
    }
    to[n] = 0;
}

static bool add_buffers(struct parts *parts, const char *model, struct error *err)
{
    json_t *root;
    bool ok = json_file_read(&root, model, JSON_OBJECT, err);
    if (!ok) return false;
    const json_t *buffers = json_object_get(root, "buffers");
    for (size_t i = 0; ok && i < json_array_size(buffers); i++) {
        const char *uri = json_string_value(json_object_get(json_array_get(buffers, i), "uri"));
        char name[1024];
        if (!uri || !strncmp(uri, "data:", 5)) continue;
        unescape(name, sizeof name, uri);
        ok = add_named(parts, model, name, err);
    }
    json_decref(root);
    return ok;
}

bool parts_find(struct parts *parts, const struct model *model, struct error *err)
{
    *parts = (struct parts){ 0 };
    const char *path = model->path;
    bool ok = add(parts, path, path, path_name(path), err);
    if (ends_in(path, ".obj")) ok = ok && add_material_files(parts, path, err);
    if (ends_in(path, ".gltf")) ok = ok && add_buffers(parts, path, err);
    for (size_t i = 0; ok && i < model->texture_count; i++) ok = add(parts, path, model->textures[i], path_name(model->textures[i]), err);
    if (!ok) parts_release(parts);
    return ok;
}

void parts_release(struct parts *parts)
{
    for (size_t i = 0; i < parts->count; i++) {
        free(parts->list[i].from);
        free(parts->list[i].to);
    }
    free(parts->list);
    *parts = (struct parts){ 0 };
}

bool parts_copy(const struct parts *parts, const char *folder, struct error *err)
{
    bool ok = true;
    for (size_t i = 0; ok && i < parts->count; i++) {
        char *to = string_format("%s/%s", folder, parts->list[i].to), *above = to ? path_folder(to) : NULL;
        ok = above ? folder_make(above, err) && file_copy(to, parts->list[i].from, err) : error_set(err, ERR_MEMORY, "no memory for a path");
        free(above);
        free(to);
    }
    return ok;
}

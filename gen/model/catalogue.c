#include "gen/model/catalogue.h"

#include "lib/file.h"
#include "lib/image.h"
#include "lib/json_file.h"

#include <ctype.h>
#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NAME_MAX_BYTES 60

const char *detail_name(enum detail detail)
{
    static const char *const names[DETAIL_COUNT] = { "near", "middle", "far" };
    return names[detail];
}

bool catalogue_name_is_good(const char *name)
{
    size_t n = 0;
    if (!isalpha((unsigned char)name[0])) return false;
    while (isalnum((unsigned char)name[n]) || name[n] == '-' || name[n] == '_') n++;
    return !name[n] && n <= NAME_MAX_BYTES;
}

/* --- one model --- */

struct entry { struct walk walk; const char *file; struct catalogue_model *model; };

static bool no_memory(struct entry *e) { return error_set(e->walk.err, ERR_MEMORY, "no memory for a catalogue"); }

static bool has(const struct entry *e, const char *key) { return json_object_get(e->walk.object, key) != NULL; }

/* Left out, it is empty. */
static bool read_text(struct entry *e, char **text, const char *key)
{
    char value[1024] = "";
    if (has(e, key) && !walk_text(&e->walk, key, value, sizeof value)) return false;
    return (*text = strdup(value)) || no_memory(e);
}

/* Left out, it is NULL. */
static bool read_path(struct entry *e, char **path, const char *key, bool required)
{
    char value[1024];
    if (!required && !has(e, key)) return true;
    return walk_string(&e->walk, key, value, sizeof value) && ((*path = path_beside(e->file, value)) || no_memory(e));
}

static bool read_number(struct entry *e, double *value, const char *key, double least, double most)
{
    return !has(e, key) || walk_real(&e->walk, key, value, least, most);
}

static bool read_axes(struct entry *e)
{
    struct model_options *options = &e->model->options;
    char up[4], front[4];
    if (!has(e, "up") && !has(e, "front")) return true;
    if (!walk_string(&e->walk, "up", up, sizeof up) || !walk_string(&e->walk, "front", front, sizeof front)) return false;
    if (!axis_from_name(&options->up, up)) return walk_wrong(&e->walk, "up", "must be one of +x, -x, +y, -y, +z, -z");
    if (!axis_from_name(&options->front, front)) return walk_wrong(&e->walk, "front", "must be one of +x, -x, +y, -y, +z, -z");
    if (options->up / 2 == options->front / 2) return walk_wrong(&e->walk, "front", "lies on the axis that points up");
    options->axes_given = true;
    return true;
}

static bool read_triangles(struct entry *e)
{
    const json_t *list = json_object_get(e->walk.object, "triangles");
    if (!list) return true;
    if (!json_is_array(list) || json_array_size(list) < 1 || json_array_size(list) > DETAIL_COUNT)
        return walk_wrong(&e->walk, "triangles", "must be 1 to %d whole numbers", DETAIL_COUNT);
    for (size_t i = 0; i < json_array_size(list); i++) {
        json_int_t n = json_integer_value(json_array_get(list, i));
        if (n < 1 || n > INT_MAX) return walk_wrong(&e->walk, "triangles", "must hold whole numbers from 1");
        e->model->triangles[i] = (int)n;
    }
    return true;
}

static bool read_color(struct model_color *color, const json_t *json)
{
    const char *text = json_string_value(json_object_get(json, "color"));
    double weight = json_number_value(json_object_get(json, "weight"));
    unsigned long rgb;
    if (!text || strlen(text) != 7 || text[0] != '#' || strspn(text + 1, "0123456789abcdefABCDEF") != 6) return false;
    if (!(weight > 0) || !(weight <= 1e6)) return false;
    rgb = strtoul(text + 1, NULL, 16);
    for (int i = 0; i < 3; i++) color->linear[i] = (double)linear_from_srgb((float)(rgb >> (16 - 8 * i) & 255u) / 255.0f);
    color->weight = weight;
    return true;
}

static bool read_colors(struct entry *e)
{
    const json_t *list = json_object_get(e->walk.object, "colors");
    struct catalogue_model *m = e->model;
    if (!list) return true;
    if (!json_is_array(list)) return walk_wrong(&e->walk, "colors", "must be a list");
    if (!(m->colors = calloc(json_array_size(list) + 1, sizeof *m->colors))) return no_memory(e);
    for (; m->color_count < json_array_size(list); m->color_count++)
        if (!read_color(&m->colors[m->color_count], json_array_get(list, m->color_count)))
            return walk_wrong(&e->walk, "colors", "must hold {\"color\": \"#rrggbb\", \"weight\": number above 0}, and number %zu does not",
                              m->color_count + 1);
    return true;
}

static bool read_animations(struct entry *e)
{
    const json_t *list = json_object_get(e->walk.object, "animations");
    char names[512] = "";
    size_t used = 0;
    if (list && !json_is_array(list)) return walk_wrong(&e->walk, "animations", "must be a list of names");
    for (size_t i = 0; i < json_array_size(list); i++) {
        const char *name = json_string_value(json_array_get(list, i));
        if (!name) return walk_wrong(&e->walk, "animations", "must be a list of names");
        int n = snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", name);
        if (n < 0 || (size_t)n >= sizeof names - used) return walk_wrong(&e->walk, "animations", "are too many");
        used += (size_t)n;
    }
    return (e->model->animations = strdup(names)) || no_memory(e);
}

static bool read_class(struct entry *e)
{
    char name[64];
    struct catalogue_model *m = e->model;
    if (!walk_string(&e->walk, "class", name, sizeof name)) return false;
    if (!class_from_name(&m->class_, name)) return walk_wrong(&e->walk, "class", "is \"%s\": car, van, truck, person or another class would be right", name);
    m->options.has_class = true;
    m->options.class_ = m->class_;
    return true;
}

static bool read_name(struct entry *e)
{
    if (!has(e, "name")) return walk_wrong(&e->walk, "name", "is missing");
    if (!read_text(e, &e->model->name, "name")) return false;
    return catalogue_name_is_good(e->model->name) ||
           walk_wrong(&e->walk, "name", "is \"%.80s\": a letter, then up to %d letters, digits, - and _ would be right", e->model->name,
                      NAME_MAX_BYTES - 1);
}

static bool read_model(struct entry *e)
{
    static const char *const sizes[] = { "length_m", "width_m", "height_m" };
    struct catalogue_model *m = e->model;
    m->weight = 1;
    if (!(m->home = strdup(e->file))) return no_memory(e);
    if (!read_name(e) || !read_class(e) || !read_path(e, &m->files[DETAIL_NEAR], "file", true) ||
        !read_path(e, &m->files[DETAIL_MIDDLE], "middle", false) || !read_path(e, &m->files[DETAIL_FAR], "far", false) ||
        !read_path(e, &m->picture, "picture", false) || !read_number(e, &m->weight, "weight", 1e-6, 1e6) ||
        !read_number(e, &m->options.unit_m, "unit_m", 1e-6, 1000))
        return false;
    for (int i = 0; i < 3; i++)
        if (!read_number(e, &m->size_m[i], sizes[i], 1e-6, 1000)) return false;
    return read_axes(e) && read_triangles(e) && read_colors(e) && read_animations(e) && read_text(e, &m->license, "license") &&
           read_text(e, &m->source, "source");
}

/* --- files and folders --- */

static void release_model(struct catalogue_model *m)
{
    for (int i = 0; i < DETAIL_COUNT; i++) free(m->files[i]);
    free(m->name);
    free(m->colors);
    free(m->animations);
    free(m->license);
    free(m->source);
    free(m->picture);
    free(m->home);
}

static bool add_model(struct catalogue *catalogue, json_t *json, const char *file, size_t index, size_t first, struct error *err)
{
    struct catalogue_model model = { 0 };
    struct entry entry = { .walk = json_read_walk(json, err), .file = file, .model = &model };
    const char *name = json_string_value(json_object_get(json, "name"));
    bool ok = json_is_object(json) ? read_model(&entry) : error_set(err, ERR_INPUT, "must be an object");
    if (!ok) {
        release_model(&model);
        return name ? json_file_fault(err, file, "model \"%.80s\": ", name) : json_file_fault(err, file, "models[%zu]: ", index);
    }
    const struct catalogue_model *taken = catalogue_find(catalogue, model.name);
    if (taken) {
        bool twice = taken >= catalogue->models + first;
        if (twice) error_at(err, ERR_INPUT, file, 0, 0, "names two models \"%s\": a name of its own for each would be right", model.name);
        release_model(&model);
        return !twice;
    }
    struct catalogue_model *grown = realloc(catalogue->models, (catalogue->count + 1) * sizeof *grown);
    if (!grown) {
        release_model(&model);
        return error_set(err, ERR_MEMORY, "no memory for a catalogue");
    }
    catalogue->models = grown;
    grown[catalogue->count++] = model;
    return true;
}

static bool add_file(struct catalogue *catalogue, const char *folder, struct error *err)
{
    char *file = string_format("%s/catalogue.json", folder);
    json_t *root = NULL;
    if (!file) return error_set(err, ERR_MEMORY, "no memory for a path");
    bool ok = true;
    if (file_exists(file)) {
        const size_t first = catalogue->count;
        ok = json_file_read(&root, file, JSON_OBJECT, err);
        json_t *models = ok ? json_object_get(root, "models") : NULL;
        if (ok && !json_is_array(models)) ok = error_at(err, ERR_INPUT, file, 0, 0, "has no list \"models\"");
        for (size_t i = 0; ok && i < json_array_size(models); i++) ok = add_model(catalogue, json_array_get(models, i), file, i, first, err);
    }
    json_decref(root);
    free(file);
    return ok;
}

static int is_visible(const struct dirent *entry) { return entry->d_name[0] != '.'; }

static bool add_folder(struct catalogue *catalogue, const char *folder, struct error *err)
{
    struct dirent **entries = NULL;
    bool ok = add_file(catalogue, folder, err);
    int n = ok ? scandir(folder, &entries, is_visible, alphasort) : 0;
    for (int i = 0; i < n; i++) {
        char *below = ok ? string_format("%s/%s", folder, entries[i]->d_name) : NULL;
        if (ok && !below) ok = error_set(err, ERR_MEMORY, "no memory for a path");
        ok = ok && add_file(catalogue, below, err);
        free(below);
        free(entries[i]);
    }
    free(entries);
    return ok;
}

bool catalogue_read(struct catalogue **catalogue, const char *const *folders, struct error *err)
{
    struct catalogue *made = calloc(1, sizeof *made);
    if (!made) return error_set(err, ERR_MEMORY, "no memory for a catalogue");
    for (; *folders; folders++)
        if (!add_folder(made, *folders, err)) {
            catalogue_destroy(made);
            return false;
        }
    *catalogue = made;
    return true;
}

void catalogue_destroy(struct catalogue *catalogue)
{
    if (!catalogue) return;
    for (size_t i = 0; i < catalogue->count; i++) release_model(&catalogue->models[i]);
    free(catalogue->models);
    free(catalogue);
}

const struct catalogue_model *catalogue_find(const struct catalogue *catalogue, const char *name)
{
    for (size_t i = 0; i < catalogue->count; i++)
        if (!strcmp(catalogue->models[i].name, name)) return &catalogue->models[i];
    return NULL;
}

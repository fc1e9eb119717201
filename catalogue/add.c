#include "catalogue/add.h"

#include "catalogue/folder.h"
#include "catalogue/inspect.h"
#include "catalogue/parts.h"
#include "catalogue/portrait.h"
#include "catalogue/sheet.h"
#include "gen/model/rig.h"
#include "gen/motion/repertoire.h"
#include "lib/file.h"
#include "lib/image.h"

#include <ctype.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define SURE 0.9             /* what is less sure must be said by the user */
#define MISFIT_MAX 4.0       /* standard deviations that a size may be off */
#define OPEN_MUCH 0.02
#define INWARD_MUCH 0.02
#define CONTACT_LITTLE 0.3
#define TRIANGLES_MANY 500000
#define GROUND_OFF_M 0.02
/* Not called as the model is: its own textures may be. */
#define PICTURE "four-sides.png"
#define REFUSED_FOLDER "out/models"

struct adding {
    const struct add_options *options;
    char name[64];
    struct known known;
    struct guess guess;
    struct model_options model_options;
    struct model *model;
    struct inspection inspection;
};

/* --- reading --- */

/* Letters in small, and one - for whatever else there is between them. */
static bool choose_name(struct adding *a, struct error *err)
{
    size_t n = 0;
    const char *from = path_name(a->options->file), *end = strrchr(from, '.');
    if (a->options->name) {
        snprintf(a->name, sizeof a->name, "%s", a->options->name);
    } else {
        for (; from < end && n + 4 < sizeof a->name; from++) {
            unsigned char c = (unsigned char)*from;
            if (isalnum(c)) a->name[n++] = (char)tolower(c);
            else if (n && a->name[n - 1] != '-') a->name[n++] = '-';
        }
        while (n && a->name[n - 1] == '-') n--;
        a->name[n] = 0;
    }
    return (catalogue_name_is_good(a->name) && (!a->options->name || strlen(a->options->name) < sizeof a->name)) ||
           error_at(err, ERR_INPUT, a->options->file, 0, 0, "\"%.80s\" is no name for a model: say one with --name, a letter and then letters, digits, - and _",
                    a->options->name ? a->options->name : a->name);
}

static bool has_extension(const char *path, const char *extension)
{
    const char *dot = strrchr(path_name(path), '.');
    return dot && !strcasecmp(dot, extension);
}

/* In the file's own axes, whatever its unit: as if it were one metre long. */
static bool load_raw(struct model **raw, const struct adding *a, struct error *err)
{
    struct model_options options = { .length_m = 1, .axes_given = true, .up = AXIS_POS_Z, .front = AXIS_POS_X };
    return model_load(raw, a->options->file, &options, err);
}

static bool guess_rest(struct adding *a, struct error *err)
{
    struct model *raw = NULL;
    if (!load_raw(&raw, a, err)) return false;
    a->known = a->options->known;
    a->known.name = path_name(a->options->file);
    a->known.format_has_axes = has_extension(a->options->file, ".glb") || has_extension(a->options->file, ".gltf");
    a->known.stated_unit_m = raw->stated_unit_m;
    a->guess = guess_model(raw, &a->known);
    model_destroy(raw);
    return true;
}

static bool load(struct adding *a, struct error *err)
{
    struct material_rules *rules = NULL;
    if (!material_rules_read(&rules, a->options->rules, err)) return false;
    a->model_options = (struct model_options){ .unit_m = a->guess.unit_m, .axes_given = true, .up = a->guess.up, .front = a->guess.front,
                                               .has_class = true, .class_ = a->guess.class_, .rules = rules };
    bool ok = model_load(&a->model, a->options->file, &a->model_options, err);
    a->model_options.rules = NULL;
    material_rules_destroy(rules);
    return ok && inspect_model(&a->inspection, a->model, err);
}

/* --- saying --- */

static int percent(double share) { return (int)floor(100 * share); }

static void say_sure(const char *what, const char *value, bool given, double sure, const char *by)
{
    if (given) printf("  %-8s %s, as you say\n", what, value);
    else printf("  %-8s %s, by %s (%d %%)\n", what, value, by, percent(sure));
}

static void warn(const char *format, ...) __attribute__((format(printf, 1, 2)));
static void warn(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fputs("  !        ", stdout);
    vprintf(format, args);
    fputc('\n', stdout);
    va_end(args);
}

static void say_guess(const struct adding *a)
{
    const struct guess *g = &a->guess;
    const struct known *k = &a->known;
    char unit[64];
    snprintf(unit, sizeof unit, "%.6g m", g->unit_m);
    say_sure("class", class_info(g->class_)->name, k->has_class, g->class_sure, "its name and its size");
    say_sure("unit", unit, k->unit_m > 0 || k->length_m > 0 || k->height_m > 0, g->unit_sure, "its size");
    say_sure("up", axis_name(g->up), k->has_up, g->up_sure, "its size");
    say_sure("front", axis_name(g->front), k->has_front, fmin(g->along_sure, g->front_sure),
             g->along_sure < g->front_sure ? "its size" : g->front_by);
}

static void say_materials(const struct model *model)
{
    size_t paints = 0;
    for (size_t i = 0; i < model->material_count; i++)
        if (model->materials[i].kind == FINISH_PAINT) printf("%s%s", paints++ ? ", " : "  paint    an entity's colour goes to ", model->materials[i].name);
    if (paints) fputc('\n', stdout);
    else puts("  paint    none: an entity's colour changes nothing");
}

static void say_model(const struct adding *a)
{
    const struct model *m = a->model;
    const struct inspection *s = &a->inspection;
    const struct vec3 size = vec3_sub(m->max_m, m->min_m);
    bool person = class_info(a->guess.class_)->is_person;
    printf("  size     %.2f x %.2f x %.2f m (length x width x height)\n", size.x, size.y, size.z);
    printf("  surface  %zu triangles in %zu material%s; %.1f %% of its edges are open, %.1f %% of what is seen of it looks inward\n", s->triangles,
           m->material_count, m->material_count == 1 ? "" : "s", 100 * s->open_share, 100 * s->inward_share);
    if (m->image_count) printf("  textures %zu, of up to %d px\n", m->image_count, s->largest_texture_px);
    if (!person) say_materials(m);
    if (m->rig) printf("  motion   %zu animation%s\n", m->rig->animation_count, m->rig->animation_count == 1 ? "" : "s");
    else if (person) puts("  motion   none: as traffic it glides");
    if (fabs(m->lowest_m) > GROUND_OFF_M)
        printf("  ground   its lowest point lies %.2f m %s the file's zero: it is stood on the ground\n", fabs(m->lowest_m), m->lowest_m > 0 ? "above" : "below");
    else puts("  ground   it stands on the file's zero");
    if (!person && fmin(s->contact_length, s->contact_width) < CONTACT_LITTLE)
        warn("only %d %% of its length and %d %% of its width touch the ground: does something reach below its wheels, or are the axes others?",
             percent(s->contact_length), percent(s->contact_width));
    if (s->open_share > OPEN_MUCH) warn("it is not closed: light and looks go in where an edge is open; close it where the picture shows it");
    if (s->inward_share > INWARD_MUCH) warn("some faces look inward: turn them around in a modelling program, if the picture shows them wrong");
    if (s->triangles > TRIANGLES_MANY) warn("so many triangles make each picture slow; under %d would be right", TRIANGLES_MANY);
    for (size_t i = 0; i < m->missing_texture_count; i++)
        warn("the texture %s is neither beside it nor in the folders around it: its material has its plain colour", m->missing_textures[i]);
}

/* --- judging --- */

static enum axis opposite(enum axis axis) { return (enum axis)(axis ^ 1); }

static bool is_sure(const struct adding *a, struct error *err)
{
    const struct guess *g = &a->guess;
    const struct known *k = &a->known;
    struct vec3 usual;
    bool sized = k->unit_m > 0 || k->length_m > 0 || k->height_m > 0, has_size = class_size(&usual, g->class_);
    const char *file = a->options->file;
    if (!k->has_class && g->class_sure < SURE)
        return error_at(err, ERR_INPUT, file, 0, 0, "what is it? Nothing says for sure that it is of class %s (%d %%): say --class car, or another",
                        class_info(g->class_)->name, percent(g->class_sure));
    if (has_size && g->misfit > MISFIT_MAX && !sized)
        return error_at(err, ERR_INPUT, file, 0, 0, "no usual unit makes it as large as a %s, about %.1f x %.1f x %.1f m: say --length or --height in metres, or another --class",
                        class_info(g->class_)->name, usual.x, usual.y, usual.z);
    if (!sized && g->unit_sure < SURE)
        return error_at(err, ERR_INPUT, file, 0, 0, "how large is it? Nothing says for sure that its unit is %.6g m (%d %%): say --length or --height in metres, or --unit",
                        g->unit_m, percent(g->unit_sure));
    if (!k->has_up && g->up_sure < SURE)
        return error_at(err, ERR_INPUT, file, 0, 0, "which way is up? Nothing says for sure that it is %s (%d %%): say --up +z, or another axis",
                        axis_name(g->up), percent(g->up_sure));
    if (!k->has_front && g->along_sure < SURE)
        return error_at(err, ERR_INPUT, file, 0, 0, "which way is its front? Nothing says for sure that it is %s (%d %%): look at the picture, and say --front and an axis",
                        axis_name(g->front), percent(fmin(g->along_sure, g->front_sure)));
    if (!k->has_front && g->front_sure < SURE)
        return error_at(err, ERR_INPUT, file, 0, 0, "which way is its front? Nothing says for sure that it is %s (%d %%): look at the picture, and say --front %s, or --front %s if it is shown from behind",
                        axis_name(g->front), percent(g->front_sure), axis_name(g->front), axis_name(opposite(g->front)));
    return true;
}

/* Who walks must be able to. */
static bool can_move(const struct adding *a, struct error *err)
{
    struct repertoire repertoire = { 0 };
    if (!a->model->rig) return true;
    bool ok = repertoire_create(&repertoire, a->model, err);
    repertoire_release(&repertoire);
    return ok;
}

/* --- keeping --- */

static bool write_picture(const struct adding *a, const char *path, struct error *err)
{
    static const enum side sides[] = { SIDE_FRONT, SIDE_LEFT, SIDE_REAR, SIDE_ABOVE };
    const struct vec3 size = vec3_sub(a->model->max_m, a->model->min_m);
    char *absolute = realpath(a->options->file, NULL), *folder = path_folder(path), *work = folder ? string_format("%s/.picture", folder) : NULL;
    struct sitter sitter = { .name = a->name, .file = absolute, .options = a->model_options, .size_m = { size.x, size.y, size.z } };
    const struct portrait_options options = { .width_px = a->options->width_px, .quick = true, .quiet = true };
    struct portraits portraits = { 0 };
    struct image sheet = { 0 };
    puts("  ...      is being rendered from four sides");
    fflush(stdout);
    bool ok = absolute && work ? true : error_set(err, ERR_MEMORY, "no memory for a picture");
    ok = ok && portraits_make(&portraits, &sitter, 1, sides, SIDE_COUNT, &options, work, err) &&
         sheet_make(&sheet, portraits.pictures, (const char *const[]){ "front", "left side", "rear", "front left, from above" }, SIDE_COUNT, 2, err) &&
         image_write(path, &sheet, err);
    image_release(&sheet);
    portraits_release(&portraits);
    free(work);
    free(folder);
    free(absolute);
    return ok;
}

static bool write_entry(const struct adding *a, const char *folder, struct error *err)
{
    const struct vec3 size = vec3_sub(a->model->max_m, a->model->min_m);
    char *path = string_format("%s/catalogue.json", folder), *absolute = realpath(a->options->file, NULL);
    json_t *entry = json_pack("{s:s, s:s, s:s, s:f, s:s, s:s, s:f, s:f, s:f, s:[i], s:s, s:s}", "name", a->name, "class",
                              class_info(a->guess.class_)->name, "file", path_name(a->options->file), "unit_m", a->guess.unit_m, "up",
                              axis_name(a->guess.up), "front", axis_name(a->guess.front), "length_m", size.x, "width_m", size.y, "height_m", size.z,
                              "triangles", (int)a->inspection.triangles, "source", absolute ? absolute : a->options->file, "picture", PICTURE);
    if (entry && a->options->license) json_object_set_new(entry, "license", json_string(a->options->license));
    json_t *root = entry ? json_pack("{s:[o]}", "models", entry) : NULL;
    char *text = root ? json_dumps(root, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) : NULL;
    bool ok = path && text ? file_write(path, text, strlen(text), err)
                           : error_set(err, ERR_INPUT, "the name of the file or the licence is no UTF-8: another name would be right");
    free(text);
    json_decref(root);
    free(absolute);
    free(path);
    return ok;
}

/* The copy is the model, with all that belongs to it. */
static bool check_copy(const struct adding *a, const char *folder, struct error *err)
{
    struct model *copy = NULL;
    char *path = string_format("%s/%s", folder, path_name(a->options->file));
    bool ok = path ? model_load(&copy, path, &a->model_options, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    if (ok && (copy->missing_texture_count != a->model->missing_texture_count || copy->image_count != a->model->image_count))
        ok = error_at(err, ERR_INPUT, a->options->file, 0, 0, "its copy lacks a texture that the model finds where it is: put the textures beside it");
    model_destroy(copy);
    free(path);
    return ok;
}

static bool picture_is_free(const struct adding *a, const char *picture, struct error *err)
{
    return !file_exists(picture) || error_at(err, ERR_INPUT, a->options->file, 0, 0, "has a texture called \"" PICTURE "\", "
                                             "as the picture of what was added is: another name would be right");
}

static bool keep(const struct adding *a, struct error *err)
{
    struct parts parts = { 0 };
    char *folder = string_format("%s/%s", a->options->folder, a->name), *part = string_format("%s/.%s.part", a->options->folder, a->name);
    char *picture = part ? string_format("%s/" PICTURE, part) : NULL;
    bool ok = folder && part && picture ? true : error_set(err, ERR_MEMORY, "no memory for a path");
    char *entry = ok ? string_format("%s/catalogue.json", folder) : NULL;
    if (ok && entry && file_exists(entry) && !a->options->replace)
        ok = error_at(err, ERR_INPUT, folder, 0, 0, "is there already: --replace takes its place, --name gives another name");
    free(entry);
    if (ok) {
        folder_remove(part);
        ok = folder_make(part, err) && parts_find(&parts, a->model, err) && parts_copy(&parts, part, err) && check_copy(a, part, err) &&
             picture_is_free(a, picture, err) && write_entry(a, part, err) && write_picture(a, picture, err) && folder_commit(part, folder, a->options->replace, err);
        if (!ok) folder_remove(part);
    }
    if (ok) printf("picture: %s/" PICTURE "\nadded: \"model: %s\" in a scene\n", folder, a->name);
    parts_release(&parts);
    free(picture);
    free(part);
    free(folder);
    return ok;
}

/* What was refused can be looked at all the same. */
static void show_refused(const struct adding *a)
{
    struct error ignored = ERROR_NONE;
    char *path = string_format(REFUSED_FOLDER "/%s.png", a->name);
    if (path && folder_make(REFUSED_FOLDER, &ignored) && write_picture(a, path, &ignored)) printf("picture: %s\n", path);
    free(path);
}

bool add_model(const struct add_options *options, struct error *err)
{
    struct adding a = { .options = options };
    bool ok = choose_name(&a, err) && guess_rest(&a, err);
    if (ok) {
        printf("%s:\n", options->file);
        say_guess(&a);
        fflush(stdout);
        struct error unsure = ERROR_NONE;
        bool sure = is_sure(&a, &unsure);
        ok = load(&a, err);
        if (ok) say_model(&a);
        ok = ok && (can_move(&a, err) || error_prefix(err, "as a model that moves: "));
        if (ok && !sure) {
            *err = unsure;
            ok = false;
        }
        if (!ok && !sure && a.model) show_refused(&a);
        ok = ok && keep(&a, err);
    }
    model_destroy(a.model);
    return ok;
}

/* Catalogues as folders hold them, and what is wrong with them. */
#include "gen/model/catalogue.h"

#include "tests/gen/model_files.h"
#include "tests/tap.h"

static struct catalogue *read_folders(const char *first, const char *second, struct error *err)
{
    char *paths[2] = { string_format("%s/%s", folder, first), string_format("%s/%s", folder, second) };
    struct catalogue *catalogue = NULL;
    catalogue_read(&catalogue, (const char *const[]){ paths[0], paths[1], NULL }, err);
    free(paths[0]);
    free(paths[1]);
    return catalogue;
}

static bool ends_in(const char *path, const char *end)
{
    size_t n = path ? strlen(path) : 0, m = strlen(end);
    return n > m && !strcmp(path + n - m, end);
}

static void a_model_is_what_its_entry_says(void)
{
    struct error err = ERROR_NONE;
    put_text("a/catalogue.json",
             "{\"models\": [{\"name\": \"sedan\", \"class\": \"car\", \"kind\": \"vehicle\", \"file\": \"sedan.glb\", \"far\": \"low/sedan.glb\","
             " \"weight\": 2.5, \"length_m\": 4.6, \"width_m\": 1.8, \"height_m\": 1.45, \"wheelbase_m\": 2.7, \"triangles\": [30000, 2000, 300],"
             " \"colors\": [{\"color\": \"#ffffff\", \"weight\": 3}, {\"color\": \"#ff0000\", \"weight\": 1}],"
             " \"animations\": [\"roll\", \"steer\"], \"license\": \"CC0-1.0\", \"source\": \"a table\"},"
             " {\"name\": \"fire-engine\", \"class\": \"fire truck\", \"file\": \"/abs/f.obj\", \"unit_m\": 0.01, \"up\": \"+z\", \"front\": \"-y\"}]}");
    struct catalogue *c = read_folders("a", "none", &err);
    if (!OK(c && c->count == 2, "two models of one file; a folder that is not there holds none %s", err.text)) return;
    const struct catalogue_model *m = &c->models[0], *f = &c->models[1];
    OK(ends_in(m->files[DETAIL_NEAR], "/a/sedan.glb") && !m->files[DETAIL_MIDDLE] && ends_in(m->files[DETAIL_FAR], "/a/low/sedan.glb"),
       "files are seen from the catalogue's folder; one that is not named is not there");
    OK(m->class_ == CLASS_CAR && m->weight == 2.5 && m->size_m[0] == 4.6 && m->size_m[2] == 1.45 && m->triangles[DETAIL_MIDDLE] == 2000,
       "class, weight, size and triangles");
    OK(m->color_count == 2 && m->colors[0].linear[1] == 1 && m->colors[1].linear[0] == 1 && m->colors[1].linear[1] == 0 && m->colors[0].weight == 3,
       "colours with their weights");
    OK(!strcmp(m->animations, "roll, steer") && !strcmp(m->license, "CC0-1.0") && !strcmp(m->source, "a table"), "animations, licence, source");
    OK(!m->options.axes_given && m->options.has_class && m->options.class_ == CLASS_CAR, "a file that states its axes needs none");
    OK(!strcmp(f->files[0], "/abs/f.obj") && f->class_ == CLASS_FIRE_TRUCK && f->options.unit_m == 0.01 && f->options.axes_given &&
           f->options.up == AXIS_POS_Z && f->options.front == AXIS_NEG_Y && f->weight == 1 && !f->color_count && !*f->license,
       "unit and axes of one that does not; the rest is left out");
    OK(catalogue_find(c, "fire-engine") == f && !catalogue_find(c, "Sedan"), "found by name, exactly");
    catalogue_destroy(c);
}

static void folders_come_in_their_order(void)
{
    struct error err = ERROR_NONE;
    put_text("b/zebra/catalogue.json", "{\"models\": [{\"name\": \"zebra\", \"class\": \"animal\", \"file\": \"z.glb\"}]}");
    put_text("b/ant/catalogue.json", "{\"models\": [{\"name\": \"sedan\", \"class\": \"van\", \"file\": \"mine.glb\"}]}");
    put_text("b/.part/catalogue.json", "broken");
    struct catalogue *c = read_folders("b", "a", &err);
    if (!OK(c && c->count == 3, "one folder below has a catalogue of its own; hidden folders have none %s", err.text)) return;
    OK(!strcmp(c->models[0].name, "sedan") && c->models[0].class_ == CLASS_VAN && !strcmp(c->models[1].name, "zebra"), "in the order of their names");
    OK(ends_in(catalogue_find(c, "sedan")->files[0], "/b/ant/mine.glb") && catalogue_find(c, "fire-engine"), "of one name the first is taken");
    catalogue_destroy(c);
}

static void names_are_words(void)
{
    OK(catalogue_name_is_good("box-truck_2") && catalogue_name_is_good("A"), "letters, digits, - and _ are good");
    OK(!catalogue_name_is_good("") && !catalogue_name_is_good("2cv") && !catalogue_name_is_good("any car") && !catalogue_name_is_good("../x") &&
           !catalogue_name_is_good(".x"),
       "blanks, slashes, and digits in front are not");
}

static void wrong(const char *entry, const char *want)
{
    struct error err = ERROR_NONE;
    char *text = string_format("{\"models\": [%s]}", entry);
    put_text("bad/catalogue.json", text);
    struct catalogue *c = read_folders("bad", "none", &err);
    OK(!c && err.code == ERR_INPUT && ends_in(err.file, "/bad/catalogue.json") && !strcmp(err.text, want), "refused: %s", want);
    if (strcmp(err.text, want)) printf("# got: %s\n", err.text);
    catalogue_destroy(c);
    free(text);
}

static void what_is_wrong_is_said(void)
{
    struct error err = ERROR_NONE;
    wrong("3", "models[0]: must be an object");
    wrong("{\"class\": \"car\"}", "models[0]: \"name\" is missing");
    wrong("{\"name\": \"a b\"}", "model \"a b\": \"name\" is \"a b\": a letter, then up to 59 letters, digits, - and _ would be right");
    wrong("{\"name\": \"a\"}", "model \"a\": \"class\" is missing");
    wrong("{\"name\": \"a\", \"class\": \"lorry\", \"file\": \"x\"}", "model \"a\": \"class\" is \"lorry\": car, van, truck, person or another class would be right");
    wrong("{\"name\": \"a\", \"class\": \"car\"}", "model \"a\": \"file\" is missing");
    wrong("{\"name\": \"a\", \"class\": \"car\", \"file\": \"x\", \"length_m\": -1}", "model \"a\": \"length_m\" must be from 1e-06 to 1000, not -1");
    wrong("{\"name\": \"a\", \"class\": \"car\", \"file\": \"x\", \"up\": \"z\"}", "model \"a\": \"front\" is missing");
    wrong("{\"name\": \"a\", \"class\": \"car\", \"file\": \"x\", \"up\": \"z\", \"front\": \"-z\"}", "model \"a\": \"front\" lies on the axis that points up");
    wrong("{\"name\": \"a\", \"class\": \"car\", \"file\": \"x\", \"triangles\": [0]}", "model \"a\": \"triangles\" must hold whole numbers from 1");
    wrong("{\"name\": \"a\", \"class\": \"car\", \"file\": \"x\", \"colors\": [{\"color\": \"red\", \"weight\": 1}]}",
          "model \"a\": \"colors\" must hold {\"color\": \"#rrggbb\", \"weight\": number above 0}, and number 1 does not");
    wrong("{\"name\": \"a\", \"class\": \"car\", \"file\": \"x\"}, {\"name\": \"a\", \"class\": \"car\", \"file\": \"y\"}",
          "names two models \"a\": a name of its own for each would be right");
    put_text("bad/catalogue.json", "{\"models\": [\n}");
    struct catalogue *c = read_folders("bad", "none", &err);
    OK(!c && err.line == 2, "no JSON: refused at its line (%d: %s)", err.line, err.text);
    catalogue_destroy(c);
}

static void what_was_made_is_there(void)
{
    struct error err = ERROR_NONE;
    struct catalogue *c = NULL;
    const char *built = getenv("top_builddir");
    char *models = string_format("%s/models", built ? built : ".");
    if (OK(catalogue_read(&c, (const char *const[]){ models, NULL }, &err), "the catalogue that comes with the program %s", err.text)) {
        size_t missing = 0, unlicensed = 0;
        for (size_t i = 0; i < c->count; i++) {
            for (int k = 0; k < DETAIL_COUNT; k++) missing += c->models[i].files[k] && !file_exists(c->models[i].files[k]);
            unlicensed += strcmp(c->models[i].license, "CC0-1.0") != 0;
        }
        OK(catalogue_find(c, "sedan") && missing == 0 && unlicensed == 0, "its %zu models are there and free for any use", c->count);
    }
    catalogue_destroy(c);
    free(models);
}

int main(void)
{
    if (!OK(mkdtemp(folder) != NULL, "a folder")) return tap_done();
    a_model_is_what_its_entry_says();
    folders_come_in_their_order();
    names_are_words();
    what_is_wrong_is_said();
    what_was_made_is_there();
    remove_tree(folder);
    return tap_done();
}

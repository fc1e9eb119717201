#include "gen/model/material.h"

#include "lib/file.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Figures of a material that a rule can set: its own where given, else its finish's. */
enum figure { ROUGHNESS, METALLIC, CLEARCOAT, CLEARCOAT_ROUGHNESS, TRANSMISSION, IOR, FIGURE_COUNT };

static const struct { const char *name; double min, max; } figures[FIGURE_COUNT] = {
    [ROUGHNESS] = { "roughness", 0, 1 },
    [METALLIC] = { "metallic", 0, 1 },
    [CLEARCOAT] = { "clearcoat", 0, 1 },
    [CLEARCOAT_ROUGHNESS] = { "clearcoat_roughness", 0, 1 },
    [TRANSMISSION] = { "transmission", 0, 1 },
    [IOR] = { "ior", 1, 3 },
};

static const char *const finish_names[FINISH_KIND_COUNT] = {
    [FINISH_PBR] = "pbr",         [FINISH_GLASS] = "glass",   [FINISH_PLASTIC] = "plastic", [FINISH_PAINT] = "paint",
    [FINISH_CHROME] = "chrome", [FINISH_RUBBER] = "rubber", [FINISH_DULL] = "dull",
};

struct finish {
    enum finish_kind kind;
    bool given[FIGURE_COUNT];
    double value[FIGURE_COUNT];
};

struct rule { char *keyword; struct finish finish; };

struct material_rules {
    struct rule *rules;
    size_t rule_count;
    struct finish default_[CLASS_COUNT + 1]; /* the last: any class */
    bool has_default[CLASS_COUNT + 1];
};

void material_default(struct material *material)
{
    *material = (struct material){ .kind = FINISH_PBR, .base_color = { 1, 1, 1 }, .alpha = 1, .alpha_cutoff = 0.5,
                                   .roughness = 1, .ior = 1.5 };
}

static size_t texel(double t, int size)
{
    double i = floor((t - floor(t)) * size);
    return i < size ? (size_t)i : (size_t)size - 1;
}

double material_alpha(const struct material *material, double u, double v)
{
    if (material->alpha_mode == ALPHA_OPAQUE) return 1;
    double alpha = material->alpha;
    const struct image *image = &material->base_image;
    if (image->data && image->channels == 4) {
        size_t x = texel(u, image->width_px), y = texel(1 - v, image->height_px);
        alpha *= *(image_u8(image, (int)x, (int)y) + 3) / 255.0;
    }
    return material->alpha_mode == ALPHA_MASK ? alpha >= material->alpha_cutoff : alpha;
}

#define GLASS_MATTE 0.3 /* as templates/materials.inc */

void material_reflectance(double rgb[3], const struct material *m, const double *paint, double u, double v)
{
    bool painted = paint && m->kind == FINISH_PAINT;
    const double *color = painted ? paint : m->base_color;
    const struct image *image = &m->base_image;
    double f0 = pow((m->ior - 1) / (m->ior + 1), 2), smooth = pow(1 - m->roughness, 2);
    double gloss = (f0 + (1 - f0) / 21) * fmax(m->clearcoat, smooth * (1 - m->metallic)); /* Schlick's, over the hemisphere */
    double matte = m->transmission > 0 || m->kind == FINISH_GLASS ? GLASS_MATTE * (1 - m->transmission)
                                                                  : 1 - m->metallic + m->metallic * (0.8 + 0.2 * smooth);
    for (int c = 0; c < 3; c++) rgb[c] = color[c] * matte;
    if (image->data && !painted) {
        const uint8_t *texels = image_u8(image, (int)texel(u, image->width_px), (int)texel(1 - v, image->height_px));
        for (int c = 0; c < 3; c++) rgb[c] *= (double)linear_from_srgb((float)texels[c] / 255);
    }
    for (int c = 0; c < 3; c++) rgb[c] = rgb[c] * (1 - gloss) + gloss;
}

/* --- reading rules --- */

struct reader {
    const char *path, *line, *at; /* the line's start, and the place in it */
    int number;
    struct error *err;
};

static int column(const struct reader *r)
{
    return (int)(r->at - r->line) + 1;
}

static void skip_blanks(struct reader *r)
{
    while (*r->at == ' ' || *r->at == '\t' || *r->at == '\r') r->at++;
}

static bool at_end(const struct reader *r)
{
    return !*r->at || *r->at == '\n' || *r->at == '#';
}

/* A word, or what stands between double quotes (blanks and all). The caller frees. */
static bool read_word(struct reader *r, char **word)
{
    const char *start = r->at;
    if (*start == '"') {
        const char *end = ++start;
        while (*end && *end != '"' && *end != '\n') end++;
        if (*end != '"')
            return error_at(r->err, ERR_INPUT, r->path, r->number, column(r), "a quote is opened and not closed in this line");
        *word = strndup(start, (size_t)(end - start));
        r->at = end + 1;
    } else {
        while (!at_end(r) && !strchr(" \t\r,:=\"", *r->at)) r->at++;
        if (r->at == start)
            return error_at(r->err, ERR_INPUT, r->path, r->number, column(r), "a word was expected, not \"%c\"", *start);
        *word = strndup(start, (size_t)(r->at - start));
    }
    if (!*word) return error_set(r->err, ERR_MEMORY, "no memory for material rules");
    skip_blanks(r);
    return true;
}

/* KIND figure=value ... up to the end of the line. */
static bool read_finish(struct reader *r, struct finish *finish)
{
    char *word = NULL;
    *finish = (struct finish){ .kind = FINISH_KIND_COUNT };
    int word_column = column(r);
    if (at_end(r))
        return error_at(r->err, ERR_INPUT, r->path, r->number, word_column,
                        "a finish is missing after \":\": pbr, glass, plastic, paint, chrome, rubber or dull");
    if (!read_word(r, &word)) return false;
    for (int k = 0; k < FINISH_KIND_COUNT; k++)
        if (!strcmp(word, finish_names[k])) finish->kind = (enum finish_kind)k;
    if (finish->kind == FINISH_KIND_COUNT)
        error_at(r->err, ERR_INPUT, r->path, r->number, word_column,
                 "unknown finish \"%s\": pbr, glass, plastic, paint, chrome, rubber or dull would be right", word);
    free(word);
    while (r->err->code == ERR_OK && !at_end(r)) {
        word_column = column(r);
        if (!read_word(r, &word)) break;
        int f = 0;
        while (f < FIGURE_COUNT && strcmp(word, figures[f].name) != 0) f++;
        if (f == FIGURE_COUNT)
            error_at(r->err, ERR_INPUT, r->path, r->number, word_column,
                     "unknown figure \"%s\": roughness, metallic, clearcoat, clearcoat_roughness, transmission or ior would be right", word);
        else if (*r->at != '=')
            error_at(r->err, ERR_INPUT, r->path, r->number, column(r), "\"=\" and a number were expected after \"%s\"", word);
        free(word);
        if (r->err->code != ERR_OK) break;
        r->at++;
        skip_blanks(r);
        word_column = column(r);
        char *end;
        double value = strtod(r->at, &end);
        bool number = end != r->at && (!*end || strchr(" \t\r\n#", *end));
        if (!number || !(value >= figures[f].min && value <= figures[f].max))
            return error_at(r->err, ERR_INPUT, r->path, r->number, word_column, "%s must be a number from %g to %g",
                            figures[f].name, figures[f].min, figures[f].max);
        finish->given[f] = true;
        finish->value[f] = value;
        r->at = end;
        skip_blanks(r);
    }
    return r->err->code == ERR_OK;
}

static bool add_rule(struct material_rules *rules, const char *keyword, const struct finish *finish, struct error *err)
{
    struct rule *grown = realloc(rules->rules, (rules->rule_count + 1) * sizeof *grown);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for material rules");
    rules->rules = grown;
    char *copy = strdup(keyword);
    if (!copy) return error_set(err, ERR_MEMORY, "no memory for material rules");
    for (char *c = copy; *c; c++) *c = (char)tolower((unsigned char)*c);
    rules->rules[rules->rule_count++] = (struct rule){ copy, *finish };
    return true;
}

/* keyword, keyword ... : FINISH     or     default CLASS, CLASS ... : FINISH */
static bool read_line(struct material_rules *rules, struct reader *r)
{
    char *words[64];
    int columns[64];
    size_t n = 0;
    bool is_default = false;
    skip_blanks(r);
    if (at_end(r)) return true;
    if (!strncmp(r->at, "default", 7) && strchr(" \t:", r->at[7])) {
        is_default = true;
        r->at += 7;
        skip_blanks(r);
    }
    while (!(is_default && n == 0 && *r->at == ':')) {
        if (n == sizeof words / sizeof *words) {
            error_at(r->err, ERR_INPUT, r->path, r->number, column(r), "a line holds at most %zu words", n);
            goto out;
        }
        if (at_end(r)) {
            error_at(r->err, ERR_INPUT, r->path, r->number, column(r), "\":\" and a finish were expected: \"keyword, keyword: finish\"");
            goto out;
        }
        columns[n] = column(r);
        if (!read_word(r, &words[n])) goto out;
        if (!words[n++][0]) {
            error_at(r->err, ERR_INPUT, r->path, r->number, columns[n - 1], "an empty keyword would match every name: use \"default\"");
            goto out;
        }
        if (*r->at == ':') break;
        if (!at_end(r) && *r->at != ',') {
            error_at(r->err, ERR_INPUT, r->path, r->number, column(r),
                     "\",\" or \":\" was expected; a keyword of several words goes in double quotes");
            goto out;
        }
        if (!at_end(r)) r->at++;
        skip_blanks(r);
    }
    r->at++;
    skip_blanks(r);
    struct finish finish;
    if (!read_finish(r, &finish)) goto out;
    if (is_default && n == 0) {
        rules->default_[CLASS_COUNT] = finish;
        rules->has_default[CLASS_COUNT] = true;
    }
    for (size_t i = 0; i < n; i++) {
        enum entity_class class_;
        if (!is_default) {
            if (!add_rule(rules, words[i], &finish, r->err)) goto out;
        } else if (class_from_name(&class_, words[i])) {
            rules->default_[class_] = finish;
            rules->has_default[class_] = true;
        } else {
            error_at(r->err, ERR_INPUT, r->path, r->number, columns[i], "unknown class \"%s\": car, van, truck, person or another class would be right", words[i]);
            goto out;
        }
    }
out:
    for (size_t i = 0; i < n; i++) free(words[i]);
    return r->err->code == ERR_OK;
}

bool material_rules_read(struct material_rules **rules, const char *path, struct error *err)
{
    char *text;
    size_t size;
    if (!file_read(&text, &size, path, err)) return false;
    struct material_rules *made = calloc(1, sizeof *made);
    if (!made) {
        free(text);
        return error_set(err, ERR_MEMORY, "no memory for material rules");
    }
    struct reader r = { .path = path, .number = 1, .err = err };
    for (const char *line = text; line && *line; r.number++) {
        r.line = r.at = line;
        if (!read_line(made, &r)) break;
        line = strchr(line, '\n');
        if (line) line++;
    }
    if (err->code == ERR_OK && strlen(text) != size)
        error_at(err, ERR_INPUT, path, r.number, 1, "is not a text file");
    if (err->code == ERR_OK && !made->has_default[CLASS_COUNT])
        error_at(err, ERR_INPUT, path, 0, 0, "has no line \"default: finish\", which decides where no keyword is found");
    free(text);
    if (err->code != ERR_OK) {
        material_rules_destroy(made);
        return false;
    }
    *rules = made;
    return true;
}

void material_rules_destroy(struct material_rules *rules)
{
    if (!rules) return;
    for (size_t i = 0; i < rules->rule_count; i++) free(rules->rules[i].keyword);
    free(rules->rules);
    free(rules);
}

/* --- applying them --- */

/* Lower case, one blank between words and at both ends: "CarBody_01" becomes " car body 01 ". */
static void split_words(char *words, size_t size, const char *name)
{
    size_t n = 0;
    words[n++] = ' ';
    for (const char *c = name; *c && n + 3 < size; c++) {
        unsigned char now = (unsigned char)*c, before = c > name ? (unsigned char)c[-1] : ' ';
        bool digit_edge = isdigit(now) ? isalpha(before) : isalpha(now) && isdigit(before);
        bool case_edge = isupper(now) && islower(before);
        if ((!isalnum(now) || case_edge || digit_edge) && words[n - 1] != ' ') words[n++] = ' ';
        if (isalnum(now)) words[n++] = (char)tolower(now);
    }
    if (words[n - 1] != ' ') words[n++] = ' ';
    words[n] = 0;
}

static const struct finish *find(const struct material_rules *rules, const char *name)
{
    char words[2 * sizeof((struct material *)0)->name + 4];
    split_words(words, sizeof words, name);
    for (size_t i = 0; i < rules->rule_count; i++)
        if (strstr(words, rules->rules[i].keyword)) return &rules->rules[i].finish;
    return NULL;
}

void material_rules_apply(const struct material_rules *rules, struct material *material, enum entity_class class_)
{
    const struct finish *finish = find(rules, material->name);
    bool person = class_ < CLASS_COUNT && class_info(class_)->is_person;
    if (person && finish && finish->kind == FINISH_PAINT) finish = NULL; /* a "Body" that is no car's */
    if (!material->names_only) {
        if (finish && finish->kind == FINISH_PAINT) material->kind = FINISH_PAINT;
        return;
    }
    if (!finish) finish = &rules->default_[rules->has_default[class_] ? class_ : CLASS_COUNT];
    double *target[FIGURE_COUNT] = { [ROUGHNESS] = &material->roughness, [METALLIC] = &material->metallic,
                                     [CLEARCOAT] = &material->clearcoat,
                                     [CLEARCOAT_ROUGHNESS] = &material->clearcoat_roughness,
                                     [TRANSMISSION] = &material->transmission, [IOR] = &material->ior };
    material->kind = finish->kind;
    for (int f = 0; f < FIGURE_COUNT; f++)
        if (finish->given[f]) *target[f] = finish->value[f];
}

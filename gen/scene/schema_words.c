#include "gen/scene/schema_words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void words_vadd(struct words *words, const char *format, va_list args)
{
    size_t room = sizeof words->text - words->length;
    int n = vsnprintf(words->text + words->length, room, format, args);
    if (n > 0) words->length += (size_t)n < room ? (size_t)n : room - 1;
}

void words_add(struct words *words, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    words_vadd(words, format, args);
    va_end(args);
}

const char *schema_child(const char *path, const char *parent)
{
    size_t n = strlen(parent);
    if (n && (strncmp(path, parent, n) || path[n++] != '.')) return NULL;
    return strchr(path + n, '.') ? NULL : path + n;
}

static void add_limits(struct words *w, const struct schema_key *key)
{
    if (!(key->min < key->max)) return;
    if (isinf(key->max))
        words_add(w, key->above_min ? " above %g" : " of at least %g", key->min);
    else
        words_add(w, key->above_min ? " above %.10g up to %.10g" : " from %.10g to %.10g", key->min, key->max);
}

static void add_list(struct words *w, int min, int max, const char *of)
{
    if (max && min == max)
        words_add(w, "list of %d %s", min, of);
    else if (max)
        words_add(w, "list of %d to %d %s", min, max, of);
    else if (min > 1)
        words_add(w, "list of at least %d %s", min, of);
    else
        words_add(w, "list of %s", of);
}

static void add_choices(struct words *w, const struct schema_key *key)
{
    for (int i = 0; key->choice(i); i++) words_add(w, "%s%s", i ? ", " : "", key->choice(i));
}

static void add_type(struct words *w, const struct schema_key *key, enum schema_type type)
{
    char of[48];
    switch (type) {
    case TYPE_MAPPING: words_add(w, "mapping"); break;
    case TYPE_NAMED: words_add(w, "names with a mapping each"); break;
    case TYPE_ITEMS: add_list(w, key->count_min, key->count_max, "mappings"); break;
    case TYPE_NUMBER:
        words_add(w, "number");
        add_limits(w, key);
        break;
    case TYPE_INTEGER:
        words_add(w, "integer");
        add_limits(w, key);
        break;
    case TYPE_BOOLEAN: words_add(w, "true or false"); break;
    case TYPE_CHOICE:
        if (key->choice(1)) words_add(w, "one of ");
        add_choices(w, key);
        break;
    case TYPE_TEXT:
        words_add(w, "text");
        if (key->count_max) words_add(w, " of up to %d bytes", key->count_max);
        break;
    case TYPE_FILE: words_add(w, "file"); break;
    case TYPE_TIME: words_add(w, "time with offset"); break;
    case TYPE_COLOR: words_add(w, "\"#rrggbb\""); break;
    case TYPE_RANGE: words_add(w, "\"first:end:step\""); break;
    case TYPE_NUMBERS:
        add_list(w, key->count_min, key->count_max, "numbers");
        add_limits(w, key);
        break;
    case TYPE_INTEGERS:
        add_list(w, key->count_min, key->count_max, "integers");
        add_limits(w, key);
        break;
    case TYPE_CHOICES:
        add_list(w, key->count_min, key->count_max, "of ");
        add_choices(w, key);
        break;
    case TYPE_FILES: add_list(w, key->count_min, key->count_max, "files"); break;
    case TYPE_COLORS: add_list(w, key->count_min, key->count_max, "\"#rrggbb\""); break;
    case TYPE_ROWS:
        snprintf(of, sizeof of, "lists of %d numbers", key->columns);
        add_list(w, key->count_min, key->count_max, of);
        break;
    case TYPE_TEXTS: add_list(w, key->count_min, key->count_max, "texts"); break;
    case TYPE_WEIGHTS: words_add(w, "names with a weight each"); break;
    }
}

struct words words_type(const struct schema_key *key)
{
    struct words w = { .length = 0 };
    for (unsigned bit = 1; bit <= TYPE_WEIGHTS; bit <<= 1) {
        if (!(key->types & bit)) continue;
        if (w.length) words_add(&w, " or ");
        add_type(&w, key, (enum schema_type)bit);
    }
    return w;
}

struct words words_found(const struct yaml_node *node)
{
    struct words w = { .length = 0 };
    double number;
    bool boolean;
    if (node->kind == YAML_MAPPING)
        words_add(&w, "mapping");
    else if (node->kind == YAML_SEQUENCE)
        words_add(&w, "list of %zu", node->count);
    else if (yaml_is_null(node))
        words_add(&w, "nothing");
    else if (yaml_number(&number, node) || yaml_boolean(&boolean, node))
        words_add(&w, "%.80s", node->text);
    else
        words_add(&w, "%s \"%.80s\"", node->plain ? "text" : "quoted text", node->text);
    return w;
}

struct words words_siblings(const struct schema *schema, const char *parent, const enum schema_presence *presence)
{
    struct words w = { .length = 0 };
    for (size_t k = 0; k < schema->count; k++) {
        const struct schema_key *key = &schema->keys[k];
        const char *name = schema_child(key->path, parent);
        if (name && (!presence || key->presence == *presence)) words_add(&w, "%s%s", w.length ? ", " : "", name);
    }
    return w;
}

static struct words words_default(const struct schema *schema, const struct schema_key *key)
{
    struct words w = { .length = 0 }, parent = { .length = 0 };
    const char *dot = strrchr(key->path, '.');
    words_add(&parent, "%.*s", dot ? (int)(dot - key->path) : 0, key->path);
    struct words group = words_siblings(schema, parent.text, &key->presence);
    switch (key->presence) {
    case OPTIONAL: words_add(&w, "%s", key->preset ? key->preset : "none"); break;
    case REQUIRED: words_add(&w, "required"); break;
    case ONE_OF: words_add(&w, "one of %s", group.text); break;
    case AT_MOST_ONE_OF: words_add(&w, "at most one of %s", group.text); break;
    }
    return w;
}

char *schema_text(const struct schema *schema)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    for (size_t k = 0; k < schema->count; k++) {
        const struct schema_key *key = &schema->keys[k];
        fprintf(out, "%s\t%s\t%s\t%s\n", key->path, words_type(key).text, key->unit ? key->unit : "-",
                words_default(schema, key).text);
    }
    bool failed = ferror(out);
    if (fclose(out) == 0 && !failed) return text;
    free(text);
    return NULL;
}

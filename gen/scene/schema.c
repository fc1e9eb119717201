#include "gen/scene/schema.h"

#include "gen/scene/nearest.h"
#include "gen/scene/schema_words.h"
#include "gen/light/sun.h"
#include "lib/file.h"
#include "lib/image.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A place in the tree, as the table names it and as the user sees it. */
struct where { char table[160], shown[240]; };

struct check {
    const struct schema *schema;
    const char *file;
    struct error *err;
};

static struct where where_key(const struct where *parent, const char *key, const char *shown)
{
    struct where w;
    snprintf(w.table, sizeof w.table, "%.110s%s%.48s", parent->table, *parent->table ? "." : "", key);
    snprintf(w.shown, sizeof w.shown, "%.150s%s%.60s", parent->shown, *parent->shown ? "." : "", shown);
    return w;
}

static struct where where_item(const struct where *parent, size_t i)
{
    struct where w;
    snprintf(w.table, sizeof w.table, "%.150s[]", parent->table);
    snprintf(w.shown, sizeof w.shown, "%.200s[%zu]", parent->shown, i);
    return w;
}

static const struct schema_key *find(const struct schema *schema, const char *path)
{
    for (size_t i = 0; i < schema->count; i++)
        if (!strcmp(schema->keys[i].path, path)) return &schema->keys[i];
    return NULL;
}

/* Record a message with its place in front. Returns false. */
__attribute__((format(printf, 5, 6)))
static bool report(const struct check *c, int line, int column, const struct where *where,
                   const char *format, ...)
{
    struct words w = { .length = 0 };
    va_list args;
    if (*where->shown) words_add(&w, "%s: ", where->shown);
    va_start(args, format);
    words_vadd(&w, format, args);
    va_end(args);
    return error_at(c->err, ERR_INPUT, c->file, line, column, "%s", w.text);
}

static bool unexpected(const struct check *c, const struct schema_key *key, const struct where *where,
                       const struct yaml_node *node)
{
    struct words type = words_type(key), found = words_found(node);
    const char *hint = yaml_is_null(node) && key->types & TYPE_COLOR ? " (without quotes, # starts a comment)" : "";
    return report(c, node->line, node->column, where, "expected %s, found %s%s", type.text, found.text, hint);
}

/* The same for an element of a list. */
static bool unexpected_item(const struct check *c, const struct schema_key *key, enum schema_type type,
                            const struct where *list, size_t i, const struct yaml_node *item)
{
    struct schema_key element = *key;
    element.types = type;
    struct where where = where_item(list, i);
    return unexpected(c, &element, &where, item);
}

/* Reads as "light: unknown sky ...": the key's name goes behind its parent's. */
static bool unknown_choice(const struct check *c, const struct schema_key *key, const struct where *where,
                           const struct yaml_node *node)
{
    struct where parent = *where;
    char *dot = strrchr(parent.shown, '.');
    *(dot ? dot : parent.shown) = 0;
    const char *name = strrchr(key->path, '.');
    name = name ? name + 1 : key->path;
    struct nearest nearest = { NULL, 0 };
    for (int i = 0; key->choice(i); i++) nearest_offer(&nearest, node->text, key->choice(i));
    if (nearest.name)
        return report(c, node->line, node->column, &parent,
                      "unknown %s \"%.80s\" (did you mean \"%s\"?)", name, node->text, nearest.name);
    struct schema_key single = *key;
    if (single.types & TYPE_CHOICES) single.types = TYPE_CHOICE;
    return report(c, node->line, node->column, &parent,
                  "unknown %s \"%.80s\" (%s)", name, node->text, words_type(&single).text);
}

static bool unknown_key(const struct check *c, const struct where *where, const struct yaml_node *mapping, size_t i)
{
    const char *name = mapping->keys[i].text, *elsewhere = NULL;
    int line = mapping->keys[i].line, column = mapping->keys[i].column;
    struct nearest nearest = { NULL, 0 };
    for (size_t k = 0; k < c->schema->count; k++) {
        const char *path = c->schema->keys[k].path, *sibling = schema_child(path, where->table);
        if (sibling) nearest_offer(&nearest, name, sibling);
        const char *dot = strrchr(path, '.');
        if (!elsewhere && !strcmp(dot ? dot + 1 : path, name)) elsewhere = path;
    }
    if (nearest.name)
        return report(c, line, column, where, "unknown key \"%.80s\" (did you mean \"%s\"?)", name, nearest.name);
    if (elsewhere) return report(c, line, column, where, "unknown key \"%.80s\" (it belongs at %s)", name, elsewhere);
    return report(c, line, column, where, "unknown key \"%.80s\" (known here: %s)", name,
                  words_siblings(c->schema, where->table, NULL).text);
}

/* Values. */

static bool within(const struct schema_key *key, double value)
{
    if (!(key->min < key->max)) return true;
    return (key->above_min ? value > key->min : value >= key->min) && value <= key->max;
}

static bool good_number(const struct schema_key *key, const struct yaml_node *node)
{
    double number;
    return yaml_number(&number, node) && within(key, number);
}

static bool good_integer(const struct schema_key *key, const struct yaml_node *node)
{
    int integer;
    return yaml_integer(&integer, node) && within(key, integer);
}

static bool good_count(const struct schema_key *key, size_t count)
{
    return count >= (size_t)key->count_min && (!key->count_max || count <= (size_t)key->count_max);
}

static bool good_text(const struct schema_key *key, const struct yaml_node *node)
{
    size_t length = strlen(node->text);
    return length > 0 && (!key->count_max || length <= (size_t)key->count_max);
}

static bool check_file(const struct check *c, const struct where *where, const struct yaml_node *node)
{
    char *path = path_beside(c->file, node->text);
    if (!path) return error_set(c->err, ERR_MEMORY, "no memory for a path");
    bool there = file_exists(path);
    free(path);
    return there || report(c, node->line, node->column, where,
                           "there is no file \"%.300s\" (a path starts at the folder of this file)", node->text);
}

static bool check_time(const struct check *c, const struct where *where, const struct yaml_node *node)
{
    struct utc_time utc;
    const char *wrong = utc_time_parse(&utc, node->text);
    return !wrong || report(c, node->line, node->column, where, "\"%.80s\": %s", node->text, wrong);
}

static bool check_scalar(const struct check *c, const struct schema_key *key, const struct where *where,
                         const struct yaml_node *node)
{
    double color[3], number;
    bool boolean;
    int first, end, step;
    unsigned types = key->types;
    if (yaml_is_null(node)) return unexpected(c, key, where, node);
    if (types & TYPE_NUMBER && good_number(key, node)) return true;
    if (types & TYPE_INTEGER && good_integer(key, node)) return true;
    if (types & TYPE_BOOLEAN && yaml_boolean(&boolean, node)) return true;
    if (types & TYPE_NUMBER && types & TYPE_CHOICE && yaml_number(&number, node)) return unexpected(c, key, where, node);
    if (types & TYPE_CHOICE) return schema_choice(key->choice, node) >= 0 || unknown_choice(c, key, where, node);
    if (types & TYPE_TEXT && good_text(key, node)) return true;
    if (types & TYPE_FILE && good_text(key, node)) return check_file(c, where, node);
    if (types & TYPE_TIME) return check_time(c, where, node);
    if (types & TYPE_COLOR && schema_color(color, node)) return true;
    if (types & TYPE_RANGE && schema_range(&first, &end, &step, node)) return true;
    return unexpected(c, key, where, node);
}

static bool check_row(const struct check *c, const struct schema_key *key, const struct where *rows, size_t i,
                      const struct yaml_node *row)
{
    struct schema_key element = *key;
    element.types = TYPE_NUMBERS;
    element.count_min = element.count_max = key->columns;
    struct where where = where_item(rows, i);
    if (row->kind != YAML_SEQUENCE || row->count != (size_t)key->columns) return unexpected(c, &element, &where, row);
    for (size_t j = 0; j < row->count; j++)
        if (!good_number(key, row->items[j])) return unexpected_item(c, key, TYPE_NUMBER, &where, j, row->items[j]);
    return true;
}

static bool check_item(const struct check *c, const struct schema_key *key, const struct where *list, size_t i,
                       const struct yaml_node *item)
{
    unsigned types = key->types;
    struct where where = where_item(list, i);
    double color[3];
    if (types & TYPE_ROWS) return check_row(c, key, list, i, item);
    if (types & TYPE_NUMBERS)
        return good_number(key, item) || unexpected_item(c, key, TYPE_NUMBER, list, i, item);
    if (types & TYPE_INTEGERS)
        return good_integer(key, item) || unexpected_item(c, key, TYPE_INTEGER, list, i, item);
    if (types & TYPE_COLORS) return schema_color(color, item) || unexpected_item(c, key, TYPE_COLOR, list, i, item);
    if (item->kind != YAML_SCALAR || yaml_is_null(item) || !*item->text)
        return unexpected_item(c, key, types & TYPE_FILES ? TYPE_FILE : types & TYPE_TEXTS ? TYPE_TEXT : TYPE_CHOICE, list, i, item);
    if (types & TYPE_TEXTS) return true;
    if (types & TYPE_FILES) return check_file(c, &where, item);
    return schema_choice(key->choice, item) >= 0 || unknown_choice(c, key, &where, item);
}

static bool check_mapping(const struct check *c, const struct where *where, const struct yaml_node *mapping);

static bool check_sequence(const struct check *c, const struct schema_key *key, const struct where *where,
                           const struct yaml_node *node)
{
    if (!(key->types & (TYPE_ITEMS | TYPE_NUMBERS | TYPE_INTEGERS | TYPE_CHOICES | TYPE_FILES | TYPE_COLORS | TYPE_ROWS |
                        TYPE_TEXTS)) ||
        !good_count(key, node->count))
        return unexpected(c, key, where, node);
    for (size_t i = 0; i < node->count; i++) {
        const struct yaml_node *item = node->items[i];
        if (!(key->types & TYPE_ITEMS)) {
            if (!check_item(c, key, where, i, item)) return false;
            continue;
        }
        struct where item_where = where_item(where, i);
        if (item->kind != YAML_MAPPING) return unexpected_item(c, key, TYPE_MAPPING, where, i, item);
        if (!check_mapping(c, &item_where, item)) return false;
    }
    return true;
}

static bool check_named(const struct check *c, const struct schema_key *key, const struct where *where,
                        const struct yaml_node *node)
{
    struct schema_key element = { .path = key->path, .types = key->types & TYPE_WEIGHTS ? TYPE_NUMBER : TYPE_MAPPING, .max = INFINITY,
                                  .above_min = true };
    for (size_t i = 0; i < node->count; i++) {
        struct where item = where_key(where, "NAME", node->keys[i].text);
        double weight;
        if (key->types & TYPE_WEIGHTS && yaml_number(&weight, node->items[i]) && weight > 0) continue;
        if (!(key->types & TYPE_NAMED) || node->items[i]->kind != YAML_MAPPING) return unexpected(c, &element, &item, node->items[i]);
        if (!check_mapping(c, &item, node->items[i])) return false;
    }
    return true;
}

static bool check_value(const struct check *c, const struct schema_key *key, const struct where *where,
                        const struct yaml_node *node)
{
    if (node->kind == YAML_SCALAR) return check_scalar(c, key, where, node);
    if (node->kind == YAML_SEQUENCE) return check_sequence(c, key, where, node);
    if (key->types & (TYPE_NAMED | TYPE_WEIGHTS)) return check_named(c, key, where, node);
    if (key->types & TYPE_MAPPING) return check_mapping(c, where, node);
    return unexpected(c, key, where, node);
}

static bool check_group(const struct check *c, const struct where *where, const struct yaml_node *mapping,
                        enum schema_presence presence)
{
    const char *first = NULL;
    for (size_t i = 0; i < mapping->count; i++) {
        struct where below = where_key(where, mapping->keys[i].text, "");
        if (find(c->schema, below.table)->presence != presence) continue;
        if (first)
            return report(c, mapping->keys[i].line, mapping->keys[i].column, where,
                          "\"%s\" and \"%s\" exclude each other (give one of %s)", first, mapping->keys[i].text,
                          words_siblings(c->schema, where->table, &presence).text);
        first = mapping->keys[i].text;
    }
    if (first || presence == AT_MOST_ONE_OF) return true;
    struct words names = words_siblings(c->schema, where->table, &presence);
    return !names.length || report(c, mapping->line, mapping->column, where, "one of %s is missing", names.text);
}

static bool check_mapping(const struct check *c, const struct where *where, const struct yaml_node *mapping)
{
    for (size_t i = 0; i < mapping->count; i++) {
        const char *name = mapping->keys[i].text;
        struct where below = where_key(where, name, name);
        const struct schema_key *key = find(c->schema, below.table);
        if (!key || strchr(name, '.')) return unknown_key(c, where, mapping, i);
        if (!check_value(c, key, &below, mapping->items[i])) return false;
    }
    for (size_t k = 0; k < c->schema->count; k++) {
        const struct schema_key *key = &c->schema->keys[k];
        const char *name = schema_child(key->path, where->table);
        if (name && key->presence == REQUIRED && !yaml_get(mapping, name))
            return report(c, mapping->line, mapping->column, where,
                          "key \"%s\" is missing (%s)", name, words_type(key).text);
    }
    return check_group(c, where, mapping, ONE_OF) && check_group(c, where, mapping, AT_MOST_ONE_OF);
}

bool schema_check(const struct schema *schema, const struct yaml_node *root, const char *file, struct error *err)
{
    struct check c = { schema, file, err };
    struct where top = { "", "" };
    if (root->kind != YAML_MAPPING)
        return report(&c, root->line, root->column, &top, "expected mapping (\"key: value\" lines), found %s",
                      words_found(root).text);
    return check_mapping(&c, &top, root);
}

static void mark_default(struct yaml_node *node, int line, int column)
{
    node->is_default = true;
    node->line = line;
    node->column = column;
    for (size_t i = 0; i < node->count; i++) mark_default(node->items[i], line, column);
}

static bool fill_mapping(const struct schema *schema, const struct where *where, struct yaml_node *mapping,
                         struct error *err)
{
    for (size_t k = 0; k < schema->count; k++) {
        const struct schema_key *key = &schema->keys[k];
        const char *name = schema_child(key->path, where->table);
        if (!name || !key->preset || yaml_get(mapping, name)) continue;
        struct yaml_node *value;
        if (!yaml_parse(&value, key->preset, strlen(key->preset), key->path, err)) return false;
        mark_default(value, mapping->line, mapping->column);
        if (!yaml_add(mapping, name, value, err)) return false;
    }
    for (size_t i = 0; i < mapping->count; i++) {
        struct yaml_node *item = mapping->items[i];
        struct where below = where_key(where, mapping->keys[i].text, "");
        const struct schema_key *key = find(schema, below.table);
        assert(key); /* the tree is checked */
        bool named = key->types & (TYPE_NAMED | TYPE_WEIGHTS), listed = key->types & TYPE_ITEMS;
        if (item->kind == YAML_MAPPING && !named && !fill_mapping(schema, &below, item, err)) return false;
        if (!named && !listed) continue;
        below = named ? where_key(&below, "NAME", "") : where_item(&below, 0);
        for (size_t j = 0; j < item->count; j++)
            if (item->items[j]->kind == YAML_MAPPING && !fill_mapping(schema, &below, item->items[j], err)) return false;
    }
    return true;
}

bool schema_fill(const struct schema *schema, struct yaml_node *root, struct error *err)
{
    struct where top = { "", "" };
    return fill_mapping(schema, &top, root, err);
}

double schema_number(const struct yaml_node *node)
{
    double number;
    bool good = yaml_number(&number, node);
    assert(good);
    return good ? number : 0;
}

void schema_numbers(double *number, size_t n, const struct yaml_node *list)
{
    assert(list->kind == YAML_SEQUENCE && list->count >= n);
    for (size_t i = 0; i < n; i++) number[i] = schema_number(list->items[i]);
}

int schema_choice(const char *(*choice)(int i), const struct yaml_node *node)
{
    if (node->kind != YAML_SCALAR) return -1;
    for (int i = 0; choice(i); i++)
        if (!strcmp(choice(i), node->text)) return i;
    return -1;
}

bool schema_color(double linear[3], const struct yaml_node *node)
{
    const char *text = node->text;
    if (node->kind != YAML_SCALAR || strlen(text) != 7 || text[0] != '#') return false;
    if (strspn(text + 1, "0123456789abcdefABCDEF") != 6) return false;
    unsigned long rgb = strtoul(text + 1, NULL, 16);
    for (int i = 0; i < 3; i++) linear[i] = (double)linear_from_srgb((float)((rgb >> (16 - 8 * i)) & 255u) / 255.0f);
    return true;
}

bool schema_range(int *first, int *end, int *step, const struct yaml_node *node)
{
    int value[3];
    const char *c = node->text;
    if (node->kind != YAML_SCALAR) return false;
    for (int i = 0; i < 3; i++) {
        size_t digits = strspn(c, "0123456789");
        if (!digits || digits > 9 || c[digits] != (i < 2 ? ':' : 0)) return false;
        value[i] = (int)strtol(c, NULL, 10);
        c += digits + 1;
    }
    if (value[0] >= value[1] || value[2] < 1) return false;
    *first = value[0];
    *end = value[1];
    *step = value[2];
    return true;
}

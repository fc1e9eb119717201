#include "gen/scene/yaml.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

/* Deeper than any scene needs; keeps a hostile file from using up the stack. */
#define DEPTH_MAX 32

struct reader {
    yaml_parser_t parser;
    const char *file;
    struct error *err;
};

static int line_of(yaml_mark_t mark) { return (int)mark.line + 1; }
static int column_of(yaml_mark_t mark) { return (int)mark.column + 1; }

void yaml_destroy(struct yaml_node *node)
{
    if (!node) return;
    for (size_t i = 0; i < node->count; i++) {
        yaml_destroy(node->items[i]);
        if (node->keys) free(node->keys[i].text);
    }
    free(node->items);
    free(node->keys);
    free(node->text);
    free(node);
}

/* Takes text and item over. text is NULL in a sequence. */
static bool append(struct yaml_node *node, char *text, yaml_mark_t mark, struct yaml_node *item, struct error *err)
{
    struct yaml_node **items = realloc(node->items, (node->count + 1) * sizeof *items);
    if (items) node->items = items;
    struct yaml_key *keys = NULL;
    if (node->kind == YAML_MAPPING) {
        keys = realloc(node->keys, (node->count + 1) * sizeof *keys);
        if (keys) node->keys = keys;
    }
    if (!items || (node->kind == YAML_MAPPING && (!keys || !text))) {
        free(text);
        yaml_destroy(item);
        return error_set(err, ERR_MEMORY, "no memory for a scene file");
    }
    if (keys) keys[node->count] = (struct yaml_key){ text, line_of(mark), column_of(mark) };
    items[node->count++] = item;
    return true;
}

bool yaml_add(struct yaml_node *mapping, const char *key, struct yaml_node *value, struct error *err)
{
    yaml_mark_t mark = { .line = (size_t)mapping->line - 1, .column = (size_t)mapping->column - 1 };
    return append(mapping, strdup(key), mark, value, err);
}

const struct yaml_node *yaml_get(const struct yaml_node *mapping, const char *key)
{
    if (!mapping || mapping->kind != YAML_MAPPING) return NULL;
    for (size_t i = 0; i < mapping->count; i++)
        if (!strcmp(mapping->keys[i].text, key)) return mapping->items[i];
    return NULL;
}

static bool refuse(struct reader *r, yaml_mark_t mark, const char *what)
{
    return error_at(r->err, ERR_INPUT, r->file, line_of(mark), column_of(mark), "%s", what);
}

static bool next_event(struct reader *r, yaml_event_t *event)
{
    if (yaml_parser_parse(&r->parser, event)) return true;
    const yaml_parser_t *p = &r->parser;
    if (p->error == YAML_MEMORY_ERROR) return error_set(r->err, ERR_MEMORY, "no memory for a scene file");
    if (p->error == YAML_READER_ERROR) /* has an offset instead of a mark */
        return error_at(r->err, ERR_INPUT, r->file, line_of(p->mark), column_of(p->mark),
                        "not a text file: %s at byte %zu", p->problem, p->problem_offset);
    return error_at(r->err, ERR_INPUT, r->file, line_of(p->problem_mark), column_of(p->problem_mark),
                    "not valid YAML: %s%s%s", p->problem, p->context ? " " : "", p->context ? p->context : "");
}

static bool text_from_scalar(struct reader *r, char **text, const yaml_event_t *event)
{
    const char *value = (const char *)event->data.scalar.value;
    for (size_t i = 0; i < event->data.scalar.length; i++)
        if ((unsigned char)value[i] < 0x20 || value[i] == 0x7f)
            return refuse(r, event->start_mark, "a line break or control character in a value");
    *text = strdup(value);
    return *text || error_set(r->err, ERR_MEMORY, "no memory for a scene file");
}

static const char *event_anchor(const yaml_event_t *event)
{
    const yaml_char_t *anchor = event->type == YAML_SCALAR_EVENT           ? event->data.scalar.anchor
                                : event->type == YAML_SEQUENCE_START_EVENT ? event->data.sequence_start.anchor
                                                                           : event->data.mapping_start.anchor;
    return (const char *)anchor;
}

static const char *event_tag(const yaml_event_t *event)
{
    const yaml_char_t *tag = event->type == YAML_SCALAR_EVENT           ? event->data.scalar.tag
                             : event->type == YAML_SEQUENCE_START_EVENT ? event->data.sequence_start.tag
                                                                        : event->data.mapping_start.tag;
    return (const char *)tag;
}

static bool read_children(struct reader *r, struct yaml_node *node, int depth);

/* The node that starts with `event`. */
static bool read_node(struct reader *r, struct yaml_node **out, const yaml_event_t *event, int depth)
{
    if (event->type == YAML_ALIAS_EVENT)
        return refuse(r, event->start_mark, "aliases (*name) are not understood here: write the value out");
    if (event_anchor(event))
        return refuse(r, event->start_mark, "anchors (&name) are not understood here: remove it");
    if (event_tag(event))
        return refuse(r, event->start_mark,
                      "tags (!name) are not understood here: put quotes around a text that starts with \"!\"");
    if (depth > DEPTH_MAX) return refuse(r, event->start_mark, "nested too deeply");
    struct yaml_node *node = calloc(1, sizeof *node);
    if (!node) return error_set(r->err, ERR_MEMORY, "no memory for a scene file");
    node->line = line_of(event->start_mark);
    node->column = column_of(event->start_mark);
    bool ok;
    if (event->type == YAML_SCALAR_EVENT) {
        node->kind = YAML_SCALAR;
        node->plain = event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
        ok = text_from_scalar(r, &node->text, event);
    } else {
        node->kind = event->type == YAML_MAPPING_START_EVENT ? YAML_MAPPING : YAML_SEQUENCE;
        ok = read_children(r, node, depth);
    }
    if (ok)
        *out = node;
    else
        yaml_destroy(node);
    return ok;
}

static bool read_key(struct reader *r, char **text, const struct yaml_node *mapping, const yaml_event_t *event)
{
    if (event->type != YAML_SCALAR_EVENT || event_anchor(event) || event_tag(event))
        return refuse(r, event->start_mark, "a key must be plain text");
    if (!text_from_scalar(r, text, event)) return false;
    for (size_t i = 0; i < mapping->count; i++)
        if (!strcmp(mapping->keys[i].text, *text)) {
            error_at(r->err, ERR_INPUT, r->file, line_of(event->start_mark), column_of(event->start_mark),
                     "key \"%.80s\" is here for the second time (first in line %d): keep one", *text,
                     mapping->keys[i].line);
            free(*text);
            return false;
        }
    return true;
}

static bool read_children(struct reader *r, struct yaml_node *node, int depth)
{
    for (;;) {
        yaml_event_t event;
        if (!next_event(r, &event)) return false;
        bool end = event.type == YAML_SEQUENCE_END_EVENT || event.type == YAML_MAPPING_END_EVENT;
        char *text = NULL;
        yaml_mark_t mark = event.start_mark;
        bool ok = true;
        if (!end && node->kind == YAML_MAPPING) {
            ok = read_key(r, &text, node, &event);
            yaml_event_delete(&event);
            if (!ok) return false;
            if (!next_event(r, &event)) {
                free(text);
                return false;
            }
        }
        struct yaml_node *item = NULL;
        if (!end) ok = read_node(r, &item, &event, depth + 1);
        yaml_event_delete(&event);
        if (end) return true;
        if (!ok) {
            free(text);
            return false;
        }
        if (!append(node, text, mark, item, r->err)) return false;
    }
}

bool yaml_parse(struct yaml_node **root, const char *data, size_t size, const char *file, struct error *err)
{
    struct reader r = { .file = file, .err = err };
    if (!yaml_parser_initialize(&r.parser)) return error_set(err, ERR_MEMORY, "no memory for a scene file");
    yaml_parser_set_input_string(&r.parser, (const unsigned char *)data, size);
    struct yaml_node *found = NULL;
    for (bool more = true; more && err->code == ERR_OK;) {
        yaml_event_t event;
        if (!next_event(&r, &event)) break;
        if (event.type == YAML_STREAM_END_EVENT)
            more = false;
        else if (event.type == YAML_DOCUMENT_START_EVENT && found)
            refuse(&r, event.start_mark, "a second document starts here: a scene file holds one");
        else if (event.type != YAML_STREAM_START_EVENT && event.type != YAML_DOCUMENT_START_EVENT &&
                 event.type != YAML_DOCUMENT_END_EVENT)
            read_node(&r, &found, &event, 0);
        yaml_event_delete(&event);
    }
    if (err->code == ERR_OK && !found) error_at(err, ERR_INPUT, file, 1, 1, "the file is empty");
    yaml_parser_delete(&r.parser);
    if (err->code == ERR_OK)
        *root = found;
    else
        yaml_destroy(found);
    return err->code == ERR_OK;
}

/* -?(0|[1-9][0-9]*), with + allowed and digits before the point optional in a fraction. */
static bool is_decimal(const char *text, bool fraction)
{
    const char *c = text + (*text == '-' || *text == '+');
    size_t whole = strspn(c, "0123456789");
    if (whole > 1 && *c == '0') return false; /* octal in YAML 1.1, decimal in 1.2: neither is guessed */
    c += whole;
    size_t part = 0;
    if (fraction && *c == '.') {
        part = strspn(++c, "0123456789");
        c += part;
    }
    if (whole + part == 0) return false;
    if (fraction && (*c == 'e' || *c == 'E')) {
        c++;
        if (*c == '-' || *c == '+') c++;
        size_t digits = strspn(c, "0123456789");
        if (!digits) return false;
        c += digits;
    }
    return *c == 0;
}

bool yaml_number(double *value, const struct yaml_node *node)
{
    if (node->kind != YAML_SCALAR || !node->plain || !is_decimal(node->text, true)) return false;
    double number = strtod(node->text, NULL);
    if (number > 1e300 || number < -1e300) return false;
    *value = number;
    return true;
}

bool yaml_integer(int *value, const struct yaml_node *node)
{
    if (node->kind != YAML_SCALAR || !node->plain || !is_decimal(node->text, false)) return false;
    errno = 0;
    long number = strtol(node->text, NULL, 10);
    if (errno || number < INT_MIN || number > INT_MAX) return false;
    *value = (int)number;
    return true;
}

bool yaml_boolean(bool *value, const struct yaml_node *node)
{
    if (node->kind != YAML_SCALAR || !node->plain) return false;
    bool yes = !strcmp(node->text, "true");
    if (!yes && strcmp(node->text, "false")) return false;
    *value = yes;
    return true;
}

bool yaml_is_null(const struct yaml_node *node)
{
    return node->kind == YAML_SCALAR && node->plain &&
           (!*node->text || !strcmp(node->text, "~") || !strcmp(node->text, "null"));
}

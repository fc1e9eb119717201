/* A table of keys that says what a YAML file may hold: from it come the check of the file,
 * the values of keys that were left out, and the text that the manual is tested against. */
#ifndef STAFFAGE_GEN_SCHEMA_H
#define STAFFAGE_GEN_SCHEMA_H

#include "gen/scene/yaml.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What a value may be; several bits: any of them. */
enum schema_type {
    TYPE_MAPPING = 1 << 0,  /* keys: the rows below this one */
    TYPE_NAMED = 1 << 1,    /* names of the user's, each with a mapping: rows path.NAME.key */
    TYPE_ITEMS = 1 << 2,    /* list of mappings: rows path[].key */
    TYPE_NUMBER = 1 << 3,
    TYPE_INTEGER = 1 << 4,
    TYPE_BOOLEAN = 1 << 5,
    TYPE_CHOICE = 1 << 6,   /* one of the names that `choice` gives */
    TYPE_TEXT = 1 << 7,
    TYPE_FILE = 1 << 8,     /* path of a file that exists, relative to the YAML file */
    TYPE_TIME = 1 << 9,     /* ISO 8601 with offset */
    TYPE_COLOR = 1 << 10,   /* "#rrggbb" */
    TYPE_RANGE = 1 << 11,   /* "first:end:step", integers from 0, end excluded */
    TYPE_NUMBERS = 1 << 12, /* the following: lists of count_min to count_max values */
    TYPE_INTEGERS = 1 << 13,
    TYPE_CHOICES = 1 << 14,
    TYPE_FILES = 1 << 15,
    TYPE_COLORS = 1 << 16,  /* "#rrggbb" each */
    TYPE_ROWS = 1 << 17,    /* list of lists of `columns` numbers */
    TYPE_TEXTS = 1 << 18,
    TYPE_WEIGHTS = 1 << 19  /* texts of the user's, each with a number above 0; a mapping, too, with TYPE_NAMED */
};

enum schema_presence {
    OPTIONAL,       /* with `preset`: takes that value when left out */
    REQUIRED,
    ONE_OF,         /* of all keys of the mapping that say so, exactly one is given */
    AT_MOST_ONE_OF
};

struct schema_key {
    const char *path;
    unsigned types;
    const char *unit;              /* NULL: none */
    enum schema_presence presence;
    const char *preset;            /* YAML text, or NULL */
    double min, max;               /* of numbers, when limited: min < max */
    bool above_min;                /* min itself is outside */
    int count_min, count_max;      /* of lists (0 max: any), and of the bytes of a text */
    int columns;
    const char *(*choice)(int i);  /* NULL from the end on */
    bool merging;                  /* it and the keys below it matter when passes are merged, not when they are rendered */
};

struct schema { const struct schema_key *keys; size_t count; };

/* Check a tree against the schema: keys, types, ranges, presence, files.
 * In:  file is the path of the YAML file
 * Err: ERR_INPUT at file:line:column: the first in the order of the file */
bool schema_check(const struct schema *schema, const struct yaml_node *root, const char *file, struct error *err);

/* Put the presets of a checked tree's missing keys in, marked is_default. */
bool schema_fill(const struct schema *schema, struct yaml_node *root, struct error *err);

/* Of all that a checked tree says but the keys for merging; comments and the order of lines do not count. */
uint64_t schema_rendered_hash(const struct schema *schema, const struct yaml_node *root);

/* "path\ttype\tunit\tdefault\n" for each key. The caller frees; NULL only when memory ends. */
char *schema_text(const struct schema *schema);

/* Values of a checked tree. */

double schema_number(const struct yaml_node *node);
/* Out: number (n), the first n of a list */
void schema_numbers(double *number, size_t n, const struct yaml_node *list);

/* Index of the node's text among the names, or -1. */
int schema_choice(const char *(*choice)(int i), const struct yaml_node *node);
/* Out: linear, 0..1 */
bool schema_color(double linear[3], const struct yaml_node *node);
bool schema_range(int *first, int *end, int *step, const struct yaml_node *node);

#endif

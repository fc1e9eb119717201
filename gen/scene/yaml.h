/* YAML as a tree that knows where everything stood. Strict: one document; no anchors,
 * aliases or tags; keys are text, and none appears twice in a mapping. */
#ifndef STAFFAGE_GEN_YAML_H
#define STAFFAGE_GEN_YAML_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

enum yaml_kind { YAML_SCALAR, YAML_SEQUENCE, YAML_MAPPING };

struct yaml_key { char *text; int line, column; };

struct yaml_node {
    enum yaml_kind kind;
    int line, column;          /* from 1 */
    bool is_default;           /* not in the file: put in by schema_fill */
    char *text;                /* SCALAR: UTF-8 without control characters */
    bool plain;                /* SCALAR: written without quotes */
    struct yaml_node **items;  /* SEQUENCE, MAPPING: (count) */
    struct yaml_key *keys;     /* MAPPING: (count) */
    size_t count;
};

/* Parse text; `file` is what errors name.
 * Out: *root, the caller's; free with yaml_destroy
 * Err: ERR_INPUT at file:line:column */
bool yaml_parse(struct yaml_node **root, const char *data, size_t size, const char *file, struct error *err);
void yaml_destroy(struct yaml_node *node);

/* The value of a key, or NULL when the node is no mapping or lacks it. Borrowed. */
const struct yaml_node *yaml_get(const struct yaml_node *mapping, const char *key);
/* Add a key at the end of a mapping; takes the value over, also on failure (memory). */
bool yaml_add(struct yaml_node *mapping, const char *key, struct yaml_node *value, struct error *err);

/* A plain scalar in the decimal notation of YAML 1.2's core schema; infinity and not-a-number are none. */
bool yaml_number(double *value, const struct yaml_node *node);
/* The same without fraction and exponent, within int. */
bool yaml_integer(int *value, const struct yaml_node *node);
/* Plain true or false. YAML 1.1's yes, no, on, off are none. */
bool yaml_boolean(bool *value, const struct yaml_node *node);
/* No value at all: nothing, ~ or null. */
bool yaml_is_null(const struct yaml_node *node);

#endif

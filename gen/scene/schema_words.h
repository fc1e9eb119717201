/* A schema in words: for messages, and for the text that the manual is tested against. */
#ifndef STAFFAGE_GEN_SCHEMA_WORDS_H
#define STAFFAGE_GEN_SCHEMA_WORDS_H

#include "gen/scene/schema.h"

#include <stdarg.h>

/* Text as long as an error's; what does not fit is cut. Start with { .length = 0 }. */
struct words { char text[1024]; size_t length; };

__attribute__((format(printf, 2, 3)))
void words_add(struct words *words, const char *format, ...);
__attribute__((format(printf, 2, 0)))
void words_vadd(struct words *words, const char *format, va_list args);

/* What a value may be: "number above 0 up to 1". */
struct words words_type(const struct schema_key *key);
/* What a value is: "list of 3". */
struct words words_found(const struct yaml_node *node);
/* The keys directly below a path, all or of one presence: "a, b, c". */
struct words words_siblings(const struct schema *schema, const char *parent, const enum schema_presence *presence);

/* The last part of a path when the rest is `parent`, else NULL. */
const char *schema_child(const char *path, const char *parent);

#endif

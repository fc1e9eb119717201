/* One walk over the fields of a JSON object both writes and reads it: what is written in one
 * order under one name with one set of checks is read with the same. */
#ifndef STAFFAGE_LIB_JSON_WALK_H
#define STAFFAGE_LIB_JSON_WALK_H

#include "lib/error.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

#define WALK_KEYS_MAX 64

struct walk {
    bool reading;
    json_t *object;             /* that is filled, or read from; borrowed */
    char where[48];             /* "camera." before its keys in messages */
    const char *seen[WALK_KEYS_MAX]; /* keys that were asked for */
    size_t seen_count;
    struct error *err;
};

/* A field each, from the value into the object or the other way.
 * Err: ERR_INPUT when reading, ERR_BUG when writing, for a key that is missing or a value of
 *      another kind, out of range or not finite; ERR_INPUT for a text that is not UTF-8 */
bool walk_bool(struct walk *walk, const char *key, bool *value);
bool walk_int(struct walk *walk, const char *key, int *value, int least, int most);
bool walk_real(struct walk *walk, const char *key, double *value, double least, double most);
bool walk_reals(struct walk *walk, const char *key, double *values, size_t n);
/* A text of 1 byte or more; walk_text also takes an empty one. In: size, of the storage with its NUL */
bool walk_string(struct walk *walk, const char *key, char *value, size_t size);
bool walk_text(struct walk *walk, const char *key, char *value, size_t size);

/* A walk over the object under a key, and whether every key of it was asked for. */
bool walk_enter(struct walk *inner, struct walk *walk, const char *key);
bool walk_leave(struct walk *walk);

/* The value of a key, borrowed; NULL and an error when there is none. */
json_t *walk_take(struct walk *walk, const char *key);
/* Takes the value over; NULL stands for memory that ended. */
bool walk_put(struct walk *walk, const char *key, json_t *value);
/* Says what is wrong with a key. Always returns false. */
__attribute__((format(printf, 3, 4)))
bool walk_wrong(struct walk *walk, const char *key, const char *format, ...);

#endif

/* JSON that other tools wrote: a walk's reading half, with names of files and what may be left out. */
#ifndef STAFFAGE_LIB_JSON_FILE_H
#define STAFFAGE_LIB_JSON_FILE_H

#include "lib/error.h"
#include "lib/json_walk.h"

#include <stdbool.h>
#include <stddef.h>

/* Out: *root, an object or array as wanted; the caller gives it back by json_decref
 * Err: ERR_INPUT at path:line:column: no JSON, or of another kind */
bool json_file_read(json_t **root, const char *path, json_type type, struct error *err);
/* Put the file and, in front of the text, where in it into an error that has no file. Always returns false. */
__attribute__((format(printf, 3, 4)))
bool json_file_fault(struct error *err, const char *path, const char *format, ...);

static inline struct walk json_read_walk(json_t *object, struct error *err)
{
    return (struct walk){ .reading = true, .object = object, .err = err };
}
/* A number that may be left out: *value stays what it is. */
bool json_read_optional(struct walk *walk, const char *key, double *value);

#endif

#include "lib/json_file.h"

#include "lib/file.h"

#include <float.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

bool json_file_read(json_t **root, const char *path, json_type type, struct error *err)
{
    char *data;
    size_t size;
    if (!file_read(&data, &size, path, err)) return false;
    json_error_t at;
    json_t *read = json_loadb(data, size, JSON_REJECT_DUPLICATES, &at);
    free(data);
    if (!read) return error_at(err, ERR_INPUT, path, at.line, at.column > 0 ? at.column : 1, "%s", at.text);
    if (json_typeof(read) != type) {
        json_decref(read);
        return error_at(err, ERR_INPUT, path, 1, 1, "must be an %s", type == JSON_ARRAY ? "array" : "object");
    }
    *root = read;
    return true;
}

bool json_file_fault(struct error *err, const char *path, const char *format, ...)
{
    char where[256];
    va_list args;
    va_start(args, format);
    vsnprintf(where, sizeof where, format, args);
    va_end(args);
    if (err->code == ERR_INPUT && !err->file[0]) snprintf(err->file, sizeof err->file, "%s", path);
    return error_prefix(err, "%s", where);
}

bool json_read_optional(struct walk *walk, const char *key, double *value)
{
    return !json_object_get(walk->object, key) || walk_real(walk, key, value, -DBL_MAX, DBL_MAX);
}

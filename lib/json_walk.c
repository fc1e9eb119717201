#include "lib/json_walk.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool walk_wrong(struct walk *walk, const char *key, const char *format, ...)
{
    char text[256];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    return error_set(walk->err, walk->reading ? ERR_INPUT : ERR_BUG, "\"%s%s\" %s", walk->where, key, text);
}

json_t *walk_take(struct walk *walk, const char *key)
{
    json_t *value = json_object_get(walk->object, key);
    if (!value) walk_wrong(walk, key, "is missing");
    assert(walk->seen_count < WALK_KEYS_MAX);
    walk->seen[walk->seen_count++] = key;
    return value;
}

bool walk_put(struct walk *walk, const char *key, json_t *value)
{
    return json_object_set_new(walk->object, key, value) == 0 || error_set(walk->err, ERR_MEMORY, "out of memory");
}

bool walk_bool(struct walk *walk, const char *key, bool *value)
{
    if (!walk->reading) return walk_put(walk, key, json_boolean(*value));
    json_t *json = walk_take(walk, key);
    if (!json) return false;
    if (!json_is_boolean(json)) return walk_wrong(walk, key, "must be true or false");
    *value = json_is_true(json);
    return true;
}

bool walk_int(struct walk *walk, const char *key, int *value, int least, int most)
{
    if (walk->reading) {
        json_t *json = walk_take(walk, key);
        if (!json) return false;
        json_int_t read = json_integer_value(json);
        if (!json_is_integer(json) || read < least || read > most)
            return walk_wrong(walk, key, "must be a whole number from %d to %d", least, most);
        *value = (int)read;
        return true;
    }
    if (*value < least || *value > most) return walk_wrong(walk, key, "must be from %d to %d, not %d", least, most, *value);
    return walk_put(walk, key, json_integer(*value));
}

bool walk_reals(struct walk *walk, const char *key, double *values, size_t n)
{
    if (walk->reading) {
        json_t *json = walk_take(walk, key);
        if (!json) return false;
        if (!json_is_array(json) || json_array_size(json) != n) return walk_wrong(walk, key, "must be %zu numbers", n);
        for (size_t i = 0; i < n; i++) {
            if (!json_is_number(json_array_get(json, i))) return walk_wrong(walk, key, "must hold numbers");
            values[i] = json_number_value(json_array_get(json, i));
        }
        return true;
    }
    json_t *json = json_array();
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(values[i])) {
            json_decref(json);
            return walk_wrong(walk, key, "must hold finite numbers");
        }
        json_array_append_new(json, json_real(values[i]));
    }
    return walk_put(walk, key, json);
}

bool walk_real(struct walk *walk, const char *key, double *value, double least, double most)
{
    if (walk->reading) {
        json_t *json = walk_take(walk, key);
        if (!json) return false;
        if (!json_is_number(json)) return walk_wrong(walk, key, "must be a number");
        *value = json_number_value(json);
    }
    if (!isfinite(*value) || !(*value >= least) || !(*value <= most))
        return walk_wrong(walk, key, "must be from %g to %g, not %g", least, most, *value);
    return walk->reading || walk_put(walk, key, json_real(*value));
}

static bool text_of(struct walk *walk, const char *key, char *value, size_t size, size_t least)
{
    if (!walk->reading) {
        if (strlen(value) < least) return walk_wrong(walk, key, "must be a text of %zu to %zu bytes", least, size - 1);
        json_t *json = json_string(value);
        if (!json) return error_set(walk->err, ERR_INPUT, "\"%s%s\" must be UTF-8", walk->where, key);
        return walk_put(walk, key, json);
    }
    json_t *json = walk_take(walk, key);
    if (!json) return false;
    size_t length = json_string_length(json);
    if (!json_is_string(json) || length < least || length >= size)
        return walk_wrong(walk, key, "must be a text of %zu to %zu bytes", least, size - 1);
    memcpy(value, json_string_value(json), length + 1);
    return true;
}

bool walk_string(struct walk *walk, const char *key, char *value, size_t size)
{
    return text_of(walk, key, value, size, 1);
}

bool walk_text(struct walk *walk, const char *key, char *value, size_t size)
{
    return text_of(walk, key, value, size, 0);
}

bool walk_enter(struct walk *inner, struct walk *walk, const char *key)
{
    json_t *object = walk->reading ? walk_take(walk, key) : json_object();
    if (walk->reading && !object) return false;
    if (walk->reading && !json_is_object(object)) return walk_wrong(walk, key, "must be an object");
    if (!walk->reading && !walk_put(walk, key, object)) return false;
    *inner = (struct walk){ .reading = walk->reading, .object = object, .err = walk->err };
    snprintf(inner->where, sizeof inner->where, "%.23s%.22s.", walk->where, key);
    return true;
}

bool walk_leave(struct walk *walk)
{
    if (!walk->reading) return true;
    const char *key;
    json_t *value;
    json_object_foreach(walk->object, key, value) {
        bool known = false;
        for (size_t i = 0; i < walk->seen_count; i++) known = known || !strcmp(key, walk->seen[i]);
        if (!known) return walk_wrong(walk, key, "is no key of a frame manifest");
    }
    return true;
}

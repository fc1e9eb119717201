#include "lib/error.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

__attribute__((format(printf, 6, 0)))
static bool set(struct error *err, enum error_code code, const char *file, int line, int column,
                const char *format, va_list args)
{
    if (err->code != ERR_OK) return false;
    *err = (struct error){ .code = code, .line = line, .column = column };
    if (file) snprintf(err->file, sizeof err->file, "%s", file);
    vsnprintf(err->text, sizeof err->text, format, args);
    for (char *c = err->text; *c; c++)
        if (*c == '\n') *c = ' ';
    return false;
}

bool error_set(struct error *err, enum error_code code, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set(err, code, NULL, 0, 0, format, args);
    va_end(args);
    return false;
}

bool error_at(struct error *err, enum error_code code, const char *file, int line, int column,
              const char *format, ...)
{
    va_list args;
    va_start(args, format);
    set(err, code, file, line, column, format, args);
    va_end(args);
    return false;
}

bool error_prefix(struct error *err, const char *format, ...)
{
    char text[2 * sizeof err->text];
    va_list args;
    va_start(args, format);
    int n = vsnprintf(text, sizeof err->text, format, args);
    va_end(args);
    if (n < 0) return false;
    size_t used = strlen(text), kept = sizeof err->text - 1 - used, length = strlen(err->text);
    if (length < kept) kept = length;
    memcpy(text + used, err->text, kept);
    text[used + kept] = 0;
    memcpy(err->text, text, used + kept + 1);
    return false;
}

void error_print(const struct error *err, const char *program)
{
    if (!err->file[0])
        fprintf(stderr, "%s: %s\n", program, err->text);
    else if (err->line > 0 && err->column <= 0)
        fprintf(stderr, "%s:%d: %s\n", err->file, err->line, err->text);
    else if (err->line > 0)
        fprintf(stderr, "%s:%d:%d: %s\n", err->file, err->line, err->column, err->text);
    else
        fprintf(stderr, "%s: %s\n", err->file, err->text);
}

int error_exit_status(const struct error *err)
{
    return err->code == ERR_OK ? 0 : err->code == ERR_BUG ? 3 : 1;
}

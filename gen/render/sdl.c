#include "gen/render/sdl.h"

#include "lib/file.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void sdl_init(struct sdl *sdl)
{
    *sdl = (struct sdl){ .line_start = true, .err = ERROR_NONE };
}

void sdl_release(struct sdl *sdl)
{
    free(sdl->text);
    sdl_init(sdl);
}

static void append(struct sdl *sdl, const char *text, size_t n)
{
    if (sdl->size + n + 1 > sdl->capacity) {
        size_t capacity = 2 * (sdl->size + n) + 4096;
        char *grown = realloc(sdl->text, capacity);
        if (!grown) {
            error_set(&sdl->err, ERR_MEMORY, "no memory for a scene text");
            return;
        }
        sdl->text = grown;
        sdl->capacity = capacity;
    }
    memcpy(sdl->text + sdl->size, text, n);
    sdl->size += n;
    sdl->text[sdl->size] = 0;
    if (n) sdl->line_start = text[n - 1] == '\n';
}

/* The text before the next token: indentation on a fresh line, else a space. */
static void gap(struct sdl *sdl)
{
    if (sdl->line_start)
        for (int i = 0; i < sdl->depth; i++) append(sdl, "  ", 2);
    else
        append(sdl, " ", 1);
}

__attribute__((format(printf, 2, 3)))
static void appendf(struct sdl *sdl, const char *format, ...)
{
    char text[256];
    va_list args;
    va_start(args, format);
    int n = vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (n < 0 || (size_t)n >= sizeof text) error_set(&sdl->err, ERR_BUG, "a scene token of %d characters", n);
    else append(sdl, text, (size_t)n);
}

static void number(struct sdl *sdl, double value)
{
    if (!isfinite(value)) error_set(&sdl->err, ERR_BUG, "a number that is not finite was to be written to a scene");
    else appendf(sdl, "%.9g", value);
}

void sdl_header(struct sdl *sdl, const char *comment)
{
    append(sdl, "#version 3.7;\n// ", 17);
    for (; *comment; comment++) append(sdl, isprint((unsigned char)*comment) ? comment : "?", 1);
    append(sdl, "\n", 1);
}

void sdl_word(struct sdl *sdl, const char *word)
{
    for (const char *c = word; *c; c++)
        if (!isalnum((unsigned char)*c) && *c != '_') {
            error_set(&sdl->err, ERR_BUG, "\"%s\" is no word of the scene language", word);
            return;
        }
    gap(sdl);
    append(sdl, word, strlen(word));
}

void sdl_number(struct sdl *sdl, double value)
{
    gap(sdl);
    number(sdl, value);
}

void sdl_vector(struct sdl *sdl, struct vec3 v)
{
    gap(sdl);
    append(sdl, "<", 1);
    number(sdl, v.x);
    append(sdl, ",", 1);
    number(sdl, v.y);
    append(sdl, ",", 1);
    number(sdl, v.z);
    append(sdl, ">", 1);
}

void sdl_vector2(struct sdl *sdl, double x, double y)
{
    gap(sdl);
    append(sdl, "<", 1);
    number(sdl, x);
    append(sdl, ",", 1);
    number(sdl, y);
    append(sdl, ">", 1);
}

void sdl_color(struct sdl *sdl, const double rgb[3])
{
    sdl_word(sdl, "rgb");
    sdl_vector(sdl, vec3(rgb[0], rgb[1], rgb[2]));
}

void sdl_string(struct sdl *sdl, const char *text)
{
    gap(sdl);
    append(sdl, "\"", 1);
    for (; *text; text++) {
        if (iscntrl((unsigned char)*text)) {
            error_set(&sdl->err, ERR_INPUT, "a path with a control character (0x%02x) cannot be given to POV-Ray",
                      (unsigned)(unsigned char)*text);
            return;
        }
        if (*text == '"' || *text == '\\') append(sdl, "\\", 1);
        append(sdl, text, 1);
    }
    append(sdl, "\"", 1);
}

void sdl_comma(struct sdl *sdl)
{
    append(sdl, ",", 1);
}

void sdl_newline(struct sdl *sdl)
{
    append(sdl, "\n", 1);
}

void sdl_begin(struct sdl *sdl, const char *word)
{
    sdl_word(sdl, word);
    append(sdl, " {\n", 3);
    sdl->depth++;
}

void sdl_end(struct sdl *sdl)
{
    if (sdl->depth-- == 0) error_set(&sdl->err, ERR_BUG, "a scene block ends that never began");
    if (!sdl->line_start) sdl_newline(sdl);
    gap(sdl);
    append(sdl, "}\n", 2);
}

void sdl_call(struct sdl *sdl, const char *macro, const double *arguments, size_t n)
{
    sdl_word(sdl, macro);
    append(sdl, "(", 1);
    for (size_t i = 0; i < n; i++) {
        if (i) append(sdl, ", ", 2);
        number(sdl, arguments[i]);
    }
    append(sdl, ")\n", 2);
}

void sdl_declare(struct sdl *sdl, const char *name)
{
    if (!sdl->line_start) sdl_newline(sdl);
    append(sdl, "#declare", 8);
    sdl_word(sdl, name);
    append(sdl, " =", 2);
}

void sdl_semicolon(struct sdl *sdl)
{
    append(sdl, ";\n", 2);
}

void sdl_declare_number(struct sdl *sdl, const char *name, double value)
{
    sdl_declare(sdl, name);
    sdl_number(sdl, value);
    sdl_semicolon(sdl);
}

void sdl_declare_vector(struct sdl *sdl, const char *name, struct vec3 value)
{
    sdl_declare(sdl, name);
    sdl_vector(sdl, value);
    sdl_semicolon(sdl);
}

void sdl_declare_color(struct sdl *sdl, const char *name, const double rgb[3])
{
    sdl_declare(sdl, name);
    sdl_color(sdl, rgb);
    sdl_semicolon(sdl);
}

void sdl_declare_string(struct sdl *sdl, const char *name, const char *value)
{
    sdl_declare(sdl, name);
    sdl_string(sdl, value);
    sdl_semicolon(sdl);
}

static void directive(struct sdl *sdl, const char *text)
{
    if (!sdl->line_start) sdl_newline(sdl);
    append(sdl, text, strlen(text));
}

void sdl_if(struct sdl *sdl, const char *name)
{
    directive(sdl, "#if (");
    sdl_word(sdl, name);
    append(sdl, ")\n", 2);
}

void sdl_ifdef(struct sdl *sdl, const char *name)
{
    directive(sdl, "#ifdef (");
    sdl_word(sdl, name);
    append(sdl, ")\n", 2);
}

void sdl_else(struct sdl *sdl)
{
    directive(sdl, "#else\n");
}

void sdl_endif(struct sdl *sdl)
{
    directive(sdl, "#end\n");
}

void sdl_matrix(struct sdl *sdl, struct pose p)
{
    sdl_word(sdl, "matrix");
    append(sdl, " <", 2);
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++) {
            number(sdl, p.rotation.m[row][column]);
            append(sdl, ",", 1);
        }
    number(sdl, p.translation.x);
    append(sdl, ",", 1);
    number(sdl, p.translation.y);
    append(sdl, ",", 1);
    number(sdl, p.translation.z);
    append(sdl, ">\n", 2);
}

void sdl_include(struct sdl *sdl, const char *path)
{
    if (!sdl->line_start) sdl_newline(sdl);
    append(sdl, "#include", 8);
    sdl_string(sdl, path);
    sdl_newline(sdl);
}

bool sdl_write(struct sdl *sdl, const char *path, struct error *err)
{
    if (sdl->err.code != ERR_OK) {
        if (err->code == ERR_OK) *err = sdl->err;
        return false;
    }
    if (sdl->depth != 0) return error_set(err, ERR_BUG, "%s: %d scene blocks have no end", path, sdl->depth);
    return file_write_if_changed(path, sdl->text, sdl->size, err);
}

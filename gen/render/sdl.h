/* The writer of POV-Ray's scene description language: the one place where its syntax is made.
 *
 * Text grows in memory; blocks must balance; strings are escaped; NaN and infinity are refused.
 * The first error sticks and is returned by sdl_write. Numbers do not depend on the locale,
 * which this program never sets. */
#ifndef STAFFAGE_GEN_SDL_H
#define STAFFAGE_GEN_SDL_H

#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

struct sdl {
    char *text;
    size_t size, capacity;
    int depth;
    bool line_start;
    struct error err;
};

void sdl_init(struct sdl *sdl);
void sdl_release(struct sdl *sdl);
/* `#version 3.7;` and a comment of ours. Once, first. */
void sdl_header(struct sdl *sdl, const char *comment);

/* A keyword or the name of something that we declared: [A-Za-z_0-9]+ only. */
void sdl_word(struct sdl *sdl, const char *word);
void sdl_number(struct sdl *sdl, double value);
void sdl_vector(struct sdl *sdl, struct vec3 v);
void sdl_vector2(struct sdl *sdl, double x, double y);
/* `rgb <r, g, b>` */
void sdl_color(struct sdl *sdl, const double rgb[3]);
/* A quoted string: quotes and backslashes escaped, control characters refused. */
void sdl_string(struct sdl *sdl, const char *text);
void sdl_comma(struct sdl *sdl);
void sdl_newline(struct sdl *sdl);
/* `WORD {` ... `}` */
void sdl_begin(struct sdl *sdl, const char *word);
void sdl_end(struct sdl *sdl);
/* `NAME(` a, b, ... `)`: numbers only */
void sdl_call(struct sdl *sdl, const char *macro, const double *arguments, size_t n);
/* `#declare NAME =` ... `;` */
void sdl_declare(struct sdl *sdl, const char *name);
void sdl_semicolon(struct sdl *sdl);
void sdl_declare_number(struct sdl *sdl, const char *name, double value);
void sdl_declare_vector(struct sdl *sdl, const char *name, struct vec3 value);
void sdl_declare_color(struct sdl *sdl, const char *name, const double rgb[3]);
void sdl_declare_string(struct sdl *sdl, const char *name, const char *value);
/* `#if (NAME)` ... `#else` ... `#end` */
void sdl_if(struct sdl *sdl, const char *name);
void sdl_ifdef(struct sdl *sdl, const char *name);
void sdl_else(struct sdl *sdl);
void sdl_endif(struct sdl *sdl);
/* `matrix <...>`: POV-Ray multiplies rows, so the rotation is written transposed. */
void sdl_matrix(struct sdl *sdl, struct pose world_from_local);
/* `#include "PATH"` */
void sdl_include(struct sdl *sdl, const char *path);

/* Write to a file unless it already says the same.
 * Err: the first error of the writer; ERR_BUG when blocks do not balance; ERR_IO */
bool sdl_write(struct sdl *sdl, const char *path, struct error *err);

#endif

/* Errors as values: what went wrong, and where in the user's file.
 *
 * A function that can fail returns bool and takes `struct error *err` as its
 * last argument. err is the caller's storage, set to ERROR_NONE before the
 * first call, and is never NULL. The first error wins: setting an error that
 * is already set does nothing. On failure the other outputs are untouched. */
#ifndef STAFFAGE_LIB_ERROR_H
#define STAFFAGE_LIB_ERROR_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum error_code {
    ERR_OK = 0,
    ERR_INPUT,         /* a file or value of the user's is wrong */
    ERR_IO,            /* the system could not read or write */
    ERR_BEHIND_CAMERA, /* a point has no image */
    ERR_NOT_INVERTIBLE,/* a pixel has no ray under this lens */
    ERR_RENDER,        /* POV-Ray failed */
    ERR_MEMORY,
    ERR_BUG            /* an invariant of ours is broken */
};

struct error {
    enum error_code code;
    char file[512];    /* the user's file, empty when none is at fault */
    int line, column;  /* from 1; 0 when unknown */
    char text[1024];   /* what is wrong and what would be right; no newline */
};

#define ERROR_NONE ((struct error){ .code = ERR_OK })

/* Record an error that has no place in a file. Always returns false, so that
 * `return error_set(err, ...)` reads as it acts. */
__attribute__((format(printf, 3, 4)))
bool error_set(struct error *err, enum error_code code, const char *format, ...);

/* Record an error at a place in a file; line and column count from 1, 0 = unknown. */
__attribute__((format(printf, 6, 7)))
bool error_at(struct error *err, enum error_code code, const char *file, int line, int column,
               const char *format, ...);

/* Put context in front of the text: "camera: " + text. Always returns false. */
__attribute__((format(printf, 2, 3)))
bool error_prefix(struct error *err, const char *format, ...);

/* Print as `FILE:LINE:COLUMN: TEXT` and a newline to stderr, what is unknown left out: for main() only. */
void error_print(const struct error *err, const char *program);

/* Exit status for an error: 0 done, 1 input or render at fault, 3 a bug of ours. */
int error_exit_status(const struct error *err);

#ifdef __cplusplus
}
#endif

#endif

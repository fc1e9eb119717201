/* Paths, and files that arrive whole: written beside, flushed, renamed. */
#ifndef STAFFAGE_LIB_FILE_H
#define STAFFAGE_LIB_FILE_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* printf into fresh memory; NULL only when memory ends. The caller frees. */
__attribute__((format(printf, 1, 2)))
char *string_format(const char *format, ...);

/* `path` as seen from the folder that holds `base_file`: an absolute path stays
 * as it is. The caller frees. */
char *path_beside(const char *base_file, const char *path);
/* The same as seen from a folder. */
char *path_from_folder(const char *folder, const char *path);
/* The folder of a path ("." when it has none). The caller frees. */
char *path_folder(const char *path);
/* The part after the last '/': points into path. */
const char *path_name(const char *path);

bool file_exists(const char *path);
/* Read a whole file. Out: *data (the caller frees; one NUL byte follows), *size. */
bool file_read(char **data, size_t *size, const char *path, struct error *err);
/* Write a whole file beside, flush, rename. */
bool file_write(const char *path, const void *data, size_t size, struct error *err);
/* The same, but a file that already has these bytes is left alone, time and all. */
bool file_write_if_changed(const char *path, const void *data, size_t size, struct error *err);
/* Copy by file_write's rule. */
bool file_copy(const char *to, const char *from, struct error *err);
/* Make a folder and those above it. One that is there is fine. */
bool folder_make(const char *path, struct error *err);
/* A name to write beside `path` before file_commit: hidden, of this process, with the same
 * extension, so that no pattern finds an unfinished file. The caller frees. */
char *file_temporary(const char *path);
/* Flush and rename a finished temporary file into place; removes it on failure. */
bool file_commit(const char *temporary, const char *path, struct error *err);

/* 64 bits that tell contents apart, not a defence against forgery; chained: start with
 * FILE_HASH_SEED. In the manner of FNV-1a, eight bytes a step. */
#define FILE_HASH_SEED 0xcbf29ce484222325u
uint64_t hash_bytes(uint64_t hash, const void *data, size_t size);
/* Adds the bytes of a file to *hash. */
bool file_hash(uint64_t *hash, const char *path, struct error *err);

#endif

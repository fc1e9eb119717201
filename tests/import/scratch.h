/* A folder of a test's own for the files that it makes up. */
#ifndef STAFFAGE_TESTS_SCRATCH_H
#define STAFFAGE_TESTS_SCRATCH_H

#include "lib/error.h"
#include "lib/file.h"
#include "tests/tap.h"

#include <dirent.h>
#include <unistd.h>

static char scratch[] = "import-test.XXXXXX";

__attribute__((unused))
static void scratch_put(const char *name, const void *data, size_t size)
{
    struct error err = ERROR_NONE;
    char *path = string_format("%s/%s", scratch, name);
    if (!file_write(path, data, size, &err)) OK(false, "a file can be written: %s", err.text);
    free(path);
}
__attribute__((unused))
static void scratch_text(const char *name, const char *text) { scratch_put(name, text, strlen(text)); }

__attribute__((unused))
static void scratch_empty(void)
{
    DIR *folder = opendir(scratch);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        char *path = string_format("%s/%s", scratch, entry->d_name);
        if (entry->d_name[0] != '.') unlink(path);
        free(path);
    }
    if (folder) closedir(folder);
}

/* The place and the words of an error, as the program prints them; the folder's name is left out. */
__attribute__((unused))
static const char *scratch_error(const struct error *err)
{
    static char text[sizeof err->file + sizeof err->text + 32];
    const char *file = strncmp(err->file, scratch, strlen(scratch)) ? err->file : err->file + strlen(scratch);
    if (err->line)
        snprintf(text, sizeof text, "%s:%d:%d: %s", file, err->line, err->column, err->text);
    else
        snprintf(text, sizeof text, "%s: %s", file, err->text);
    return text;
}

#endif

#include "import/path_from.h"

#include "lib/file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static char *relative(const char *folder, const char *path)
{
    size_t common = 0, i = 0;
    for (; folder[i] && folder[i] == path[i]; i++)
        if (folder[i] == '/') common = i;
    if (!folder[i] && path[i] == '/') common = i;
    if (common == 0) return strdup(path);
    size_t ups = 0;
    for (const char *c = folder + common; *c; c++) ups += *c == '/';
    size_t rest = strlen(path + common + 1);
    char *name = malloc(3 * ups + rest + 1);
    if (!name) return NULL;
    for (size_t k = 0; k < ups; k++) memcpy(name + 3 * k, "../", 3);
    memcpy(name + 3 * ups, path + common + 1, rest + 1);
    return name;
}

char *path_from(const char *base_file, const char *path, struct error *err)
{
    char *folder = path_folder(base_file), *real_folder = folder ? realpath(folder, NULL) : NULL;
    char *real_path = realpath(path, NULL), *name = NULL;
    if (!real_path)
        error_at(err, ERR_INPUT, path, 0, 0, "cannot be opened: %s", strerror(errno));
    else if (folder && !real_folder)
        error_at(err, ERR_INPUT, base_file, 0, 0, "its folder is not there");
    else if (!real_folder || !(name = relative(real_folder, real_path)))
        error_set(err, ERR_MEMORY, "no memory for a path");
    free(folder);
    free(real_folder);
    free(real_path);
    return name;
}

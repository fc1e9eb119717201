#include "post/output.h"

#include "lib/file.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* OUT/KIND/NAME.SUFFIX, its folder made; the caller frees. */
static char *output_path(const char *out, const char *kind, const char *name, const char *suffix, struct error *err)
{
    char *path = string_format("%s/%s/%s%s", out, kind, name, suffix), *folder = path ? path_folder(path) : NULL;
    if (!folder) error_set(err, ERR_MEMORY, "no memory for a path");
    if (!folder || !folder_make(folder, err)) {
        free(path);
        path = NULL;
    }
    free(folder);
    return path;
}

bool output_image(const char *out, const char *kind, const char *name, const char *suffix, const struct image *image,
                  struct error *err)
{
    char *path = output_path(out, kind, name, suffix, err);
    bool ok = path && image_write(path, image, err);
    free(path);
    return ok;
}

bool output_copy(const char *out, const char *kind, const char *name, const char *suffix, const char *folder,
                 const char *file, struct error *err)
{
    char *from = string_format("%s/%s", folder, file), *to = output_path(out, kind, name, suffix, err);
    bool ok = to && (from ? file_copy(to, from, err) : error_set(err, ERR_MEMORY, "no memory for a path"));
    free(from);
    free(to);
    return ok;
}

/* Remove the files of a folder that another one does not have. */
static bool remove_others(const char *folder, const char *kept, struct error *err)
{
    DIR *dir = opendir(folder);
    for (struct dirent *entry; err->code == ERR_OK && dir && (entry = readdir(dir));) {
        char *here = string_format("%s/%s", folder, entry->d_name), *there = string_format("%s/%s", kept, entry->d_name);
        if (!here || !there) error_set(err, ERR_MEMORY, "no memory for a path");
        else if (file_exists(here) && !file_exists(there)) unlink(here);
        free(here);
        free(there);
    }
    if (dir) closedir(dir);
    return err->code == ERR_OK;
}

bool output_copy_folder(const char *out, const char *kind, const char *name, const char *folder, const char *subfolder,
                        struct error *err)
{
    char *from = string_format("%s/%s", folder, subfolder), *to = string_format("%s/%s/%s", out, kind, name);
    DIR *dir = from ? opendir(from) : NULL;
    if (!from || !to) error_set(err, ERR_MEMORY, "no memory for a path");
    else remove_others(to, from, err);
    for (struct dirent *entry; err->code == ERR_OK && dir && (entry = readdir(dir));) {
        if (entry->d_name[0] == '.') continue;
        char *suffix = string_format("/%s", entry->d_name);
        if (suffix) output_copy(out, kind, name, suffix, from, entry->d_name, err);
        else error_set(err, ERR_MEMORY, "no memory for a path");
        free(suffix);
    }
    if (dir) closedir(dir);
    free(from);
    free(to);
    return err->code == ERR_OK;
}

#include "post/frame_list.h"

#include "lib/file.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

static int is_frame_name(const struct dirent *entry)
{
    return strspn(entry->d_name, "0123456789") == strlen(entry->d_name);
}

bool frame_list(char ***frames, size_t *count, const char *out, struct error *err)
{
    char *folder = string_format("%s/frames", out);
    if (!folder) return error_set(err, ERR_MEMORY, "no memory for a path");
    struct dirent **entries = NULL;
    int found = scandir(folder, &entries, is_frame_name, alphasort);
    if (found < 0) error_at(err, ERR_INPUT, folder, 0, 0, "cannot be read: %s", strerror(errno));
    char **list = calloc((size_t)(found > 0 ? found : 1), sizeof *list);
    if (!list) error_set(err, ERR_MEMORY, "no memory for a list of frames");
    size_t n = 0;
    for (int i = 0; i < found; i++) {
        char *manifest = string_format("%s/%s/frame.json", folder, entries[i]->d_name);
        if (list && manifest && file_exists(manifest) && (list[n] = strdup(entries[i]->d_name))) n++;
        free(manifest);
        free(entries[i]);
    }
    free(entries);
    if (err->code == ERR_OK && n == 0) error_at(err, ERR_INPUT, folder, 0, 0, "has no frame: run staffage-gen first");
    free(folder);
    if (err->code != ERR_OK) {
        free(list);
        return false;
    }
    *frames = list;
    *count = n;
    return true;
}

void frame_list_free(char **frames, size_t count)
{
    for (size_t i = 0; i < count; i++) free(frames[i]);
    free(frames);
}

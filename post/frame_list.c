#include "post/frame_list.h"

#include "lib/file.h"

#include <dirent.h>
#include <errno.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

static int is_frame_name(const struct dirent *entry)
{
    return strspn(entry->d_name, "0123456789") == strlen(entry->d_name);
}

/* Does run.json name a frame? Where there is none, every frame counts. */
static bool of_this_run(const json_t *run, const char *frame)
{
    const json_t *frames = json_object_get(run, "frames"), *name;
    size_t i;
    if (!json_is_array(frames)) return true;
    json_array_foreach(frames, i, name)
        if (json_is_string(name) && !strcmp(json_string_value(name), frame)) return true;
    return false;
}

bool frame_list(char ***frames, size_t *count, const char *out, struct error *err)
{
    char *folder = string_format("%s/frames", out), *run_path = string_format("%s/run.json", out);
    if (!folder || !run_path) {
        free(folder);
        free(run_path);
        return error_set(err, ERR_MEMORY, "no memory for a path");
    }
    json_t *run = json_load_file(run_path, 0, NULL);
    free(run_path);
    struct dirent **entries = NULL;
    int found = scandir(folder, &entries, is_frame_name, alphasort);
    if (found < 0) error_at(err, ERR_INPUT, folder, 0, 0, "cannot be read: %s", strerror(errno));
    char **list = calloc((size_t)(found > 0 ? found : 1), sizeof *list);
    if (!list) error_set(err, ERR_MEMORY, "no memory for a list of frames");
    size_t n = 0;
    for (int i = 0; i < found; i++) {
        char *manifest = string_format("%s/%s/frame.json", folder, entries[i]->d_name);
        if (list && manifest && of_this_run(run, entries[i]->d_name) && file_exists(manifest) && (list[n] = strdup(entries[i]->d_name))) n++;
        free(manifest);
        free(entries[i]);
    }
    free(entries);
    json_decref(run);
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

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

static bool is_output(const char *folder)
{
    char *run = string_format("%s/run.json", folder);
    bool is = run && file_exists(run);
    free(run);
    return is;
}

/* The output folder that was meant, most likely: that which the path lies in, or that of the scene it names. The caller
 * frees; NULL: none, or no memory. */
static char *meant(const char *path)
{
    const char *name = strrchr(path, '/') ? strrchr(path, '/') + 1 : path, *ending = strrchr(name, '.');
    char *of_scene = ending && ending > name ? string_format("out/%.*s", (int)(ending - name), name) : NULL;
    if (of_scene && is_output(of_scene)) return of_scene;
    free(of_scene);
    char *at = path_folder(path);
    while (at && !is_output(at)) {
        char *above = strcmp(at, "/") != 0 && strcmp(at, ".") != 0 ? path_folder(at) : NULL;
        free(at);
        at = above;
    }
    return at;
}

/* Always returns false. */
static bool no_output(const char *path, struct error *err)
{
    char *right = meant(path);
    error_at(err, ERR_INPUT, path, 0, 0, "is not a folder that `staffage run` wrote%s%s%s", right ? "; " : "", right ? right : "",
             right ? " is one" : "");
    free(right);
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
    if (found < 0 && (errno == ENOENT || errno == ENOTDIR)) no_output(out, err);
    else if (found < 0) error_at(err, ERR_INPUT, folder, 0, 0, "cannot be read: %s", strerror(errno));
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

#include "import/photographs.h"

#include "import/path_from.h"
#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static bool is_folder(const char *path)
{
    struct stat st;
    return stat(path, &st) == 0 && S_ISDIR(st.st_mode);
}

/* The folder in which an image is, seen from what was imported. */
static char *find_folder(const char *source, const char *image, struct error *err)
{
    static const char *const places[] = { "", "/images", "/..", "/../images", "/../..", "/../../images" };
    char *base = is_folder(source) ? strdup(source) : path_folder(source), *found = NULL;
    for (size_t i = 0; base && !found && i < sizeof places / sizeof *places; i++) {
        char *folder = string_format("%s%s", base, places[i]);
        char *file = folder ? string_format("%s/%s", folder, image) : NULL;
        if (file && file_exists(file)) found = folder;
        if (found != folder) free(folder);
        free(file);
    }
    if (!found)
        error_at(err, ERR_INPUT, source, 0, 0,
                 "its photograph \"%s\" lies neither there, nor in a folder images, nor in the two folders above: "
                 "say by --images where the photographs are", image);
    free(base);
    return found;
}

static bool find_one(char **name, struct photo_facts *facts, const char *scene_path, const char *folder,
                     const char *image, struct error *err)
{
    char *file = string_format("%s/%s", folder, image);
    if (!file) return error_set(err, ERR_MEMORY, "no memory for the photographs");
    bool ok = photo_facts_read(facts, file, err) && (*name = path_from(scene_path, file, err)) != NULL;
    free(file);
    return ok;
}

bool photographs_find(struct photographs *photographs, const struct reconstruction *reconstruction,
                      const char *scene_path, const char *source, const char *folder, struct error *err)
{
    if (folder && !is_folder(folder)) return error_at(err, ERR_INPUT, folder, 0, 0, "is no folder; --images names the one of the photographs");
    size_t n = reconstruction->shot_count;
    struct photographs found = { calloc(n, sizeof *found.names), calloc(n, sizeof *found.facts), n };
    char *beside = folder ? strdup(folder) : find_folder(source, reconstruction->shots[0].image, err);
    bool ok = beside != NULL;
    if (!found.names || !found.facts) ok = error_set(err, ERR_MEMORY, "no memory for the photographs");
    for (size_t i = 0; ok && i < n; i++)
        ok = find_one(&found.names[i], &found.facts[i], scene_path, beside, reconstruction->shots[i].image, err);
    free(beside);
    if (ok)
        *photographs = found;
    else
        photographs_release(&found);
    return ok;
}

void photographs_release(struct photographs *photographs)
{
    for (size_t i = 0; photographs->names && i < photographs->count; i++) free(photographs->names[i]);
    free(photographs->names);
    free(photographs->facts);
    *photographs = (struct photographs){ 0 };
}

size_t photographs_with_clock(const struct photographs *photographs)
{
    size_t n = 0;
    for (size_t i = 0; i < photographs->count; i++) n += photographs->facts[i].has_time;
    return n;
}

bool photograph_time(char text[40], const struct photo_facts *facts, const char *utc_offset)
{
    const char *offset = utc_offset ? utc_offset : facts->offset;
    if (!facts->has_time || !*offset) return false;
    snprintf(text, 40, "%s%s", facts->time, offset);
    return true;
}

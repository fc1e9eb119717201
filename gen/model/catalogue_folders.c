#include "gen/model/catalogue.h"

#include "lib/file.h"

#include <stdlib.h>
#include <unistd.h>

static const char *given(const char *variable)
{
    const char *value = getenv(variable);
    return value && *value ? value : NULL;
}

/* The folder models beside the running program, as it lies in a build tree; NULL when there is none. */
static char *beside_program(void)
{
    char *program = realpath("/proc/self/exe", NULL), *folder = program ? path_folder(program) : NULL;
    char *models = folder ? string_format("%s/models", folder) : NULL, *file = models ? string_format("%s/catalogue.json", models) : NULL;
    if (!file || !file_exists(file)) {
        free(models);
        models = NULL;
    }
    free(file);
    free(folder);
    free(program);
    return models;
}

bool catalogue_folders_init(struct catalogue_folders *folders, const char *data_folder, struct error *err)
{
    const char *own = given("STAFFAGE_MODELS"), *data = given("STAFFAGE_DATADIR"), *data_home = given("XDG_DATA_HOME"), *home = given("HOME");
    struct catalogue_folders made = { 0 };
    made.own = own ? string_format("%s", own) : beside_program();
    if (!made.own) made.own = string_format("%s/models", data ? data : data_folder);
    made.user = data_home ? string_format("%s/staffage/models", data_home)
                          : string_format("%s/.local/share/staffage/models", home ? home : "");
    if (!made.own || !made.user) {
        catalogue_folders_release(&made);
        return error_set(err, ERR_MEMORY, "no memory for a path");
    }
    made.list[0] = made.user;
    made.list[1] = made.own;
    *folders = made;
    return true;
}

void catalogue_folders_release(struct catalogue_folders *folders)
{
    free(folders->own);
    free(folders->user);
    *folders = (struct catalogue_folders){ 0 };
}

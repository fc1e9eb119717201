#include "catalogue/folder.h"

#include "lib/file.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <string.h>

static int remove_entry(const char *path, const struct stat *st, int type, struct FTW *at)
{
    (void)st;
    (void)type;
    (void)at;
    remove(path);
    return 0;
}

void folder_remove(const char *path)
{
    nftw(path, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
}

bool folder_commit(const char *temporary, const char *path, bool replace, struct error *err)
{
    if (renameat2(AT_FDCWD, temporary, AT_FDCWD, path, RENAME_NOREPLACE) == 0) return true;
    if (errno != EEXIST && errno != ENOTEMPTY) return error_at(err, ERR_IO, path, 0, 0, "cannot be made: %s", strerror(errno));
    if (!replace) return error_at(err, ERR_INPUT, path, 0, 0, "is there already: --replace takes its place, --name gives another name");
    /* Both names stay valid throughout; the old one is then below the temporary name. */
    if (renameat2(AT_FDCWD, temporary, AT_FDCWD, path, RENAME_EXCHANGE) != 0)
        return error_at(err, ERR_IO, path, 0, 0, "cannot be replaced: %s", strerror(errno));
    folder_remove(temporary);
    return true;
}

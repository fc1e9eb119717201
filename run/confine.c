#include "run/confine.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/landlock.h>
#include <stdint.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#define READ_FILE LANDLOCK_ACCESS_FS_READ_FILE
#define READ_TREE (LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR)
#define EXECUTE   LANDLOCK_ACCESS_FS_EXECUTE
#define WRITE_TREE (LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_REMOVE_FILE)
#define ALL (LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_READ_FILE | \
             LANDLOCK_ACCESS_FS_READ_DIR | LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE | \
             LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG | \
             LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK | \
             LANDLOCK_ACCESS_FS_MAKE_SYM)

/* What any program needs to start. Libraries may be executed because the loader is one of them. */
static const struct { const char *path; uint64_t access; } system_paths[] = {
    { "/lib", READ_TREE | EXECUTE },
    { "/lib32", READ_TREE | EXECUTE },
    { "/lib64", READ_TREE | EXECUTE },
    { "/usr/lib", READ_TREE | EXECUTE },
    { "/usr/lib32", READ_TREE | EXECUTE },
    { "/usr/lib64", READ_TREE | EXECUTE },
    { "/usr/local/lib", READ_TREE | EXECUTE },
    { "/usr/share", READ_TREE },
    { "/usr/local/share", READ_TREE },
    { "/etc/povray", READ_TREE },
    { "/etc/ld.so.cache", READ_FILE },
    { "/etc/ld.so.preload", READ_FILE },
    { "/dev/null", READ_FILE },
    { "/dev/urandom", READ_FILE },
    { "/sys/devices/system/cpu", READ_TREE },
};

bool confine_available(void)
{
    return syscall(SYS_landlock_create_ruleset, NULL, 0, LANDLOCK_CREATE_RULESET_VERSION) >= 1;
}

static bool allow(int rules, const char *path, uint64_t access, bool required, struct error *err)
{
    int fd = open(path, O_PATH | O_CLOEXEC);
    if (fd < 0) {
        if (!required) return true;
        return error_at(err, ERR_IO, path, 0, 0, "cannot be opened: %s", strerror(errno));
    }
    struct landlock_path_beneath_attr rule = { .allowed_access = access, .parent_fd = fd };
    bool ok = syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
    if (!ok) error_at(err, ERR_IO, path, 0, 0, "the kernel takes no Landlock rule: %s", strerror(errno));
    close(fd);
    return ok;
}

bool confine(const char *program, const char *readable, const char *writable, struct error *err)
{
    struct landlock_ruleset_attr handled = { .handled_access_fs = ALL };
    int rules = (int)syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0);
    if (rules < 0) return error_set(err, ERR_IO, "the kernel makes no Landlock rules: %s", strerror(errno));
    bool ok = true;
    for (size_t i = 0; ok && i < sizeof system_paths / sizeof *system_paths; i++)
        ok = allow(rules, system_paths[i].path, system_paths[i].access, false, err);
    ok = ok && allow(rules, program, READ_FILE | EXECUTE, true, err) &&
         allow(rules, readable, READ_TREE, true, err) &&
         allow(rules, writable, READ_TREE | WRITE_TREE, true, err);
    if (ok && (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || syscall(SYS_landlock_restrict_self, rules, 0) != 0))
        ok = error_set(err, ERR_IO, "Landlock: %s", strerror(errno));
    close(rules);
    return ok;
}

#include "run/pass.h"

#include "lib/file.h"
#include "run/confine.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* The files of a pass, all named after its stem. POV-Ray keeps a .pov-state beside the picture
 * that it is at. */
struct files { char *scene, *picture, *unfinished, *state, *log, *folder, *home, *in, *out, *size[2]; };

static bool files_init(struct files *files, const struct pass *pass, struct error *err)
{
    const char *stem = pass->stem;
    char *here = realpath(".", NULL);
    *files = (struct files){
        .scene = string_format("%s/%s.pov", here ? here : ".", stem),
        .picture = string_format("%s.exr", stem),
        .unfinished = string_format("%s.part.exr", stem),
        .state = string_format("%s.part.pov-state", stem),
        .log = string_format("%s.log", stem),
        .folder = path_folder(stem),
        .home = string_format("%s/frames/home", here ? here : "."),
        .in = string_format("+I%s.pov", stem),
        .out = string_format("+O%s.part.exr", stem),
        .size = { string_format("+W%d", pass->width_px), string_format("+H%d", pass->height_px) },
    };
    free(here);
    if (files->scene && files->picture && files->unfinished && files->state && files->log && files->folder &&
        files->home && files->in && files->out && files->size[0] && files->size[1])
        return true;
    return error_set(err, ERR_MEMORY, "no memory for paths");
}

static void files_release(struct files *files)
{
    free(files->scene);
    free(files->picture);
    free(files->unfinished);
    free(files->state);
    free(files->log);
    free(files->folder);
    free(files->home);
    free(files->in);
    free(files->out);
    free(files->size[0]);
    free(files->size[1]);
}

/* What a child that could not start POV-Ray leaves in the log, for pass_complaint. */
static _Noreturn void child_fail(const char *what, const char *why)
{
    fprintf(stderr, "Error: %s: %s\n", what, why);
    _exit(127);
}

static _Noreturn void child_run(const struct files *files, const struct pass *pass, int log, pid_t parent,
                                const sigset_t *signals)
{
    /* One core a process; warnings and fatal errors only; nothing from the user's own ini files. */
    const char *const fixed[] = { POVRAY_PROGRAM, files->in, files->out, files->size[0], files->size[1],
                                  "+FE", "+UA", "+WT1", "-D", "-V", "-P", "-C", "-GD", "-GR", "-GS", "+Ltemplates" };
    size_t n = sizeof fixed / sizeof *fixed;
    int null = open("/dev/null", O_RDONLY);
    if (null < 0 || dup2(null, 0) < 0 || dup2(log, 1) < 0 || dup2(log, 2) < 0) _exit(127);
    char **arguments = calloc(n + pass->option_count + 1, sizeof *arguments);
    if (!arguments) child_fail("POV-Ray", "no memory to start it");
    memcpy(arguments, fixed, sizeof fixed);
    if (pass->option_count > 0) memcpy(arguments + n, pass->options, pass->option_count * sizeof *arguments);
    /* POV-Ray has its own idea of Ctrl-C: what ends it is its parent. */
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127);
    struct error err = ERROR_NONE;
    if (setenv("HOME", files->home, 1) != 0 || setenv("POV_TEMP_DIR", files->folder, 1) != 0 ||
        unsetenv("POVINI") != 0)
        child_fail("POV-Ray", "no memory for its environment");
    if (confine_available() && !confine(POVRAY_PROGRAM, ".", files->folder, &err)) child_fail(err.file, err.text);
    sigprocmask(SIG_SETMASK, signals, NULL);
    execv(POVRAY_PROGRAM, arguments);
    child_fail(POVRAY_PROGRAM, strerror(errno));
}

char *pass_complaint(const char *log)
{
    char *text = calloc(1, strlen(log) + 1), *end = text;
    if (!text) return NULL;
    bool wanted = false;
    for (const char *line = log; *line;) {
        size_t length = strcspn(line, "\n");
        /* A line that begins with a blank goes on with the one before. */
        if (line[0] != ' ')
            wanted = (memmem(line, length, "rror", 4) || memmem(line, length, "Cannot", 6)) &&
                     strncmp(line, "Fatal error", 11) != 0;
        if (wanted) {
            if (end != text && line[0] != ' ') *end++ = ' ';
            memcpy(end, line, length);
            end += length;
        }
        line += length + (line[length] == '\n');
    }
    while (end > text && end[-1] == ' ') end--;
    *end = 0;
    return text;
}

static bool fail(const struct files *files, int status, struct error *err)
{
    struct error unread = ERROR_NONE;
    char *log = NULL;
    size_t size;
    char *complaint = file_read(&log, &size, files->log, &unread) ? pass_complaint(log) : NULL;
    if (complaint && *complaint)
        error_at(err, ERR_RENDER, files->scene, 0, 0, "POV-Ray: %s", complaint);
    else if (WIFSIGNALED(status))
        error_at(err, ERR_RENDER, files->scene, 0, 0, "POV-Ray was ended by signal %d (%s)%s", WTERMSIG(status),
                 strsignal(WTERMSIG(status)), WTERMSIG(status) == SIGKILL ? ": perhaps memory ran out" : "");
    else
        error_at(err, ERR_RENDER, files->scene, 0, 0, "POV-Ray ended with status %d; what it printed is in %s",
                 WEXITSTATUS(status), files->log);
    free(complaint);
    free(log);
    return false;
}

static void add_unless_ignored(sigset_t *set, int number)
{
    struct sigaction action;
    if (sigaction(number, NULL, &action) == 0 && action.sa_handler != SIG_IGN) sigaddset(set, number);
}

bool pass_render(const struct pass *pass, struct error *err)
{
    struct files files;
    sigset_t waited, before;
    int log = -1, stopped = 0;
    bool ok = false;
    if (!files_init(&files, pass, err)) goto out;
    log = open(files.log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (log < 0) {
        error_at(err, ERR_IO, files.log, 0, 0, "cannot be written: %s", strerror(errno));
        goto out;
    }
    sigemptyset(&waited);
    sigaddset(&waited, SIGCHLD);
    add_unless_ignored(&waited, SIGINT);
    add_unless_ignored(&waited, SIGTERM);
    add_unless_ignored(&waited, SIGHUP);
    sigprocmask(SIG_BLOCK, &waited, &before);
    pid_t parent = getpid(), child = fork();
    if (child == 0) child_run(&files, pass, log, parent, &before);
    if (child < 0) {
        error_set(err, ERR_IO, "no process for POV-Ray: %s", strerror(errno));
        goto unblock;
    }
    int status = 0;
    pid_t ended;
    while ((ended = waitpid(child, &status, WNOHANG)) == 0) {
        int caught = sigwaitinfo(&waited, NULL);
        if (caught > 0 && caught != SIGCHLD) {
            stopped = caught;
            kill(child, SIGKILL);
        }
    }
    if (stopped) {
        error_at(err, ERR_RENDER, files.scene, 0, 0, "stopped");
        unlink(files.log);
    } else if (ended < 0) {
        error_set(err, ERR_IO, "POV-Ray cannot be waited for: %s", strerror(errno));
    } else if (status != 0) {
        fail(&files, status, err);
    } else {
        ok = file_commit(files.unfinished, files.picture, err);
        unlink(files.log);
    }
    if (!ok) {
        unlink(files.unfinished);
        unlink(files.state);
    }
unblock:
    sigprocmask(SIG_SETMASK, &before, NULL);
out:
    if (log >= 0) close(log);
    files_release(&files);
    if (stopped) raise(stopped);
    return ok;
}

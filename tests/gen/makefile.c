/* The makefile of an output folder: what it takes and refuses. */
#include "gen/render/makefile.h"
#include "lib/file.h"
#include "tests/tap.h"

#include <sys/stat.h>
#include <unistd.h>

static char out[] = "/tmp/makefile-test-XXXXXX";

static char *written(const char *name)
{
    struct error err = ERROR_NONE;
    char *path = string_format("%s/%s", out, name), *data = NULL;
    size_t size;
    if (!file_read(&data, &size, path, &err)) data = NULL;
    free(path);
    return data;
}

static bool refuses(struct makefile_frame frame, const char *templates)
{
    struct error err = ERROR_NONE;
    return !makefile_write(out, templates, &frame, 1, &err) && err.code == ERR_BUG;
}

int main(void)
{
    struct error err = ERROR_NONE;
    char *templates = string_format("%s/templates", getenv("top_srcdir"));
    if (!mkdtemp(out) || !templates) return 2;
    struct makefile_frame frames[] = {
        { .name = "000007", .width_px = { 320, 320, 320 }, .height_px = { 200, 200, 200 }, .options = { "+AM2 +A0.05 +R2 -J", NULL, "" } },
        { .name = "000008", .empty = true },
    };

    OK(refuses((struct makefile_frame){ .name = "7 x", .empty = true }, templates), "refuses a name that is not digits");
    OK(refuses((struct makefile_frame){ .name = "", .empty = true }, templates), "refuses an empty name");
    OK(refuses((struct makefile_frame){ .name = "7", .width_px = { 9, 0, 9 }, .height_px = { 9, 9, 9 } }, templates), "refuses an empty picture");
    OK(refuses((struct makefile_frame){ .name = "7", .width_px = { 9, 9, 9 }, .height_px = { 9, 9, 9 }, .options = { "+A;rm" } }, templates),
       "refuses an option that a shell would split");
    OK(!written("Makefile"), "writes nothing when it refuses");

    OK(makefile_write(out, templates, frames, 2, &err), "writes: %s", err.text);
    char *makefile = written("Makefile");
    OK(makefile && strstr(makefile, "\nobject_000007 := 320 200 +AM2 +A0.05 +R2 -J\n"),
       "a pass has its size and options");
    OK(makefile && strstr(makefile, "\nplane_000007 := 320 200\n"), "a pass without options");
    OK(makefile && !strstr(makefile, "object_000008"), "an empty frame has no passes");
    OK(makefile && strstr(makefile, "\nFRAMES := 000007 000008\n"), "every frame is there");
    OK(makefile && !strstr(makefile, out), "holds relative paths only");
    free(makefile);
    char *template = written("templates/camera.inc");
    OK(template, "templates lie in the output folder");
    free(template);
    char *conf = written("frames/home/.povray/3.7/povray.conf");
    OK(conf && strstr(conf, "forbidden"), "POV-Ray finds a configuration that forbids shell-outs");
    free(conf);

    char *path = string_format("%s/Makefile", out);
    struct stat first, second;
    stat(path, &first);
    OK(makefile_write(out, templates, frames, 2, &err) && stat(path, &second) == 0 &&
           first.st_mtim.tv_nsec == second.st_mtim.tv_nsec && first.st_ino == second.st_ino,
       "the same again touches nothing");
    free(path);

    char *command[] = { "rm", "-rf", out, NULL };
    free(templates);
    int done = tap_done();
    fflush(stdout);
    if (done == 0) execvp("rm", command);
    return done;
}

/* staffage-povray: render one pass, for the makefile of an output folder. */
#include "run/confine.h"
#include "run/pass.h"

#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>

static const char usage[] =
    "usage: staffage-povray STEM WIDTH HEIGHT [POV-RAY OPTION...]\n"
    "       staffage-povray --confined | --help | --version\n"
    "\n"
    "Renders STEM.pov to STEM.exr, inside the output folder. STEM is frames/NNNNNN/PASS.\n"
    "\n"
    "  --confined   say whether this kernel can confine POV-Ray to the output folder\n"
    "  --help       show this text\n"
    "  --version    show the version\n";

static int size_px(const char *text)
{
    char *end;
    errno = 0;
    long n = strtol(text, &end, 10);
    return errno || end == text || *end || n < 1 || n > INT_MAX ? 0 : (int)n;
}

static int misused(const char *what)
{
    fprintf(stderr, "staffage-povray: %s\n%s", what, usage);
    return 2;
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--help") == 0) {
        fputs(usage, stdout);
        return 0;
    }
    if (argc == 2 && strcmp(argv[1], "--version") == 0) {
        puts("staffage-povray " PACKAGE_VERSION);
        return 0;
    }
    if (argc == 2 && strcmp(argv[1], "--confined") == 0) {
        puts(confine_available() ? "yes" : "no");
        return confine_available() ? 0 : 1;
    }
    if (argc < 4) return misused("a stem, a width and a height are wanted");
    struct pass pass = { .stem = argv[1], .width_px = size_px(argv[2]), .height_px = size_px(argv[3]),
                         .options = argv + 4, .option_count = (size_t)argc - 4 };
    if (!pass.width_px || !pass.height_px) return misused("width and height are whole numbers from 1");

    /* A make that is killed takes its renders along: the next run must not meet them. */
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    struct error err = ERROR_NONE;
    if (!pass_render(&pass, &err)) error_print(&err, "staffage-povray");
    return error_exit_status(&err);
}

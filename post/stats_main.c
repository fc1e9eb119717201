/* staffage-stats: the share of pixels of each class, before and after, and its objects. */
#include "lib/error.h"
#include "post/stats.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>

static const char usage[] =
    "Usage: staffage stats OUT [--json]\n"
    "Print the share of pixels that each class has in the frames of a dataset, before and after,\n"
    "and how many objects of each class there are, how large and how much of them visible.\n"
    "\n"
    "  OUT             the output folder of staffage\n"
    "  --json          print JSON\n"
    "  --help          this text\n"
    "  --version       the version\n"
    "\n"
    "Exit status: 0 done, 1 no frame could be counted, 2 wrong usage, 3 a bug.\n";

static int misused(const char *what, const char *value)
{
    fprintf(stderr, "staffage-stats: %s%s (staffage stats --help shows how)\n", what, value);
    return 2;
}

static int print_stats(const char *out, bool as_json)
{
    struct error err = ERROR_NONE;
    struct stats stats = { 0 };
    char *text = NULL;
    if (stats_count(&stats, out, &err)) {
        text = as_json ? stats_json(&stats) : stats_table(&stats);
        if (!text) error_set(&err, ERR_MEMORY, "out of memory");
        else if (fputs(text, stdout) == EOF || fflush(stdout) != 0) error_set(&err, ERR_IO, "the figures cannot be printed");
    }
    free(text);
    stats_release(&stats);
    if (err.code == ERR_OK) return 0;
    error_print(&err, "staffage-stats");
    return error_exit_status(&err);
}

int main(int argc, char **argv)
{
    static const struct option options[] = {
        { "json", no_argument, NULL, 'j' },
        { "help", no_argument, NULL, 'h' },
        { "version", no_argument, NULL, 'V' },
        { 0 },
    };
    bool as_json = false;
    opterr = 0;
    for (int o; (o = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        switch (o) {
        case 'j': as_json = true; break;
        case 'h': fputs(usage, stdout); return 0;
        case 'V': puts("staffage-stats " PACKAGE_VERSION); return 0;
        default: return misused("wrong option: ", argv[optind - 1]);
        }
    }
    if (argc - optind != 1)
        return misused(argc == optind ? "no output folder is given" : "more than one output folder: ",
                       argc == optind ? "" : argv[optind + 1]);
    return print_stats(argv[optind], as_json);
}

/* Writes our own models: `staffage-cast FOLDER` makes GLB files there, and the catalogue that lists them; with names
 * after it, these alone. The same numbers give the same bytes on every run. */
#include "cast/workshop.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: staffage-cast FOLDER [NAME ...]\n");
        return 2;
    }
    struct error err = ERROR_NONE;
    if (!workshop_run(argv[1], (const char *const *)argv + 2, argc - 2, &err)) error_print(&err, "staffage-cast");
    return error_exit_status(&err);
}

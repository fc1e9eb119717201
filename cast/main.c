/* Writes our own models: `staffage-cast FOLDER` makes GLB files there, and the catalogue that lists them. The same
 * numbers give the same bytes on every run. */
#include "cast/figure.h"
#include "cast/fleet.h"
#include "cast/listing.h"
#include "lib/file.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: staffage-cast FOLDER\n");
        return 2;
    }
    struct error err = ERROR_NONE;
    struct listing listing = { 0 };
    bool good = folder_make(argv[1], &err) && write_fleet(&listing, argv[1], &err) && write_people(&listing, argv[1], &err) &&
                listing_write(&listing, argv[1], &err);
    if (!good) error_print(&err, "staffage-cast");
    return error_exit_status(&err);
}

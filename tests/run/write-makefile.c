/* write-makefile OUT TEMPLATES WIDTH HEIGHT OPTIONS [NAME | NAME:empty]...: makefile_write, for
 * tests of what people type that need no real scene. */
#include "gen/render/makefile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv)
{
    if (argc < 6) return 2;
    size_t n = (size_t)argc - 6;
    struct makefile_frame *frames = calloc(n + 1, sizeof *frames);
    if (!frames) return 2;
    for (size_t i = 0; i < n; i++) {
        char *name = argv[6 + i], *colon = strchr(name, ':');
        if (colon) *colon = 0;
        int w = atoi(argv[3]), h = atoi(argv[4]);
        frames[i] = (struct makefile_frame){
            .name = name, .empty = colon, .width_px = { w, w, w }, .height_px = { h, h, h },
            .options = { argv[5], argv[5], argv[5] },
        };
    }
    struct error err = ERROR_NONE;
    if (!makefile_write(argv[1], argv[2], frames, n, &err)) error_print(&err, "write-makefile");
    free(frames);
    return error_exit_status(&err);
}

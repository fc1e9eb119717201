/* staffage-post: from passes and photograph to the dataset. */
#include "lib/error.h"
#include "post/frame.h"
#include "post/frame_list.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "Usage: staffage-post OUT [--frame 000123]...\n"
    "Merge the rendered passes of frames into their photographs, and write pictures and labels.\n"
    "\n"
    "  OUT             the output folder that staffage-gen and POV-Ray have worked in\n"
    "  --frame NAME    this frame only; may be given again. Without it: all frames in OUT/frames\n"
    "  --help          this text\n"
    "  --version       the version\n"
    "\n"
    "Exit status: 0 done, 1 the input or a render was at fault, 2 wrong usage, 3 a bug.\n";

static int misused(const char *what, const char *value)
{
    fprintf(stderr, "staffage-post: %s%s (staffage-post --help shows how)\n", what, value);
    return 2;
}

/* A frame that fails does not keep the others from being done. Returns the worst exit status. */
static int post_frames(const char *out, char *const *frames, size_t count)
{
    int status = 0;
    for (size_t i = 0; i < count; i++) {
        struct error err = ERROR_NONE;
        if (frame_post(out, frames[i], &err)) continue;
        error_print(&err, "staffage-post");
        int this_one = error_exit_status(&err);
        if (this_one > status) status = this_one;
    }
    return status;
}

static int post_all(const char *out)
{
    struct error err = ERROR_NONE;
    char **frames;
    size_t count;
    if (!frame_list(&frames, &count, out, &err)) {
        error_print(&err, "staffage-post");
        return error_exit_status(&err);
    }
    int status = post_frames(out, frames, count);
    frame_list_free(frames, count);
    return status;
}

int main(int argc, char **argv)
{
    static const struct option options[] = {
        { "frame", required_argument, NULL, 'f' },
        { "help", no_argument, NULL, 'h' },
        { "version", no_argument, NULL, 'V' },
        { 0 },
    };
    char **frames = calloc((size_t)argc, sizeof *frames);
    size_t count = 0;
    int status = 0;
    if (!frames) return 1;
    opterr = 0;
    for (int o; (o = getopt_long(argc, argv, "", options, NULL)) != -1;) {
        switch (o) {
        case 'f':
            if (!*optarg || strspn(optarg, "0123456789") != strlen(optarg)) {
                status = misused("not the name of a frame: ", optarg);
                goto out;
            }
            frames[count++] = optarg;
            break;
        case 'h':
            fputs(usage, stdout);
            goto out;
        case 'V':
            puts("staffage-post " PACKAGE_VERSION);
            goto out;
        default:
            status = misused("wrong option: ", argv[optind - 1]);
            goto out;
        }
    }
    if (argc - optind != 1)
        status = misused(argc == optind ? "no output folder is given" : "more than one output folder: ",
                         argc == optind ? "" : argv[optind + 1]);
    else
        status = count > 0 ? post_frames(argv[optind], frames, count) : post_all(argv[optind]);
out:
    free(frames);
    return status;
}

/* POV-Ray on one pass of a folder that passes_write filled. */
#ifndef STAFFAGE_TESTS_GEN_POVRAY_H
#define STAFFAGE_TESTS_GEN_POVRAY_H

#include "lib/file.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static inline bool povray(const char *out, const char *pass, int width, int height, const char *antialias)
{
    char *templates = string_format("+L%s/templates", getenv("top_srcdir"));
    char *in = string_format("+Iframes/%s.pov", pass), *to = string_format("+Oframes/%s.exr", pass);
    char *w = string_format("+W%d", width), *h = string_format("+H%d", height);
    char *words = string_format("%s", antialias), *option[4] = { 0 };
    int n = 0;
    for (char *word = strtok(words, " "); word && n < 4; word = strtok(NULL, " ")) option[n++] = word;
    pid_t child = fork();
    if (child == 0) {
        if (chdir(out) != 0) _exit(126);
        freopen("/dev/null", "w", stdout);
        freopen("povray.log", "w", stderr);
        execlp("povray", "povray", in, to, w, h, templates, "+L.", "+FE", "-D", "+WT1", "+UA", option[0], option[1],
               option[2], option[3], (char *)NULL);
        _exit(127);
    }
    int status = 1;
    waitpid(child, &status, 0);
    free(words);
    free(templates);
    free(in);
    free(to);
    free(w);
    free(h);
    return status == 0;
}

/* The folder and all in it. */
static inline void povray_remove(const char *out)
{
    pid_t child = fork();
    if (child == 0) {
        execlp("rm", "rm", "-rf", out, (char *)NULL);
        _exit(127);
    }
    waitpid(child, NULL, 0);
}

#endif

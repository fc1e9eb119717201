/* Files that cannot be read, each with the words that say so. */
#ifndef STAFFAGE_TESTS_REFUSALS_H
#define STAFFAGE_TESTS_REFUSALS_H

#include "import/reconstruction.h"
#include "tests/import/scratch.h"
#include "tests/tap.h"

struct bad_file { const char *what, *json, *error; };

static void refuses(const struct bad_file *cases, size_t n,
                    bool (*reads)(struct reconstruction *r, const char *json, struct error *err))
{
    for (size_t i = 0; i < n; i++) {
        struct reconstruction r;
        struct error err;
        bool read = reads(&r, cases[i].json, &err);
        if (!OK(!read && !strcmp(scratch_error(&err), cases[i].error), "refuses %s", cases[i].what)) printf("# %s\n", scratch_error(&err));
        if (read) reconstruction_release(&r);
    }
}

#endif

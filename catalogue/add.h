/* Bringing a user's own model into the catalogue. */
#ifndef STAFFAGE_CATALOGUE_ADD_H
#define STAFFAGE_CATALOGUE_ADD_H

#include "catalogue/guess.h"
#include "lib/error.h"

#include <stdbool.h>

struct add_options {
    const char *file;
    const char *name;           /* NULL: from the file's */
    const char *license;        /* NULL: not told */
    struct known known;         /* what the user says; the rest is filled in here */
    bool replace;
    const char *folder;         /* the user's catalogue */
    const char *rules;          /* path of the rules of materials */
    int width_px;               /* of one of the four pictures */
};

/* Look at a model, say on stdout what it is like, and put it into the catalogue, with a picture from four sides: whole
 * or not at all. One that is refused has its picture in out/models/NAME.png, as far as it can be shown.
 * Err: ERR_INPUT at the file: not readable; something is not sure enough and must be said; a name that is taken */
bool add_model(const struct add_options *options, struct error *err);

#endif

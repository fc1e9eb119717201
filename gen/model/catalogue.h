/* The catalogue: models by short names, with what a scene needs to know of them. docs/models.md
 * describes its file. */
#ifndef STAFFAGE_GEN_CATALOGUE_H
#define STAFFAGE_GEN_CATALOGUE_H

#include "gen/model/model.h"
#include "lib/class.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* How finely a model is made: for views from near, from some way off, from the air. */
enum detail { DETAIL_NEAR, DETAIL_MIDDLE, DETAIL_FAR, DETAIL_COUNT };
/* "near", "middle", "far" */
const char *detail_name(enum detail detail);

/* A paint that its kind is seen in, and how often. */
struct model_color { double linear[3], weight; };

struct catalogue_model {
    char *name;
    char *files[DETAIL_COUNT];    /* paths; NULL: no file for this detail, the next finer one serves. The first is never NULL */
    struct model_options options; /* unit and axes, where the files do not state them; class */
    enum entity_class class_;
    double weight;                /* how common among those of its class */
    double size_m[3];             /* length, width, height; 0: not told */
    int triangles[DETAIL_COUNT];  /* 0: not told */
    struct model_color *colors;   /* (color_count) */
    size_t color_count;
    char *animations;             /* "walk, run"; empty: none */
    char *license, *source;       /* empty: not told */
    char *picture;                /* path of its picture, or NULL */
    char *home;                   /* path of the catalogue file that it is from */
};

struct catalogue {
    struct catalogue_model *models; /* (count) in the order of the folders, then of their files */
    size_t count;
};

/* Read what folders hold: FOLDER/catalogue.json, and FOLDER/X/catalogue.json by X. What is not there holds nothing.
 * Of models of one name the first is taken.
 * In:  folders   ends with NULL
 * Out: *catalogue, the caller's
 * Err: ERR_INPUT at a catalogue file */
bool catalogue_read(struct catalogue **catalogue, const char *const *folders, struct error *err);
void catalogue_destroy(struct catalogue *catalogue);

/* NULL: there is none. */
const struct catalogue_model *catalogue_find(const struct catalogue *catalogue, const char *name);

/* Is it a name that a model may have: a letter, then letters, digits, "-" and "_", up to 60? */
bool catalogue_name_is_good(const char *name);

/* Where catalogues are looked for. The program's own: $STAFFAGE_MODELS, or the folder models beside the running
 * program, or in $STAFFAGE_DATADIR, or in data_folder. The user's: staffage/models in $XDG_DATA_HOME or ~/.local/share.
 * Out: folders   ends with NULL; free with catalogue_folders_release */
struct catalogue_folders { char *user, *own; const char *list[3]; };
bool catalogue_folders_init(struct catalogue_folders *folders, const char *data_folder, struct error *err);
void catalogue_folders_release(struct catalogue_folders *folders);

#endif

/* What a model file leaves open - what it is, its unit, its axes - by its size and its shape, and how sure that is. */
#ifndef STAFFAGE_CATALOGUE_GUESS_H
#define STAFFAGE_CATALOGUE_GUESS_H

#include "gen/model/model.h"
#include "lib/class.h"
#include "lib/vec.h"

#include <stdbool.h>

/* What is known beforehand. */
struct known {
    const char *name;           /* words in it may say what it is */
    bool has_class;
    enum entity_class class_;
    double unit_m, length_m, height_m; /* 0: not known; of one at most */
    bool has_up, has_front;
    enum axis up, front;
    bool format_has_axes;       /* +y up, +z front, as glTF says */
    double stated_unit_m;       /* as the file says; 0: it does not */
};

/* Shares of certainty: 1 for what was known. */
struct guess {
    enum entity_class class_;
    double unit_m;
    enum axis up, front;
    double class_sure, unit_sure, up_sure, along_sure, front_sure; /* along: the axis of front, whichever way */
    const char *front_by;       /* what tells which way: "the format", "the user", or as front_odds says */
    double misfit;              /* how far its size is from that of its class, in standard deviations, at most of its sides */
};

/* In: model   in the file's axes (x forward, z up), in any unit: its own by unit_m */
struct guess guess_model(const struct model *model, const struct known *known);

/* Length, width and height that things of a class have; false for a class of all sizes. */
bool class_size(struct vec3 *size_m, enum entity_class class_);

#endif

/* What the catalogue says of the models made: FOLDER/catalogue.json, as docs/models.md has it. */
#ifndef STAFFAGE_CAST_LISTING_H
#define STAFFAGE_CAST_LISTING_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

struct paint_share { const char *color; double weight; }; /* "#rrggbb", and how often it is seen */

/* One model. What is 0 or NULL is left out. */
struct listed {
    const char *name, *class_, *kind;                /* a class of lib/class.h; vehicle, person */
    const char *file, *middle, *far;                 /* in the folder: for views from near, from some way off, from the air */
    double weight;                                   /* how common among those of its class; 0 stands for 1 */
    double length_m, width_m, height_m;
    double wheelbase_m, track_m, clearance_m, wheel_diameter_m;
    size_t triangles[3];
    const char *const *animations;                   /* ends with NULL */
    const struct paint_share *colors;                /* (color_count) */
    size_t color_count;
    const char *source;                              /* where the proportions come from */
};

/* { 0 } is empty. */
struct listing { struct json_t *models; };
/* Err: ERR_MEMORY */
bool listing_add(struct listing *listing, const struct listed *model, struct error *err);
/* Append what `from` lists, and empty it, also on failure. Err: ERR_MEMORY */
bool listing_append(struct listing *listing, struct listing *from, struct error *err);
/* Write FOLDER/catalogue.json. Err: ERR_IO, ERR_MEMORY */
bool listing_write(const struct listing *listing, const char *folder, struct error *err);
void listing_release(struct listing *listing);

#endif

/* What of a dataset's objects can be seen: how many of each class, how large, how much of them. */
#ifndef STAFFAGE_POST_OBJECTS_H
#define STAFFAGE_POST_OBJECTS_H

#include "lib/class.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* An entity counts as one object in each frame that it is in. */
struct objects {
    size_t count;              /* in a frame, hidden or not */
    size_t visible;            /* of these, with a pixel that can be seen */
    double *height_px;         /* (visible) of the box round what can be seen */
    double *visible_fraction;  /* (visible) */
};

/* Add the objects of a frame. Start with zeros; release them.
 * In:  path   a frame's labels, labels/NNNNNN.json
 * Out: objects (CLASS_COUNT) by class; untouched on failure, but for their room
 * Err: ERR_INPUT at the path: missing, damaged, or of another format; ERR_MEMORY */
bool objects_add(struct objects objects[CLASS_COUNT], const char *path, struct error *err);
void objects_release(struct objects objects[CLASS_COUNT]);

/* Bring the values of each class into ascending order, for objects_quartiles. */
void objects_sort(struct objects objects[CLASS_COUNT]);
/* First quartile, median and third quartile, even between two values.
 * In:  values   (n) ascending, n > 0
 * Src: Hyndman & Fan 1996, definition 7 */
void objects_quartiles(double quartiles[3], const double *values, size_t n);

#endif

/* How much of the pictures each class has, before anything is put in and after; and what can be seen of the objects. */
#ifndef STAFFAGE_POST_STATS_H
#define STAFFAGE_POST_STATS_H

#include "lib/class.h"
#include "lib/error.h"
#include "post/objects.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define STATS_OTHER 256 /* what is no label of the palette */

struct stats_skipped { char frame[16]; char *why; };

struct stats {
    enum palette palette;
    bool has_before;        /* false: no frame has labels of its own, and only what was put in is counted */
    size_t frames;          /* counted */
    uint64_t pixels;        /* of all of them */
    uint64_t before[STATS_OTHER + 1], after[STATS_OTHER + 1]; /* pixels by id; before: 0 without has_before */
    struct objects objects[CLASS_COUNT]; /* that were put in, by class; their values ascend */
    struct stats_skipped *skipped; /* frames that could not be counted, with the reason */
    size_t skipped_count;
};

/* Over all frames of an output folder. Before are the photographs' semantic images or the place's labels;
 * where some frames have these, those that have not are left out. Release it.
 * Err: ERR_INPUT as frame_list: no output folder, no frames; ERR_INPUT for the first frame when none can be counted; ERR_MEMORY */
bool stats_count(struct stats *stats, const char *out, struct error *err);
void stats_release(struct stats *stats);

/* As a table for people, or as JSON. NULL when memory ends; the caller frees. */
char *stats_table(const struct stats *stats);
char *stats_json(const struct stats *stats);

#endif

/* Which share of each pixel static things leave of entities, and of what receives shadows. */
#ifndef STAFFAGE_GEN_TRACE_SHARE_H
#define STAFFAGE_GEN_TRACE_SHARE_H

#include "gen/trace/backdrop.h"
#include "gen/trace/screen.h"
#include "lib/rect.h"

struct share_input {
    struct rays *rays;
    struct screen *screens;          /* (screen_count) */
    size_t screen_count;
    struct sight_plane ground;       /* without a place; of normal 0: none */
    const struct backdrop *backdrop; /* NULL: no place */
    const struct prism *receivers;   /* (receiver_count) of the place */
    size_t receiver_count;
    const struct image *ahead;       /* F32 1: range of the nearest entity at each pixel, INFINITY where there is none */
    const struct rect *entity_px;    /* (entity_count) where entities can be in the photograph */
    size_t entity_count;
};

/* Out: visible, receiver  initialized here: 255 times the shares, as struct frame_labels says
 * Err: ERR_MEMORY; outputs may have been initialized */
bool shares_trace(struct image *visible, struct image *receiver, const struct share_input *in, struct error *err);

#endif

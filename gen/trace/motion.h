/* How far things move in the picture while the shutter is open. */
#ifndef STAFFAGE_GEN_TRACE_MOTION_H
#define STAFFAGE_GEN_TRACE_MOTION_H

#include "gen/trace/trace.h"

/* The same moment's frame at the shutter's opening and closing. */
struct motion_input {
    struct pose opening, closing;               /* world_from_camera */
    const struct pose *entity_opening, *entity_closing; /* (entity_count) world_from_entity */
};

/* Out: motion  F32 3, initialized here: px right, px down, 0. Where an entity is seen, and EDGE_PX round it,
 *      the movement of that point of it; elsewhere within a receiver (in[].receivers or the ground) that of
 *      the entity whose receiver it is, as its shadow moves with it over the ground; 0 elsewhere
 * In:  labels of the frame by the same trace_input; receiver k is that of entity receiver_entity[k] */
bool motion_trace(struct image *motion, const struct trace_input *in, const size_t *receiver_entity,
                  const struct frame_labels *labels, const struct motion_input *move, struct error *err);

#endif

/* How far things move in the picture while the shutter is open. */
#ifndef STAFFAGE_GEN_TRACE_MOTION_H
#define STAFFAGE_GEN_TRACE_MOTION_H

#include "gen/trace/trace.h"

/* The same moment's frame at the shutter's opening and closing. */
struct motion_input {
    struct pose opening, closing;               /* world_from_camera */
    const struct pose *entity_opening, *entity_closing; /* (entity_count) world_from_entity */
};

/* Out: motion  F32 3, initialized here: px right, px down, 0; from where the point is at the opening to where it is at the
 *      closing. Where an entity is seen, and EDGE_PX round it, the movement of that point of it. Elsewhere within a
 *      receiver, where it can be seen, the movement of the shade there: it goes over the place (without one, over the
 *      ground) as its entity goes, by the same translation; of several receivers it belongs to the entity nearest on the map.
 *      0 elsewhere, and where the lens loses the point before the shutter closes
 * In:  labels of the frame by the same trace_input; receiver k is that of entity receiver_entity[k], an index
 * Err: ERR_MEMORY; motion may have been initialized */
bool motion_trace(struct image *motion, const struct trace_input *in, const size_t *receiver_entity,
                  const struct frame_labels *labels, const struct motion_input *move, struct error *err);

#endif

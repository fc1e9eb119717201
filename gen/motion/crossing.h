/* Where tracks come so near that two bodies could touch: first come, first served.
 *
 * A crossing is a stretch of one track, against stretches of others. Who is in it holds it, and while it is
 * held nobody may enter one that it is against. So bodies of different tracks never meet. */
#ifndef STAFFAGE_GEN_CROSSING_H
#define STAFFAGE_GEN_CROSSING_H

#include "gen/motion/track.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

#define STANDING_GAP_M 2.0   /* between vehicles that stand */

struct crossing {
    double from_m, to_m;
    size_t *against;         /* (against_count) indices of crossings; itself: one at a time */
    size_t against_count;
    size_t holders;
};
struct crossings { struct crossing *at; size_t count; };

/* The largest body of a use. */
struct body_size { double length_m, width_m; };

/* Find where bodies of these sizes could touch. A track that only ends on another is cut back
 * to where it is clear of it. Tracks' crossing_first and crossing_count are set.
 * In:  largest  of enum road_use */
bool crossings_find(struct crossings *crossings, struct track *tracks, size_t track_count,
                    const struct body_size largest[2], struct error *err);
void crossings_release(struct crossings *crossings);

struct crowd;
struct body;
/* One that appears where it stands: false if it would be in a crossing that it cannot have.
 * On success it holds the crossing that it is in. */
bool crossing_appear(struct crowd *crowd, struct body *body);
/* Give up what lies behind, ask for what comes. Before each step. */
void crossings_settle(struct crowd *crowd);
/* Give up everything: before a body goes. */
void crossing_leave(struct crowd *crowd, struct body *body);
/* How far the body may go on from here: to the crossing that it may not enter, INFINITY if none is near. */
double crossing_room(const struct crowd *crowd, const struct body *body);

#endif

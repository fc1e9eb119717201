/* Who comes into the crowd, where and with which wishes. */
#ifndef STAFFAGE_GEN_POPULATION_H
#define STAFFAGE_GEN_POPULATION_H

#include "gen/motion/crowd.h"
#include "gen/motion/traffic.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What stays with one for life. */
struct character { struct body body; size_t kind; int color; double phase; };

/* As long as the longest and as wide as the widest of a use. */
struct body_size largest_of(const struct traffic_options *options, bool is_person);

/* Draw the n-th (from 0) of all: kind, colour and wishes; not yet on a track. */
struct character character_draw(const struct traffic_options *options, uint32_t n, bool is_person);

/* Fill the crowd (with room for all) with those who are about at the beginning, spread over the tracks.
 * Out: characters (vehicle_count + people_count), the crowd's bodies are theirs
 * Err: ERR_INPUT: no track for one of the uses; not all of them fit */
bool population_begin(struct crowd *crowd, struct character *characters, const struct traffic_options *options,
                      struct error *err);
/* Let one more come in at an end of a track, where there is room. False if there is none. */
bool population_add(struct crowd *crowd, struct character *character, const struct traffic_options *options);

#endif

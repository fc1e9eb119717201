/* What the tags of an OpenStreetMap way say of a road, and what is taken where they say nothing. */
#ifndef STAFFAGE_GEN_ROAD_TAGS_H
#define STAFFAGE_GEN_ROAD_TAGS_H

#include "gen/world/osm.h"
#include "gen/world/road.h"

#include <stdbool.h>

struct road_traits {
    enum road_use use;
    double width_m;               /* without sidewalks */
    int forward, backward;        /* lanes for vehicles */
    double limit_m_s[2];          /* forward, backward; 0: none is known */
    double sidewalk_m;            /* 0: none */
    bool walk_left, walk_right;   /* which sides have one */
};

/* False where nobody is to drive or walk: areas, tunnels, what is under construction or closed, steps,
 * cycleways, crossings (people on them would walk through the traffic). A tag that cannot be read
 * ("width=narrow") counts as none: maps are full of them. */
bool road_traits(struct road_traits *traits, const struct osm_way *way, const struct road_rules *rules);

#endif

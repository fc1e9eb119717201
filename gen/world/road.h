/* Roads and footways: curves with lanes, from OpenStreetMap or by hand. */
#ifndef STAFFAGE_GEN_ROAD_H
#define STAFFAGE_GEN_ROAD_H

#include "gen/light/sun.h"
#include "gen/world/path.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

enum road_use { ROAD_VEHICLES, ROAD_PEOPLE };
enum driving_side { DRIVE_RIGHT, DRIVE_LEFT };

/* Where one follows another. Vehicles' lanes lie on the road; people's are a footway's or sidewalk's whole
 * width, walked in both directions. */
struct lane {
    enum road_use use;
    double offset_m;         /* of its centre, to the left of the way's direction */
    double width_m;
    bool backward;           /* driven against the way's direction */
    double speed_limit_m_s;  /* 0: none is known */
};

struct way {
    char *name;              /* the user's name, the street's, or "way/100" */
    enum road_use use;
    struct path path;
    double width_m;          /* carriageway or footway, without sidewalks */
    double sidewalk_m;       /* width of the sidewalks left and right, 0: none */
    struct lane *lanes;      /* (lane_count) from left to right */
    size_t lane_count;
};

struct road_network { struct way *ways; size_t way_count; };

/* What tags leave open. */
struct road_rules {
    enum driving_side side;
    double sidewalk_m;       /* width of a sidewalk where the map has one, and along residential streets */
    struct geodetic origin;  /* of the world */
    double north_rad;        /* azimuth of the world's +y */
};

/* Add the roads and footways of an .osm or .osm.pbf file (readosm) that come within `keep` (min, max
 * corners, world x and y): highway=* with width, lanes, lanes:forward/backward, oneway, maxspeed,
 * sidewalk; areas, tunnels, things under construction and steps are left out.
 * Err: ERR_INPUT at path: not readable as OSM, a way without nodes, a way whose node is not in the
 *      file, no road at all within keep */
bool roads_read_osm(struct road_network *roads, const char *path, const struct road_rules *rules,
                    const struct vec2 keep[2], struct error *err);
/* Add one by hand: for vehicles one lane a direction (lanes <= 2 of width_m / lanes), for people the whole width.
 * In:  point_m (n) world */
bool roads_add(struct road_network *roads, const char *name, enum road_use use, const struct vec2 *point_m, size_t n,
               double width_m, bool oneway, const struct road_rules *rules, struct error *err);
void roads_release(struct road_network *roads);
/* Take a way out; those behind it move up. */
void roads_drop(struct road_network *roads, size_t way);

#endif

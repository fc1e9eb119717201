#include "gen/world/road_tags.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FOOT_M 0.3048
#define TAGGED_LANE_M 3.0   /* of a road whose lanes are counted and whose width is not told */
#define NARROWEST_LANE_M 2.25 /* a two-way road that has not twice this is one lane */

/* Widths where the map has none. Lanes of vehicles: within the ranges for freeways (3.6 m), arterials
 * (3.0 to 3.6), collectors (3.0 to 3.6) and local roads (2.7 to 3.6) of FHWA-SA-07-011, Mitigation
 * Strategies for Design Exceptions, table 3; their number: the assumptions of the OpenStreetMap wiki,
 * Key:lanes. Footways: 1.5 m, where two can pass (FHWA, Designing Sidewalks and Trails for Access). */
static const struct kind {
    const char *highway;
    enum road_use use;
    int lanes;      /* both directions together; 1: one car's width */
    double lane_m;  /* of people: the whole width */
    bool oneway;
} kinds[] = {
    { "motorway", ROAD_VEHICLES, 4, 3.6, true },
    { "motorway_link", ROAD_VEHICLES, 2, 3.6, true },
    { "trunk", ROAD_VEHICLES, 2, 3.6, false },
    { "trunk_link", ROAD_VEHICLES, 2, 3.6, false },
    { "primary", ROAD_VEHICLES, 2, 3.3, false },
    { "primary_link", ROAD_VEHICLES, 2, 3.3, false },
    { "secondary", ROAD_VEHICLES, 2, 3.3, false },
    { "secondary_link", ROAD_VEHICLES, 2, 3.3, false },
    { "tertiary", ROAD_VEHICLES, 2, 3.0, false },
    { "tertiary_link", ROAD_VEHICLES, 2, 3.0, false },
    { "unclassified", ROAD_VEHICLES, 2, 2.7, false },
    { "residential", ROAD_VEHICLES, 2, 2.7, false },
    { "living_street", ROAD_VEHICLES, 2, 2.7, false },
    { "road", ROAD_VEHICLES, 2, 2.7, false },
    { "service", ROAD_VEHICLES, 1, 3.0, false },
    { "track", ROAD_VEHICLES, 1, 2.7, false },
    { "pedestrian", ROAD_PEOPLE, 0, 5.4, false },
    { "footway", ROAD_PEOPLE, 0, 1.5, false },
    { "path", ROAD_PEOPLE, 0, 1.5, false },
};

static bool is(const struct osm_way *way, const char *key, const char *value)
{
    const char *given = osm_tag(way, key);
    return given && strcmp(given, value) == 0;
}

static bool is_any(const struct osm_way *way, const char *key, const char *const *values)
{
    for (; *values; values++)
        if (is(way, key, *values)) return true;
    return false;
}

/* A number and the rest after it and its blanks; false without a number. */
static bool number(const char *text, double *value, const char **rest)
{
    if (!text || !isdigit((unsigned char)*text)) return false;
    char *end;
    *value = strtod(text, &end);
    while (*end == ' ') end++;
    *rest = end;
    return isfinite(*value);
}

/* "6", "6.5 m", "20'", "19'6\"", "20 ft": 0 where there is none or it cannot be. */
static double width(const char *text)
{
    double value, inches = 0;
    const char *unit;
    if (!number(text, &value, &unit)) return 0;
    if (*unit == '\'') {
        if (unit[1] && (!number(unit + 1, &inches, &unit) || strcmp(unit, "\"") != 0)) return 0;
        value = (value + inches / 12) * FOOT_M;
    } else if (!strcmp(unit, "ft")) value *= FOOT_M;
    else if (*unit && strcmp(unit, "m") != 0) return 0;
    return value >= 0.5 && value <= 100 ? value : 0;
}

/* "50", "50 km/h", "30 mph", "10 knots", "walk" (7 km/h); "none" and what varies is no limit. */
static double limit(const char *text)
{
    double value;
    const char *unit;
    if (text && !strcmp(text, "walk")) return 7 / 3.6;
    if (!number(text, &value, &unit)) return 0;
    if (!*unit || !strcmp(unit, "km/h") || !strcmp(unit, "kmh")) return value / 3.6;
    if (!strcmp(unit, "mph")) return value * 0.44704;
    return strcmp(unit, "knots") ? 0 : value * 1852 / 3600;
}

/* A count of lanes; -1 where there is none. Halves ("1.5": a wide lane) are cut. */
static int count(const char *text)
{
    double value;
    const char *rest;
    return number(text, &value, &rest) && !*rest && value <= 16 ? (int)value : -1;
}

/* 1: only with the way's direction, -1: only against it, 0: both. */
static int direction(const struct osm_way *way, const struct kind *kind)
{
    if (is_any(way, "oneway", (const char *const[]){ "-1", "reverse", NULL })) return -1;
    /* Of those that change with the hour one direction is taken: nobody meets there head on. */
    if (is_any(way, "oneway", (const char *const[]){ "yes", "true", "1", "reversible", "alternating", NULL })) return 1;
    if (osm_tag(way, "oneway")) return 0;
    return kind->oneway || is_any(way, "junction", (const char *const[]){ "roundabout", "circular", NULL });
}

static void lanes_and_width(struct road_traits *traits, const struct osm_way *way, const struct kind *kind)
{
    int total = count(osm_tag(way, "lanes")), oneway = direction(way, kind);
    int forward = count(osm_tag(way, "lanes:forward")), backward = count(osm_tag(way, "lanes:backward"));
    int middle = count(osm_tag(way, "lanes:both_ways")); /* to turn from: nobody drives along it */
    middle = middle > 0 ? middle : 0;
    if (total < 1 && forward >= 0 && backward >= 0) total = forward + backward + middle;
    double wide = width(osm_tag(way, "width:carriageway"));
    if (wide <= 0) wide = width(osm_tag(way, "width"));
    if (wide <= 0) wide = width(osm_tag(way, "est_width"));
    if (wide <= 0 && total > 0) wide = total * TAGGED_LANE_M;
    if (total < 1) {
        total = oneway ? (kind->lanes + 1) / 2 : kind->lanes;
        if (wide <= 0) wide = total * kind->lane_m;
        if (!oneway && total < 3) total = wide >= 2 * NARROWEST_LANE_M ? 2 : 1;
    }
    traits->width_m = wide;
    int usable = total - middle > 0 ? total - middle : 1;
    if (oneway > 0) traits->forward = usable;
    else if (oneway < 0) traits->backward = usable;
    else {
        /* The odd lane of a two-way road goes with the way; so does the only one. */
        if (forward < 0) forward = backward >= 0 && backward <= usable ? usable - backward : (usable + 1) / 2;
        if (forward > usable) forward = usable;
        traits->forward = forward;
        traits->backward = usable - forward;
    }
    double both = limit(osm_tag(way, "maxspeed"));
    double with = limit(osm_tag(way, "maxspeed:forward")), against = limit(osm_tag(way, "maxspeed:backward"));
    traits->limit_m_s[0] = with > 0 ? with : both;
    traits->limit_m_s[1] = against > 0 ? against : both;
}

static void sidewalks(struct road_traits *traits, const struct osm_way *way, const struct road_rules *rules)
{
    const char *all = osm_tag(way, "sidewalk:both");
    const char *left = osm_tag(way, "sidewalk:left"), *right = osm_tag(way, "sidewalk:right");
    if (!all) all = osm_tag(way, "sidewalk");
    if (!all && !left && !right) {
        traits->walk_left = traits->walk_right = is(way, "highway", "residential");
    } else {
        bool both = all && (!strcmp(all, "both") || !strcmp(all, "yes"));
        /* "separate": drawn as a way of its own. */
        traits->walk_left = left ? !strcmp(left, "yes") : both || (all && !strcmp(all, "left"));
        traits->walk_right = right ? !strcmp(right, "yes") : both || (all && !strcmp(all, "right"));
    }
    if (!traits->walk_left && !traits->walk_right) return;
    double wide = width(osm_tag(way, "sidewalk:both:width"));
    if (wide <= 0) wide = width(osm_tag(way, "sidewalk:width"));
    traits->sidewalk_m = wide > 0 ? wide : rules->sidewalk_m;
    if (traits->sidewalk_m <= 0) traits->walk_left = traits->walk_right = false;
}

static bool is_closed(const struct osm_way *way, enum road_use use)
{
    static const char *const no[] = { "no", NULL };
    const char *tunnel = osm_tag(way, "tunnel");
    if ((tunnel && strcmp(tunnel, "no")) || is(way, "area", "yes") || is(way, "indoor", "yes")) return true;
    if (use == ROAD_PEOPLE) return is_any(way, "foot", no) || is(way, "footway", "crossing");
    return is_any(way, "access", no) || is_any(way, "vehicle", no) || is_any(way, "motor_vehicle", no);
}

bool road_traits(struct road_traits *traits, const struct osm_way *way, const struct road_rules *rules)
{
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        if (!is(way, "highway", kinds[i].highway)) continue;
        struct road_traits found = { .use = kinds[i].use };
        if (is_closed(way, found.use)) return false;
        if (found.use == ROAD_VEHICLES) {
            lanes_and_width(&found, way, &kinds[i]);
            sidewalks(&found, way, rules);
        } else {
            double wide = width(osm_tag(way, "width"));
            found.width_m = wide > 0 ? wide : kinds[i].lane_m;
        }
        *traits = found;
        return true;
    }
    return false;
}

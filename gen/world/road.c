#include "gen/world/road.h"

#include "gen/world/osm.h"
#include "gen/world/road_tags.h"
#include "lib/file.h"
#include "lib/place.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SHORTEST_PIECE_M 1.0 /* what is cut off shorter at the rectangle's edge is no road */

static void walk(struct way *way, double middle_m, double width_m)
{
    way->lanes[way->lane_count++] = (struct lane){ .use = ROAD_PEOPLE, .offset_m = middle_m, .width_m = width_m };
}

/* The lanes from left to right. */
static bool lanes_create(struct way *way, const struct road_traits *traits, enum driving_side side)
{
    int drive = traits->forward + traits->backward;
    way->lanes = calloc((size_t)drive + 2, sizeof *way->lanes);
    if (!way->lanes) return false;
    double aside = (way->width_m + way->sidewalk_m) / 2;
    if (way->use == ROAD_PEOPLE) walk(way, 0, way->width_m);
    if (traits->walk_left) walk(way, aside, way->sidewalk_m);
    for (int i = 0; i < drive; i++) {
        bool backward = side == DRIVE_RIGHT ? i < traits->backward : i >= traits->forward;
        way->lanes[way->lane_count++] = (struct lane){
            .use = ROAD_VEHICLES, .width_m = way->width_m / drive, .backward = backward,
            .offset_m = way->width_m / 2 - (i + 0.5) * way->width_m / drive,
            .speed_limit_m_s = traits->limit_m_s[backward],
        };
    }
    if (traits->walk_right) walk(way, -aside, way->sidewalk_m);
    return true;
}

static void way_release(struct way *way)
{
    free(way->name);
    free(way->lanes);
    path_release(&way->path);
}

static bool add(struct road_network *roads, const char *name, const struct vec2 *point_m, size_t n,
                const struct road_traits *traits, enum driving_side side, struct error *err)
{
    struct way way = { .name = strdup(name), .use = traits->use, .width_m = traits->width_m,
                       .sidewalk_m = traits->sidewalk_m };
    if (!path_create(&way.path, point_m, n, err)) {
        error_prefix(err, "%s: ", name);
        goto fail;
    }
    struct way *ways = realloc(roads->ways, (roads->way_count + 1) * sizeof *ways);
    if (ways) roads->ways = ways;
    if (!ways || !way.name || !lanes_create(&way, traits, side)) {
        error_set(err, ERR_MEMORY, "no memory for the road %s", name);
        goto fail;
    }
    ways[roads->way_count++] = way;
    return true;
fail:
    way_release(&way);
    return false;
}

bool roads_add(struct road_network *roads, const char *name, enum road_use use, const struct vec2 *point_m, size_t n,
               double width_m, bool oneway, const struct road_rules *rules, struct error *err)
{
    if (!(width_m > 0 && isfinite(width_m)))
        return error_set(err, ERR_INPUT, "%s: width %.9g m; a road or footway is wider than 0", name, width_m);
    struct road_traits traits = { .use = use, .width_m = width_m };
    if (use == ROAD_VEHICLES) {
        traits.forward = 1;
        traits.backward = !oneway;
    }
    return add(roads, name, point_m, n, &traits, rules->side, err);
}

void roads_release(struct road_network *roads)
{
    for (size_t i = 0; i < roads->way_count; i++) way_release(&roads->ways[i]);
    free(roads->ways);
    *roads = (struct road_network){ 0 };
}

void roads_drop(struct road_network *roads, size_t way)
{
    way_release(&roads->ways[way]);
    roads->way_count--;
    memmove(&roads->ways[way], &roads->ways[way + 1], (roads->way_count - way) * sizeof *roads->ways);
}

/* The part of the segment within the rectangle, as parts of its way from a to b. */
static bool clip(const struct vec2 keep[2], struct vec2 a, struct vec2 b, double *from, double *to)
{
    double start[2] = { a.x, a.y }, step[2] = { b.x - a.x, b.y - a.y };
    double low[2] = { keep[0].x, keep[0].y }, high[2] = { keep[1].x, keep[1].y };
    *from = 0;
    *to = 1;
    for (int axis = 0; axis < 2; axis++) {
        double near = (low[axis] - start[axis]) / step[axis], far = (high[axis] - start[axis]) / step[axis];
        if (step[axis] == 0) {
            if (start[axis] < low[axis] || start[axis] > high[axis]) return false;
            continue;
        }
        *from = fmax(*from, fmin(near, far));
        *to = fmin(*to, fmax(near, far));
    }
    return *from < *to;
}

static double polyline_length(const struct vec2 *p, size_t n)
{
    double length = 0;
    for (size_t i = 1; i < n; i++) length += hypot(p[i].x - p[i - 1].x, p[i].y - p[i - 1].y);
    return length;
}

/* Add what lies within keep: a road that comes back in is one piece more. */
static bool add_clipped(struct road_network *roads, const char *name, const struct vec2 *point_m, size_t n,
                        const struct road_traits *traits, enum driving_side side, const struct vec2 keep[2],
                        struct error *err)
{
    struct vec2 *piece = malloc(2 * n * sizeof *piece);
    if (!piece) return error_set(err, ERR_MEMORY, "no memory for the road %s", name);
    size_t count = 0;
    bool good = true;
    for (size_t i = 0; good && i + 1 < n; i++) {
        struct vec2 a = point_m[i], b = point_m[i + 1];
        double from, to;
        if (clip(keep, a, b, &from, &to)) {
            if (count == 0) piece[count++] = (struct vec2){ a.x + from * (b.x - a.x), a.y + from * (b.y - a.y) };
            piece[count++] = (struct vec2){ a.x + to * (b.x - a.x), a.y + to * (b.y - a.y) };
            if (to >= 1 && i + 2 < n) continue;
        }
        if (polyline_length(piece, count) >= SHORTEST_PIECE_M)
            good = add(roads, name, piece, count, traits, side, err);
        count = 0;
    }
    free(piece);
    return good;
}

/* ENU east and north to the world's axes, whose +y has the azimuth north_rad. */
static bool world_from_node(struct vec2 *p_m, const struct osm_node *node, const struct road_rules *rules,
                            struct error *err)
{
    const double deg = 180 / M_PI;
    double origin[3] = { rules->origin.latitude_rad * deg, rules->origin.longitude_rad * deg, rules->origin.height_m };
    double place[3] = { node->latitude_deg, node->longitude_deg, rules->origin.height_m }, enu[3];
    if (!place_enu_from_geodetic(enu, origin, place, err)) return false;
    double c = cos(rules->north_rad), s = sin(rules->north_rad);
    *p_m = (struct vec2){ c * enu[0] - s * enu[1], s * enu[0] + c * enu[1] };
    return true;
}

static bool add_osm_way(struct road_network *roads, const struct osm *osm, const struct osm_way *way,
                        const struct road_rules *rules, const struct vec2 keep[2], struct error *err)
{
    struct road_traits traits;
    if (!road_traits(&traits, way, rules)) return true;
    const char *tagged = osm_tag(way, "name");
    char *name = tagged ? strdup(tagged) : string_format("way/%" PRId64, way->id);
    struct vec2 *point_m = malloc(way->node_count * sizeof *point_m);
    bool good = name && point_m;
    if (!good) error_set(err, ERR_MEMORY, "no memory for way %" PRId64, way->id);
    for (size_t i = 0; good && i < way->node_count; i++)
        good = world_from_node(&point_m[i], osm_node(osm, way->node_ids[i]), rules, err);
    good = good && add_clipped(roads, name, point_m, way->node_count, &traits, rules->side, keep, err);
    free(point_m);
    free(name);
    return good;
}

bool roads_read_osm(struct road_network *roads, const char *path, const struct road_rules *rules,
                    const struct vec2 keep[2], struct error *err)
{
    struct osm osm;
    if (!osm_read(&osm, path, err)) return false;
    struct road_network found = { 0 };
    bool good = true;
    for (size_t i = 0; good && i < osm.way_count; i++) good = add_osm_way(&found, &osm, &osm.ways[i], rules, keep, err);
    if (good && found.way_count == 0)
        good = error_at(err, ERR_INPUT, path, 0, 0,
                        "no road or footway of it comes within x %.0f to %.0f m, y %.0f to %.0f m of the scene's "
                        "origin (%zu highways in all)", keep[0].x, keep[1].x, keep[0].y, keep[1].y, osm.way_count);
    struct way *ways = good ? realloc(roads->ways, (roads->way_count + found.way_count) * sizeof *ways) : NULL;
    if (good && !ways) good = error_set(err, ERR_MEMORY, "no memory for the roads of %s", path);
    if (good) {
        roads->ways = ways;
        memcpy(ways + roads->way_count, found.ways, found.way_count * sizeof *ways);
        roads->way_count += found.way_count;
        free(found.ways);
        found = (struct road_network){ 0 };
    }
    roads_release(&found);
    osm_release(&osm);
    return good;
}

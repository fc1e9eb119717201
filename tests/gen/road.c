#include "gen/world/road.h"

#include "lib/file.h"
#include "tests/tap.h"

#include <stdint.h>
#include <unistd.h>

/* tests/input/town.osm was written by hand, in metres around 50 N 10 E (a degree of latitude there is
 * 111229.03 m, of longitude 71695.73 m: the series of the WGS 84 ellipsoid). town.osm.pbf is the same:
 *     osmium cat town.osm -o town.osm.pbf */
#define DEG (M_PI / 180)
static const struct vec2 town_keep[2] = { { -100, -100 }, { 100, 100 } };
static struct road_rules town_rules(enum driving_side side)
{
    return (struct road_rules){ .side = side, .sidewalk_m = 1.5, .origin = { 50 * DEG, 10 * DEG, 0 } };
}

static char *input(const char *name)
{
    return string_format("%s/tests/input/%s", getenv("top_srcdir"), name);
}

static const struct way *named(const struct road_network *roads, const char *name)
{
    for (size_t i = 0; i < roads->way_count; i++)
        if (!strcmp(roads->ways[i].name, name)) return &roads->ways[i];
    static const struct way none = { 0 };
    return &none;
}

/* The lanes as text: v and p for vehicles and people, > and < with and against the way, offsets in mm. */
static const char *lanes(const struct way *way)
{
    static char text[400];
    size_t used = 0;
    text[0] = 0;
    for (size_t i = 0; i < way->lane_count; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%c%c%.0f", i ? " " : "",
                                 way->lanes[i].use == ROAD_PEOPLE ? 'p' : 'v', way->lanes[i].backward ? '<' : '>',
                                 1000 * way->lanes[i].offset_m);
    return text;
}

#define LANES(way, want) \
    do { \
        const char *lanes_got = lanes(way); \
        if (!OK(!strcmp(lanes_got, want), "%s", want)) printf("# got  %s\n", lanes_got); \
    } while (0)

static void check_town(const struct road_network *roads)
{
    OK(roads->way_count == 11, "steps, tunnels, areas, crossings, works, and what is far away are left out (%zu ways)",
       roads->way_count);
    const struct way *way = named(roads, "Main Street");
    OK(way->use == ROAD_VEHICLES && way->path.n > 0, "a street has its own name");
    NEAR(way->width_m, 5.4, 1e-9, "a residential street without a width is two lanes of 2.7 m");
    NEAR(path_length(&way->path), 160, 0.01, "160 m along the parallel are 160 m");
    NEAR(way->path.point_m[0].x, -80, 0.01, "it begins in the west");
    NEAR(way->path.point_m[0].y, 0, 0.01, "and on the origin's parallel");
    LANES(way, "p>3450 v<1350 v>-1350 p>-3450");
    NEAR(way->lanes[2].speed_limit_m_s, 13.4112, 1e-9, "30 mph are 13.4112 m/s");
    NEAR(way->sidewalk_m, 1.5, 0, "along a residential street there are sidewalks");

    way = named(roads, "way/2");
    NEAR(way->width_m, 9, 0, "three lanes without a width are 9 m");
    LANES(way, "v<3000 v>0 v>-3000 p>-5250");
    NEAR(way->lanes[0].speed_limit_m_s, 50 / 3.6, 1e-9, "50 without a unit are km/h");

    way = named(roads, "way/3");
    LANES(way, "v<0");
    NEAR(way->width_m, 4.5, 0, "a width is a width");
    NEAR(way->lanes[0].speed_limit_m_s, 0, 0, "no limit is none");

    way = named(roads, "way/4");
    LANES(way, "v>0");
    NEAR(path_length(&way->path), 2 * M_PI * 12, 0.4, "eight points about a roundabout make a circle");
    struct path_point start = path_at(&way->path, 0, 0), end = path_at(&way->path, path_length(&way->path), 0);
    NEAR(hypot(start.p_m.x - end.p_m.x, start.p_m.y - end.p_m.y), 0, 1e-6, "and it closes");

    way = named(roads, "way/5");
    OK(way->use == ROAD_PEOPLE, "a footway is for people");
    NEAR(way->width_m, 2, 0, "as wide as its tag says");
    LANES(way, "p>0");

    way = named(roads, "way/12");
    LANES(way, "v>0");
    NEAR(way->width_m, 3, 0, "a service road is one lane, that goes with the way: nobody meets head on");
    way = named(roads, "way/13");
    LANES(way, "v>1800 v>-1800");
    way = named(roads, "way/14");
    NEAR(way->width_m, 6.096, 1e-9, "20' are 6.096 m");
    NEAR(way->sidewalk_m, 2.5, 0, "a sidewalk's own width");
    LANES(way, "p>4298 v<1524 v>-1524");
    way = named(roads, "way/15");
    NEAR(way->width_m, 5.4, 1e-9, "a width that is no number is none");
    LANES(way, "v<1350 v>-1350");
    NEAR(way->lanes[0].speed_limit_m_s, 10 * 1852 / 3600., 1e-9, "10 knots against the way");
    NEAR(way->lanes[1].speed_limit_m_s, 0, 0, "and nothing is known with it");

    size_t pieces = 0;
    double length = 0;
    bool within = true;
    for (size_t i = 0; i < roads->way_count; i++) {
        if (strcmp(roads->ways[i].name, "way/16")) continue;
        pieces++;
        length += path_length(&roads->ways[i].path);
        for (size_t k = 0; k < roads->ways[i].path.n; k++) within = within && roads->ways[i].path.point_m[k].y <= 100.5;
    }
    OK(pieces == 2, "a road that leaves the rectangle and comes back is two pieces");
    /* (-100, 80) (-90, 80) to (-54, 100), which is 2/5 of the leg to (0, 130), and its mirror image */
    NEAR(length, 2 * (10 + 0.4 * hypot(90, 50)), 0.6, "cut at the rectangle's edge");
    OK(within, "and not beyond");
}

static void check_formats(void)
{
    struct error err = ERROR_NONE;
    struct road_network xml = { 0 }, pbf = { 0 };
    struct road_rules rules = town_rules(DRIVE_RIGHT);
    char *path[2] = { input("town.osm"), input("town.osm.pbf") };
    if (!OK(roads_read_osm(&xml, path[0], &rules, town_keep, &err), "XML is read")) printf("# %s\n", err.text);
    if (!OK(roads_read_osm(&pbf, path[1], &rules, town_keep, &err), "PBF is read")) printf("# %s\n", err.text);
    check_town(&xml);
    bool same = xml.way_count == pbf.way_count;
    double worst = 0;
    for (size_t i = 0; same && i < xml.way_count; i++) {
        const struct way *a = &xml.ways[i], *b = &pbf.ways[i];
        same = !strcmp(a->name, b->name) && a->path.n == b->path.n && a->lane_count == b->lane_count
               && a->width_m == b->width_m && a->sidewalk_m == b->sidewalk_m
               && !memcmp(a->lanes, b->lanes, a->lane_count * sizeof *a->lanes);
        for (size_t k = 0; same && k < a->path.n; k++)
            worst = fmax(worst, hypot(a->path.point_m[k].x - b->path.point_m[k].x, a->path.point_m[k].y - b->path.point_m[k].y));
    }
    OK(same && xml.way_count > 0, "XML and PBF of one map make the same network");
    NEAR(worst, 0, 1e-6, "point by point");
    roads_release(&pbf);
    roads_release(&xml);

    rules = town_rules(DRIVE_LEFT);
    OK(roads_read_osm(&xml, path[0], &rules, town_keep, &err), "the same town where people drive on the left");
    LANES(named(&xml, "Main Street"), "p>3450 v>1350 v<-1350 p>-3450");
    LANES(named(&xml, "way/2"), "v>3000 v>0 v<-3000 p>-5250");
    roads_release(&xml);

    rules = town_rules(DRIVE_RIGHT);
    rules.north_rad = 90 * DEG; /* +y is east, +x south */
    rules.sidewalk_m = 0;
    OK(roads_read_osm(&xml, path[0], &rules, town_keep, &err), "a world whose +y is east");
    const struct way *way = named(&xml, "way/12");
    NEAR(way->path.point_m[0].x, 20, 0.01, "what lies 20 m south is at x = 20");
    NEAR(way->path.point_m[0].y, -80, 0.01, "what lies 80 m west is at y = -80");
    LANES(named(&xml, "Main Street"), "v<1350 v>-1350");
    roads_release(&xml);
    free(path[0]);
    free(path[1]);
}

static char scratch[200];

/* Reads what is written into a file of this name: the message, or "read". */
static const char *said(const char *name, const char *text, size_t size)
{
    static struct error err;
    err = ERROR_NONE;
    char *path = string_format("%s/%s", scratch, name);
    FILE *f = fopen(path, "wb");
    fwrite(text, 1, size, f);
    fclose(f);
    struct road_network roads = { 0 };
    struct road_rules rules = town_rules(DRIVE_RIGHT);
    bool good = roads_read_osm(&roads, path, &rules, town_keep, &err);
    static char message[1200];
    snprintf(message, sizeof message, "%d: %s", err.line, good ? "read" : err.text);
    bool at_path = good || (err.code == ERR_INPUT && !strcmp(err.file, path));
    if (!at_path) snprintf(message, sizeof message, "not an error of the input at its path");
    OK(good || (roads.way_count == 0 && !roads.ways), "%s: nothing comes out with an error", name);
    roads_release(&roads);
    unlink(path);
    free(path);
    return message;
}

#define SAYS(name, text, want) \
    do { \
        const char *said_got = said(name, text, strlen(text)); \
        if (!OK(!strcmp(said_got, want), "%s", want)) printf("# got  %s\n", said_got); \
    } while (0)

#define NODES "<osm>\n<node id='1' lat='50' lon='10'/>\n<node id='2' lat='50.0005' lon='10'/>\n<node id='3' lat='95' lon='10'/>\n"
#define ROAD "<tag k='highway' v='residential'/></way>\n"

static void check_refused(void)
{
    snprintf(scratch, sizeof scratch, "road-test.XXXXXX");
    if (!OK(mkdtemp(scratch) != NULL, "a scratch folder")) return;
    SAYS("good.osm", NODES "<way id='7'><nd ref='1'/><nd ref='2'/>" ROAD "</osm>", "0: read");
    SAYS("ways-first.osm", "<osm><way id='7'><nd ref='1'/><nd ref='2'/>" ROAD
         "<node id='2' lat='50' lon='10'/><node id='1' lat='50.0005' lon='10'/></osm>", "0: read");
    SAYS("no-nodes.osm", NODES "<way id='6'><nd ref='1'/><nd ref='2'/>" ROAD "<way id='7'>" ROAD "</osm>",
         "6: way 7 has no nodes: a way is a line through 2 or more");
    SAYS("one-node.osm", NODES "<way id='7'><nd ref='2'/>" ROAD "</osm>",
         "5: way 7 has one node, 2: a way is a line through 2 or more");
    SAYS("node-not-there.osm", NODES "<way id='7'><nd ref='1'/><nd ref='8'/>" ROAD "</osm>",
         "5: way 7 names node 8, which the file does not have: extract the area with whole ways");
    SAYS("node-off-the-earth.osm", NODES "<way id='7'><nd ref='1'/><nd ref='3'/>" ROAD "</osm>",
         "5: way 7 names node 3, which has no place: lat is -90 to 90 and lon -180 to 180 deg");
    SAYS("cut-off.osm", NODES "<way id='7'><nd ref='1'/><nd ref='2'/>" ROAD,
         "0: not XML, or cut off: the XML of OpenStreetMap ends with </osm>");
    SAYS("empty.osm", "", "0: not XML, or cut off: the XML of OpenStreetMap ends with </osm>");
    SAYS("page.osm", "<html><body/></html>", "0: no node is in it: this is no map of OpenStreetMap");
    SAYS("elsewhere.osm", "<osm><node id='1' lat='51' lon='10'/><node id='2' lat='51.001' lon='10'/>"
         "<way id='7'><nd ref='1'/><nd ref='2'/>" ROAD "</osm>",
         "0: no road or footway of it comes within x -100 to 100 m, y -100 to 100 m of the scene's origin (1 highways in all)");
    SAYS("map.xml", NODES "</osm>", "0: a map is told by its name: .osm is OpenStreetMap XML, .osm.pbf the binary form");

    char *path = input("town.osm.pbf"), *data;
    size_t size;
    struct error err = ERROR_NONE;
    if (!OK(file_read(&data, &size, path, &err), "the PBF file")) return;
    bool refused = true;
    for (size_t cut = 1; cut < size; cut += 37) refused = refused && strcmp(said("cut.osm.pbf", data, size - cut), "0: read");
    OK(refused, "a PBF file is refused wherever it is cut off");
    OK(!strcmp(said("whole.osm.pbf", data, size), "0: read"), "and read when it is whole");
    data[size - 60] = (char)(data[size - 60] ^ 0x40);
    OK(strcmp(said("damaged.osm.pbf", data, size), "0: read"), "a damaged one is refused");
    free(data);
    free(path);
    rmdir(scratch);

    struct road_network roads = { 0 };
    struct road_rules rules = town_rules(DRIVE_RIGHT);
    OK(!roads_read_osm(&roads, "no-such.osm", &rules, town_keep, &err) && !strcmp(err.text, "there is no such file"),
       "a file that is not there");
}

static void check_by_hand(void)
{
    struct error err = ERROR_NONE;
    struct road_network roads = { 0 };
    struct road_rules rules = town_rules(DRIVE_RIGHT);
    struct vec2 p[3] = { { 0, 0 }, { 30, 0 }, { 30, 30 } };
    OK(roads_add(&roads, "street", ROAD_VEHICLES, p, 3, 6, false, &rules, &err), "a street by hand");
    LANES(&roads.ways[0], "v<1500 v>-1500");
    OK(roads_add(&roads, "ramp", ROAD_VEHICLES, p, 3, 4, true, &rules, &err), "a one-way street");
    LANES(&roads.ways[1], "v>0");
    OK(roads_add(&roads, "walk", ROAD_PEOPLE, p, 3, 2, false, &rules, &err), "a footway");
    LANES(&roads.ways[2], "p>0");
    OK(!roads_add(&roads, "dot", ROAD_PEOPLE, p, 1, 2, false, &rules, &err) && roads.way_count == 3
       && !strncmp(err.text, "dot: ", 5), "a path of one point is refused by its name");
    err = ERROR_NONE;
    OK(!roads_add(&roads, "thread", ROAD_PEOPLE, p, 3, 0, false, &rules, &err) && roads.way_count == 3, "so is a width of 0");
    roads_release(&roads);
}

static void check_brighton(void)
{
    const char *shared = tap_shared();
    if (!shared) {
        SKIP("the roads of brighton", "no shared material");
        return;
    }
    struct error err = ERROR_NONE;
    struct road_network roads = { 0 };
    struct road_rules rules = { .sidewalk_m = 0, .origin = { 46.8426 * DEG, -91.9940 * DEG, 200 } };
    const struct vec2 keep[2] = { { -200, -200 }, { 200, 200 } };
    char *path = string_format("%s/data/brighton/roads.osm", shared);
    OK(roads_read_osm(&roads, path, &rules, keep, &err) && roads.way_count == 3, "three ways");
    /* Great circles between the nodes on the sphere of 6371008.8 m; a smooth curve is a little longer than its chords. */
    const struct { const char *name; double width_m, length_m; } want[] = {
        { "way/100", 6, 84.2907 }, { "way/101", 5, 71.8018 }, { "way/102", 2, 15.9965 },
    };
    for (size_t i = 0; i < 3; i++) {
        const struct way *way = named(&roads, want[i].name);
        NEAR(way->width_m, want[i].width_m, 0, "%s is as wide as it is", want[i].name);
        if (way->path.n) NEAR(path_length(&way->path), want[i].length_m, 0.015 * want[i].length_m, "and as long");
        if (way->path.n) printf("# %s: %.2f m, chords %.2f m\n", want[i].name, path_length(&way->path), want[i].length_m);
    }
    LANES(named(&roads, "way/100"), "v<1500 v>-1500");
    LANES(named(&roads, "way/101"), "v<1250 v>-1250");
    LANES(named(&roads, "way/102"), "p>0");
    roads_release(&roads);
    free(path);
}

int main(void)
{
    check_formats();
    check_refused();
    check_by_hand();
    check_brighton();
    return tap_done();
}
